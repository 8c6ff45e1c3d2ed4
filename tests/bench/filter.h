/* SPDX-License-Identifier: MIT
 *
 * Separable filters of pictures, for the measures that look at neighbourhoods.
 */
#pragma once

#include <stddef.h>

enum { FILTER_MAX_RADIUS = 32, FILTER_MAX_TAPS = 2 * FILTER_MAX_RADIUS + 1 };

typedef struct kernel {
    int radius;
    float taps[FILTER_MAX_TAPS]; /* 2 radius + 1 of them */
} kernel;

/* A Gaussian whose taps sum to 1; sigma in pixels. */
kernel kernel_gaussian(double sigma, int radius);

/* What lies outside the picture: its nearest pixel, or 0. */
typedef enum filter_edge { FILTER_REPLICATE, FILTER_ZERO } filter_edge;

/* Correlates the rows of `in` with `along_x` and the columns with `along_y`. `scratch` holds width x height values;
 * `out` may be `in`. */
void filter_picture(const float *in, int width, int height, const kernel *along_x, const kernel *along_y,
                    filter_edge edge, float *scratch, float *out);
