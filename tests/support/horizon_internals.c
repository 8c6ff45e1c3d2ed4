/* SPDX-License-Identifier: MIT */
#include "horizon_internals.h"

#include "effect.h"
#include "shader_constants.h"

uint32_t horizon_distance_map(const glssao_effect *effect, int *out_width, int *out_height)
{
    *out_width = effect->distance_map.width;
    *out_height = effect->distance_map.height;
    return effect->distance_map.texture;
}

uint32_t horizon_paired_map(const glssao_effect *effect, int number)
{
    return effect->paired.texture[number];
}

static bool read_pass_constants(enum glssao__shader shader, const char *tolerance, const char *near,
                                pass_constants *out)
{
    const char *pieces[GLSSAO__PROGRAM_MAX_SOURCES];
    const int count = glssao__program_sources(NULL, shader, 0, GL_FRAGMENT_SHADER, pieces);
    return shader_constant(pieces, count, tolerance, &out->tolerance) &&
           shader_constant(pieces, count, near, &out->near) && shader_constant(pieces, count, "CHORD", &out->chord) &&
           shader_constant(pieces, count, "NORMAL_STEP", &out->normal_step);
}

bool horizon_read_pass_constants(pass_constants *out_blur, pass_constants *out_upsample)
{
    const char *pieces[GLSSAO__PROGRAM_MAX_SOURCES];
    const int count = glssao__program_sources(NULL, SHADER_PLANAR_BLUR, 0, GL_FRAGMENT_SHADER, pieces);
    return read_pass_constants(SHADER_PLANAR_BLUR, "BLUR_TOLERANCE", "BLUR_NEAR", out_blur) &&
           shader_constant(pieces, count, "BLUR_HOLLOW", &out_blur->hollow) &&
           read_pass_constants(SHADER_UPSAMPLE, "UPSAMPLE_TOLERANCE", "UPSAMPLE_NEAR", out_upsample);
}

void horizon_depth_step(const glssao_effect *effect, double out_step[3])
{
    for (int i = 0; i < 3; ++i)
        out_step[i] = (double)effect->frame_constants.gDepthStep[i];
}

bool horizon_variant(const glssao_effect *effect, horizon_input *out)
{
    int found = 0;
    unsigned variant = 0;
    for (int i = 0; i < effect->program_count; ++i)
        if (effect->programs[i].shader == SHADER_HORIZON) {
            variant = effect->programs[i].variant;
            ++found;
        }
    out->steps = variant & VARIANT_STEPS_16 ? 16 : variant & VARIANT_STEPS_12 ? 12 : variant & VARIANT_STEPS_8 ? 8 : 6;
    out->slices = variant & VARIANT_SLICES_2 ? 2 : 1;
    horizon_depth_step(effect, out->depth_step);
    const char *pieces[GLSSAO__PROGRAM_MAX_SOURCES];
    const int count = glssao__program_sources(NULL, SHADER_HORIZON, variant, GL_FRAGMENT_SHADER, pieces);
    return found == 1 && horizon_read_constants(pieces, count, variant & VARIANT_LAYERS, &out->constants);
}

uint32_t horizon_sum_map(const glssao_effect *effect)
{
    return effect->accumulation.sum.texture;
}

void horizon_read_noise(const glssao_effect *effect, horizon_input *out)
{
    for (int i = 0; i < 2; ++i)
        out->noise_offset[i] = (double)effect->frame_constants.gNoise[i];
    out->turned_over = effect->frame_constants.gAccumulation[0] == 0.0f;
}
