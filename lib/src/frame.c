/* SPDX-License-Identifier: MIT
 *
 * One frame: the planned passes, run in order.
 */
#include "effect.h"

/* The texture that holds depth. */
static gl_uint depth_source(const glssao_frame *frame)
{
    return frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA ? frame->normal_texture : frame->depth_texture;
}

/* Whether the result goes to a map of its own: the passes draw into maps of the estimate's size. */
static bool is_apart(const glssao_plan *plan, const glssao_frame *frame)
{
    return plan->passes[GLSSAO_PASS_UPSAMPLE].run || frame->margin > 0;
}

/* Makes the maps that the plan draws into, at its sizes. */
static glssao_result fit_maps(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                              const glssao_plan *plan)
{
    int width, height;
    glssao__plan_ambient_size(effect, settings, &width, &height);
    const glssao__region delivered = glssao__plan_result(effect, frame, settings, plan);
    glssao_result result = GLSSAO_OK;
    if (plan->passes[GLSSAO_PASS_DISTANCE].run)
        result = glssao__maps_fit_distance(effect, width, height, frame->back_texture != 0);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_TILES].run)
        result = glssao__maps_fit_tiles(effect, width, height, glssao__tiles_variant(settings) & VARIANT_FROM_DEPTH);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_RESOLVE].run)
        result = glssao__maps_fit_accumulation(effect);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_UPSAMPLE].run && !plan->passes[GLSSAO_PASS_UPSAMPLE].compute)
        result = glssao__maps_fit_block(effect, width, height);
    if (result != GLSSAO_OK)
        return result;
    const bool apart = is_apart(plan, frame);
    return glssao__maps_fit_results(effect, width, height, glssao__plan_is_paired(settings, plan),
                                    apart ? delivered.width : 0, apart ? delivered.height : 0);
}

/* `block_count`: how many blocks the frame reads; only the hemisphere technique needs the last. */
static void upload_constants(glssao_effect *effect, gl_uint block_count)
{
    const glssao__gl *gl = &effect->gl;
    const void *data[BLOCK_COUNT] = {&effect->constants, &effect->frame_constants, &effect->hemisphere_constants};
    const gl_sizeiptr sizes[BLOCK_COUNT] = {sizeof effect->constants, sizeof effect->frame_constants,
                                            sizeof effect->hemisphere_constants};
    for (gl_uint i = 0; i < block_count; ++i) {
        gl->BindBufferBase(GL_UNIFORM_BUFFER, i, effect->uniform_buffers[i]);
        gl->BufferSubData(GL_UNIFORM_BUFFER, 0, sizes[i], data[i]);
    }
}

/* What the passes of one frame have in common. */
typedef struct frame_run {
    glssao_effect *effect;
    const glssao_frame *host;  /* as it was handed over */
    const glssao_frame *frame; /* as the passes after the copying of inputs see it */
    const glssao_settings *settings;
    const glssao_plan *plan;
    glssao__frame_programs programs;
    glssao__region delivered; /* what of the last pass's map is the result */
    int rings; /* tiles around one that needs an estimate in which blur and upsampling may change something */
} frame_run;

static bool runs(const frame_run *r, glssao_pass pass)
{
    return r->plan->passes[pass].run;
}

static glssao__region region_of(const frame_run *r, glssao_pass pass)
{
    return glssao__plan_region(r->effect, r->frame, r->settings, r->plan, pass);
}

/* Horizon fetches depth; the others read occluders filtered. */
static void bind_depth(const frame_run *r)
{
    glssao__draw_bind(r->effect, UNIT_DEPTH, depth_source(r->frame),
                      r->settings->technique == GLSSAO_HORIZON ? SAMPLER_POINT_CLAMP : SAMPLER_DEPTH);
}

static void copy_inputs(const frame_run *r)
{
    glssao__inputs_copy(r->effect, r->host, r->programs.inputs);
    bind_depth(r);
}

static void rebuild_normals(const frame_run *r)
{
    const glssao__region region = region_of(r, GLSSAO_PASS_NORMALS);
    glssao__draw_use(r->effect, &r->programs.normals);
    glssao__draw_region(r->effect, &r->effect->normal_map, &region);
}

static void map_distance(const frame_run *r)
{
    glssao_effect *effect = r->effect;
    glssao__draw_use(effect, &r->programs.distance);
    if (r->frame->back_texture) {
        glssao__draw_bind(effect, UNIT_BACK, r->frame->back_texture, SAMPLER_POINT_CLAMP);
        glssao__draw_bind(effect, UNIT_SECOND, r->frame->second_texture, SAMPLER_POINT_CLAMP);
    }
    const glssao__region region = region_of(r, GLSSAO_PASS_DISTANCE);
    glssao__draw_region(effect, &effect->distance_map, &region);
    glssao__draw_bind(effect, UNIT_DISTANCE, effect->distance_map.texture, SAMPLER_POINT_CLAMP);
}

