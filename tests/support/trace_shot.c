/* SPDX-License-Identifier: MIT */
#include "trace_shot.h"

#include "camera.h"
#include "testing.h"

enum { ERROR_LENGTH = 512 };

trace_scene *trace_shot_open(const scene *s)
{
    char error[ERROR_LENGTH] = "";
    trace_scene *t = trace_scene_create(s, FAULT(error));
    if (!t)
        fail_msg("%s", error);
    return t;
}

double trace_shot_point(const trace_scene *t, float x, float y, float z, float radius, int samples)
{
    char error[ERROR_LENGTH] = "";
    const float position[1][3] = {{x, y, z}}, up[1][3] = {{0, 1, 0}};
    const trace_options options = {.radius = radius, .samples = samples, .threads = 1};
    float out = -1;
    if (!trace_points(t, position, up, 1, TRACE_COSINE, 1e-5f, &options, &out, NULL, FAULT(error)))
        fail_msg("%s", error);
    return (double)out;
}

scene_view trace_shot_view(const float eye[3], const float target[3], float scale)
{
    camera c = {.fov_y_rad = 0.8f, .near_plane = 0.1f * scale, .far_plane = 100 * scale, .up = {0, 1, 0}};
    for (int i = 0; i < 3; i++) {
        c.eye[i] = eye[i] * scale;
        c.target[i] = target[i] * scale;
    }
    return camera_view(&c, TRACE_SHOT_SIDE, TRACE_SHOT_SIDE);
}

trace_shot trace_shot_take(const scene *s, const scene_view *view, trace_options options)
{
    char error[ERROR_LENGTH] = "";
    trace_shot out;
    SCOPED(traced) trace_scene *t = trace_shot_open(s);
    if (!trace_accessibility(t, view, &options, out.accessibility, out.foreground, &out.stats, FAULT(error)))
        fail_msg("%s", error);
    return out;
}

int trace_shot_foreground(const trace_shot *p)
{
    int count = 0;
    for (int i = 0; i < TRACE_SHOT_PIXELS; i++)
        count += p->foreground[i];
    return count;
}

double trace_shot_difference(const trace_shot *a, const trace_shot *b)
{
    double sum = 0;
    for (int i = 0; i < TRACE_SHOT_PIXELS; i++)
        sum += fabs((double)a->accessibility[i] - (double)b->accessibility[i]);
    return sum / TRACE_SHOT_PIXELS;
}
