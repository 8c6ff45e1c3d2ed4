/* SPDX-License-Identifier: MIT
 *
 * The planar blur and upsampling in double precision, written from their formulas, to compare with pixel by pixel. As
 * in horizon_model.h, the result is an interval where float arithmetic could decide a threshold either way.
 */
#ifndef GLSSAO_TESTS_HORIZON_PASSES_H
#define GLSSAO_TESTS_HORIZON_PASSES_H

#include <stdbool.h>

/* Accessibility and the linear quantity of distance (1 / distance in perspective, distance in orthographic views). */
typedef struct paired_map {
    float *texels; /* three floats a texel, the third unused */
    int width, height;
} paired_map;

/* `tolerance`: scene units. */
void planar_blur_model(const paired_map *map, bool horizontal, bool orthographic, double tolerance, int x, int y,
                       double *out_low, double *out_high);

/* `own`: the full-size pixel's linear quantity. */
void upsample_model(const paired_map *half, bool orthographic, double tolerance, double own, int x, int y,
                    double *out_low, double *out_high);

#endif
