/* SPDX-License-Identifier: MIT
 *
 * The public calls of a frame: check, schedule, save the host's state, prepare, run, restore.
 */
#include "effect.h"

#include "frame/choose.h"
#include "frame/schedule.h"
#include "input/check.h"

#include <math.h>
#include <string.h>

bool glssao__effect_is_closed(const glssao_effect *effect, const char *function)
{
    if (effect->normals.is_open)
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s called before glssao_end_normals", function);
    return !effect->normals.is_open;
}

glssao_result glssao__effect_check_state(const glssao_effect *effect, const char *function)
{
    return effect->host_restores_state ? GLSSAO_OK : glssao__state_check(&effect->gl, &effect->log, function);
}

/* A texture that a pass both reads and draws into gives undefined pixels. */
static bool check_loops(const glssao_effect *effect, const glssao__schedule *schedule, const glssao__log *log)
{
    for (int map = MAP_FIRST_TARGET; map < MAP_COUNT; ++map)
        for (int i = 0; i < HOST_TEXTURES; ++i) {
            const gl_uint own = effect->resources.targets[map].texture;
            const bool is_output = map != MAP_NORMAL && own != 0; /* the host may have drawn normals into it */
            if (is_output && schedule->host_names[i] == own) {
                glssao__log_write(log, GLSSAO_LOG_ERROR, "frame texture = %u: the effect's own map can't be its input",
                                  own);
                return false;
            }
        }
    return true;
}

static glssao__request request_of(const glssao_effect *effect, const glssao_frame *frame,
                                  const glssao_settings *settings, int estimates, const glssao__projection *projection)
{
    return (glssao__request){.frame = frame,
                             .settings = settings,
                             .size = {effect->size[0], effect->size[1]},
                             .estimates = estimates,
                             .frames = glssao__history_frames(&effect->history, frame, settings, projection),
                             .is_orthographic = projection->is_orthographic,
                             .is_oblique = projection->is_oblique,
                             .is_turned = projection->is_turned,
                             .can = effect->can};
}

/* A matrix that works but was hardly meant is told once. */
static void warn_of_projection(glssao_effect *effect, const glssao_frame *frame, enum glssao__doubt doubt)
{
    if (doubt == DOUBT_NONE || effect->doubts & 1u << doubt)
        return;
    effect->doubts |= 1u << doubt;
    if (doubt == DOUBT_IDENTITY)
        glssao__log_write(&effect->log, GLSSAO_LOG_WARNING,
                          "frame.projection is the identity: hand over the matrix that depth was drawn with "
                          "(GL_PROJECTION_MATRIX is the identity in programs with shaders)");
    else
        glssao__log_write(&effect->log, GLSSAO_LOG_WARNING,
                          "frame.projection[14] = %g, [15] = %g: the matrix looks transposed; want column-major",
                          (double)frame->projection[14], (double)frame->projection[15]);
}

glssao_plan glssao_plan_frame(const glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    static const glssao__log silent = {0};
    glssao__projection projection;
    glssao__schedule schedule;
    if (effect && glssao__check_frame(frame, settings, effect->size, &silent, &projection)) {
        const glssao__request request = request_of(effect, frame, settings, 0, &projection);
        glssao__schedule_make(&schedule, &request);
        if (check_loops(effect, &schedule, &silent))
            return schedule.plan;
    }
    glssao__choose_nothing(&schedule.plan, "glssao_compute would refuse these arguments");
    return schedule.plan;
}

/* A call for a frame. */
typedef struct call {
    const char *function;
    const glssao_frame *frame;
    const glssao_settings *settings;
    int estimates, frames; /* as in glssao__request */
    bool only_prepares;
    glssao__projection projection;
} call;

