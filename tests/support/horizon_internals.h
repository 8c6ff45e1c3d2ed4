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

/* Slices, steps and constants of the variant that was compiled; the effect must have run one alone. */
bool horizon_variant(const glssao_effect *effect, horizon_input *out);

#endif
