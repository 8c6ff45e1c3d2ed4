/* SPDX-License-Identifier: MIT
 *
 * What the horizon estimate was given in an effect's last frame, from the library's internals.
 */
#ifndef GLSSAO_TESTS_HORIZON_INTERNALS_H
#define GLSSAO_TESTS_HORIZON_INTERNALS_H

#include "horizon_model.h"

#include <glssao/glssao.h>

/* The distance map's texture, and its size. */
uint32_t horizon_distance_map(const glssao_effect *effect, int *out_width, int *out_height);

/* One of the two maps that hold accessibility and the linear quantity of distance, by turns. */
uint32_t horizon_paired_map(const glssao_effect *effect, int number);

/* TOLERANCE of the planar blur and of upsampling; false where there is none. */
bool horizon_read_tolerances(double *out_blur, double *out_upsample);

/* Slices, steps and constants of the variant that was compiled, and the step of the depth format; the effect must have
 * run one alone. */
bool horizon_variant(const glssao_effect *effect, horizon_input *out);

#endif
