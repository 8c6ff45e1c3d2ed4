/* SPDX-License-Identifier: MIT
 *
 * The orthographic view of a height map from above.
 */
#include "occlude.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool occlude_look_down(const float *heights, int width, int height, float spacing, float *out_depth,
                       float out_projection[16], char *error, size_t error_size)
{
    if (width < 1 || height < 1) {
        snprintf(error, error_size, "the height map is %d x %d: want 1 x 1 or more", width, height);
        return false;
    }
    if (!(spacing > 0.0f && isfinite(spacing))) {
        snprintf(error, error_size, "spacing = %g: want a positive number", (double)spacing);
        return false;
    }
    const size_t count = (size_t)width * (size_t)height;
    double lowest = INFINITY, highest = -INFINITY;
    for (size_t i = 0; i < count; ++i)
        if (isfinite(heights[i])) {
            lowest = fmin(lowest, (double)heights[i]);
            highest = fmax(highest, (double)heights[i]);
        }
    if (lowest > highest) {
        snprintf(error, error_size, "no height is a finite number");
        return false;
    }
    /* The camera stands one spacing above the highest point, because a distance of 0 means no surface. */
    const double camera = highest + (double)spacing;
    for (size_t i = 0; i < count; ++i)
        out_depth[i] = isfinite(heights[i]) ? (float)(camera - (double)heights[i]) : 0.0f;

    const double near_plane = 0.5 * (double)spacing, far_plane = camera - lowest + (double)spacing;
    memset(out_projection, 0, 16 * sizeof *out_projection);
    out_projection[0] = (float)(2.0 / (width * (double)spacing));
    out_projection[5] = (float)(2.0 / (height * (double)spacing));
    out_projection[10] = (float)(-2.0 / (far_plane - near_plane));
    out_projection[14] = (float)(-(far_plane + near_plane) / (far_plane - near_plane));
    out_projection[15] = 1.0f;
    return true;
}
