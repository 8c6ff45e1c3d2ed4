/* SPDX-License-Identifier: MIT
 *
 * Error measures between a picture of accessibility and the truth, over the pixels that show something. Sums of several
 * views give each view the same weight, however many of its pixels show something.
 */
#ifndef GLSSAO_BENCH_MEASURE_H
#define GLSSAO_BENCH_MEASURE_H

#include <stddef.h>
#include <stdint.h>

/* Of each pixel: nothing is seen; a surface; a surface near an edge, where a blur could mix two surfaces. */
typedef enum pixel_class { PIXEL_NONE = 0, PIXEL_SMOOTH, PIXEL_EDGE, PIXEL_CLASSES } pixel_class;

enum { MEASURE_BINS = 2048 };

/* Picture minus truth. */
typedef struct error_sum {
    double weight, nonfinite, sum, sum2;
    double histogram[MEASURE_BINS]; /* of the absolute error, 0 to 1 */
} error_sum;

typedef struct error_measure {
    double rmse, mean, p95, nonfinite_share;
} error_measure;

void error_add(error_sum *e, const float *picture, const float *truth, const uint8_t *classes, size_t count);
/* Adds `from` scaled to a weight of 1. */
void error_merge(error_sum *e, const error_sum *from);
error_measure error_finish(const error_sum *e);

/* Which truths stand against each accessibility: enough to know the error for any exponent, to 1 / MEASURE_BINS. */
typedef struct fit_sum {
    double weight[PIXEL_CLASSES][MEASURE_BINS], picture[PIXEL_CLASSES][MEASURE_BINS];
    double truth[PIXEL_CLASSES][MEASURE_BINS], truth2[PIXEL_CLASSES][MEASURE_BINS];
} fit_sum;

void fit_add(fit_sum *f, const float *picture, const float *truth, const uint8_t *classes, size_t count);
void fit_merge(fit_sum *f, const fit_sum *from);

enum { FIT_ALL = PIXEL_CLASSES };
/* RMSE and mean error of picture^exponent, over one class of pixels or FIT_ALL. 0 where there are no such pixels. */
double fit_rmse(const fit_sum *f, double exponent, int of_class);
double fit_mean(const fit_sum *f, double exponent);
/* The exponent in 0.1 to 8 with the smallest RMSE. */
double fit_exponent(const fit_sum *f);

#endif
