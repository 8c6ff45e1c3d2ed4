/* SPDX-License-Identifier: MIT
 *
 * Measures a finished scene, chooses the zero of world space, and converts all places to single precision.
 */
#include "scene_builder.h"

#include <math.h>

typedef struct box {
    double low[3], high[3];
    bool finite; /* fmin and fmax pass over NaN, so the box does not show it */
} box;

static void grow_box(box *to, const double m[16], const float p[3])
{
    double sum = 0;
    for (int row = 0; row < 3; ++row) {
        const double at = m[row] * (double)p[0] + m[4 + row] * (double)p[1] + m[8 + row] * (double)p[2] + m[12 + row];
        to->low[row] = fmin(to->low[row], at);
        to->high[row] = fmax(to->high[row], at);
        sum += at;
    }
    to->finite = to->finite && isfinite(sum);
}

static void grow_box_by_vertices(box *to, const scene *s, const scene_primitive *p, const double m[16])
{
    for (uint32_t i = 0; i < p->index_count; ++i)
        grow_box(to, m, s->vertices[s->indices[p->first_index + i]].position);
}

/* By the eight corners of the primitive's box: exact where no axis is turned into two, and else for instances whose
 * every vertex would take too long. */
static void grow_box_by_corners(box *to, const scene_primitive *p, const double m[16])
{
    for (int corner = 0; corner < 8; ++corner) {
        float at[3];
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = corner >> axis & 1 ? p->bounds_max[axis] : p->bounds_min[axis];
        grow_box(to, m, at);
    }
}

/* Whether each axis of mesh space goes along one of the world's. */
static bool keeps_axes(const double m[16])
{
    bool kept = true;
    for (int row = 0; row < 3; ++row)
        kept = kept && (m[row] != 0) + (m[4 + row] != 0) + (m[8 + row] != 0) <= 1;
    return kept;
}

static box measure(const scene_builder *b)
{
    enum { MOST_POINTS = 1 << 26 }; /* of the instances of a mesh: about a quarter of a second */
    const scene *s = b->made;
    box all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, true};
    for (uint32_t k = 0; k < s->mesh_count; ++k) {
        const scene_mesh *mesh = &s->meshes[k];
        for (uint32_t i = mesh->first_instance; i < mesh->first_instance + mesh->instance_count; ++i)
            for (uint32_t n = mesh->first_primitive; n < mesh->first_primitive + mesh->primitive_count; ++n) {
                const scene_primitive *p = &s->primitives[n];
                const double *m = b->placements[i].world_from_mesh;
                const bool few =
                    mesh->instance_count == 1 || (uint64_t)p->index_count * mesh->instance_count <= MOST_POINTS;
                if (few && !keeps_axes(m))
                    grow_box_by_vertices(&all, s, p, m);
                else
                    grow_box_by_corners(&all, p, m);
            }
    }
    return all;
}

bool scene_is_far(const double low[3], const double high[3])
{
    const double most = 8; /* times the size: 2^-21 of the size is told apart then */
    double distance = 0, size = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double middle = 0.5 * low[axis] + 0.5 * high[axis];
        distance += middle * middle;
        size += (high[axis] - low[axis]) * (high[axis] - low[axis]);
    }
    return distance > most * most * size && isfinite(distance);
}

static bool move_instances(scene_builder *b)
{
    scene *s = b->made;
    bool finite = true;
    for (uint32_t i = 0; i < s->instance_count; ++i)
        for (int k = 0; k < 16; ++k) {
            const double at = b->placements[i].world_from_mesh[k] - (k >= 12 && k < 15 ? s->origin[k - 12] : 0);
            s->instances[i].world_from_mesh[k] = (float)at;
            finite = finite && isfinite(s->instances[i].world_from_mesh[k]);
        }
    return finite;
}

static void move_views(scene_builder *b)
{
    scene *s = b->made;
    for (uint32_t i = 0; i < s->camera_count; ++i)
        for (int axis = 0; axis < 3; ++axis)
            s->cameras[i].world_from_view[12 + axis] = (float)(b->camera_places[i][axis] - s->origin[axis]);
    for (uint32_t i = 0; i < s->light_count; ++i)
        for (int axis = 0; axis < 3; ++axis)
            s->lights[i].position_world[axis] = (float)(b->light_places[i][axis] - s->origin[axis]);
}

bool scene_builder_settle(scene_builder *b)
{
    scene *s = b->made;
    const box all = measure(b);
    const bool any = all.low[0] <= all.high[0], far = any && all.finite && scene_is_far(all.low, all.high);
    bool finite = all.finite;
    for (int axis = 0; axis < 3; ++axis) {
        s->origin[axis] = far ? 0.5 * all.low[axis] + 0.5 * all.high[axis] : 0;
        s->bounds_min[axis] = any ? (float)(all.low[axis] - s->origin[axis]) : 0;
        s->bounds_max[axis] = any ? (float)(all.high[axis] - s->origin[axis]) : 0;
        finite = finite && isfinite(s->bounds_max[axis] - s->bounds_min[axis]);
    }
    finite = move_instances(b) && finite;
    move_views(b);
    return finite || fault_set(b->fault, "the scene is too large for single precision");
}
