/* SPDX-License-Identifier: MIT
 *
 * One frame: the planned passes, and the result multiplied into colour.
 */
#include "effect.h"

typedef struct frame_programs {
    glssao__program_object normals, distance, estimate, open, resolve, probe, blur, upsample;
    glssao__tile_programs tiles;
} frame_programs;

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

/* The texture that holds depth. */
static gl_uint depth_source(const glssao_frame *frame)
{
    return frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA ? frame->normal_texture : frame->depth_texture;
}

/* Compiles what the plan needs, before anything changes. */
static glssao_result get_programs(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                                  const glssao_plan *plan, frame_programs *out)
{
    unsigned inputs = input_variant(frame);
    unsigned blur = inputs | (settings->blur == GLSSAO_BLUR_BILATERAL ? VARIANT_EDGE_AWARE : 0u) |
                    (settings->blur == GLSSAO_BLUR_BOX ? VARIANT_BOX : 0u);
    unsigned tiles = inputs | glssao__tiles_variant(settings);
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
         inputs | estimate_variant(settings) | (plan->passes[GLSSAO_PASS_RESOLVE].run ? VARIANT_ACCUMULATE : 0u),
         &out->estimate},
        {GLSSAO_PASS_RESOLVE, SHADER_RESOLVE, 0, &out->resolve},
        {GLSSAO_PASS_RESOLVE, SHADER_PROBE, 0, &out->probe},
        {GLSSAO_PASS_BLUR, settings->blur == GLSSAO_BLUR_PLANAR ? SHADER_PLANAR_BLUR : SHADER_BLUR, blur, &out->blur},
        {GLSSAO_PASS_UPSAMPLE, SHADER_UPSAMPLE, inputs, &out->upsample},
    };
    glssao_result result = GLSSAO_OK;
    for (size_t i = 0; i < sizeof needed / sizeof *needed && result == GLSSAO_OK; ++i)
        if (plan->passes[needed[i].pass].run)
            result = glssao__program_get(effect, needed[i].shader, needed[i].variant, needed[i].out);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_TILES].run && glssao__plan_is_paired(settings, plan))
        result = glssao__program_get(effect, estimate_shader(settings), inputs | VARIANT_OPEN, &out->open);
    return result;
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
    if (result == GLSSAO_OK && is_apart(plan, frame))
        result = glssao__maps_fit_result(effect, delivered.width, delivered.height);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_RESOLVE].run)
        result = glssao__maps_fit_accumulation(effect);
    if (result == GLSSAO_OK && glssao__plan_is_paired(settings, plan))
        result = glssao__maps_fit_paired(effect, width, height);
    if (result != GLSSAO_OK || (width == effect->ambient.width && height == effect->ambient.height))
        return result;
    glssao__ambient_maps maps;
    result = glssao__maps_make_ambient(effect, width, height, &maps);
    if (result != GLSSAO_OK)
        return result;
    glssao__maps_delete_ambient(&effect->gl, &effect->ambient);
    effect->ambient = maps;
    effect->ambient_is_one = true;
    effect->has_result_map = false; /* until the last pass has run */
    effect->is_paired = false;
    return GLSSAO_OK;
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
    const glssao_frame *frame;
    const glssao_settings *settings;
    const glssao_plan *plan;
    frame_programs programs;
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
    glssao__draw(effect, effect->distance_map.framebuffer, effect->distance_map.width, effect->distance_map.height);
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
    return (glssao__target){
        .texture = maps->texture[i], .framebuffer = maps->framebuffer[i], .width = maps->width, .height = maps->height};
}

/* Draws the `number`-th of the estimate (0) and the blur's passes; the last leaves the result, if it is not brought to
 * full size, where the host looks for it. */
