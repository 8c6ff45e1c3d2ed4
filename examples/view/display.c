/* SPDX-License-Identifier: MIT
 *
 * Draws what is on the screen: the frame with or without occlusion, halves of both, or one of its maps. Pictures are
 * copied to the window unchanged, so that it shows the bits that glssao-render writes.
 */
#include "viewer.h"

#include "map_view.h"

#include <GLFW/glfw3.h>

#include <stdlib.h>
#include <string.h>

static const double quick_seconds = 0.1; /* with a filled Mesa cache it takes 0.02 s, otherwise 0.25 s or more */

static GLuint make_target(GLenum format, int width, int height, GLuint depth, GLuint *out_framebuffer)
{
    const GLuint texture = gl_make_texture(format, GL_RGBA, GL_UNSIGNED_BYTE, width, height, NULL);
    (void)gl_make_framebuffer(texture, depth, out_framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return texture;
}

void viewer_free_targets(viewer *v)
{
    gl.DeleteFramebuffers(1, &v->off_framebuffer);
    gl.DeleteFramebuffers(1, &v->map_framebuffer);
    gl.DeleteTextures(1, &v->off_color);
    gl.DeleteTextures(1, &v->map);
    v->off_framebuffer = v->map_framebuffer = v->off_color = v->map = 0;
}

bool viewer_resize(viewer *v, int width, int height)
{
    viewer_drop_truth(v);
    rays_view_drop(v);
    viewer_free_targets(v);
    v->width = width;
    v->height = height;
    v->frame_due = true;
    if (!pipeline_resize(&v->pipeline, width, height, FAULT(v->error))) {
        viewer_say(v, true, "%s", v->error);
        return false;
    }
    if (!v->moved)
        viewer_frame_scene(v); /* as glssao-render does for this size */
    return true;
}

static bool needs_off(const viewer *v)
{
    return v->shown == SHOWN_PICTURE && v->mode != MODE_ON;
}

/* The current settings, without blur and upsampling for the raw estimate. */
static glssao_settings frame_settings(const viewer *v)
{
    glssao_settings s = v->settings;
    if (!rest_reuses(v))
        s.history = 0;
    rays_view_adjust(v, &s);
    if (v->shown == SHOWN_RAW) {
        s.blur = GLSSAO_BLUR_NONE;
        s.blur_rounds = 0;
        s.upsample = false;
    }
    return s;
}

static void record_times(viewer *v, const stopwatch *times)
{
    const glssao_stats stats = glssao_get_stats(v->pipeline.effect);
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++)
        v->graph[i][v->graph_next] = stats.passes[i].gpu_ms > 0 ? (float)stats.passes[i].gpu_ms : 0;
    v->graph[GRAPH_PREPASS][v->graph_next] = (float)times->ms[PHASE_PREPASS];
    v->graph[GRAPH_MAIN][v->graph_next] = (float)times->ms[PHASE_MAIN];
    v->frame_ms[v->graph_next] = (float)(times->ms[PHASE_PREPASS] + times->ms[PHASE_AO] + times->ms[PHASE_MAIN]);
    v->graph_next = (v->graph_next + 1) % GRAPH_LENGTH;
}

/* Programs that are not in the driver's cache take a second or more until they run. The time that compiling takes tells
 * which case this is. */
static bool compiles_quickly(viewer *v)
{
    const double start = glfwGetTime();
    const glssao_frame frame = pipeline_frame(&v->pipeline, &v->view);
    return glssao_prepare(v->pipeline.effect, &frame, &v->pipeline.settings) == GLSSAO_OK &&
           glfwGetTime() - start < quick_seconds;
}

/* Only the horizon technique accumulates estimates. The raw estimate is a single one. With a history, a view that rests
 * comes to the goal. */
static progressive_goal frame_goal(const viewer *v)
{
    if (v->settings.technique != GLSSAO_HORIZON || v->shown == SHOWN_RAW || rest_reuses(v))
        return (progressive_goal){0};
    return (progressive_goal){(double)v->options.error.value, (double)v->options.budget_ms.value};
}

static bool find_view(viewer *v)
{
    const bool found = viewpoint_view(&v->viewpoint, v->scene, 0, v->width, v->height, &v->view, FAULT(v->error));
    if (!found)
        viewer_say(v, true, "%s", v->error);
    return found;
}

bool viewer_lights_bent(const viewer *v)
{
    return v->options.bent_normals && v->settings.bent_normals;
}

/* Without occlusion there are no bent normals to light by. */
static bool choose_light(viewer *v, bool occludes)
{
    pipeline *p = &v->pipeline;
    const bool bent = occludes && viewer_lights_bent(v);
    if (p->draw_options.bent == bent)
        return true;
    p->draw_options.bent = bent;
    if (scene_renderer_configure(p->renderer, &p->lighting, &p->draw_options, FAULT(v->error)))
        return true;
    viewer_say(v, true, "%s", v->error);
    return false;
}

static bool draw_frame(viewer *v)
{
    stopwatch times = {.finish = true};
    rays_view_take(v);
    v->pipeline.settings = frame_settings(v);
    v->pipeline.goal = frame_goal(v);
    v->pipeline.reached = (progressive_report){0};
    v->still_frames = 0;
    v->rested = false;
    stopwatch_start(&times);
    /* If compiling takes long, a picture without occlusion comes first. */
    v->pipeline.wants.ao = v->updates > 0 || compiles_quickly(v);
    if (!choose_light(v, v->pipeline.wants.ao))
        return false;
    if (!pipeline_draw(&v->pipeline, &v->view, &times, FAULT(v->error))) {
        viewer_say(v, true, "%s", v->error);
        return false;
    }
    v->frames++;
    v->reused += rest_reuses(v);
    record_times(v, &times);
    rays_view_ask(v);
    return true;
}

