/* SPDX-License-Identifier: MIT
 *
 * Error measures between a picture of accessibility and the truth, pixel by pixel, over the pixels that show a surface.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Of each pixel: nothing is seen; a surface; a surface near an edge, where a blur could mix two surfaces. */
typedef enum pixel_class { PIXEL_NONE = 0, PIXEL_SMOOTH, PIXEL_EDGE } pixel_class;

enum { MEASURE_BINS = 2048 };

/* Of picture minus truth. Percentiles are of the absolute error, in steps of 1 / MEASURE_BINS. */
typedef struct error_measure {
    double rmse, mean, p95, p99;
    double off_share;       /* of pixels that are off by more than 0.1 */
    double nonfinite_share; /* of pixels that are not finite; the others make up the rest of the figures */
    double smooth_rmse, edge_rmse;
} error_measure;

error_measure measure_error(const float *picture, const float *truth, const uint8_t *classes, size_t count);

/* The truths that stand against each accessibility: enough to know the RMSE for any exponent, to 1 / MEASURE_BINS. */
typedef struct fit_sum {
    double weight[MEASURE_BINS], picture[MEASURE_BINS], truth[MEASURE_BINS], truth2[MEASURE_BINS];
} fit_sum;

void fit_add(fit_sum *f, const float *picture, const float *truth, const uint8_t *classes, size_t count);
/* Adds `from` scaled to a weight of 1, so that each view counts the same, however many of its pixels show something. */
void fit_merge(fit_sum *f, const fit_sum *from);
/* RMSE of picture^exponent; 0 where there are no pixels. */
double fit_rmse(const fit_sum *f, double exponent);
/* The exponent in 0.1 to 8 with the smallest RMSE. */
double fit_exponent(const fit_sum *f);
