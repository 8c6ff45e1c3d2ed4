/* SPDX-License-Identifier: MIT
 *
 * Targets, passes and read-back of one frame.
 */
#include "pipeline.h"

#include "camera.h"
#include "map_view.h"
#include "setting_table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The effect's lengths belong together: a radius other than the default's scales the others along. */
glssao_settings pipeline_settings(const options *o, const scene *s)
{
    const bool traced = o->technique == OPTIONS_RAYTRACE;
    glssao_settings settings =
        glssao_default_settings(traced ? GLSSAO_CLASSIC : (glssao_technique)o->technique, (glssao_quality)o->quality);
    if (traced) { /* of these, the tracer uses the radius, and its own: */
        settings.power = 1;
        settings.sample_count = 512;
    }
    float radius = settings.radius;
    if (o->radius.given) {
        radius = o->radius.value;
    } else if (o->scene_path) {
        radius = camera_suggest_radius(s);
    }
    setting_scale_radius(&settings, radius);
    if (o->power.given) {
        settings.power = o->power.value;
    }
    if (o->sample_count) {
        settings.sample_count = o->sample_count;
    }
    if (o->blur_rounds >= 0) {
        settings.blur_rounds = o->blur_rounds;
    }
    if (o->set) {
        char fault[256];
        setting_apply(o->set, &settings, fault, sizeof fault); /* options_parse saw that it is right */
    }
    return settings;
}

static GLuint make_texture(GLenum internal_format, GLenum format, GLenum type, int width, int height)
{
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal_format, width, height, 0, format, type, NULL);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST); /* the default wants mipmaps */
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

/* Leaves it bound. Either texture may be 0. */
static bool make_framebuffer(GLuint color, GLuint depth, GLuint *out)
{
    gl.GenFramebuffers(1, out);
    gl.BindFramebuffer(GL_FRAMEBUFFER, *out);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color, 0);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    if (!color) {
        gl.DrawBuffer(GL_NONE);
        gl.ReadBuffer(GL_NONE);
    }
    return gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static bool check_size(int width, int height, char *error, size_t error_size)
{
    GLint max_size = 0;
    GLint max_viewport[2] = {0, 0};
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &max_size);
    gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, max_viewport);
    const int max_width = max_size < max_viewport[0] ? max_size : max_viewport[0];
    const int max_height = max_size < max_viewport[1] ? max_size : max_viewport[1];
    if (width > max_width || height > max_height) {
        snprintf(error, error_size, "--size %dx%d: this context draws up to %dx%d", width, height, max_width,
                 max_height);
        return false;
    }
    return true;
}

static void free_targets(pipeline *p)
{
    gl.DeleteFramebuffers(1, &p->depth_framebuffer);
    gl.DeleteFramebuffers(1, &p->color_framebuffer);
    gl.DeleteTextures(1, &p->depth);
    gl.DeleteTextures(1, &p->color);
    gl.DeleteFramebuffers(1, &p->layer_framebuffer);
    gl.DeleteTextures(2, p->layers);
    p->layers[0] = p->layers[1] = p->layer_framebuffer = 0;
    p->depth_framebuffer = p->color_framebuffer = p->depth = p->color = 0;
    map_view_free(p);
}

static bool make_targets(pipeline *p, char *error, size_t error_size)
{
    bool complete = true;
    p->depth = make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, p->width, p->height);
    if (!p->effect) {
        complete = make_framebuffer(0, p->depth, &p->depth_framebuffer);
    }
    if (p->wants.picture) {
        p->color = make_texture(GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, p->width, p->height);
        complete = make_framebuffer(p->color, p->depth, &p->color_framebuffer) && complete;
    }
    for (int i = 0; p->draw_options.layers && i < 2; i++) {
        p->layers[i] = make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, p->width, p->height);
    }
    if (p->draw_options.layers) {
        complete = make_framebuffer(0, p->layers[0], &p->layer_framebuffer) && complete;
    }
    const GLenum gl_error = gl.GetError();
    if (!complete || gl_error != GL_NO_ERROR) {
        snprintf(error, error_size, "--size %dx%d: no framebuffer of that size (OpenGL error 0x%04x)", p->width,
                 p->height, gl_error);
        return false;
    }
    return true;
}

