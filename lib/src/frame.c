/* SPDX-License-Identifier: MIT
 *
 * One frame: the planned passes, and the result multiplied into colour.
 */
#include "effect.h"

typedef struct frame_programs {
    glssao__program_object normals, distance, estimate, resolve, probe, blur, upsample;
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
    const struct {
        glssao_pass pass;
        enum glssao__shader shader;
        unsigned variant;
        glssao__program_object *out;
    } needed[] = {
        {GLSSAO_PASS_NORMALS, SHADER_NORMALS, inputs, &out->normals},
        {GLSSAO_PASS_DISTANCE, SHADER_DISTANCE, inputs, &out->distance},
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
    return result;
}

/* Whether a pass reads the linear quantity of distance beside accessibility. */
static bool is_paired(const glssao_settings *settings, const glssao_plan *plan)
{
    return plan->passes[GLSSAO_PASS_UPSAMPLE].run ||
           (plan->passes[GLSSAO_PASS_BLUR].run && settings->blur == GLSSAO_BLUR_PLANAR);
}

/* Makes the maps that the plan draws into, at its sizes. */
static glssao_result fit_maps(glssao_effect *effect, const glssao_settings *settings, const glssao_plan *plan)
{
    int width, height;
    glssao__plan_ambient_size(effect, settings, &width, &height);
    glssao_result result = GLSSAO_OK;
    if (plan->passes[GLSSAO_PASS_DISTANCE].run)
        result = glssao__maps_fit_distance(effect, width, height);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_UPSAMPLE].run)
        result = glssao__maps_fit_full(effect);
    if (result == GLSSAO_OK && plan->passes[GLSSAO_PASS_RESOLVE].run)
        result = glssao__maps_fit_accumulation(effect);
    if (result == GLSSAO_OK && is_paired(settings, plan))
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
    effect->result_is_full = false; /* until the upsampling has run */
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

static void rebuild_normals(glssao_effect *effect, const glssao__program_object *program)
{
    effect->gl.UseProgram(program->name);
    glssao__draw(effect, effect->normal_map.framebuffer, effect->width, effect->height);
}

static void map_distance(glssao_effect *effect, const glssao__program_object *program)
{
    effect->gl.UseProgram(program->name);
    glssao__draw(effect, effect->distance_map.framebuffer, effect->distance_map.width, effect->distance_map.height);
    glssao__draw_bind(effect, UNIT_DISTANCE, effect->distance_map.texture, SAMPLER_POINT_CLAMP);
}

/* The two maps that the passes of a frame draw into by turns, and read from. */
static const glssao__ambient_maps *turns(const glssao_effect *effect)
{
    return effect->is_paired ? &effect->paired : &effect->ambient;
}

/* Draws the `number`-th of the estimate (0) and the blur's passes; the last leaves the result, if it is not brought to
 * full size, where the host looks for it. */
static void draw_turn(glssao_effect *effect, int number, bool is_result)
{
    const glssao__ambient_maps *maps = is_result ? &effect->ambient : turns(effect);
    if (number > 0)
        glssao__draw_bind(effect, UNIT_AMBIENT, turns(effect)->texture[(number - 1) % 2], SAMPLER_POINT_CLAMP);
    glssao__draw(effect, maps->framebuffer[is_result ? 0 : number % 2], maps->width, maps->height);
}

static void estimate(glssao_effect *effect, const glssao__program_object *program, bool is_result)
{
    glssao__draw_bind(effect, UNIT_RANDOM_VECTOR, effect->random_vector_map, SAMPLER_LINEAR_WRAP);
    effect->gl.UseProgram(program->name);
    draw_turn(effect, 0, is_result);
}

/* Adds an estimate to the sum of its replicate. */
static void add_estimate(glssao_effect *effect, const glssao__program_object *program)
{
    const glssao__target *sum = &effect->accumulation.sum;
    effect->gl.UseProgram(program->name);
    glssao__state_set_blend(&effect->gl, GL_ONE, GL_ONE);
    glssao__draw(effect, sum->framebuffer, sum->width, sum->height);
    effect->gl.Disablei(GL_BLEND, 0);
}

static void resolve(glssao_effect *effect, const frame_programs *programs, bool is_result, bool probes)
{
    glssao__draw_bind(effect, UNIT_AMBIENT, effect->accumulation.sum.texture, SAMPLER_POINT_CLAMP);
    if (probes)
        glssao__accumulate_probe(effect, &programs->probe);
    effect->gl.UseProgram(programs->resolve.name);
    draw_turn(effect, 0, is_result);
}

static void blur(glssao_effect *effect, const glssao__program_object *program, int rounds, bool is_result)
{
    effect->gl.UseProgram(program->name);
    for (int i = 1; i <= 2 * rounds; ++i) {
        effect->gl.Uniform1i(program->horizontal_location, i % 2); /* horizontal 0 to 1, vertical 1 to 0 */
        draw_turn(effect, i, is_result && i == 2 * rounds);
    }
}

static void upsample(glssao_effect *effect, const glssao_frame *frame, const glssao__program_object *program)
{
    effect->gl.UseProgram(program->name);
    glssao__draw_bind(effect, UNIT_DEPTH, depth_source(frame), SAMPLER_POINT_CLAMP);
    glssao__draw_bind(effect, UNIT_AMBIENT, turns(effect)->texture[0], SAMPLER_POINT_CLAMP);
    glssao__draw(effect, effect->full_map.framebuffer, effect->full_map.width, effect->full_map.height);
}

