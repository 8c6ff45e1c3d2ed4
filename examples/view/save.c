/* SPDX-License-Identifier: MIT
 *
 * Saves pictures and writes command lines.
 */
#define _POSIX_C_SOURCE 200809L
#include "picture.h"
#include "setting_table.h"
#include "viewer.h"
#include "words.h"

#include <GLFW/glfw3.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The name from --output, or the first free name. */
static void choose_name(const viewer *v, char *out, size_t out_size)
{
    snprintf(out, out_size, "%s", v->options.output ? v->options.output : "");
    for (int i = 1; !v->options.output && i < 10000; i++) {
        snprintf(out, out_size, "glssao-view-%04d.png", i);
        if (access(out, F_OK) != 0)
            return;
    }
}

void viewer_save_picture(viewer *v)
{
    char name[4096];
    choose_name(v, name, sizeof name);
    if (!inputs_spare(&v->inputs, v->options.environment, name, FAULT(v->error))) {
        viewer_say(v, true, "%s", v->error);
        return;
    }
    uint8_t *pixels = viewer_read_shown(v);
    if (!pixels) {
        viewer_say(v, true, "%s: out of memory", name);
        return;
    }
    /* drop alpha, as glssao-render does, unless the background has none */
    const int channels = v->pipeline.transparent && v->shown == SHOWN_PICTURE ? 4 : 3;
    const size_t count = (size_t)v->width * (size_t)v->height;
    for (size_t i = 0; i < count && channels == 3; i++)
        memmove(pixels + 3 * i, pixels + 4 * i, 3);
    if (picture_write(name, v->width, v->height, channels, pixels, FAULT(v->error)))
        viewer_say(v, false, "saved %s", name);
    else
        viewer_say(v, true, "%s", v->error);
    free(pixels);
}

typedef struct line {
    char *text;
    size_t size, used;
    bool full;
} line;

static void add(line *l, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(l->text + l->used, l->size - l->used, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= l->size - l->used)
        l->full = true;
    else
        l->used += (size_t)length;
}

/* Adds a word in the quotes of a POSIX shell. */
static void add_quoted(line *l, const char *text)
{
    add(l, " '");
    for (const char *c = text; *c; c++)
        add(l, *c == '\'' ? "'\\''" : "%c", *c);
    add(l, "'");
}

/* Adds `origin` (NULL: 0): positions on the command line are in the coordinates of the file. */
static void add_vector(line *l, const char *name, const float value[3], const double *origin)
{
    add(l, " --%s", name);
    for (int i = 0; i < 3; i++)
        add(l, "%s%.*g", i ? "," : " ", origin && origin[i] != 0 ? 15 : 9, (double)value[i] + (origin ? origin[i] : 0));
}

static void add_camera(line *l, const viewer *v)
{
    const options *o = &v->options;
    const camera *c = &v->viewpoint.base;
    const float given_up[3] = {(float)o->up.value[0], (float)o->up.value[1], (float)o->up.value[2]};
    const bool placed = v->moved || (v->viewpoint.fitted && v->panel_open); /* glssao-render has no panel */
    if (o->camera > 0 && !placed)
        add(l, " --camera %d", o->camera);
    if (o->camera < 0)
        add(l, " --camera none");
    if (o->view && !placed)
        add(l, " --view %s", o->view);
    if (o->orthographic && c->half_height > 0)
        add(l, " --ortho");
    if (placed || o->eye.given)
        add_vector(l, "eye", c->eye, v->scene->origin);
    if (placed || o->target.given)
        add_vector(l, "target", c->target, v->scene->origin);
    if (placed || o->up.given)
        add_vector(l, "up", placed ? c->up : given_up, NULL);
    if (placed || o->sky_up.given)
        add_vector(l, "sky-up", v->pipeline.up, NULL);
    if (placed || o->fov_deg.given)
        add(l, " --fov %.9g", (double)viewpoint_fov_deg(&v->viewpoint));
    if (o->near_plane.given)
        add(l, " --near %.9g", (double)o->near_plane.value);
    if (o->far_plane.given)
        add(l, " --far %.9g", (double)o->far_plane.value);
}

