/* SPDX-License-Identifier: MIT
 *
 * Tangents of a primitive that has a normal map: those of the file where it has them and nothing poses the vertices,
 * else computed. A vertex whose faces want different tangents is split.
 */
#include "gltf_loader.h"
#include "tangent_space.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_set(const float tangent[4])
{
    return tangent[3] != 0;
}

static void copy_from_file(const gltf_vertices *v, float (*tangents)[4])
{
    for (uint32_t i = 0; i < v->count; ++i) {
        const float *from = v->tangents[i];
        const float length = sqrtf(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]);
        const bool sound = length > 0 && isfinite(length);
        for (int axis = 0; axis < 3; ++axis)
            tangents[v->first + i][axis] = sound ? from[axis] / length : 0;
        tangents[v->first + i][3] = from[3] < 0 ? -1 : 1;
    }
}

/* The copy of vertex `index` that has this tangent, or can take it; `copy_of` links from one copy to the next, 0 at
 * the end. UINT32_MAX on failure. */
static uint32_t vertex_with(gltf_loader *l, uint32_t index, const float tangent[4], uint32_t *copy_of)
{
    const float(*tangents)[4] = (const float(*)[4])l->builder->made->tangents;
    uint32_t last, at = index;
    do {
        if (!is_set(tangents[at]) || !memcmp(tangents[at], tangent, sizeof tangents[at]))
            return at;
        last = at;
        at = copy_of[at];
    } while (at);
    uint32_t made;
    if (!memory_budget_charge(&l->document->budget, sizeof(scene_vertex), "the file's vertices", l->fault))
        return UINT32_MAX;
    scene_vertex *to = scene_builder_add_vertices(l->builder, 1, &made);
    if (!to || !scene_builder_tangents(l->builder))
        return UINT32_MAX;
    *to = l->builder->made->vertices[index];
    float(*more)[2][2] = l->builder->made->more_uvs ? scene_builder_more_uvs(l->builder) : NULL;
    if (more)
        memcpy(more[made], more[index], sizeof more[made]);
    copy_of[last] = made;
    return made;
}

bool gltf_add_tangents(gltf_loader *l, gltf_triangles *triangles, int uv)
{
    float(*tangents)[4] = scene_builder_tangents(l->builder);
    if (!tangents)
        return false;
    if (l->recent.tangents) {
        copy_from_file(&l->recent, tangents);
        return true;
    }
    float(*corners)[4] = malloc(triangles->count * sizeof *corners);
    /* Each corner makes one copy at most. */
    uint32_t *copy_of = calloc((size_t)l->builder->made->vertex_count + triangles->count + 1, sizeof *copy_of);
    bool done = corners && copy_of &&
                tangent_space_make(l->builder->made->vertices, uv, triangles->indices, triangles->count, corners);
    if (!done)
        fault_set_memory(l->fault);
    for (uint32_t i = 0; done && i < triangles->count; ++i) {
        const uint32_t vertex = vertex_with(l, triangles->indices[i], corners[i], copy_of);
        done = vertex != UINT32_MAX;
        if (done) {
            memcpy(l->builder->made->tangents[vertex], corners[i], sizeof corners[i]);
            triangles->indices[i] = vertex;
        }
    }
    free(corners);
    free(copy_of);
    return done;
}
