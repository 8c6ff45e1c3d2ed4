/* SPDX-License-Identifier: MIT
 *
 * The passes of a frame, and everything they need except targets.
 */
#define _POSIX_C_SOURCE 200809L
#include "pipeline.h"

#include "camera.h"
#include "map_view.h"
#include "setting_table.h"
#include "stop.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A radius that differs from that of the level scales the other lengths of the effect by the same factor. */
glssao_settings pipeline_settings_at(const options *o, float radius)
{
    const bool traced = o->technique == OPTIONS_RAYTRACE;
    glssao_settings settings =
        glssao_default_settings(traced ? GLSSAO_CLASSIC : (glssao_technique)o->technique, (glssao_quality)o->quality);
    if (traced) { /* the tracer uses the radius and these two */
        settings.power = 1;
        settings.sample_count = 512;
    }
    const bool given = o->radius.given && !o->radius_in_pixels;
    setting_scale_radius(&settings, given ? o->radius.value : radius > 0 ? radius : settings.radius);
    settings.radius_in_pixels = o->radius_in_pixels;
    if (o->radius_in_pixels)
        settings.radius = o->radius.given ? o->radius.value : (float)SETTING_PIXELS;
    if (o->thickness.given)
        settings.thickness = o->thickness.value;
    if (o->fade_far.given) {
        settings.fade_far_start = (float)o->fade_far.value[0];
        settings.fade_far_end = (float)o->fade_far.value[1];
    }
    if (o->power.given)
        settings.power = o->power.value;
    if (o->sample_count)
        settings.sample_count = o->sample_count;
    if (o->technique == GLSSAO_RAYS && o->rays)
        settings.sample_count = o->rays;
    if (o->blur_rounds >= 0)
        settings.blur_rounds = o->blur_rounds;
    if (o->history >= 0)
        settings.history = o->history;
    settings.bent_normals = o->bent_normals && settings.technique == GLSSAO_HORIZON;
    if (o->set) {
        setting_apply(o->set, &settings, &(failure){0}); /* options_parse made sure that it is valid */
    }
    return settings;
}

glssao_settings pipeline_settings(const options *o, const scene *s)
{
    return pipeline_settings_at(o, o->scene_path ? camera_suggest_radius(s) : 0);
}

/* The last error that the library logged. It becomes part of the line that reports a failed job. */
static char heard[200];

static void hear(glssao_log_level level, const char *message, void *user)
{
    glssao_log_to_stderr(level, message, user);
    if (level == GLSSAO_LOG_ERROR)
        snprintf(heard, sizeof heard, "%.*s", (int)strcspn(message, "\n"), message);
}

bool pipeline_check(glssao_result result, const char *what, failure *why)
{
    if (result != GLSSAO_OK) {
        fault_set(why, "%s failed: %s%s%s", what, glssao_result_string(result), heard[0] ? ": " : "", heard);
        heard[0] = '\0';
    }
    return result == GLSSAO_OK;
}