static void sort_tiles(const frame_run *r)
{
    glssao__tiles_run(r->effect, &r->programs.tiles);
    /* Before the rest draws on top: what no pass draws is 1. */
    glssao__maps_clear_all(r->effect);
}

/* Draws what lies `least` to `most` tiles from one that needs an estimate; everything, without tiles. */
static void select_tiles(const frame_run *r, const glssao__program_object *program, int factor, int least, int most)
{
    if (runs(r, GLSSAO_PASS_TILES))
        glssao__tiles_select(r->effect, program, factor, least, most);
}

/* The two maps that the passes of a frame draw into by turns, and read from. */
static const glssao__ambient_maps *turns(const glssao_effect *effect)
{
    return effect->is_paired ? &effect->paired : &effect->ambient;
}

static glssao__target target_of(const glssao__ambient_maps *maps, int i)
{
    return (glssao__target){.texture = maps->texture[i],
                            .framebuffer = maps->framebuffer[i],
                            .width = maps->width,
                            .height = maps->height,
                            .format = maps->format};
}

/* Draws the `number`-th of the estimate (0) and the blur's passes; the last leaves the result, if it is not brought to
 * full size, where the host looks for it. */
static void draw_turn(const frame_run *r, glssao_pass pass, int number, bool is_result)
{
    glssao_effect *effect = r->effect;
    if (number > 0)
        glssao__draw_bind(effect, UNIT_AMBIENT, turns(effect)->texture[(number - 1) % 2], SAMPLER_POINT_CLAMP);
    if (is_result && effect->has_result_map) {
        glssao__draw_crop(effect, &effect->result_map, effect->ambient.width, effect->ambient.height, &r->delivered);
        return;
    }
    const glssao__region region = region_of(r, pass);
    const glssao__target target = is_result ? target_of(&effect->ambient, 0) : target_of(turns(effect), number % 2);
    glssao__draw_region(effect, &target, &region);
}

static void estimate(const frame_run *r)
{
    glssao_effect *effect = r->effect;
    glssao__draw_bind(effect, UNIT_RANDOM_VECTOR, effect->random_vector_map, SAMPLER_LINEAR_WRAP);
    glssao__draw_use(effect, &r->programs.estimate);
    if (!runs(r, GLSSAO_PASS_RESOLVE)) {
        select_tiles(r, &r->programs.estimate, 1, 0, 0);
        draw_turn(r, GLSSAO_PASS_ESTIMATE, 0, !runs(r, GLSSAO_PASS_BLUR) && !runs(r, GLSSAO_PASS_UPSAMPLE));
        if (r->plan->passes[GLSSAO_PASS_ESTIMATE].draw_calls > 1) {
            glssao__draw_use(effect, &r->programs.open);
            select_tiles(r, &r->programs.open, 1, 1, r->rings + 2);
            draw_turn(r, GLSSAO_PASS_ESTIMATE, 0, false);
        }
        return;
    }
    /* Added to the sum of its replicate. */
    const glssao__region region = region_of(r, GLSSAO_PASS_ESTIMATE);
    glssao__state_set_blend(&effect->gl, GL_ONE, GL_ONE);
    glssao__draw_region(effect, &effect->accumulation.sum, &region);
    effect->gl.Disablei(GL_BLEND, 0);
}

static void resolve(const frame_run *r)
{
    glssao__draw_bind(r->effect, UNIT_AMBIENT, r->effect->accumulation.sum.texture, SAMPLER_POINT_CLAMP);
    if (r->plan->passes[GLSSAO_PASS_RESOLVE].draw_calls > 1)
        glssao__accumulate_probe(r->effect, &r->programs.probe);
    glssao__draw_use(r->effect, &r->programs.resolve);
    draw_turn(r, GLSSAO_PASS_RESOLVE, 0, !runs(r, GLSSAO_PASS_BLUR));
}

static void blur(const frame_run *r)
{
    const int count = r->plan->passes[GLSSAO_PASS_BLUR].draw_calls;
    for (int i = 1; i <= count; ++i) {
        const bool is_first = i <= (r->programs.blur.compute ? 1 : 2);
        const glssao__program_object *program = i == count ? &r->programs.last_blur
                                                : is_first ? &r->programs.blur
                                                           : &r->programs.wide_blur;
        glssao__draw_use(r->effect, program);
        r->effect->gl.Uniform1i(program->horizontal_location, i % 2);
        /* The vertical pass reads a tile farther than it draws. */
        select_tiles(r, program, 1, 0, r->rings + i % 2);
        draw_turn(r, GLSSAO_PASS_BLUR, i, i == count && !runs(r, GLSSAO_PASS_UPSAMPLE));
    }
}