bool pipeline_resize(pipeline *p, int width, int height, char *error, size_t error_size)
{
    if (!check_size(width, height, error, error_size)) {
        return false;
    }
    const glssao_result result = p->effect ? glssao_resize(p->effect, width, height) : GLSSAO_OK;
    if (result != GLSSAO_OK) {
        snprintf(error, error_size, "glssao_resize failed: %s", glssao_result_string(result));
        return false;
    }
    free_targets(p);
    p->width = width;
    p->height = height;
    return make_targets(p, error, error_size);
}

bool pipeline_create(pipeline *p, const scene *s, glssao_load_fn load, void *load_user, const options *o,
                     pipeline_wants wants, char *error, size_t error_size)
{
    *p = (pipeline){.wants = wants,
                    .width = o->width + 2 * o->margin,
                    .height = o->height + 2 * o->margin,
                    .margin = o->margin,
                    .seed = o->seed};
    if (!check_size(p->width, p->height, error, error_size)) {
        return false;
    }
    p->settings = pipeline_settings(o, s);
    p->goal = (progressive_goal){.error = (double)o->error.value, .budget_ms = (double)o->budget_ms.value};
    p->lights = malloc((s->light_count + 1u) * sizeof *p->lights);
    p->renderer = p->lights ? scene_renderer_create(s, error, error_size) : NULL;
    if (!p->renderer) {
        return false;
    }
    p->lighting = scene_lighting_of(s, p->lights);
    p->draw_options = (scene_draw_options){.shadows = !o->no_shadows,
                                           .shadow_size = o->shadow_size,
                                           .mapped_normals = o->mapped_normals,
                                           .specular_occlusion = o->specular_occlusion,
                                           .multi_bounce = o->multi_bounce,
                                           .layers = wants.ao && o->layers == 2,
                                           .no_picture = !wants.picture};
    if (!scene_renderer_configure(p->renderer, &p->lighting, &p->draw_options, error, error_size)) {
        return false;
    }
    p->debug_map = (options_map)o->debug_map;
    if (wants.traced && !truth_open(&p->truth, s, o->width, o->height, error, error_size)) {
        return false;
    }
    if (wants.normals) {
        const glssao_config config = {.load = load,
                                      .load_user = load_user,
                                      .log = glssao_log_to_stderr,
                                      .width = p->width,
                                      .height = p->height,
                                      .seed = o->seed,
                                      .no_timers = !wants.timers};
        const glssao_result result = glssao_create(&config, &p->effect);
        if (result != GLSSAO_OK) {
            snprintf(error, error_size, "the effect can't be made: %s", glssao_result_string(result));
            return false;
        }
    }
    return make_targets(p, error, error_size);
}

void pipeline_destroy(pipeline *p)
{
    glssao_destroy(p->effect);
    truth_close(&p->truth);
    if (p->renderer) {
        free_targets(p);
        scene_renderer_destroy(p->renderer);
    }
    free(p->lights);
    *p = (pipeline){0};
}

static bool check(glssao_result result, const char *what, char *error, size_t error_size)
{
    if (result != GLSSAO_OK) {
        snprintf(error, error_size, "%s failed: %s", what, glssao_result_string(result));
    }
    return result == GLSSAO_OK;
}