static bool is_folder(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

static bool prepare_effect(pipeline *p, glssao_load_fn load, void *load_user, const options *o, failure *why)
{
    p->effect = NULL;
    if (!p->wants.normals)
        return true;
    if (p->kept && (p->seed != o->seed || p->kept_timers != p->wants.timers || p->kept_path != (glssao_path)o->path)) {
        glssao_destroy(p->kept);
        p->kept = NULL;
    }
    if (!p->kept) {
        if (o->program_cache && !is_folder(o->program_cache))
            return fault_set(why, "--program-cache %s: no such folder", o->program_cache);
        const glssao_config config = {.load = load,
                                      .load_user = load_user,
                                      .log = hear,
                                      .width = p->width,
                                      .height = p->height,
                                      .seed = o->seed,
                                      .no_timers = !p->wants.timers,
                                      .path = (glssao_path)o->path,
                                      .program_cache = o->program_cache};
        const glssao_result result = glssao_create(&config, &p->kept);
        if (!pipeline_check(result, "glssao_create", why))
            return false;
        p->kept_timers = p->wants.timers;
        p->kept_path = (glssao_path)o->path;
    }
    p->effect = p->kept;
    return true;
}

static void drop_environment(pipeline *p)
{
    scene_environment_destroy(p->environment);
    free(p->environment_path);
    p->environment = NULL;
    p->environment_path = NULL;
}

bool pipeline_surround(pipeline *p, const stage *st, const char *path, failure *why)
{
    if (!path) {
        drop_environment(p);
    } else if (!p->environment_path || strcmp(path, p->environment_path) != 0) {
        scene_environment *loaded = scene_environment_load(path, why);
        if (!loaded)
            return false;
        drop_environment(p);
        p->environment = loaded;
        p->environment_path = strdup(path);
    }
    p->lighting = st->lighting;
    scene_lighting_surround(&p->lighting, st->scene, p->environment);
    scene_lighting_turn(&p->lighting, st->scene, p->up);
    p->lighting.plain = p->plain;
    memcpy(p->lighting.background, p->background, sizeof p->background);
    return true;
}

/* Pixels to one that rays are traced from: as many as to one of the estimate. */
static int ray_step(const pipeline *p)
{
    return p->settings.half_resolution ? 2 : 1;
}

bool pipeline_prepare(pipeline *p, stage *st, glssao_load_fn load, void *load_user, const options *o,
                      pipeline_wants wants, failure *why)
{
    const int width = o->width + 2 * o->margin, height = o->height + 2 * o->margin;
    p->wants = wants;
    p->renderer = st->renderer;
    p->plain = options_parse_background(o->background, p->background);
    p->transparent = p->plain && p->background[3] == 0;
    for (int i = 0; i < 3; i++)
        p->up[i] = o->sky_up.given ? (float)o->sky_up.value[i] : o->up.given ? (float)o->up.value[i] : i == 1;
    if (!pipeline_surround(p, st, wants.picture ? o->environment : NULL, why))
        return false;
    if ((width != p->width || height != p->height) && !pipeline_change_size(p, width, height, why))
        return false;
    p->margin = o->margin;
    p->settings = pipeline_settings(o, st->scene);
    p->goal = (progressive_goal){.error = (double)o->error.value, .budget_ms = (double)o->budget_ms.value};
    p->reached = (progressive_report){0};
    p->draw_options = (scene_draw_options){.shadows = !o->no_shadows,
                                           .shadow_size = o->shadow_size,
                                           .mapped_normals = o->mapped_normals,
                                           .specular_occlusion = o->specular_occlusion,
                                           .multi_bounce = o->multi_bounce,
                                           .bent = o->bent_normals && p->settings.bent_normals && wants.ao,
                                           .left_out = o->intensity.given ? 1 - o->intensity.value : 0,
                                           .layers = wants.ao && o->layers == 2,
                                           .motion = wants.motion,
                                           .no_picture = !wants.picture,
                                           .no_prepass = !wants.prepass};
    p->debug_map = (options_map)o->debug_map;
    if (!scene_renderer_configure(p->renderer, &p->lighting, &p->draw_options, why))
        return false;
    p->adaptive_rays = o->adaptive_rays;
    p->ray_count = o->technique == GLSSAO_RAYS ? p->settings.sample_count : o->rays;
    if (wants.rays && (!stage_trace(st, why) || !rays_open(&p->rays, p->width, p->height, ray_step(p), why)))
        return false;
    p->traced = st->traced;
    if (wants.traced && (!stage_trace(st, why) || !truth_open(&p->truth, st->traced, o->width, o->height, why)))
        return false;
    if (!prepare_effect(p, load, load_user, o, why))
        return false;
    p->seed = o->seed;
    return pipeline_make_targets(p, why);
}

bool pipeline_create(pipeline *p, const scene *s, glssao_load_fn load, void *load_user, const options *o,
                     pipeline_wants wants, failure *why)
{
    *p = (pipeline){.margin = 0};
    return stage_open(&p->own, s, why) && pipeline_prepare(p, &p->own, load, load_user, o, wants, why);
}

void pipeline_destroy(pipeline *p)
{
    glssao_destroy(p->kept);
    truth_close(&p->truth);
    rays_close(&p->rays);
    if (p->renderer) {
        drop_environment(p);
        pipeline_free_targets(p);
    }
    stage_close(&p->own);
    *p = (pipeline){.margin = 0};
}

bool pipeline_runs_occlusion(const pipeline *p, const scene_view *view)
{
    if (!p->wants.ao || p->wants.traced)
        return false;
    const glssao_frame frame = pipeline_frame(p, view);
    return glssao_plan_frame(p->effect, &frame, &p->settings).passes[GLSSAO_PASS_ESTIMATE].run;
}

bool pipeline_reads_normals(const pipeline *p, const scene_view *view)
{
    return p->effect && (p->wants.normal_map || pipeline_runs_occlusion(p, view));
}

static bool reads_motion(const pipeline *p)
{
    return p->wants.motion && p->is_posed && p->has_last;
}

static bool draw_prepass(pipeline *p, const scene_view *view, failure *why)
{
    if (pipeline_reads_normals(p, view)) {
        if (!pipeline_check(glssao_begin_normals(p->effect, p->depth), "glssao_begin_normals", why))
            return false;
        scene_draw_normals(p->renderer, view);
        if (!pipeline_check(glssao_end_normals(p->effect), "glssao_end_normals", why))
            return false;
        for (int i = 0; p->draw_options.layers && pipeline_runs_occlusion(p, view) && i < 2; i++) {
            gl.BindFramebuffer(GL_FRAMEBUFFER, p->layer_framebuffer);
            gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, p->layers[i], 0);
            scene_draw_layer(p->renderer, view, p->depth, i == 0 ? SCENE_LAYER_BACK : SCENE_LAYER_SECOND);
        }
        if (reads_motion(p) && pipeline_runs_occlusion(p, view)) {
            gl.BindFramebuffer(GL_FRAMEBUFFER, p->motion_framebuffer);
            scene_draw_motion(p->renderer, view, &p->last_view);
        }
        return true;
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, p->depth_framebuffer);
    gl.Viewport(0, 0, p->width, p->height);
    gl.DepthMask(GL_TRUE);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    scene_draw_normals(p->renderer, view);
    return true;
}

