/* SPDX-License-Identifier: MIT
 *
 * The hemisphere technique's random inputs, asked of the library's own code, for the model to be fed with.
 */
#ifndef GLSSAO_TESTS_KERNEL_H
#define GLSSAO_TESTS_KERNEL_H

#include <stdint.h>

void kernel_of_seed(uint32_t seed, int sample_count, float out_kernel[64][4], float out_rotations[16][4]);

#endif
