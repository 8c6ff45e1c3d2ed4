/* SPDX-License-Identifier: MIT
 *
 * The inputs of the horizon estimate in an effect's last frame, read from the library's internals.
 */
#pragma once

#include "horizon_model.h"
#include "horizon_passes.h"

#include <glssao/glssao.h>

/* The distance map's texture, and its size. */
uint32_t horizon_distance_map(const glssao_effect *effect, int *out_width, int *out_height);

/* One of the two paired maps (accessibility, distance and normal in one texel), which the passes after the estimate
 * read in turn; see paired_map. */
uint32_t horizon_paired_map(const glssao_effect *effect, int number);

/* One of the two maps of differences between rays and estimate. */
uint32_t horizon_rays_map(const glssao_effect *effect, int number);
/* The constants RAYS_ALIKE and CORRECTION_PRIOR. */
double horizon_rays_alike(void);
double horizon_correction_prior(void);

/* The sum of accumulation: linear accessibility of two replicates, full size. */
uint32_t horizon_sum_map(const glssao_effect *effect);

/* The noise of the estimate added last. */
void horizon_read_noise(const glssao_effect *effect, horizon_input *out);

/* Constants of the planar blur and of upsampling; lengths in units of the radius. */
void horizon_read_pass_constants(pass_constants *out_blur, pass_constants *out_upsample);

/* Of the last frame: the step of its depth format at view distance t, as coefficients of 1, t and t^2. */
void horizon_depth_step(const struct glssao_effect *effect, double out_step[3]);
/* Slices, steps and constants of the compiled variant, and the step of the depth format. The effect must have run
 * exactly one variant. */
bool horizon_variant(const glssao_effect *effect, horizon_input *out);
