/* SPDX-License-Identifier: MIT
 *
 * Cameras and a box in motion. Steps are those of 60 frames a second.
 */
#include "paths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float rad_per_deg = 0.01745329252f;

const char *path_name(bench_path path)
{
    static const char *const names[PATH_COUNT] = {"still", "orbit", "walk", "pan", "dolly", "cut", "box", "bend"};
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

static bool move_box(scene *s, int frame)
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

/* How far the tops lean, in scene units, and the height that this is at. */
static float lean(int frame)
{
    return frame > 0 ? 0.6f * sinf((float)frame * 2 * 3.14159265f / 40) : 0;
}

static float height_of(const scene_primitive *p)
{
    return p->bounds_max[1] - p->bounds_min[1];
}

/* Shears the tallest mesh along x by lean (y / top)^2; normals follow by the inverse transpose. */
static bool bend(scene *s, int frame)
{
    const scene_primitive *p = &s->primitives[0];
    for (uint32_t i = 1; i < s->primitive_count; i++)
        p = height_of(&s->primitives[i]) > height_of(p) ? &s->primitives[i] : p;
    unsigned char *is_bent = calloc(s->vertex_count, 1);
    const float by = lean(frame) - lean(frame - 1), top = p->bounds_max[1];
    for (uint32_t i = 0; is_bent && i < p->index_count; i++) {
        scene_vertex *v = &s->vertices[s->indices[p->first_index + i]];
        if (is_bent[v - s->vertices])
            continue;
        is_bent[v - s->vertices] = 1;
        const float y = v->position[1] / top;
        float *n = v->normal, length = 0;
        v->position[0] += by * y * y;
        n[1] -= by * 2 * y / top * n[0];
        for (int k = 0; k < 3; k++)
            length += n[k] * n[k];
        for (int k = 0; k < 3; k++)
            n[k] /= sqrtf(length);
    }
    free(is_bent);
    return is_bent != NULL;
}

bool path_moves_things(bench_path path)
{
    return path == PATH_BOX || path == PATH_BEND;
}

bool path_move_things(bench_path path, scene *s, int frame)
{
    return path == PATH_BOX ? move_box(s, frame) : bend(s, frame);
}
