/* SPDX-License-Identifier: MIT
 *
 * What the horizon estimate was given in an effect's last frame, from the library's internals.
 */
#ifndef GLSSAO_TESTS_HORIZON_INTERNALS_H
#define GLSSAO_TESTS_HORIZON_INTERNALS_H

#include "horizon_model.h"
#include "horizon_passes.h"

#include <glssao/glssao.h>

/* The distance map's texture, and its size. */
uint32_t horizon_distance_map(const glssao_effect *effect, int *out_width, int *out_height);

/* One of the two maps that the passes after the estimate read, by turns; see paired_map. */
uint32_t horizon_paired_map(const glssao_effect *effect, int number);

/* What accumulation sums up: linear accessibility of two replicates, full size. */
uint32_t horizon_sum_map(const glssao_effect *effect);

/* Noise of the last estimate that was added to it. */
void horizon_read_noise(const glssao_effect *effect, horizon_input *out);

/* Constants of the planar blur and of upsampling, lengths in units of the radius; false where one is missing. */
bool horizon_read_pass_constants(pass_constants *out_blur, pass_constants *out_upsample);

/* Of the last frame: what a step of its depth format comes to in view distance t, of 1, t and t^2. */
void horizon_depth_step(const struct glssao_effect *effect, double out_step[3]);
/* Slices, steps and constants of the variant that was compiled, and the step of the depth format; the effect must have
 * run one alone. */
bool horizon_variant(const glssao_effect *effect, horizon_input *out);

#endif
