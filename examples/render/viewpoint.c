/* SPDX-License-Identifier: MIT
 *
 * Chooses the camera of a picture and fits its planes.
 */
#include "viewpoint.h"

#include "words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float rad_per_deg = 0.01745329252f;

/* The target of a file's camera is the point on its line of sight nearest to the middle of the scene. A turntable then
 * turns about the thing that the camera looks at. */
static void from_scene_camera(const scene_camera *c, const scene *s, viewpoint *out)
{
    const float *m = c->world_from_view;
    const float length = sqrtf(m[8] * m[8] + m[9] * m[9] + m[10] * m[10]);
    float distance = 0;
    for (int i = 0; i < 3; i++) {
        const float middle = 0.5f * s->bounds_min[i] + 0.5f * s->bounds_max[i];
        distance += (middle - m[12 + i]) * (-m[8 + i] / length);
    }
    if (!(distance > 0))
        distance = 1;
    for (int i = 0; i < 3; i++) {
        out->base.eye[i] = m[12 + i];
        out->base.target[i] = m[12 + i] - m[8 + i] / length * distance;
        out->base.up[i] = m[4 + i];
    }
    out->base.fov_y_rad = c->orthographic ? 45.0f * rad_per_deg : c->fov_y_rad;
    out->base.half_height = c->orthographic ? c->half_height : 0;
    out->clip_near = c->near_plane;
    out->clip_far = c->far_plane;
}

bool viewpoint_parse_view(const char *text, float out_deg[2])
{
    /* Isometric: at an elevation of atan(1 / sqrt(2)) the three axes look equally long. */
    static const float named[][2] = {{0, 0}, {90, 0}, {180, 0}, {-90, 0}, {0, 90}, {0, -90}, {45, 35.2643897f}};
    const int index = words_find(VIEW_WORDS, text);
    if (index >= 0) {
        memcpy(out_deg, named[index], sizeof named[index]);
        return true;
    }
    char *end = NULL;
    for (int i = 0; i < 2; i++) {
        if (!strchr("+-.0123456789", *text) || *text == '\0')
            return false;
        out_deg[i] = strtof(text, &end);
        if (end == text || *end != (i == 0 ? ',' : '\0') || !(fabsf(out_deg[i]) <= (i == 0 ? 1e6f : 90)))
            return false;
        text = end + 1;
    }
    return true;
}

static void fit_scene(const options *o, const scene *s, float free_left, viewpoint *out)
{
    camera_framing how = camera_default_framing((float)o->width / (float)o->height);
    float angles[2];
    memcpy(how.up, out->axis, sizeof how.up);
    if (o->view && viewpoint_parse_view(o->view, angles)) {
        how.azimuth_rad = angles[0] * rad_per_deg;
        how.elevation_rad = angles[1] * rad_per_deg;
    }
    if (o->fov_deg.given)
        how.fov_y_rad = o->fov_deg.value * rad_per_deg;
    how.free_left = free_left;
    how.orthographic = o->orthographic;
    how.turns = o->frames > 0 && !o->fps.given;
    out->base = camera_frame(s, &how);
    out->fitted = true;
    for (int i = 0; i < 3; i++)
        out->pivot[i] = 0.5f * s->bounds_min[i] + 0.5f * s->bounds_max[i];
}

static float distance_to_target(const camera *c)
{
    return hypotf(hypotf(c->eye[0] - c->target[0], c->eye[1] - c->target[1]), c->eye[2] - c->target[2]);
}

/* Replaces parts of the camera by --eye and --target, which are in the file's coordinates, --up and --fov. */
static void take_given(const options *o, const scene *s, viewpoint *v)
{
    camera *c = &v->base;
    if (v->fitted && (o->eye.given || o->target.given)) {
        memcpy(c->target, v->pivot, sizeof c->target);
        memcpy(c->up, v->axis, sizeof c->up);
        c->half_height = 0;
        v->fitted = false;
    }
    for (int i = 0; i < 3; i++) {
        if (o->eye.given)
            c->eye[i] = (float)(o->eye.value[i] - s->origin[i]);
        if (o->target.given)
            c->target[i] = (float)(o->target.value[i] - s->origin[i]);
        if (o->up.given && !v->fitted)
            c->up[i] = (float)o->up.value[i];
    }
    if (o->fov_deg.given && !v->fitted) {
        c->fov_y_rad = o->fov_deg.value * rad_per_deg;
        c->half_height = 0;
    }
    if (o->orthographic && c->half_height == 0) /* things at the target keep their size */
        c->half_height = distance_to_target(c) * tanf(0.5f * c->fov_y_rad);
}

float viewpoint_fov_deg(const viewpoint *v)
{
    const camera *c = &v->base;
    return (c->half_height > 0 ? 2 * atan2f(c->half_height, distance_to_target(c)) : c->fov_y_rad) / rad_per_deg;
}

bool viewpoint_choose(const options *o, const scene *s, float free_left, viewpoint *out, failure *why)
{
    *out = (viewpoint){.axis = {0, 1, 0}, .near_plane = o->near_plane, .far_plane = o->far_plane};
    if (o->camera > 0 && (uint32_t)o->camera > s->camera_count)
        return fault_set(why, "--camera %d: %s has %u camera%s", o->camera, s->name, s->camera_count,
                         s->camera_count == 1 ? "" : "s");
    if (o->up.given) {
        const double *up = o->up.value, length = hypot(hypot(up[0], up[1]), up[2]);
        for (int i = 0; i < 3; i++)
            out->axis[i] = (float)(up[i] / length);
        if (!(length > 0))
            return fault_set(why, "--up 0,0,0: has no direction");
    }
    if (s->camera_count > 0 && o->camera >= 0 && !o->view)
        from_scene_camera(&s->cameras[o->camera > 0 ? o->camera - 1 : 0], s, out);
    else
        fit_scene(o, s, free_left, out);
    take_given(o, s, out);
    if (!out->fitted)
        memcpy(out->pivot, out->base.target, sizeof out->pivot);
    if (o->eye.given || o->target.given || o->fov_deg.given)
        out->clip_near = out->clip_far = 0; /* the planes of the file belong to its own view */
    return true;
}

/* Fits the planes to the scene. They never show what the file's camera cuts away. */
static void fit_planes(const viewpoint *v, const scene *s, camera *c)
{
    camera_fit_planes(c, s);
    const float near_plane = fmaxf(c->near_plane, v->clip_near);
    const float far_plane = v->clip_far > 0 ? fminf(c->far_plane, v->clip_far) : c->far_plane;
    if (near_plane < far_plane) {
        c->near_plane = near_plane;
        c->far_plane = far_plane;
    }
    if (v->near_plane.given)
        c->near_plane = v->near_plane.value;
    if (v->far_plane.given)
        c->far_plane = v->far_plane.value;
}

bool viewpoint_view(const viewpoint *v, const scene *s, float angle_rad, int width, int height, scene_view *out,
                    failure *why)
{
    camera c = angle_rad == 0 ? v->base : camera_turned(&v->base, v->pivot, v->axis, angle_rad);
    fit_planes(v, s, &c);
    if (!camera_check(&c, why))
        return false;
    *out = camera_view(&c, width, height);
    return true;
}
