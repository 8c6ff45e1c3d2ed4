/* SPDX-License-Identifier: MIT
 *
 * Two measures that weigh an error as a viewer would, over the pixels that show a surface.
 *
 * SSIM: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity",
 * IEEE Transactions on Image Processing 13(4), 2004, equation 13 with their constants.
 *
 * FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for
 * Alternating Images", HPG 2020. Accessibility is shown as linear grey: a white surface under ambient light alone.
 * For grey pictures the paper's two colour channels are 0, so only its achromatic channel is computed.
 */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* What both measures need of the truth, computed once. */
typedef struct perception {
    int width, height;
    float *shown;                      /* 1 where a pixel shows a surface, else 0 */
    float *truth;                      /* 1 where nothing is seen */
    float *weight, *mean, *square;     /* SSIM's sums about each pixel: of `shown`, the truth and its square */
    float *lightness, *edges, *points; /* FLIP's */
    float *scratch[6];
    double shown_count;
} perception;

/* False when memory is short; perception_destroy is due in either case. `shows`: not 0 where a surface is seen. */
bool perception_create(perception *p, const float *truth, const uint8_t *shows, int width, int height);
void perception_destroy(perception *p);

/* Mean SSIM: 1 for equal pictures. Windows are Gaussian, sigma 1.5 pixels, over pixels that show a surface. */
double perception_ssim(perception *p, const float *picture);

/* Mean FLIP: 0 for equal pictures, at most 1. The viewer sees 67 pixels a degree, the paper's default. */
double perception_flip(perception *p, const float *picture);