static void upsample(const frame_run *r)
{
    glssao_effect *effect = r->effect;
    glssao__draw_use(effect, &r->programs.upsample);
    glssao__draw_bind(effect, UNIT_DEPTH, depth_source(r->frame), SAMPLER_POINT_CLAMP);
    glssao__draw_bind(effect, UNIT_AMBIENT, turns(effect)->texture[r->plan->passes[GLSSAO_PASS_BLUR].draw_calls % 2],
                      SAMPLER_POINT_CLAMP);
    if (!r->programs.upsample.compute) {
        select_tiles(r, &r->programs.upsample, 1, 0, r->rings);
        const glssao__region blocks =
            glssao__plan_inner(effect->ambient.width, effect->ambient.height, r->frame->margin / 2);
        glssao__draw_region(effect, &effect->block_map, &blocks);
        glssao__draw_use(effect, &r->programs.spread);
        select_tiles(r, &r->programs.spread, 2, 0, r->rings);
        glssao__draw_bind(effect, UNIT_AMBIENT, effect->block_map.texture, SAMPLER_POINT_CLAMP);
    }
    glssao__draw_crop(effect, &effect->result_map, effect->width, effect->height, &r->delivered);
}

/* The plan's passes, in order. */
static void run_passes(const frame_run *r)
{
    static void (*const passes[GLSSAO_PASS_COUNT])(const frame_run *) = {
        [GLSSAO_PASS_INPUTS] = copy_inputs,
        [GLSSAO_PASS_NORMALS] = rebuild_normals,
        [GLSSAO_PASS_DISTANCE] = map_distance,
        [GLSSAO_PASS_TILES] = sort_tiles,
        [GLSSAO_PASS_ESTIMATE] = estimate,
        [GLSSAO_PASS_RESOLVE] = resolve,
        [GLSSAO_PASS_BLUR] = blur,
        [GLSSAO_PASS_UPSAMPLE] = upsample,
    };
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i) {
        const struct glssao_planned_pass *planned = &r->plan->passes[i];
        if (!planned->run)
            continue;
        glssao__stats_begin_pass(r->effect, (glssao_pass)i);
        if (i == GLSSAO_PASS_ESTIMATE || i == GLSSAO_PASS_TILES)
            glssao__draw_bind(r->effect, UNIT_NORMAL,
                              r->frame->normal_texture ? r->frame->normal_texture : r->effect->normal_map.texture,
                              SAMPLER_POINT_CLAMP);
        passes[i](r);
        glssao__stats_end_pass(r->effect, (glssao_pass)i, planned->draw_calls);
        glssao__draw_check(r->effect, planned->name);
    }
    glssao__compute_finish(r->effect);
}

