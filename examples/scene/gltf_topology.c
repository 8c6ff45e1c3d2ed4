/* SPDX-License-Identifier: MIT
 *
 * Which vertices make a primitive's triangles, lines and points: lists, strips, fans and loops, with or without
 * indices.
 */
#include "gltf_loader.h"

#include <stdlib.h>
#include <string.h>

scene_topology gltf_find_topology(const gltf_primitive *p)
{
    return p->mode == GLTF_POINTS ? SCENE_POINTS : p->mode < GLTF_TRIANGLES ? SCENE_LINES : SCENE_TRIANGLES;
}

/* How many triangles, lines or points `order` vertices make. */
static size_t count_shapes(int mode, size_t order)
{
    switch (mode) {
    case GLTF_POINTS:
        return order;
    case GLTF_LINES:
        return order / 2;
    case GLTF_LINE_LOOP:
        return order < 2 ? 0 : order;
    case GLTF_LINE_STRIP:
        return order < 2 ? 0 : order - 1;
    case GLTF_TRIANGLES:
        return order / 3;
    default:
        return order < 3 ? 0 : order - 2;
    }
}

/* The k-th corner of a shape as a position in the primitive's order. Odd triangles of a strip are turned over. */
static size_t corner(int mode, size_t order, size_t shape, unsigned k)
{
    switch (mode) {
    case GLTF_POINTS:
        return shape;
    case GLTF_LINES:
        return 2 * shape + k;
    case GLTF_LINE_LOOP:
        return (shape + k) % order;
    case GLTF_LINE_STRIP:
        return shape + k;
    case GLTF_TRIANGLE_STRIP:
        return shape + (k == 0 ? 0 : shape % 2 ? 3 - k : k);
    case GLTF_TRIANGLE_FAN:
        return k == 2 ? 0 : shape + k + 1;
    default:
        return 3 * shape + k;
    }
}

/* Swaps the winding of a list where a skin turns it inside out. */
static void turn_list(const gltf_vertices *v, uint32_t *indices, size_t count)
{
    for (size_t i = 0; v->mirrored && i < count; i += 3) {
        const uint32_t first = indices[i];
        indices[i] = indices[i + 2];
        indices[i + 2] = first;
    }
}

static bool check_indices(gltf_loader *l, const gltf_primitive *p, const uint32_t *given, size_t order)
{
    const uint32_t count = l->recent.count;
    for (size_t i = 0; i < order; ++i)
        if (given[i] >= count)
            return fault_set(l->fault, "accessor %d: index %u for %u vertices", p->indices, given[i], count);
    return true;
}

bool gltf_make_triangles(gltf_loader *l, const gltf_primitive *p, gltf_triangles *out)
{
    const gltf_vertices *v = &l->recent;
    const scene_topology topology = gltf_find_topology(p);
    const unsigned corners = topology == SCENE_TRIANGLES ? 3 : topology == SCENE_LINES ? 2 : 1;
    const size_t order = p->indices < 0 ? v->count : l->document->accessors[p->indices].count;
    const size_t shapes = count_shapes(p->mode, order);
    memset(out, 0, sizeof *out);
    if (!shapes)
        return true;
    if (shapes > UINT32_MAX / corners)
        return fault_set(l->fault, "too many triangles");
    if (!memory_budget_charge(&l->document->budget, (uint64_t)shapes * corners * sizeof *out->indices,
                              "the file's triangles", l->fault))
        return false;
    uint32_t *given = p->indices < 0 ? NULL : gltf_read_indices(l, p->indices, 1);
    if (p->indices >= 0 && (!given || !check_indices(l, p, given, order))) {
        free(given);
        return false;
    }
    out->count = (uint32_t)(shapes * corners);
    if (given && p->mode == GLTF_TRIANGLES) {
        turn_list(v, given, out->count);
        out->indices = given;
        return true;
    }
    out->indices = malloc(out->count * sizeof *out->indices);
    uint32_t *to = out->indices;
    for (size_t t = 0; to && t < shapes; ++t)
        for (unsigned k = 0; k < corners; ++k) {
            const size_t at = corner(p->mode, order, t, v->mirrored && corners == 3 ? 2 - k : k);
            *to++ = given ? given[at] : (uint32_t)at;
        }
    free(given);
    return out->indices || fault_set_memory(l->fault);
}
