/* SPDX-License-Identifier: MIT */
#include "kernel.h"

#include "effect.h"

#include <string.h>

const float *depth_step_of(const glssao_effect *effect)
{
    return effect->uniforms.frame.gDepthStep;
}

void kernel_of_seed(uint32_t seed, int sample_count, float out_kernel[64][4], float out_rotations[16][4])
{
    glssao__uniforms u;
    glssao__uniforms_init(&u, seed);
    glssao__uniforms_kernel(&u.hemisphere, seed, sample_count);
    memcpy(out_kernel, u.hemisphere.gKernel, sizeof u.hemisphere.gKernel);
    memcpy(out_rotations, u.hemisphere.gRotations, sizeof u.hemisphere.gRotations);
}
