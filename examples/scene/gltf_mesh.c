/* SPDX-License-Identifier: MIT
 *
 * Turns primitives into triangles of the scene: lists, strips and fans with or without indices. Points and lines are
 * left out. Where the file has no normals they are flat, as glTF says; where one has no direction, the faces that meet
 * there give it one.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

/* The k-th corner of a triangle as a position in the primitive's order. Odd triangles of a strip are turned over. */
static size_t corner(int mode, size_t triangle, unsigned k)
{
    switch (mode) {
    case GLTF_TRIANGLE_STRIP:
        return triangle + (k == 0 ? 0 : triangle % 2 ? 3 - k : k);
    case GLTF_TRIANGLE_FAN:
        return k == 2 ? 0 : triangle + k + 1;
    default:
        return 3 * triangle + k;
    }
}

bool gltf_make_triangles(gltf_loader *l, const gltf_primitive *p, gltf_triangles *out)
{
    const gltf_vertices *v = &l->recent;
    const size_t order = p->indices < 0 ? v->count : l->document->accessors[p->indices].count;
    const size_t triangles = order < 3 ? 0 : p->mode == GLTF_TRIANGLES ? order / 3 : order - 2;
    memset(out, 0, sizeof *out);
    if (!triangles)
        return true;
    if (triangles * 3 > l->indices_left)
        return scene_fail(l->fault, "too many triangles");
    l->indices_left -= triangles * 3;
    uint32_t *given = p->indices < 0 ? NULL : gltf_read_indices(l, p->indices, 1);
    if (p->indices >= 0 && !given)
        return false;
    for (size_t i = 0; given && i < order; ++i) {
        if (given[i] >= v->count) {
            scene_fail(l->fault, "accessor %d: index %u for %u vertices", p->indices, given[i], v->count);
            free(given);
            return false;
        }
    }
    out->indices = malloc(triangles * 3 * sizeof *out->indices);
    for (size_t t = 0; out->indices && t < triangles; ++t) {
        for (unsigned k = 0; k < 3; ++k) {
            const size_t at = corner(p->mode, t, v->mirrored ? 2 - k : k);
            out->indices[out->count++] = given ? given[at] : (uint32_t)at;
        }
    }
    free(given);
    return out->indices || scene_fail_memory(l->fault);
}

/* Twice the triangle's area, along its normal; in double precision, where no product of floats overflows. */
static void face_vector(const gltf_vertices *v, const uint32_t *corners, double out[3])
{
    double a[3], b[3];
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = (double)v->positions[corners[0]][axis];
        a[axis] = (double)v->positions[corners[1]][axis] - origin;
        b[axis] = (double)v->positions[corners[2]][axis] - origin;
    }
    for (int axis = 0; axis < 3; ++axis)
        out[axis] = a[(axis + 1) % 3] * b[(axis + 2) % 3] - a[(axis + 2) % 3] * b[(axis + 1) % 3];
}

/* Upwards where the vector has no direction: the face has no area then, and nobody sees it. */
static void set_normal(scene_vertex *to, const double vector[3])
{
    const double length = sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
    for (int axis = 0; axis < 3; ++axis)
        to->normal[axis] = length > 0 ? (float)(vector[axis] / length) : (float)(axis == 1);
}

static void copy_vertex(const gltf_vertices *v, uint32_t from, scene_vertex *to)
{
    static const float white[4] = {1, 1, 1, 1};
    memcpy(to->position, v->positions[from], sizeof to->position);
    if (v->normals)
        memcpy(to->normal, v->normals[from], sizeof to->normal);
    for (int set = 0; set < 2; ++set)
        if (v->uvs[set])
            memcpy(to->uv[set], v->uvs[set][from], sizeof to->uv[set]);
    memcpy(to->color, v->colors ? v->colors[from] : white, sizeof to->color);
}

static scene_vertex *add_vertices(gltf_loader *l, uint32_t count, uint32_t *out_first)
{
    if (count > l->vertices_left) {
        scene_fail(l->fault, "too many vertices");
        return NULL;
    }
    l->vertices_left -= count;
    return scene_builder_add_vertices(l->builder, count, out_first);
}

/* Each corner becomes a vertex of its own, with its face's normal; the indices follow. */
static bool add_flat(gltf_loader *l, gltf_triangles *triangles)
{
    const gltf_vertices *v = &l->recent;
    uint32_t first = 0;
    scene_vertex *to = add_vertices(l, triangles->count, &first);
    for (uint32_t i = 0; to && i < triangles->count; i += 3) {
        double normal[3];
        face_vector(v, triangles->indices + i, normal);
        for (uint32_t k = 0; k < 3; ++k) {
            copy_vertex(v, triangles->indices[i + k], &to[i + k]);
            set_normal(&to[i + k], normal);
            triangles->indices[i + k] = first + i + k;
        }
    }
    return to;
}