/* What glssao_compute and glssao_accumulate have in common; `plan` tells which it is. */
static glssao_result run(glssao_effect *effect, const glssao_frame *host, const glssao_settings *settings,
                         const glssao__projection *projection, const glssao_plan *plan)
{
    frame_run r = {.effect = effect,
                   .host = host,
                   .settings = settings,
                   .plan = plan,
                   .delivered = glssao__plan_result(effect, host, settings, plan),
                   .rings = glssao__tiles_rings(glssao__plan_reach(settings, plan))};
    glssao__precision precision;
    glssao_result result = glssao__inputs_check(effect, host, &precision);
    if (result == GLSSAO_OK)
        result = glssao__inputs_fit(effect, host);
    const glssao_frame read = glssao__inputs_frame(effect, host), *const frame = r.frame = &read;
    if (result == GLSSAO_OK)
        result = glssao__frame_programs_get(effect, host, frame, settings, plan, &r.programs);
    if (result == GLSSAO_OK)
        result = fit_maps(effect, frame, settings, plan);
    if (result != GLSSAO_OK)
        return result;

    effect->depth_texture = depth_source(host);
    effect->margin = frame->margin;
    glssao__constants_fill(&effect->constants, frame, settings, projection, effect->ambient.width,
                           effect->ambient.height);
    glssao__constants_fill_frame(&effect->frame_constants, host, settings, projection, &precision,
                                 (const int[2]){effect->width, effect->height},
                                 (const int[2]){effect->ambient.width, effect->ambient.height});
    glssao__tiles_fill_constants(&effect->frame_constants, settings, r.rings);
    if (settings->technique == GLSSAO_HEMISPHERE)
        glssao__constants_fill_kernel(&effect->hemisphere_constants, effect->seed, settings->sample_count);
    if (plan->passes[GLSSAO_PASS_RESOLVE].run) {
        glssao__accumulate_begin(effect, host, settings);
        glssao__accumulate_fill_constants(effect, &r.delivered, &effect->frame_constants);
    } else {
        glssao__accumulate_stop(effect);
    }
    upload_constants(effect, settings->technique == GLSSAO_HEMISPHERE ? BLOCK_COUNT : BLOCK_HEMISPHERE);
    glssao__stats_begin_frame(effect);
    effect->is_paired = glssao__plan_is_paired(settings, plan);
    effect->has_result_map = is_apart(plan, frame);
    effect->tiles.used = plan->passes[GLSSAO_PASS_TILES].run;
    if (!plan->passes[GLSSAO_PASS_ESTIMATE].run) {
        glssao__maps_clear_result(effect);
        return GLSSAO_OK;
    }
    effect->ambient_is_one = false;
    gl_float sky = frame->depth_kind == GLSSAO_DEPTH_WINDOW ? projection->sky_depth : SKY_DISTANCE;
    effect->gl.SamplerParameterfv(effect->samplers[SAMPLER_DEPTH], GL_TEXTURE_BORDER_COLOR,
                                  (const gl_float[4]){sky, sky, sky, sky});
    bind_depth(&r);
    run_passes(&r);
    return GLSSAO_OK;
}

static bool may_run(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                    const char *function, glssao__projection *out_projection)
{
    return effect && !glssao__draw_is_between_normals(effect, function) &&
           glssao__settings_check_frame(effect, frame, settings, &effect->log, out_projection);
}

/* Makes what the frame needs, without drawing. */
static glssao_result prepare(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                             const glssao_plan *plan)
{
    glssao__frame_programs programs;
    glssao_result result = glssao__inputs_fit(effect, frame);
    const glssao_frame read = glssao__inputs_frame(effect, frame);
    if (result == GLSSAO_OK)
        result = glssao__frame_programs_get(effect, frame, &read, settings, plan, &programs);
    return result == GLSSAO_OK ? fit_maps(effect, &read, settings, plan) : result;
}

glssao_result glssao_prepare(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    glssao__projection projection;
    if (!may_run(effect, frame, settings, "glssao_prepare", &projection))
        return GLSSAO_INVALID_ARGUMENT;
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    glssao_result result;
    glssao_plan plan;
    do {
        plan = glssao_plan_frame(effect, frame, settings);
        result = prepare(effect, frame, settings, &plan);
    } while (glssao__compute_gives_up(effect, &plan, result));
    glssao__state_restore(&effect->gl, &host);
    glssao__draw_check(effect, "glssao_prepare");
    return result;
}

glssao_result glssao_compute(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    glssao__projection projection;
    if (!may_run(effect, frame, settings, "glssao_compute", &projection))
        return GLSSAO_INVALID_ARGUMENT;
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    glssao_result result;
    glssao_plan plan;
    do {
        plan = glssao_plan_frame(effect, frame, settings);
        result = run(effect, frame, settings, &projection, &plan);
    } while (glssao__compute_gives_up(effect, &plan, result));
    glssao__state_restore(&effect->gl, &host);
    glssao__draw_check(effect, "glssao_compute");
    return result;
}

glssao_result glssao_accumulate(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    glssao__projection projection;
    if (!may_run(effect, frame, settings, "glssao_accumulate", &projection))
        return GLSSAO_INVALID_ARGUMENT;
    if (settings->technique != GLSSAO_HORIZON) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR,
                          "settings.technique = %d: only the horizon technique accumulates", settings->technique);
        return GLSSAO_INVALID_ARGUMENT;
    }
    const glssao_settings estimate = glssao__accumulate_settings(settings);
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    glssao_result result;
    glssao_plan plan;
    do {
        plan = glssao__plan_accumulate(effect, frame, &estimate, glssao__accumulate_next(effect, frame, &estimate));
        result = run(effect, frame, &estimate, &projection, &plan);
    } while (glssao__compute_gives_up(effect, &plan, result));
    if (result == GLSSAO_OK && !plan.passes[GLSSAO_PASS_ESTIMATE].run)
        effect->accumulation.sampling_error = 0.0; /* nothing was sampled */
    glssao__state_restore(&effect->gl, &host);
    glssao__draw_check(effect, "glssao_accumulate");
    return result;
}
