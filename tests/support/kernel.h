/* SPDX-License-Identifier: MIT
 *
 * Inputs of the models that come from the library's own code: the random inputs of the hemisphere technique, and the
 * step of the depth format in the last frame.
 */
#pragma once

#include <glssao/glssao.h>

/* Coefficients of 1, t, t^2 at view distance t; test_internals checks them. */
const float *depth_step_of(const glssao_effect *effect);
void kernel_of_seed(uint32_t seed, int sample_count, float out_kernel[64][4], float out_rotations[16][4]);
