/* SPDX-License-Identifier: MIT
 *
 * Faults that an eye finds though an error average hides them.
 */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* Where grain is looked for, computed once from the truth: away from edges, and where the truth, blurred with a sigma
 * of 3 pixels, changes by less than 0.01 from pixel to pixel; and so for all pixels that the measure's blur reaches. */
typedef struct grain_places {
    int width, height;
    uint8_t *smooth;
    float *weight; /* share of the blur's weight that lies on such pixels */
    float *scratch[3];
} grain_places;

/* `classes`: pixel_class of measure.h. False when memory is short; grain_destroy is due in either case. */
bool grain_create(grain_places *g, const float *truth, const uint8_t *classes, int width, int height);
void grain_destroy(grain_places *g);

/* Standard deviation of what is left of the picture after a Gaussian blur is taken off that halves waves of 8 pixels.
 * The truth has no such short waves there, so all that is left is error. 0 where there is no such place. */
double grain_measure(grain_places *g, const float *picture);

/* How many pixels are darker by more than 0.5 than each pixel of the truth in the 3 x 3 about them that shows a
 * surface. */
int count_specks(const float *picture, const float *truth, const uint8_t *classes, int width, int height);