static bool draw_prepass(pipeline *p, const scene_view *view, char *error, size_t error_size)
{
    if (p->effect) {
        if (!check(glssao_begin_normals(p->effect, p->depth), "glssao_begin_normals", error, error_size)) {
            return false;
        }
        scene_draw_normals(p->renderer, view);
        if (!check(glssao_end_normals(p->effect), "glssao_end_normals", error, error_size)) {
            return false;
        }
        for (int i = 0; p->draw_options.layers && i < 2; i++) {
            gl.BindFramebuffer(GL_FRAMEBUFFER, p->layer_framebuffer);
            gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, p->layers[i], 0);
            scene_draw_layer(p->renderer, view, p->depth, i == 0 ? SCENE_LAYER_BACK : SCENE_LAYER_SECOND);
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

static bool has_ambient(const scene_lighting *l)
{
    bool any = false;
    for (int i = 0; i < 3; i++) {
        any = any || l->ambient[i] != 0 || l->ambient_tilt[i] != 0;
    }
    return any;
}

static glssao_frame make_frame(const pipeline *p, const scene_view *view)
{
    glssao_frame frame = {.depth_texture = p->depth,
                          .margin = p->margin,
                          .back_texture = p->layers[0],
                          .second_texture = p->layers[1],
                          .normal_texture = glssao_map(p->effect, GLSSAO_MAP_NORMAL, NULL, NULL)};
    memcpy(frame.projection, view->clip_from_view, sizeof frame.projection);
    frame.only_sky = scene_find_seen(p->renderer, view).opaque == 0;
    /* Accessibility scales nothing else; but a map that was asked for itself is made. */
    frame.no_ambient_light = p->wants.picture && !p->wants.ao_map && !has_ambient(&p->lighting);
    return frame;
}

static bool find_accessibility(pipeline *p, const scene_view *view, char *error, size_t error_size)
{
    if (p->wants.traced) {
        return truth_trace(&p->truth, view, &p->settings, p->seed, error, error_size);
    }
    const glssao_frame frame = make_frame(p, view);
    if (p->goal.error <= 0 && p->goal.budget_ms <= 0) {
        return check(glssao_compute(p->effect, &frame, &p->settings), "glssao_compute", error, error_size);
    }
    const glssao_result result = progressive_run(p->effect, &frame, &p->settings, &p->goal, &p->reached);
    if (result == GLSSAO_OK) {
        progressive_print(&p->reached, &p->goal);
    }
    return check(result, "glssao_accumulate", error, error_size);
}

GLuint pipeline_ambient_map(const pipeline *p)
{
    return p->wants.traced ? p->truth.map : glssao_map(p->effect, GLSSAO_MAP_AMBIENT, NULL, NULL);
}

void pipeline_shade(pipeline *p, const scene_view *view, GLuint ambient_map, GLuint framebuffer)
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
    if (p->debug_map) {
        map_view_draw(p, view, p->debug_map, map_view_inset(p, p->debug_map), framebuffer);
    }
}

bool pipeline_draw(pipeline *p, const scene_view *view, stopwatch *times, char *error, size_t error_size)
{
    if (p->wants.prepass) {
        if (!draw_prepass(p, view, error, error_size)) {
            return false;
        }
        stopwatch_lap(times, PHASE_PREPASS);
    }
    if (p->wants.ao) {
        if (!find_accessibility(p, view, error, error_size)) {
            return false;
        }
        stopwatch_lap(times, PHASE_AO);
    }
    if (p->wants.picture) {
        pipeline_shade(p, view, p->wants.ao ? pipeline_ambient_map(p) : 0, p->color_framebuffer);
        stopwatch_lap(times, PHASE_MAIN);
    }
    return true;
}

static void *read_framebuffer(const pipeline *p, GLuint framebuffer, pixel_kind kind)
{
    static const struct {
        GLenum format, type;
        size_t size;
    } layouts[] = {[PIXELS_RGBA8] = {GL_RGBA, GL_UNSIGNED_BYTE, 4},
                   [PIXELS_GREY8] = {GL_RED, GL_UNSIGNED_BYTE, 1},
                   [PIXELS_FLOAT] = {GL_RED, GL_FLOAT, 4}};
    const int width = p->width - 2 * p->margin, height = p->height - 2 * p->margin;
    void *pixels = malloc((size_t)width * (size_t)height * layouts[kind].size);
    if (pixels) {
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
        gl.ReadPixels(p->margin, p->margin, width, height, layouts[kind].format, layouts[kind].type, pixels);
    }
    return pixels;
}

void *pipeline_read_picture(pipeline *p)
{
    return read_framebuffer(p, p->color_framebuffer, PIXELS_RGBA8);
}

/* How to draw a map over a target that is read back at full size. */
typedef struct map_drawing {
    GLuint texture;
    scene_rectangle place;
    bool red_only;
    float scale, bias;
    const scene_view *view; /* not NULL: view distances of the depth texture instead */
} map_drawing;

static void *read_map(pipeline *p, const map_drawing *drawing, pixel_kind kind)
{
    static const struct {
        GLenum internal_format, format, type;
    } layouts[] = {[PIXELS_RGBA8] = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
                   [PIXELS_GREY8] = {GL_R8, GL_RED, GL_UNSIGNED_BYTE},
                   [PIXELS_FLOAT] = {GL_R32F, GL_RED, GL_FLOAT}};
    void *pixels = NULL;
    GLuint framebuffer;
    const GLuint texture =
        make_texture(layouts[kind].internal_format, layouts[kind].format, layouts[kind].type, p->width, p->height);
    if (make_framebuffer(texture, 0, &framebuffer)) {
        gl.Viewport(0, 0, p->width, p->height);
        if (drawing->view) {
            scene_draw_view_distance(p->renderer, drawing->view, drawing->texture);
        } else {
            scene_draw_map_in(p->renderer, drawing->texture, drawing->place, drawing->red_only, drawing->scale,
                              drawing->bias);
        }
        pixels = read_framebuffer(p, framebuffer, kind);
    }
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(1, &texture);
    return pixels;
}

void *pipeline_read_ao(pipeline *p, pixel_kind kind)
{
    if (p->wants.traced && kind == PIXELS_FLOAT) { /* as traced, past any filter */
        const size_t size = (size_t)p->width * (size_t)p->height * sizeof(float);
        void *copy = malloc(size);
        return copy ? memcpy(copy, p->truth.accessibility, size) : NULL;
    }
    const int m = p->margin;
    const scene_rectangle delivered = {m, m, p->width - 2 * m, p->height - 2 * m};
    return read_map(
        p, &(map_drawing){.texture = pipeline_ambient_map(p), .place = delivered, .red_only = true, .scale = 1}, kind);
}

void *pipeline_read_normals(pipeline *p)
{
    const GLuint map = glssao_map(p->effect, GLSSAO_MAP_NORMAL, NULL, NULL);
    const scene_rectangle whole = {0, 0, p->width, p->height};
    return read_map(p, &(map_drawing){.texture = map, .place = whole, .scale = 0.5f, .bias = 0.5f}, PIXELS_RGBA8);
}

void *pipeline_read_view_distance(pipeline *p, const scene_view *view)
{
    return read_map(p, &(map_drawing){.texture = p->depth, .view = view}, PIXELS_FLOAT);
}

static void print_row(const char *name, bool run, int draws, int width, int height, const char *reason)
{
    char draw_text[16] = "-", size_text[32] = "-";
    if (run && draws >= 0) {
        snprintf(draw_text, sizeof draw_text, "%d", draws);
    }
    if (run) {
        snprintf(size_text, sizeof size_text, "%dx%d", width, height);
    }
    printf("%-12s %-5s %5s  %-12s %s\n", name, run ? "run" : "skip", draw_text, size_text, reason);
}

void pipeline_print_plan(const pipeline *p, const scene_view *view)
{
    printf("%-12s %-5s %5s  %-12s %s\n", "pass", "", "draws", "size", "reason");
    print_row("pre-pass", p->wants.prepass, -1, p->width, p->height,
              p->effect          ? "depth and view-space normals"
              : p->wants.prepass ? "depth alone: nothing reads normals"
                                 : "rays find their surfaces themselves");
    if (p->wants.traced) {
        print_row("raytrace", true, 0, p->width, p->height, "rays from each pixel's surface, on the processor");
    } else if (p->wants.ao) {
        const glssao_frame frame = make_frame(p, view);
        const glssao_plan plan = glssao_plan_frame(p->effect, &frame, &p->settings);
        for (int i = 0; i < GLSSAO_PASS_COUNT; i++) {
            if (i != GLSSAO_PASS_APPLY) { /* the main pass reads the map itself */
                print_row(plan.passes[i].name, plan.passes[i].run, plan.passes[i].draw_calls, plan.passes[i].width,
                          plan.passes[i].height, plan.passes[i].reason);
            }
        }
    } else {
        print_row("occlusion", false, 0, 0, 0, "no output reads it");
    }
    print_row("layers", p->draw_options.layers, -1, p->width, p->height,
              p->draw_options.layers ? "back faces and the next fronts, for thickness" : "not asked for");
    print_row("main", p->wants.picture, -1, p->width, p->height,
              !p->wants.picture ? "no shaded picture is wanted"
              : p->wants.ao     ? "shades, ambient light scaled by accessibility"
                                : "shades, ambient light in full");
    const scene_seen seen = scene_find_seen(p->renderer, view);
    const unsigned hidden = seen.opaque_total + seen.blended_total - seen.opaque - seen.blended;
    char text[128];
    snprintf(text, sizeof text, "%u of %u draw calls lie outside the view and are not issued", hidden,
             seen.opaque_total + seen.blended_total);
    print_row("culling", hidden > 0, (int)(seen.opaque + seen.blended), p->width, p->height, text);
    scene_effect effects[SCENE_EFFECT_COUNT];
    scene_renderer_effects(p->renderer, &p->lighting, effects);
    for (int i = 0; p->wants.picture && i < SCENE_EFFECT_COUNT; i++) {
        printf("%-12s %-5s %5s  %-12s %s\n", effects[i].name, effects[i].used ? "use" : "skip", "-", "-",
               effects[i].reason);
    }
}
