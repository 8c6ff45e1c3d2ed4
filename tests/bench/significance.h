/* SPDX-License-Identifier: MIT
 *
 * Tests whether a noisy picture is an unbiased estimate of a reference: a t-test for each pixel, with a correction for
 * testing many pixels at once. Subr and Arvo, "Statistical Hypothesis Testing for Assessing Monte Carlo Estimators",
 * Pacific Graphics 2007.
 */
#pragma once

#include <stddef.h>

/* Several independent pictures of the same thing: per pixel, sums of the values and of their squares. */
typedef struct sample_set {
    size_t pixels;
    int count;
    double *sum, *sum2;
} sample_set;

/* Starts empty, with arrays of `pixels` zeros that the caller owns. */
sample_set sample_set_begin(size_t pixels, double *sum, double *sum2);
void sample_set_add(sample_set *s, const float *picture);

/* Probability that Student's t with `freedom` degrees of freedom lies farther from 0 than `t`. */
double student_p(double t, double freedom);

/* The smallest of all pixels' p-values after the Sidak correction 1 - (1 - p)^pixels: the probability that unbiased
 * pictures differ as much somewhere. `scale` multiplies the estimate's pictures: 1.01 stands for a bias of 1 %. `step`
 * is the distance of two stored values, which bounds how well a pixel without noise can agree. Welch's t-test, where
 * `reference` has one picture: exact values. */
double significance(const sample_set *estimate, double scale, const sample_set *reference, double step);