/* The plan's passes, in order. */
static void run_passes(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                       const glssao_plan *plan, const frame_programs *programs)
{
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i) {
        glssao_pass pass = (glssao_pass)i;
        if (!plan->passes[pass].run)
            continue;
        glssao__stats_begin_pass(effect, pass);
        switch (pass) {
        case GLSSAO_PASS_NORMALS:
            rebuild_normals(effect, &programs->normals);
            break;
        case GLSSAO_PASS_DISTANCE:
            map_distance(effect, &programs->distance);
            break;
        case GLSSAO_PASS_ESTIMATE:
            glssao__draw_bind(effect, UNIT_NORMAL,
                              frame->normal_texture ? frame->normal_texture : effect->normal_map.texture,
                              SAMPLER_POINT_CLAMP);
            if (plan->passes[GLSSAO_PASS_RESOLVE].run)
                add_estimate(effect, &programs->estimate);
            else
                estimate(effect, &programs->estimate,
                         !plan->passes[GLSSAO_PASS_BLUR].run && !plan->passes[GLSSAO_PASS_UPSAMPLE].run);
            break;
        case GLSSAO_PASS_RESOLVE:
            resolve(effect, programs, !plan->passes[GLSSAO_PASS_BLUR].run, plan->passes[pass].draw_calls > 1);
            break;
        case GLSSAO_PASS_BLUR:
            blur(effect, &programs->blur, settings->blur_rounds, !plan->passes[GLSSAO_PASS_UPSAMPLE].run);
            break;
        case GLSSAO_PASS_UPSAMPLE:
            upsample(effect, frame, &programs->upsample);
            break;
        case GLSSAO_PASS_APPLY: /* glssao_apply's own */
        case GLSSAO_PASS_COUNT:
            break;
        }
        glssao__stats_end_pass(effect, pass, plan->passes[pass].draw_calls);
        glssao__draw_check(effect, plan->passes[pass].name);
    }
}

/* What glssao_compute and glssao_accumulate have in common; `plan` tells which it is. */
static glssao_result run(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                         const glssao__projection *projection, const glssao_plan *plan)
{
    glssao_result result = GLSSAO_OK;
    if (frame->depth_kind != GLSSAO_DEPTH_NORMAL_ALPHA)
        result = glssao__maps_check_texture(effect, frame->depth_texture, false, "frame.depth_texture");
    if (result == GLSSAO_OK && frame->normal_texture)
        result = glssao__maps_check_texture(effect, frame->normal_texture, false, "frame.normal_texture");
    frame_programs programs = {0};
    if (result == GLSSAO_OK)
        result = get_programs(effect, frame, settings, plan, &programs);
    if (result == GLSSAO_OK)
        result = fit_maps(effect, settings, plan);
    if (result != GLSSAO_OK)
        return result;

    effect->depth_texture = depth_source(frame);
    glssao__constants_fill(&effect->constants, frame, settings, projection, effect->ambient.width,
                           effect->ambient.height);
    glssao__constants_fill_frame(&effect->frame_constants, frame, settings, projection);
    if (settings->technique == GLSSAO_HEMISPHERE)
        glssao__constants_fill_kernel(&effect->hemisphere_constants, effect->seed, settings->sample_count);
    if (plan->passes[GLSSAO_PASS_RESOLVE].run) {
        glssao__accumulate_begin(effect, frame, settings);
        glssao__accumulate_fill_constants(effect, &effect->frame_constants);
    } else {
        glssao__accumulate_stop(effect);
    }
    upload_constants(effect, settings->technique == GLSSAO_HEMISPHERE ? BLOCK_COUNT : BLOCK_HEMISPHERE);
    glssao__stats_begin_frame(effect);
    if (!plan->passes[GLSSAO_PASS_ESTIMATE].run) {
        glssao__maps_clear_ambient(effect);
        effect->result_is_full = false;
        effect->is_paired = false;
        return GLSSAO_OK;
    }
    effect->ambient_is_one = false;
    gl_float sky = frame->depth_kind == GLSSAO_DEPTH_WINDOW ? projection->sky_depth : SKY_DISTANCE;
    effect->gl.SamplerParameterfv(effect->samplers[SAMPLER_DEPTH], GL_TEXTURE_BORDER_COLOR,
                                  (const gl_float[4]){sky, sky, sky, sky});
    effect->is_paired = is_paired(settings, plan);
    /* Horizon fetches depth; the others read occluders filtered. */
    glssao__draw_bind(effect, UNIT_DEPTH, depth_source(frame),
                      settings->technique == GLSSAO_HORIZON ? SAMPLER_POINT_CLAMP : SAMPLER_DEPTH);
    run_passes(effect, frame, settings, plan, &programs);
    effect->result_is_full = plan->passes[GLSSAO_PASS_UPSAMPLE].run;
    return GLSSAO_OK;
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
    gl->UseProgram(program.name);
    int width, height;
    glssao__draw_bind(effect, UNIT_AMBIENT, glssao__maps_result(effect, &width, &height), SAMPLER_LINEAR_CLAMP);
    glssao__draw(effect, framebuffer, effect->width, effect->height);
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