/* Fills the uniform blocks, runs the steps and notes what they left. */
static void run_schedule(glssao_effect *effect, const call *c, const glssao__schedule *schedule,
                         const glssao__host_inputs *host)
{
    glssao__accumulation *accumulation = &effect->accumulation;
    const glssao__region *delivered = &schedule->delivered;
    const glssao__uniforms_source source = {
        .frame = c->frame,
        .settings = c->settings,
        .projection = &c->projection,
        .precision = host->precision,
        .size = {effect->size[0], effect->size[1]},
        .estimate_size = {schedule->estimate_size[0], schedule->estimate_size[1]},
        .map_factor = schedule->map_factor,
        .tile_rings = schedule->tile_rings,
        .seed = effect->seed,
        .noise_index = c->settings->noise_index + (uint32_t)c->frames,
    };
    const bool is_sampled = schedule->plan.passes[GLSSAO_PASS_ESTIMATE].run;
    glssao__uniforms_fill(&effect->uniforms, &source);
    if (c->estimates > 0 && is_sampled) {
        glssao__accumulate_begin(accumulation, &effect->gl, c->frame, c->settings);
        glssao__accumulate_fill(accumulation, effect->seed,
                                (const int[4]){delivered->x, delivered->y, delivered->width, delivered->height},
                                &effect->uniforms.frame);
    } else {
        glssao__history_fill(&effect->history, &source, c->frames, &effect->uniforms.frame);
        glssao__accumulate_stop(accumulation, &effect->gl);
    }
    if (c->estimates == 0) { /* a mean of a still view leaves the history as it was */
        glssao__history_keep(&effect->history, &source, c->frames, delivered);
        if (!is_sampled) /* no pass drew a history */
            effect->history.frames = 0;
    }
    glssao__last_frame *last = &effect->last;
    last->number += 1;
    last->result = schedule->result;
    last->other = schedule->other;
    last->has_tiles = schedule->has_tiles;
    last->has_bent = c->settings->bent_normals;
    last->margin = c->frame->margin;
    memcpy(last->viewport, c->frame->viewport, sizeof last->viewport);
    last->depth_texture =
        c->frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA ? c->frame->normal_texture : c->frame->depth_texture;
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i)
        last->draw_calls[i] = schedule->plan.passes[i].draw_calls;

    const bool is_window = glssao__projection_reads_window_depth(c->frame, c->projection.is_oblique);
    glssao__timers_frame(&effect->resources.timers, last->number);
    glssao__execute(&effect->resources, schedule, host, &effect->uniforms,
                    is_window ? c->projection.sky_depth : SKY_DISTANCE);
    if (c->estimates > 1 && is_sampled)
        glssao__accumulate_read_probe(accumulation, &effect->gl, &effect->resources.targets[MAP_PROBE]);
    else if (c->estimates > 0 && !is_sampled)
        accumulation->sampling_error = 0.0;
}

/* Saves the host's state, does the work, and restores. */
static glssao_result run_guarded(glssao_effect *effect, const call *c, const glssao__schedule *schedule)
{
    const glssao__gl *gl = &effect->gl;
    const glssao__state_need need = glssao__execute_need(&effect->resources, schedule);
    glssao__host_textures *known = effect->host_restores_state ? &effect->known : NULL;
    glssao__host_inputs host;
    glssao__state state;
    glssao__state_save(gl, &need, effect->host_restores_state, &state);
    glssao_result result = glssao__host_textures_check(gl, &effect->log, c->frame, effect->size, UNIT_DEPTH,
                                                       schedule->host_names, known, &host);
    if (result == GLSSAO_OK) {
        result = glssao__resources_prepare(&effect->resources, schedule);
        if (result == GLSSAO_OK && !c->only_prepares)
            run_schedule(effect, c, schedule, &host);
        glssao__host_textures_restore(gl, &host, UNIT_DEPTH);
    }
    glssao__state_restore(gl, &state);
    glssao__resources_collect(&effect->resources);
    return result;
}

/* What glssao_prepare, glssao_compute and glssao_accumulate have in common. A schedule whose compute shaders the driver
 * rejects is made again without. */
static glssao_result run_call(glssao_effect *effect, call *c)
{
    if (!glssao__effect_is_closed(effect, c->function) ||
        !glssao__check_frame(c->frame, c->settings, effect->size, &effect->log, &c->projection))
        return GLSSAO_INVALID_ARGUMENT;
    warn_of_projection(effect, c->frame, c->projection.doubt);
    glssao_result result = glssao__effect_check_state(effect, c->function);
    glssao__schedule schedule;
    c->frames = glssao__history_frames(&effect->history, c->frame, c->settings, &c->projection);
    for (bool again = result == GLSSAO_OK; again;) {
        const glssao__request request = request_of(effect, c->frame, c->settings, c->estimates, &c->projection);
        glssao__schedule_make(&schedule, &request);
        if (!check_loops(effect, &schedule, &effect->log))
            return GLSSAO_INVALID_ARGUMENT;
        result = run_guarded(effect, c, &schedule);
        again = result == GLSSAO_SHADER_ERROR && schedule.may_use_compute;
        if (again) {
            glssao__log_write(&effect->log, GLSSAO_LOG_WARNING,
                              "the driver rejected a compute shader: fragment shaders from now on");
            effect->can.compute_failed = true;
        }
    }
    glssao__resources_check(&effect->resources, c->function);
    return result;
}

glssao_result glssao_prepare(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    call c = {.function = "glssao_prepare", .frame = frame, .settings = settings, .only_prepares = true};
    return effect ? run_call(effect, &c) : GLSSAO_INVALID_ARGUMENT;
}

glssao_result glssao_compute(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    call c = {.function = "glssao_compute", .frame = frame, .settings = settings};
    return effect ? run_call(effect, &c) : GLSSAO_INVALID_ARGUMENT;
}