glssao_frame pipeline_frame(const pipeline *p, const scene_view *view)
{
    glssao_frame frame = {.depth_texture = p->depth,
                          .margin = p->margin,
                          .back_texture = p->draw_options.layers ? p->layers[0] : 0,
                          .second_texture = p->draw_options.layers ? p->layers[1] : 0,
                          .normal_texture = glssao_map(p->effect, GLSSAO_MAP_NORMAL, NULL, NULL),
                          .rays_texture = p->wants.rays || p->rays_ready ? p->rays.texture : 0,
                          .motion_texture = reads_motion(p) ? p->motion : 0,
                          .cut = !p->has_last};
    if (frame.rays_texture)
        memcpy(frame.rays_offset, p->rays.offset, sizeof frame.rays_offset);
    memcpy(frame.projection, view->clip_from_view, sizeof frame.projection);
    memcpy(frame.view, view->view_from_world, sizeof frame.view);
    const scene_seen seen = scene_find_seen(p->renderer, view);
    frame.only_sky = seen.opaque == 0;
    /* The picture uses accessibility only for ambient light. A map that is written is always made. */
    frame.no_ambient_light =
        p->wants.picture && !p->wants.ao_map && (seen.lit == 0 || !scene_lighting_has_ambient(&p->lighting));
    return frame;
}

static bool is_stopped(void *user)
{
    (void)user;
    return stop_signal();
}

static rays_job make_rays_job(const pipeline *p, const scene_view *view, int step)
{
    return (rays_job){.renderer = p->renderer,
                      .depth = p->depth,
                      .normals = glssao_map(p->effect, GLSSAO_MAP_NORMAL, NULL, NULL),
                      .view = view,
                      .margin = p->margin,
                      .step = step};
}

static bool trace_rays(pipeline *p, const scene_view *view, int index, failure *why)
{
    rays_job job = make_rays_job(p, view, ray_step(p));
    job.options = (trace_options){.radius = p->settings.radius,
                                  .samples = p->ray_count,
                                  .adaptive = p->adaptive_rays,
                                  .seed = p->seed + (uint32_t)index * 0x9e3779b9u + p->frame_number * 0x85ebca6bu,
                                  .stopped = is_stopped};
    if (p->settings.history > 0 && job.step == 2)
        rays_choose_offset(p->frame_number, job.offset);
    return rays_trace(&p->rays, p->traced, &job, why);
}

float (*pipeline_read_surfaces(pipeline *p, const scene_view *view, int step, failure *why))[4]
{
    const rays_job job = make_rays_job(p, view, step);
    return rays_read_surfaces(&p->rays, &job, why);
}

/* Finds accessibility for one of `count` samples of a pixel. The picture shows their mean. So each sample gets its
 * share of the rays and of the time, and a larger sampling error. */
