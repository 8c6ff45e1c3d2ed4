/* SPDX-License-Identifier: MIT
 *
 * Cameras and a box in motion. Steps are those of 60 frames a second.
 */
#include "paths.h"

#include <math.h>
#include <string.h>

static const float rad_per_deg = 0.01745329252f;

const char *path_name(bench_path path)
{
    static const char *const names[PATH_COUNT] = {"still", "orbit", "walk", "pan", "dolly", "cut", "box"};
    return names[path];
}

static void axes(const camera *c, float forward[3], float right[3], float *out_distance)
{
    float length = 0, across = 0;
    for (int i = 0; i < 3; i++) {
        forward[i] = c->target[i] - c->eye[i];
        length += forward[i] * forward[i];
    }
    *out_distance = sqrtf(length);
    for (int i = 0; i < 3; i++)
        forward[i] /= *out_distance;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        right[i] = forward[j] * c->up[k] - forward[k] * c->up[j];
        across += right[i] * right[i];
    }
    for (int i = 0; i < 3; i++)
        right[i] /= sqrtf(across);
}

static camera moved(const camera *c, const float way[3], float by)
{
    camera m = *c;
    for (int i = 0; i < 3; i++) {
        m.eye[i] += by * way[i];
        m.target[i] += by * way[i];
    }
    return m;
}

camera path_camera(bench_path path, const camera *start, int frame)
{
    float forward[3], right[3], distance;
    axes(start, forward, right, &distance);
    const float f = (float)frame;
    camera c;
    switch (path) {
    case PATH_ORBIT:
        return camera_turned(start, start->target, start->up, 0.3f * rad_per_deg * f);
    case PATH_WALK: /* two steps a second */
        c = moved(start, forward, 0.004f * distance * f);
        c = moved(&c, start->up, 0.004f * distance * sinf(f * 2 * 3.14159265f / 30));
        return camera_turned(&c, c.eye, right, 0.3f * rad_per_deg * sinf(f * 2 * 3.14159265f / 30));
    case PATH_PAN:
        return camera_turned(start, start->eye, start->up, 2 * rad_per_deg * f);
    case PATH_DOLLY:
        return moved(start, right, 0.004f * distance * f);
    case PATH_CUT:
        return frame < PATH_EVENT ? *start : camera_turned(start, start->target, start->up, 40 * rad_per_deg);
    default:
        return *start;
    }
}

static const float box_step = 0.08f;

static float box_place(int frame)
{
    return frame < PATH_EVENT ? box_step * (float)(frame - PATH_EVENT) : 1e3f;
}

bool path_move_box(scene *s, int frame)
{
    for (uint32_t i = 0; i < s->instance_count; i++) {
        float *m = s->instances[i].world_from_mesh;
        if (m[0] == 3 && m[5] == 1 && m[10] == 3) { /* the only one of this size */
            m[12] = box_place(frame);
            return true;
        }
    }
    return false;
}

bool path_is_on_box(const float world[3], int frame, float *out_moved)
{
    const float slack = 0.01f;
    *out_moved = frame > 0 && frame < PATH_EVENT ? box_step : 0;
    return fabsf(world[0] - box_place(frame)) < 1.5f + slack && fabsf(world[2]) < 1.5f + slack && world[1] > slack &&
           world[1] < 1 + slack;
}
