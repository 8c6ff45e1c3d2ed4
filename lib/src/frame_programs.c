/* SPDX-License-Identifier: MIT
 *
 * Which programs, in which variants, the passes of a frame run.
 */
#include "effect.h"

/* How the host stores what the passes read. */
static unsigned input_variant(const glssao_frame *frame)
{
    unsigned variant = 0;
    if (frame->normal_texture && frame->normal_kind == GLSSAO_NORMAL_UNSIGNED)
        variant |= VARIANT_UNSIGNED_NORMALS;
    if (frame->normal_texture && frame->normal_kind == GLSSAO_NORMAL_OCTAHEDRAL)
        variant |= VARIANT_OCTAHEDRAL_NORMALS;
    if (frame->depth_kind != GLSSAO_DEPTH_WINDOW)
        variant |= VARIANT_DEPTH_IS_DISTANCE;
    if (frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA)
        variant |= VARIANT_DEPTH_IN_ALPHA;
    if (frame->back_texture)
        variant |= VARIANT_LAYERS;
    return variant;
}

static enum glssao__shader estimate_shader(const glssao_settings *settings)
{
    return settings->technique == GLSSAO_CLASSIC      ? SHADER_CLASSIC
           : settings->technique == GLSSAO_HEMISPHERE ? SHADER_HEMISPHERE
                                                      : SHADER_HORIZON;
}

static unsigned estimate_variant(const glssao_settings *settings)
{
    if (settings->technique != GLSSAO_HORIZON)
        return settings->no_angle_weight ? VARIANT_NO_ANGLE_WEIGHT : 0u;
    switch (settings->sample_count) {
    case 16:
        return VARIANT_STEPS_8;
    case 24:
        return VARIANT_STEPS_12;
    case 32:
        return VARIANT_STEPS_8 | VARIANT_SLICES_2;
    case 48:
        return VARIANT_STEPS_12 | VARIANT_SLICES_2;
    case 64:
        return VARIANT_STEPS_16 | VARIANT_SLICES_2;
    default:
        return 0; /* 12 */
    }
}

static unsigned rounds_variant(int rounds)
{
    return rounds == 0 ? 0u : rounds == 1 ? VARIANT_ROUNDS_1 : VARIANT_ROUNDS_2;
}

glssao_result glssao__frame_programs_get(glssao_effect *effect, const glssao_frame *host, const glssao_frame *frame,
                                         const glssao_settings *settings, const glssao_plan *plan,
                                         glssao__frame_programs *out)
{
    /* Where clip w depends on z. */
    const unsigned perspective = frame->projection[11] != 0.0f ? VARIANT_PERSPECTIVE : 0u;
    const unsigned inputs = input_variant(frame) | perspective,
                   paired = glssao__plan_is_paired(settings, plan) ? VARIANT_PAIRED : 0u;
    const unsigned blur = inputs | (settings->blur == GLSSAO_BLUR_BILATERAL ? VARIANT_EDGE_AWARE : 0u) |
                          (settings->blur == GLSSAO_BLUR_BOX ? VARIANT_BOX : 0u);
    const bool planar = settings->blur == GLSSAO_BLUR_PLANAR, tiled = planar && plan->passes[GLSSAO_PASS_BLUR].compute;
    const enum glssao__shader blur_shader = tiled ? SHADER_PLANAR_TILE : planar ? SHADER_PLANAR_BLUR : SHADER_BLUR;
    const bool upsample_compute = plan->passes[GLSSAO_PASS_UPSAMPLE].compute;
    /* Of a blur by compute shader, the last dispatch may run fewer rounds than those before it. */
    const int within = glssao__compute_rounds_within(settings, plan), rounds = settings->blur_rounds - within;
    const int calls = plan->passes[GLSSAO_PASS_BLUR].draw_calls, first_calls = tiled ? 1 : 2;
    const unsigned all_rounds = tiled ? rounds_variant(COMPUTE_ROUNDS) : 0u, wide = planar ? VARIANT_WIDE : 0u;
    const unsigned last_rounds =
        tiled && rounds % COMPUTE_ROUNDS ? rounds_variant(rounds % COMPUTE_ROUNDS) : all_rounds;
    const unsigned last_blur =
        blur | last_rounds | (calls > first_calls ? wide : 0u) | (plan->passes[GLSSAO_PASS_UPSAMPLE].run ? paired : 0u);
    const unsigned first_blur = calls > 1 ? blur | paired | all_rounds : last_blur;
    const unsigned wide_blur = calls > first_calls + 1 ? first_blur | wide : last_blur;
    const unsigned tiles = inputs | glssao__tiles_variant(settings);
    const struct {
        glssao_pass pass;
        enum glssao__shader shader;
        unsigned variant;
        glssao__program_object *out;
    } needed[] = {
        {GLSSAO_PASS_NORMALS, SHADER_NORMALS, inputs, &out->normals},
        {GLSSAO_PASS_DISTANCE, SHADER_DISTANCE, inputs, &out->distance},
        {GLSSAO_PASS_TILES, SHADER_TILE_ROWS, tiles, &out->tiles.rows},
        {GLSSAO_PASS_TILES, SHADER_TILE_BOUNDS, tiles, &out->tiles.bounds},
        {GLSSAO_PASS_TILES, SHADER_TILE_CLASS, tiles, &out->tiles.needed},
        {GLSSAO_PASS_TILES, SHADER_TILE_RINGS, 0, &out->tiles.rings},
        {GLSSAO_PASS_ESTIMATE, estimate_shader(settings),
         inputs | estimate_variant(settings) | (plan->passes[GLSSAO_PASS_RESOLVE].run ? VARIANT_ACCUMULATE : paired),
         &out->estimate},
        {GLSSAO_PASS_RESOLVE, SHADER_RESOLVE, inputs | paired, &out->resolve},
        {GLSSAO_PASS_RESOLVE, SHADER_PROBE, 0, &out->probe},
        {GLSSAO_PASS_BLUR, blur_shader, first_blur, &out->blur},
        {GLSSAO_PASS_BLUR, blur_shader, wide_blur, &out->wide_blur},
        {GLSSAO_PASS_BLUR, blur_shader, last_blur, &out->last_blur},
        {GLSSAO_PASS_UPSAMPLE, upsample_compute ? SHADER_PLANAR_TILE : SHADER_UPSAMPLE,
         inputs | (upsample_compute ? VARIANT_UPSAMPLE | rounds_variant(within) : 0u) |
             (within > 0 && rounds > 0 ? wide : 0u),
         &out->upsample},
    };
    glssao_result result =
        plan->passes[GLSSAO_PASS_INPUTS].run ? glssao__inputs_programs(effect, host, out->inputs) : GLSSAO_OK;
    for (size_t i = 0; i < sizeof needed / sizeof *needed && result == GLSSAO_OK; ++i)
        if (plan->passes[needed[i].pass].run)
            result = glssao__program_get(
                effect, needed[i].shader,
                needed[i].variant | (plan->passes[needed[i].pass].compute ? VARIANT_COMPUTE : 0u), needed[i].out);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_TILES].run && glssao__plan_is_paired(settings, plan))
        result = glssao__program_get(effect, estimate_shader(settings), inputs | paired | VARIANT_OPEN, &out->open);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_UPSAMPLE].run && !upsample_compute)
        result = glssao__program_get(effect, SHADER_SPREAD, 0, &out->spread);
    return result;
}