/* Normals of no direction become the mean, by area, of the faces around them. */
static bool repair_normals(gltf_loader *l, const gltf_triangles *triangles, scene_vertex *vertices)
{
    const gltf_vertices *v = &l->recent;
    double(*sums)[3] = calloc(v->count, sizeof *sums);
    if (!sums)
        return scene_fail_memory(l->fault);
    for (uint32_t i = 0; i < triangles->count; i += 3) {
        double face[3];
        face_vector(v, triangles->indices + i, face);
        for (uint32_t k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                sums[triangles->indices[i + k]][axis] += face[axis];
    }
    for (uint32_t i = 0; i < v->count; ++i) {
        const float *n = v->normals[i];
        if (n[0] == 0 && n[1] == 0 && n[2] == 0)
            set_normal(&vertices[i], sums[i]);
    }
    free(sums);
    return true;
}

/* The vertices as they are, once for all primitives that share them; the indices follow. */
static bool add_shared(gltf_loader *l, gltf_triangles *triangles)
{
    gltf_vertices *v = &l->recent;
    if (!v->emitted) {
        scene_vertex *to = add_vertices(l, v->count, &v->first);
        for (uint32_t i = 0; to && i < v->count; ++i)
            copy_vertex(v, i, &to[i]);
        if (!to || (!v->normals_ok && !repair_normals(l, triangles, to)))
            return false;
        /* Another primitive has other faces to repair normals by. */
        v->emitted = v->normals_ok;
    }
    for (uint32_t i = 0; i < triangles->count; ++i)
        triangles->indices[i] += v->first;
    return true;
}

static bool add_triangles(gltf_loader *l, gltf_triangles *triangles, int material)
{
    uint32_t first = 0;
    if (!(l->recent.normals ? add_shared(l, triangles) : add_flat(l, triangles)))
        return false;
    const scene_map *normal_map = &l->builder->made->materials[material].normal_map;
    if (normal_map->used && !gltf_add_tangents(l, triangles, normal_map->uv))
        return false;
    uint32_t *to = scene_builder_add_indices(l->builder, triangles->count, &first);
    if (!to)
        return false;
    memcpy(to, triangles->indices, triangles->count * sizeof *to);
    return scene_builder_add_primitive(l->builder, first, material);
}

/* A vertex keeps two sets. One past the second takes its place; of several, the first that a map names. */
static int second_uv_set(const gltf_material *m)
{
    const gltf_texture_use *const maps[] = {&m->base_color_map, &m->normal_map, &m->metallic_roughness_map,
                                            &m->occlusion_map, &m->emissive_map};
    for (size_t i = 0; i < sizeof maps / sizeof *maps; ++i)
        if (maps[i]->texture >= 0 && maps[i]->uv_set > 0)
            return maps[i]->uv_set;
    return 1;
}

static bool add_primitive(gltf_loader *l, const gltf_primitive *p, size_t node)
{
    if (p->mode < GLTF_TRIANGLES || gltf_find_attribute(&p->attributes, "POSITION") < 0)
        return true;
    const int material = gltf_add_material(l, p->material);
    if (material < 0)
        return false;
    const int uv_sets[2] = {0, p->material < 0 ? 1 : second_uv_set(&l->document->materials[p->material])};
    gltf_triangles triangles = {0};
    const bool ok = gltf_read_vertices(l, p, node, uv_sets) && gltf_make_triangles(l, p, &triangles) &&
                    (!triangles.count || add_triangles(l, &triangles, material));
    free(triangles.indices);
    return ok;
}

int gltf_add_mesh(gltf_loader *l, size_t node)
{
    const gltf_node *n = &l->document->nodes[node];
    const gltf_mesh *mesh = &l->document->meshes[n->mesh];
    const bool own = n->skin >= 0 || n->weights.count;
    if (!own && l->mesh_map[n->mesh] >= 0)
        return l->mesh_map[n->mesh];
    const int made = scene_builder_add_mesh(l->builder);
    for (size_t i = 0; made >= 0 && i < mesh->primitive_count; ++i)
        if (!add_primitive(l, &mesh->primitives[i], node))
            return -1;
    if (!own)
        l->mesh_map[n->mesh] = made;
    return made;
}
