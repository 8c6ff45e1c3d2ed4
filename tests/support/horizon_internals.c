/* SPDX-License-Identifier: MIT */
#include "horizon_internals.h"

#include "effect.h"
#include "tuned.glsl"

static const glssao__target *map_of(const glssao_effect *effect, enum glssao__map map)
{
    return &effect->resources.targets[map];
}

uint32_t horizon_distance_map(const glssao_effect *effect, int *out_width, int *out_height)
{
    *out_width = map_of(effect, MAP_DISTANCE)->width;
    *out_height = map_of(effect, MAP_DISTANCE)->height;
    return map_of(effect, MAP_DISTANCE)->texture;
}

uint32_t horizon_paired_map(const glssao_effect *effect, int number)
{
    return map_of(effect, number == 0 ? MAP_PAIRED_0 : MAP_PAIRED_1)->texture;
}

uint32_t horizon_rays_map(const glssao_effect *effect, int number)
{
    return map_of(effect, number == 0 ? MAP_RAYS_0 : MAP_RAYS_1)->texture;
}

double horizon_rays_alike(void)
{
    return RAYS_ALIKE;
}

double horizon_correction_prior(void)
{
    return CORRECTION_PRIOR;
}

uint32_t horizon_sum_map(const glssao_effect *effect)
{
    return map_of(effect, MAP_SUM)->texture;
}

void horizon_read_pass_constants(pass_constants *out_blur, pass_constants *out_upsample)
{
    *out_blur = (pass_constants){.tolerance = BLUR_TOLERANCE,
                                 .near = BLUR_NEAR,
                                 .hollow = BLUR_HOLLOW,
                                 .alone = BLUR_ALONE,
                                 .wide_alike = BLUR_ALIKE,
                                 .chord = CHORD,
                                 .normal_step = NORMAL_STEP};
    *out_upsample = (pass_constants){.tolerance = UPSAMPLE_TOLERANCE,
                                     .near = UPSAMPLE_NEAR,
                                     .chord = CHORD,
                                     .normal_step = NORMAL_STEP,
                                     .fall = UPSAMPLE_FALL};
}

void horizon_depth_step(const glssao_effect *effect, double out_step[3])
{
    for (int i = 0; i < 3; ++i)
        out_step[i] = (double)effect->uniforms.frame.gDepthStep[i];
}

bool horizon_variant(const glssao_effect *effect, horizon_input *out)
{
    const glssao__programs *programs = &effect->resources.programs;
    glssao__variant variant = {{0}};
    int found = 0;
    for (int i = 0; i < programs->count; ++i)
        if (programs->compiled[i].key.bytes[0] == SHADER_HORIZON) {
            for (int k = 0; k < MACRO_COUNT; ++k)
                variant.values[k] = programs->compiled[i].key.bytes[k + 1];
            ++found;
        }
    out->steps = variant.values[MACRO_STEPS];
    out->slices = variant.values[MACRO_SLICES];
    out->constants = (horizon_constants){
        .jump = JUMP,
        .alike = ALIKE,
        .open_end = OPEN_END,
        .width = RUN_WIDTH,
        .veil = variant.values[MACRO_LAYERS] ? VEIL_TWO_LAYERS : VEIL_ONE_LAYER,
        .veil_width = VEIL_WIDTH,
        .rise = LEAST_RISE,
        .veil_reach = VEIL_REACH,
        .veil_far = VEIL_FAR,
        .reach_on = REACH_ON,
        .plan_width = PLAN_WIDTH,
        .plan_from = PLAN_FROM,
        .plan_to = PLAN_TO,
        .second = SECOND_WIDTH,
        .calibration = out->steps >= 12  ? CALIBRATION_12
                       : out->steps == 8 ? CALIBRATION_8
                                         : CALIBRATION_6,
    };
    horizon_depth_step(effect, out->depth_step);
    return found == 1;
}

void horizon_read_noise(const glssao_effect *effect, horizon_input *out)
{
    for (int i = 0; i < 2; ++i)
        out->noise_offset[i] = (double)effect->uniforms.frame.gNoise[i];
    out->turned_over = effect->uniforms.frame.gAccumulation[0] == 0.0f;
}