glssao_result glssao_accumulate(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    if (!effect)
        return GLSSAO_INVALID_ARGUMENT;
    if (!frame || !settings)
        return glssao__log_refuse(&effect->log, "%s is NULL", frame ? "settings" : "frame");
    if (!glssao__check_settings(settings, &effect->log))
        return GLSSAO_INVALID_ARGUMENT;
    if (settings->technique != GLSSAO_HORIZON)
        return glssao__log_refuse(&effect->log, "settings.technique = %d: only the horizon technique accumulates",
                                  settings->technique);
    const glssao_settings estimate = glssao__schedule_accumulated(settings);
    glssao_frame without_rays = *frame; /* a mean needs no correction by a few of them */
    without_rays.rays_texture = 0;
    memset(without_rays.rays_offset, 0, sizeof without_rays.rays_offset);
    call c = {.function = "glssao_accumulate", .frame = &without_rays, .settings = &estimate};
    c.estimates = glssao__accumulate_next(&effect->accumulation, &without_rays, &estimate);
    return run_call(effect, &c);
}

void glssao_restart_accumulation(glssao_effect *effect)
{
    if (effect)
        glssao__accumulate_stop(&effect->accumulation, &effect->gl);
}

/* ---- normals ---- */

glssao_result glssao_begin_normals(glssao_effect *effect, uint32_t depth_texture)
{
    if (!effect || !glssao__effect_is_closed(effect, "glssao_begin_normals"))
        return GLSSAO_INVALID_ARGUMENT;
    const glssao__gl *gl = &effect->gl;
    const bool host_restores = effect->host_restores_state;
    const glssao__target *normal_map = &effect->resources.targets[MAP_NORMAL];
    const glssao__state_need need = glssao__normals_need();
    glssao__state state;
    glssao_result result = glssao__effect_check_state(effect, "glssao_begin_normals");
    if (result != GLSSAO_OK)
        return result;
    glssao__state_save(gl, &need, host_restores, &state);
    result = glssao__normals_begin(&effect->normals, gl, &effect->log, normal_map, depth_texture, host_restores);
    glssao__state_restore(gl, &state);
    if (result == GLSSAO_OK) {
        glssao__normals_open(&effect->normals, gl, normal_map, host_restores);
        effect->last.depth_texture = depth_texture;
    }
    glssao__resources_check(&effect->resources, "glssao_begin_normals");
    return result;
}

glssao_result glssao_end_normals(glssao_effect *effect)
{
    if (!effect)
        return GLSSAO_INVALID_ARGUMENT;
    if (!effect->normals.is_open)
        return glssao__log_refuse(&effect->log, "glssao_end_normals called without glssao_begin_normals");
    const glssao__target *normal_map = &effect->resources.targets[MAP_NORMAL];
    if (!effect->host_restores_state && !glssao__normals_are_bound(&effect->gl, normal_map))
        return glssao__log_refuse(&effect->log,
                                  "glssao_end_normals: the framebuffer of glssao_begin_normals is not bound; bind it "
                                  "again, and end pairs of several effects in reverse order");
    glssao__normals_close(&effect->normals, &effect->gl, normal_map, effect->host_restores_state);
    glssao__resources_check(&effect->resources, "glssao_end_normals");
    return GLSSAO_OK;
}

/* ---- statistics ---- */

static void add_time(glssao_stats *stats, const glssao__timers *timers, int section, glssao_pass pass)
{
    const double ms = timers->known_ms[section];
    if (timers->known_frame == 0 || ms < 0.0)
        return;
    stats->passes[pass].gpu_ms = fmax(stats->passes[pass].gpu_ms, 0.0) + ms;
    stats->gpu_ms += ms;
}

glssao_stats glssao_get_stats(glssao_effect *effect)
{
    glssao_stats stats = {.gpu_ms = -1.0, .sampling_error = -1.0};
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass) {
        stats.passes[pass].name = glssao__pass_name((glssao_pass)pass);
        stats.passes[pass].gpu_ms = -1.0;
    }
    if (!effect)
        return stats;
    glssao__timers *timers = &effect->resources.timers;
    stats.frame = effect->last.number;
    stats.estimates = effect->accumulation.count[0] + effect->accumulation.count[1];
    stats.sampling_error = glssao__accumulate_error(&effect->accumulation, &effect->gl);
    glssao__timers_poll(timers, &effect->gl);
    stats.timed_frame = timers->known_frame;
    if (timers->known_frame > 0)
        stats.gpu_ms = 0.0;
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass) {
        stats.passes[pass].draw_calls = effect->last.draw_calls[pass];
        stats.draw_calls += effect->last.draw_calls[pass];
        add_time(&stats, timers, pass, (glssao_pass)pass);
    }
    add_time(&stats, timers, SECTION_DEPTH_COPY, GLSSAO_PASS_INPUTS);
    return stats;
}