static void draw_turn(const frame_run *r, const glssao__program_object *program, glssao_pass pass, int number,
                      bool is_result)
{
    glssao_effect *effect = r->effect;
    if (number > 0)
        glssao__draw_bind(effect, UNIT_AMBIENT, turns(effect)->texture[(number - 1) % 2], SAMPLER_POINT_CLAMP);
    if (is_result && effect->has_result_map) {
        glssao__draw_crop(effect, program, &effect->result_map, effect->ambient.width, effect->ambient.height,
                          &r->delivered);
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
        draw_turn(r, &r->programs.estimate, GLSSAO_PASS_ESTIMATE, 0,
                  !runs(r, GLSSAO_PASS_BLUR) && !runs(r, GLSSAO_PASS_UPSAMPLE));
        if (r->plan->passes[GLSSAO_PASS_ESTIMATE].draw_calls > 1) {
            glssao__draw_use(effect, &r->programs.open);
            select_tiles(r, &r->programs.open, 1, 1, r->rings + 2);
            draw_turn(r, &r->programs.open, GLSSAO_PASS_ESTIMATE, 0, false);
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
    draw_turn(r, &r->programs.resolve, GLSSAO_PASS_RESOLVE, 0, !runs(r, GLSSAO_PASS_BLUR));
}

static void blur(const frame_run *r)
{
    const int count = 2 * r->settings->blur_rounds;
    glssao__draw_use(r->effect, &r->programs.blur);
    for (int i = 1; i <= count; ++i) {
        /* Horizontal 0 to 1, vertical 1 to 0. */
        r->effect->gl.Uniform1i(r->programs.blur.horizontal_location, i % 2);
        /* The vertical pass reads a tile farther than it draws. */
        select_tiles(r, &r->programs.blur, 1, 0, r->rings + i % 2);
        draw_turn(r, &r->programs.blur, GLSSAO_PASS_BLUR, i, i == count && !runs(r, GLSSAO_PASS_UPSAMPLE));
    }
}

static void upsample(const frame_run *r)
{
    glssao_effect *effect = r->effect;
    glssao__draw_use(effect, &r->programs.upsample);
    select_tiles(r, &r->programs.upsample, 2, 0, r->rings);
    glssao__draw_bind(effect, UNIT_DEPTH, depth_source(r->frame), SAMPLER_POINT_CLAMP);
    glssao__draw_bind(effect, UNIT_AMBIENT, turns(effect)->texture[0], SAMPLER_POINT_CLAMP);
    glssao__draw_crop(effect, &r->programs.upsample, &effect->result_map, effect->width, effect->height, &r->delivered);
}

/* The plan's passes, in order. */
static void run_passes(const frame_run *r)
{
    static void (*const passes[GLSSAO_PASS_COUNT])(const frame_run *) = {
        [GLSSAO_PASS_NORMALS] = rebuild_normals, [GLSSAO_PASS_DISTANCE] = map_distance,
        [GLSSAO_PASS_TILES] = sort_tiles,        [GLSSAO_PASS_ESTIMATE] = estimate,
        [GLSSAO_PASS_RESOLVE] = resolve,         [GLSSAO_PASS_BLUR] = blur,
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
}

/* Textures of the host, whose content only GL knows. */
static glssao_result check_textures(glssao_effect *effect, const glssao_frame *frame)
{
    const struct {
        gl_uint texture;
        const char *field;
    } textures[] = {
        {frame->depth_kind != GLSSAO_DEPTH_NORMAL_ALPHA ? frame->depth_texture : 0, "frame.depth_texture"},
        {frame->normal_texture, "frame.normal_texture"},
        {frame->back_texture, "frame.back_texture"},
        {frame->second_texture, "frame.second_texture"},
    };
    glssao_result result = GLSSAO_OK;
    for (size_t i = 0; i < sizeof textures / sizeof *textures && result == GLSSAO_OK; ++i)
        if (textures[i].texture)
            result = glssao__maps_check_texture(effect, textures[i].texture, false, textures[i].field);
    return result;
}

/* What glssao_compute and glssao_accumulate have in common; `plan` tells which it is. */
static glssao_result run(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                         const glssao__projection *projection, const glssao_plan *plan)
{
    frame_run r = {.effect = effect,
                   .frame = frame,
                   .settings = settings,
                   .plan = plan,
                   .delivered = glssao__plan_result(effect, frame, settings, plan),
                   .rings = glssao__tiles_rings(glssao__plan_reach(settings, plan))};
    glssao_result result = check_textures(effect, frame);
    if (result == GLSSAO_OK)
        result = get_programs(effect, frame, settings, plan, &r.programs);
    if (result == GLSSAO_OK)
        result = fit_maps(effect, frame, settings, plan);
    if (result != GLSSAO_OK)
        return result;

    effect->depth_texture = depth_source(frame);
    effect->margin = frame->margin;
    glssao__constants_fill(&effect->constants, frame, settings, projection, effect->ambient.width,
                           effect->ambient.height);
    glssao__constants_fill_frame(&effect->frame_constants, frame, settings, projection);
    glssao__tiles_fill_constants(&effect->frame_constants, settings, r.rings);
    if (settings->technique == GLSSAO_HEMISPHERE)
        glssao__constants_fill_kernel(&effect->hemisphere_constants, effect->seed, settings->sample_count);
    if (plan->passes[GLSSAO_PASS_RESOLVE].run) {
        glssao__accumulate_begin(effect, frame, settings);
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
    /* Horizon fetches depth; the others read occluders filtered. */
    glssao__draw_bind(effect, UNIT_DEPTH, depth_source(frame),
                      settings->technique == GLSSAO_HORIZON ? SAMPLER_POINT_CLAMP : SAMPLER_DEPTH);
    run_passes(&r);
    return GLSSAO_OK;
}

glssao_result glssao_prepare(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    glssao__projection projection;
    if (!effect || glssao__draw_is_between_normals(effect, "glssao_prepare") ||
        !glssao__settings_check_frame(effect, frame, settings, &effect->log, &projection))
        return GLSSAO_INVALID_ARGUMENT;
    frame_programs programs;
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    const glssao_plan plan = glssao_plan_frame(effect, frame, settings);
    glssao_result result = get_programs(effect, frame, settings, &plan, &programs);
    if (result == GLSSAO_OK)
        result = fit_maps(effect, frame, settings, &plan);
    glssao__state_restore(&effect->gl, &host);
    glssao__draw_check(effect, "glssao_prepare");
    return result;
}

glssao_result glssao_compute(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    glssao__projection projection;
    if (!effect || glssao__draw_is_between_normals(effect, "glssao_compute") ||
        !glssao__settings_check_frame(effect, frame, settings, &effect->log, &projection))
        return GLSSAO_INVALID_ARGUMENT;
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    const glssao_plan plan = glssao_plan_frame(effect, frame, settings);
    glssao_result result = run(effect, frame, settings, &projection, &plan);
    glssao__state_restore(&effect->gl, &host);
    glssao__draw_check(effect, "glssao_compute");
    return result;
}

glssao_result glssao_accumulate(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    glssao__projection projection;
    if (!effect || glssao__draw_is_between_normals(effect, "glssao_accumulate") ||
        !glssao__settings_check_frame(effect, frame, settings, &effect->log, &projection))
        return GLSSAO_INVALID_ARGUMENT;
    if (settings->technique != GLSSAO_HORIZON) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR,
                          "settings.technique = %d: only the horizon technique accumulates", settings->technique);
        return GLSSAO_INVALID_ARGUMENT;
    }
    const glssao_settings estimate = glssao__accumulate_settings(settings);
    const glssao_plan plan =
        glssao__plan_accumulate(effect, frame, &estimate, glssao__accumulate_next(effect, frame, &estimate));
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    glssao_result result = run(effect, frame, &estimate, &projection, &plan);
    if (result == GLSSAO_OK && !plan.passes[GLSSAO_PASS_ESTIMATE].run)
        effect->accumulation.sampling_error = 0.0; /* nothing was sampled */
    glssao__state_restore(&effect->gl, &host);
    glssao__draw_check(effect, "glssao_accumulate");
    return result;
}

static glssao_result apply(glssao_effect *effect, gl_uint framebuffer)
{
    const glssao__gl *gl = &effect->gl;
    glssao__program_object program;
    glssao_result result = glssao__program_get(effect, SHADER_APPLY, 0, &program);
    if (result != GLSSAO_OK)
        return result;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl_enum status = gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "framebuffer = %u: not complete: 0x%04X", framebuffer,
                          status);
        return GLSSAO_FRAMEBUFFER_ERROR;
    }
    glssao__stats_begin_pass(effect, GLSSAO_PASS_APPLY);
    glssao__state_set_blend(gl, GL_ZERO, GL_SRC_COLOR);
    glssao__draw_use(effect, &program);
    int width, height;
    glssao__draw_bind(effect, UNIT_AMBIENT, glssao__maps_result(effect, &width, &height), SAMPLER_LINEAR_CLAMP);
    glssao__draw(effect, framebuffer, effect->width - 2 * effect->margin, effect->height - 2 * effect->margin);
    glssao__stats_end_pass(effect, GLSSAO_PASS_APPLY, 1);
    return GLSSAO_OK;
}

glssao_result glssao_apply(glssao_effect *effect, uint32_t framebuffer)
{
    if (!effect || glssao__draw_is_between_normals(effect, "glssao_apply"))
        return GLSSAO_INVALID_ARGUMENT;
    if (effect->frame == 0) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "glssao_apply called before glssao_compute");
        return GLSSAO_INVALID_ARGUMENT;
    }
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    glssao_result result = apply(effect, framebuffer);
    glssao__state_restore(&effect->gl, &host);
    glssao__draw_check(effect, "glssao_apply");
    return result;
}
