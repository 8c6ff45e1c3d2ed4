/* SPDX-License-Identifier: MIT
 *
 * Places each pixel in view space.
 */
#include "reach.h"

#include <math.h>

/* z in view space, which is negative in front of the camera; NaN or infinite where there is no surface. */
static double view_z(const occlude_input *input, float stored)
{
    const float *m = input->projection;
    if (!input->window_depth)
        return stored == 0.0f ? NAN : -(double)stored;
    if (stored == 0.0f || stored == 1.0f) /* one of them is the far end; nothing lies exactly on the near plane */
        return NAN;
    const double ndc = input->clip_zero_to_one ? (double)stored : 2.0 * (double)stored - 1.0;
    return (ndc * (double)m[15] - (double)m[14]) / ((double)m[10] - ndc * (double)m[11]);
}

/* Solves clip.xy = ndc * w for the x and y that lie at depth z. */
static void place(const float m[16], const double ndc[2], double z, double out[2])
{
    const double w = (double)m[11] * z + (double)m[15];
    const double a = ndc[0] * w - (double)m[8] * z - (double)m[12], b = ndc[1] * w - (double)m[9] * z - (double)m[13];
    const double determinant = (double)m[0] * (double)m[5] - (double)m[4] * (double)m[1];
    out[0] = (a * (double)m[5] - b * (double)m[4]) / determinant;
    out[1] = (b * (double)m[0] - a * (double)m[1]) / determinant;
}

reach reach_measure(const occlude_input *input)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double sum_of_scales = 0.0;
    size_t count = 0;
    for (int y = 0; y < input->height; ++y)
        for (int x = 0; x < input->width; ++x) {
            const double z = view_z(input, input->depth[(size_t)y * (size_t)input->width + (size_t)x]);
            const double ndc[2] = {2.0 * (x + 0.5) / input->width - 1.0, 1.0 - 2.0 * (y + 0.5) / input->height};
            double at[3] = {0.0, 0.0, z};
            place(input->projection, ndc, z, at);
            if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(z))
                continue;
            for (int i = 0; i < 3; ++i) {
                low[i] = fmin(low[i], at[i]);
                high[i] = fmax(high[i], at[i]);
            }
            sum_of_scales += 1.0 / fabs((double)input->projection[11] * z + (double)input->projection[15]);
            ++count;
        }
    const double extent = sqrt(pow(high[0] - low[0], 2.0) + pow(high[1] - low[1], 2.0) + pow(high[2] - low[2], 2.0));
    const double across = 0.5 * input->height * hypot((double)input->projection[4], (double)input->projection[5]);
    const double pixels = across * sum_of_scales / (double)count;
    if (count == 0 || !isfinite(extent) || !isfinite(pixels))
        return (reach){0};
    return (reach){.extent = (float)extent, .pixels_per_unit = (float)pixels};
}

float occlude_extent(const occlude_input *input)
{
    return reach_measure(input).extent;
}