bool viewer_averages(const viewer *v)
{
    return v->pipeline.wants.samples > 1 || v->pipeline.transparent;
}

/* The picture without occlusion shows no map of occlusion. It uses the depth of the frame, or draws its own and then
 * comes before the frame. */
static bool draw_off(viewer *v)
{
    pipeline *p = &v->pipeline;
    const options_map corner = p->debug_map;
    const GLuint on = p->color_framebuffer;
    bool done = true;
    if (!choose_light(v, false))
        return false;
    if (!v->off_color)
        v->off_color = make_target(GL_SRGB8_ALPHA8, v->width, v->height, p->depth, &v->off_framebuffer);
    if (corner == OPTIONS_MAP_AO || corner == OPTIONS_MAP_TILES || corner == OPTIONS_MAP_BENT)
        p->debug_map = OPTIONS_MAP_NONE;
    if (viewer_averages(v)) {
        stopwatch times = {.finish = false};
        p->wants.ao = false;
        p->color_framebuffer = v->off_framebuffer;
        done = pipeline_draw(p, &v->view, &times, FAULT(v->error));
        p->color_framebuffer = on;
        p->wants.ao = true;
    } else {
        pipeline_shade(p, &v->view, 0, v->off_framebuffer);
    }
    p->debug_map = corner;
    if (!done)
        viewer_say(v, true, "%s", v->error);
    return done;
}

static void draw_map(viewer *v)
{
    static const options_map maps[SHOWN_COUNT] = {
        [SHOWN_AO] = OPTIONS_MAP_AO,           [SHOWN_RAW] = OPTIONS_MAP_AO,
        [SHOWN_NORMALS] = OPTIONS_MAP_NORMALS, [SHOWN_DISTANCE] = OPTIONS_MAP_DEPTH,
        [SHOWN_RANDOM] = OPTIONS_MAP_RANDOM,   [SHOWN_SHADOW] = OPTIONS_MAP_SHADOW,
        [SHOWN_TILES] = OPTIONS_MAP_TILES};
    scene_rectangle place = {0, 0, v->width, v->height};
    const float black[4] = {0, 0, 0, 1};
    if (!v->map)
        v->map = make_target(GL_RGBA8, v->width, v->height, 0, &v->map_framebuffer);
    if (viewer_shows_truth(v)) {
        viewer_draw_truth(v);
        return;
    }
    if (v->shown == SHOWN_SHADOW || v->shown == SHOWN_RANDOM) { /* the largest square that fits */
        const int side = v->width < v->height ? v->width : v->height;
        place = (scene_rectangle){(v->width - side) / 2, (v->height - side) / 2, side, side};
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, v->map_framebuffer);
    gl.ClearBufferfv(GL_COLOR, 0, black);
    map_view_draw(&v->pipeline, &v->view, maps[v->shown], place, v->map_framebuffer);
}

/* Copies the columns from `left` up to `right` without sRGB conversion. */
static void copy_columns(const viewer *v, GLuint from, GLuint to, int left, int right)
{
    if (right <= left)
        return;
    gl.Disable(GL_FRAMEBUFFER_SRGB);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, from);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    gl.BlitFramebuffer(left, 0, right, v->height, left, 0, right, v->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

static void compose(const viewer *v, GLuint to)
{
    const GLuint on = v->pipeline.color_framebuffer, off = v->off_framebuffer;
    if (v->shown != SHOWN_PICTURE) {
        copy_columns(v, v->map_framebuffer, to, 0, v->width);
    } else if (v->mode == MODE_SPLIT) {
        const int line = (int)(v->split * (float)v->width + 0.5f);
        copy_columns(v, off, to, 0, line);
        copy_columns(v, on, to, line, v->width);
    } else {
        const bool without = v->mode == MODE_OFF || (v->mode == MODE_BLINK && v->blink_off);
        copy_columns(v, without ? off : on, to, 0, v->width);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, to);
}

void viewer_display(viewer *v)
{
    const bool off_due = needs_off(v) && (v->frame_due || !v->off_color), off_first = off_due && viewer_averages(v);
    const bool due = v->frame_due || off_first || rays_view_is_due(v);
    if (due && !(find_view(v) && (!off_first || draw_off(v)) && draw_frame(v))) {
        v->frame_due = false;
        gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
        return;
    }
    v->frame_due = !v->pipeline.wants.ao;
    if (!due && rest_is_due(v))
        rest_step(v);
    if (off_due && !off_first)
        draw_off(v);
    if (v->shown != SHOWN_PICTURE && !(v->shown == SHOWN_AO && v->map && rest_hides(v)))
        draw_map(v);
    compose(v, 0);
}

void *viewer_read_shown(viewer *v)
{
    GLuint framebuffer;
    do /* earlier keys may have arrived in the same update; a view that rests is saved at its best */
        viewer_display(v);
    while (rest_is_due(v));
    const GLuint texture = make_target(GL_RGBA8, v->width, v->height, 0, &framebuffer);
    void *pixels = malloc((size_t)v->width * (size_t)v->height * 4);
    if (pixels) {
        compose(v, framebuffer);
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
        gl.ReadPixels(0, 0, v->width, v->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(1, &texture);
    return pixels;
}