static bool find_accessibility(pipeline *p, const scene_view *view, int index, int count, failure *why)
{
    if (p->wants.traced) {
        glssao_settings share = p->settings;
        share.sample_count = (share.sample_count + count - 1) / count;
        return truth_trace(&p->truth, view, &share, p->seed + (uint32_t)index * 0x9e3779b9u, why);
    }
    if (p->wants.rays && pipeline_runs_occlusion(p, view) && !trace_rays(p, view, index, why))
        return false;
    const glssao_frame frame = pipeline_frame(p, view);
    if (p->goal.error <= 0 && p->goal.budget_ms <= 0) {
        p->has_last = pipeline_check(glssao_compute(p->effect, &frame, &p->settings), "glssao_compute", why);
        p->last_view = *view;
        p->frame_number += p->settings.history > 0;
        p->is_posed = false;
        return p->has_last;
    }
    const progressive_goal share = {p->goal.error * sqrt(count), p->goal.budget_ms / count};
    const glssao_result result = progressive_run(p->effect, &frame, &p->settings, &share, &p->reached);
    return pipeline_check(result, "glssao_accumulate", why);
}

bool pipeline_occlude(pipeline *p, const scene_view *view, failure *why)
{
    return find_accessibility(p, view, 0, 1, why);
}

bool pipeline_accumulate(pipeline *p, const scene_view *view, const progressive_goal *goal, failure *why)
{
    const glssao_frame frame = pipeline_frame(p, view);
    return pipeline_check(progressive_step(p->effect, &frame, &p->settings, goal, &p->reached), "glssao_accumulate",
                          why);
}

GLuint pipeline_ambient_map(const pipeline *p)
{
    return p->wants.traced ? p->truth.map : glssao_map(p->effect, GLSSAO_MAP_AMBIENT, NULL, NULL);
}

/* What ambient light is scaled by: accessibility, or with --bent-normals that and directions. 0: nothing. */
static GLuint find_light_map(const pipeline *p)
{
    if (!p->wants.ao)
        return 0;
    return p->draw_options.bent ? glssao_map(p->effect, GLSSAO_MAP_BENT_NORMAL, NULL, NULL) : pipeline_ambient_map(p);
}

static void shade(pipeline *p, const scene_view *view, GLuint ambient_map, GLuint framebuffer)
{
    scene_draw_shadow(p->renderer, &p->lighting);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.Viewport(0, 0, p->width, p->height);
    if (p->margin) {
        gl.Enable(GL_SCISSOR_TEST);
        gl.Scissor(p->margin, p->margin, p->width - 2 * p->margin, p->height - 2 * p->margin);
    }
    scene_draw_main(p->renderer, view, &p->lighting, ambient_map);
    gl.Disable(GL_SCISSOR_TEST);
}

static void draw_debug_map(pipeline *p, const scene_view *view, GLuint framebuffer)
{
    if (p->debug_map)
        map_view_draw(p, view, p->debug_map, map_view_inset(p, p->debug_map), framebuffer);
}

void pipeline_shade(pipeline *p, const scene_view *view, GLuint ambient_map, GLuint framebuffer)
{
    shade(p, view, ambient_map, framebuffer);
    draw_debug_map(p, view, framebuffer);
}

/* Draws the pre-pass and finds accessibility. */
static bool draw_maps(pipeline *p, const scene_view *view, int index, int count, stopwatch *times, failure *why)
{
    if (p->wants.prepass) {
        if (!draw_prepass(p, view, why))
            return false;
        stopwatch_lap(times, PHASE_PREPASS);
    }
    if (p->wants.ao) {
        if (!find_accessibility(p, view, index, count, why))
            return false;
        stopwatch_lap(times, PHASE_AO);
    }
    return true;
}

bool pipeline_draw(pipeline *p, const scene_view *view, stopwatch *times, failure *why)
{
    const int count = p->wants.samples;
    const bool averages = p->wants.picture && (count > 1 || p->transparent);
    for (int i = 0; averages && i < count; i++) {
        const scene_view shifted = samples_view(view, i, count);
        if (!draw_maps(p, &shifted, i, count, times, why))
            return false;
        shade(p, &shifted, find_light_map(p), p->samples.framebuffer);
        samples_add(&p->samples, i == 0);
        stopwatch_lap(times, PHASE_MAIN);
    }
    if (averages)
        samples_resolve(&p->samples, count, p->color_framebuffer);
    /* Maps belong to the centres of the pixels. */
    const bool has_maps = averages && (count == 1 || !p->wants.maps);
    if (!has_maps && !draw_maps(p, view, 0, 1, times, why))
        return false;
    if (p->wants.picture && !averages)
        shade(p, view, find_light_map(p), p->color_framebuffer);
    if (p->wants.picture) {
        draw_debug_map(p, view, p->color_framebuffer);
        stopwatch_lap(times, PHASE_MAIN);
    }
    return true;
}
