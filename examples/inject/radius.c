/* SPDX-License-Identifier: MIT
 *
 * Reads depth back and finds a radius that suits what is in view.
 */
#include "inject.h"
#include "statistics.h"

#include <GL/glcorearb.h>
#include <math.h>
#include <stdlib.h>

enum { SAMPLES = 4096 };

/* Reads the depth texture back, independent of the program's pixel pack state. The caller frees. */
static float *read_depth(GLuint texture, int width, int height)
{
    INJECT_REAL(PFNGLGETINTEGERVPROC, GetIntegerv);
    INJECT_REAL(PFNGLPIXELSTOREIPROC, PixelStorei);
    INJECT_REAL(PFNGLBINDBUFFERPROC, BindBuffer);
    INJECT_REAL(PFNGLBINDTEXTUREPROC, BindTexture);
    INJECT_REAL(PFNGLGETTEXIMAGEPROC, GetTexImage);
    static const GLenum names[] = {GL_PACK_SWAP_BYTES, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
                                   GL_PACK_ALIGNMENT};
    float *depth = malloc((size_t)width * (size_t)height * sizeof *depth);
    if (!depth)
        return NULL;
    GLint packing[5], buffer, bound;
    for (int i = 0; i < 5; ++i) {
        GetIntegerv(names[i], &packing[i]);
        PixelStorei(names[i], i == 4 ? 4 : 0);
    }
    GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer);
    GetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    BindTexture(GL_TEXTURE_2D, texture);
    GetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
    BindTexture(GL_TEXTURE_2D, (GLuint)bound);
    BindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)buffer);
    for (int i = 0; i < 5; ++i)
        PixelStorei(names[i], packing[i]);
    return depth;
}

float inject_fitting_radius(unsigned texture, int width, int height, const inject_projection *projection)
{
    const float *p = projection->matrix;
    const bool is_perspective = p[11] != 0.0f;
    float *depth = read_depth(texture, width, height);
    double distances[2 * SAMPLES];
    int count = 0;
    const size_t all = (size_t)width * (size_t)height, step = all > SAMPLES ? all / SAMPLES : 1;
    for (size_t i = 0; depth && i < all; i += step) {
        const float ndc = projection->zero_to_one ? depth[i] : 2.0f * depth[i] - 1.0f;
        const float distance = is_perspective ? p[14] / (ndc + p[10]) : (p[14] - ndc) / p[10];
        const bool is_seen = depth[i] > 0.0f && depth[i] < 1.0f; /* 0: never cleared */
        if (is_seen && isfinite(distance) && (distance > 0.0f || !is_perspective))
            distances[count++] = (double)distance;
    }
    float radius = 0.0f;
    if ((size_t)count > all / step / 200)
        radius = (is_perspective ? (float)statistics_percentile(distances, count, 50) : 1.0f) * 2.0f / p[5] / 12.0f;
    free(depth);
    return radius;
}