/* Adds options that glssao-render accepts only with the current technique, or only with occlusion. */
static void add_occlusion(line *l, const viewer *v)
{
    const options *o = &v->options;
    const bool horizon = v->settings.technique == GLSSAO_HORIZON;
    if (v->mode == MODE_OFF)
        add(l, " --no-ao");
    if (o->layers && horizon)
        add(l, " --layers %d", o->layers);
    if (rest_error(v) > 0 && v->mode != MODE_OFF)
        add(l, " --error %.9g", rest_error(v));
    const int rounds = v->rays_rounds > 1 ? v->rays_rounds : 1;
    const int each = v->settings.technique == GLSSAO_RAYS ? v->settings.sample_count : o->rays;
    if (rays_view_applies(v) && each > 0 && v->mode != MODE_OFF) {
        add(l, " --rays %d", each * rounds < 64 ? each * rounds : 64);
        if (o->adaptive_rays && each * rounds <= OPTIONS_ADAPTIVE_RAYS)
            add(l, " --adaptive-rays");
    }
    if (o->budget_ms.given && horizon && v->mode != MODE_OFF)
        add(l, " --budget %.9g", (double)o->budget_ms.value);
    if (o->path)
        add(l, " --path %s", words_at(PATH_WORDS, o->path).text);
}

/* Adds the map in the corner, if glssao-render can show it. */
static void add_debug_map(line *l, const viewer *v)
{
    const int map = v->options.debug_map;
    const bool is_of_occlusion = map == OPTIONS_MAP_AO || map == OPTIONS_MAP_TILES || map == OPTIONS_MAP_BENT;
    if (map && !(is_of_occlusion && v->mode == MODE_OFF) && !(map == OPTIONS_MAP_SHADOW && v->options.no_shadows))
        add(l, " --debug-map %s", words_at(OPTIONS_MAP_WORDS, map).text);
}

bool viewer_command_line(const viewer *v, char *out, size_t out_size)
{
    const options *o = &v->options;
    char settings[1024];
    line l = {out, out_size, 0, false};
    out[0] = '\0';
    add(&l, "glssao-render -o picture.png -s %dx%d -t %s -q %s --radius %.9g", v->width, v->height,
        words_at(ALL_TECHNIQUE_WORDS, (int)v->settings.technique).text, words_at(QUALITY_WORDS, o->quality).text,
        (double)v->settings.radius);
    const glssao_settings standard = viewer_standard(v);
    glssao_settings rest = v->settings;
    rest.radius = standard.radius;
    rest.history = standard.history; /* a single picture has no earlier one */
    if (!setting_differences(&standard, &rest, settings, sizeof settings))
        return false;
    if (settings[0])
        add(&l, " --set %s", settings);
    add_camera(&l, v);
    add_occlusion(&l, v);
    if (o->no_shadows)
        add(&l, " --no-shadows");
    if (o->shadow_size && !o->no_shadows)
        add(&l, " --shadow-size %d", o->shadow_size);
    add(&l, "%s%s%s%s", o->mapped_normals ? " --mapped-normals" : "",
        o->specular_occlusion ? " --specular-occlusion" : "", o->multi_bounce ? " --multi-bounce" : "",
        viewer_lights_bent(v) && v->mode != MODE_OFF ? " --bent-normals" : "");
    if (o->intensity.given)
        add(&l, " --intensity %.9g", (double)o->intensity.value);
    if (o->environment) {
        add(&l, " --environment");
        add_quoted(&l, o->environment);
    }
    if (o->background) {
        add(&l, " --background");
        add_quoted(&l, o->background);
    }
    add_debug_map(&l, v);
    add(&l, " --samples-per-pixel %d", v->pipeline.wants.samples);
    if (o->seed)
        add(&l, " --seed %u", o->seed);
    if (o->time_s.given)
        add(&l, " --time %.9g", (double)o->time_s.value);
    if (o->file.animation)
        add(&l, " --animation %d", o->file.animation);
    if (o->file.scene)
        add(&l, " --gltf-scene %d", o->file.scene);
    if (o->file.variant) {
        add(&l, " --variant");
        add_quoted(&l, o->file.variant);
    }
    if (o->file.root) {
        add(&l, " --root");
        add_quoted(&l, o->file.root);
    }
    if (v->scene_path[0])
        add_quoted(&l, v->scene_path);
    else
        add(&l, " --scene %s", v->scene->name);
    return !l.full;
}

void viewer_copy_command_line(viewer *v)
{
    char text[8192];
    if (!viewer_command_line(v, text, sizeof text)) {
        viewer_say(v, true, "the command line is too long");
        return;
    }
    glfwSetClipboardString(v->window, text);
    puts(text);
    fflush(stdout);
    viewer_say(v, false, "copied and printed: %s", text);
}
