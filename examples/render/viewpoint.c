/* SPDX-License-Identifier: MIT
 *
 * Chooses the camera and fits its planes.
 */
#include "viewpoint.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const float rad_per_deg = 0.01745329252f;

/* The file's camera looks along a ray; the target is the point of it nearest to the scene's middle, so that a
 * turntable turns about what is looked at. */
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
    out->half_height = c->orthographic ? c->half_height : 0;
    out->clip_near = c->near_plane;
    out->clip_far = c->far_plane;
}

bool viewpoint_choose(const options *o, const scene *s, viewpoint *out, fault *why)
{
    *out = (viewpoint){.near_plane = o->near_plane, .far_plane = o->far_plane};
    if (o->camera > 0 && (uint32_t)o->camera > s->camera_count) {
        return fault_set(why, "--camera %d: %s has %u camera%s", o->camera, s->name, s->camera_count,
                         s->camera_count == 1 ? "" : "s");
    }
    if (s->camera_count > 0)
        from_scene_camera(&s->cameras[o->camera > 0 ? o->camera - 1 : 0], s, out);
    else
        out->base = camera_frame_scene(s, (float)o->width / (float)o->height);
    const struct {
        const option_vector *from;
        float *to;
    } vectors[] = {{&o->eye, out->base.eye}, {&o->target, out->base.target}, {&o->up, out->base.up}};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        if (vectors[i].from->given)
            memcpy(vectors[i].to, vectors[i].from->value, sizeof vectors[i].from->value);
    if (o->fov_deg.given) {
        out->base.fov_y_rad = o->fov_deg.value * rad_per_deg;
        out->half_height = 0;
    }
    if (o->eye.given || o->target.given || o->fov_deg.given)
        out->clip_near = out->clip_far = 0; /* the file's planes belong to the file's view */
    return true;
}

/* Planes that hug the scene, but never show what the file's camera cuts away. */
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

/* clip_from_view, column-major, as glOrtho defines it for a frustum about the axis. */
static void orthographic(float half_width, float half_height, float near_plane, float far_plane, float out[16])
{
    memset(out, 0, 16 * sizeof out[0]);
    out[0] = 1 / half_width;
    out[5] = 1 / half_height;
    out[10] = -2 / (far_plane - near_plane);
    out[14] = -(far_plane + near_plane) / (far_plane - near_plane);
    out[15] = 1;
}

bool viewpoint_view(const viewpoint *v, const scene *s, float angle_rad, int width, int height, scene_view *out,
                    fault *why)
{
    camera c = angle_rad == 0 ? v->base : camera_turned(&v->base, angle_rad);
    fit_planes(v, s, &c);
    if (!camera_check(&c, why->text, why->size))
        return false;
    *out = camera_view(&c, width, height);
    if (v->half_height > 0) {
        orthographic(v->half_height * (float)width / (float)height, v->half_height, c.near_plane, c.far_plane,
                     out->clip_from_view);
    }
    return true;
}
