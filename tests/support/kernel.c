/* SPDX-License-Identifier: MIT */
#include "kernel.h"

#include "effect.h"

#include <string.h>

const float *depth_step_of(const glssao_effect *effect)
{
    return effect->frame_constants.gDepthStep;
}

void kernel_of_seed(uint32_t seed, int sample_count, float out_kernel[64][4], float out_rotations[16][4])
{
    glssao__hemisphere_constants c;
    glssao__constants_init_hemisphere(&c, seed);
    glssao__constants_fill_kernel(&c, seed, sample_count);
    memcpy(out_kernel, c.gKernel, sizeof c.gKernel);
    memcpy(out_rotations, c.gRotations, sizeof c.gRotations);
}
