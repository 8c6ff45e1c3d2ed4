/* SPDX-License-Identifier: MIT
 *
 * Turns primitives into the scene's vertices and triangles, lines or points. Where the file has no normals the
 * primitive is marked flat; where one normal has no direction, the faces that meet there give it one.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

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

/* A zero vector gives (0, 1, 0). Its face has no area and is never seen. */
static void set_normal(scene_vertex *to, const double vector[3])
{
    const double length = sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
    for (int axis = 0; axis < 3; ++axis)
        to->normal[axis] = length > 0 ? (float)(vector[axis] / length) : (float)(axis == 1);
}

static bool has_direction(const float n[3])
{
    return n[0] != 0 || n[1] != 0 || n[2] != 0;
}

static void copy_vertex(const gltf_vertices *v, uint32_t from, scene_vertex *to)
{
    static const float white[4] = {1, 1, 1, 1}, upwards[3] = {0, 1, 0}, none[2] = {0, 0};
    memcpy(to->position, v->positions[from], sizeof to->position);
    memcpy(to->normal, v->normals && has_direction(v->normals[from]) ? v->normals[from] : upwards, sizeof to->normal);
    for (int set = 0; set < 2; ++set)
        memcpy(to->uv[set], v->uvs[set] ? v->uvs[set][from] : none, sizeof to->uv[set]);
    memcpy(to->color, v->colors ? v->colors[from] : white, sizeof to->color);
}

/* Uv sets of slots 2 and 3, where the material reads so many. `from` of each new vertex; NULL: in order. */
static bool copy_more_uvs(gltf_loader *l, uint32_t first, uint32_t count, const uint32_t *from)
{
    const gltf_vertices *v = &l->recent;
    if (v->slots.count <= 2)
        return true;
    float(*to)[2][2] = scene_builder_more_uvs(l->builder);
    for (uint32_t i = 0; to && i < count; ++i)
        for (int set = 0; set < 2; ++set)
            if (v->uvs[2 + set])
                memcpy(to[first + i][set], v->uvs[2 + set][from ? from[i] : i], sizeof to[0][set]);
    return to;
}

static scene_vertex *add_vertices(gltf_loader *l, uint32_t count, uint32_t *out_first)
{
    const size_t each = sizeof(scene_vertex) + (l->recent.slots.count > 2 ? sizeof(float[4]) : 0);
    if (!memory_budget_charge(&l->document->budget, (uint64_t)count * each, "the file's vertices", l->fault))
        return NULL;
    return scene_builder_add_vertices(l->builder, count, out_first);
}

/* Each corner becomes a vertex of its own, with its face's normal; the indices follow. For flat primitives with a
 * normal map, whose tangents are kept at vertices. */
static bool add_corners(gltf_loader *l, gltf_triangles *triangles)
{
    const gltf_vertices *v = &l->recent;
    uint32_t first = 0;
    scene_vertex *to = add_vertices(l, triangles->count, &first);
    if (!to || !copy_more_uvs(l, first, triangles->count, triangles->indices))
        return false;
    for (uint32_t i = 0; i < triangles->count; i += 3) {
        double normal[3];
        face_vector(v, triangles->indices + i, normal);
        for (uint32_t k = 0; k < 3; ++k) {
            copy_vertex(v, triangles->indices[i + k], &to[i + k]);
            set_normal(&to[i + k], normal);
            triangles->indices[i + k] = first + i + k;
        }
    }
    return true;
}

/* Normals of no direction become the mean, by area, of the faces around them. */
static bool repair_normals(gltf_loader *l, const gltf_triangles *triangles, scene_vertex *vertices)
{
    const gltf_vertices *v = &l->recent;
    double(*sums)[3] = calloc(v->count, sizeof *sums);
    if (!sums)
        return fault_set_memory(l->fault);
    for (uint32_t i = 0; i < triangles->count; i += 3) {
        double face[3];
        face_vector(v, triangles->indices + i, face);
        for (uint32_t k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                sums[triangles->indices[i + k]][axis] += face[axis];
    }
    for (uint32_t i = 0; i < v->count; ++i)
        if (!has_direction(v->normals[i]))
            set_normal(&vertices[i], sums[i]);
    free(sums);
    return true;
}

/* The vertices as they are, once for all primitives that share them; the indices follow. */
static bool add_shared(gltf_loader *l, gltf_triangles *triangles, bool repairs)
{
    gltf_vertices *v = &l->recent;
    if (!v->emitted) {
        scene_vertex *to = add_vertices(l, v->count, &v->first);
        for (uint32_t i = 0; to && i < v->count; ++i)
            copy_vertex(v, i, &to[i]);
        if (!to || !copy_more_uvs(l, v->first, v->count, NULL) ||
            (repairs && !v->normals_ok && !repair_normals(l, triangles, to)))
            return false;
        /* Another primitive has other faces to repair normals by. */
        v->emitted = v->normals_ok;
    }
    for (uint32_t i = 0; i < triangles->count; ++i)
        triangles->indices[i] += v->first;
    return true;
}

static bool add_shapes(gltf_loader *l, gltf_triangles *shapes, int material, scene_topology topology)
{
    uint32_t first = 0;
    const scene_map *normal_map = &l->builder->made->materials[material].normal_map;
    const bool flat = topology == SCENE_TRIANGLES && !l->recent.normals && !normal_map->used;
    const bool corners = topology == SCENE_TRIANGLES && !l->recent.normals && normal_map->used;
    if (!(corners ? add_corners(l, shapes) : add_shared(l, shapes, topology == SCENE_TRIANGLES && l->recent.normals)))
        return false;
    if (normal_map->used && !gltf_add_tangents(l, shapes, normal_map->uv))
        return false;
    uint32_t *const indices = shapes->indices;
    shapes->indices = NULL;
    if (!scene_builder_take_indices(l->builder, indices, shapes->count, &first) ||
        !scene_builder_add_primitive(l->builder, first, material))
        return false;
    scene_primitive *made = &l->builder->made->primitives[l->builder->made->primitive_count - 1];
    made->topology = topology;
    made->flat = flat;
    made->white = !l->recent.colors;
    return true;
}

/* Vertices with another center than those before start another mesh of the scene. */
static bool choose_mesh(gltf_loader *l, gltf_mesh_range *meshes)
{
    const double *center = l->recent.center;
    if (meshes->count && !memcmp(l->builder->centers[meshes->first + meshes->count - 1], center, sizeof(double[3])))
        return true;
    const int made = scene_builder_add_mesh_about(l->builder, center);
    meshes->first = meshes->count ? meshes->first : made;
    meshes->count++;
    return made >= 0;
}

static int choose_material(gltf_loader *l, const gltf_primitive *p)
{
    int material = gltf_add_material(l, p->material);
    if (material >= 0 && !l->recent.translucent)
        material = gltf_add_opaque(l, material);
    if (material >= 0 && gltf_find_topology(p) != SCENE_TRIANGLES)
        material = gltf_add_unlit(l, material);
    return material;
}

static bool add_primitive(gltf_loader *l, const gltf_primitive *p, size_t node, gltf_mesh_range *meshes)
{
    if (gltf_find_attribute(&p->attributes, "POSITION") < 0) {
        l->omitted.without_positions++;
        return true;
    }
    gltf_uv_slots slots = {.count = 0};
    if (p->material >= 0)
        slots = gltf_find_uv_slots(&l->document->materials[p->material]);
    if (!gltf_read_vertices(l, p, node, &slots))
        return false;
    gltf_triangles shapes = {0};
    const int material = choose_material(l, p);
    bool ok = material >= 0 && gltf_make_triangles(l, p, &shapes);
    if (ok && shapes.count)
        ok = choose_mesh(l, meshes) && add_shapes(l, &shapes, material, gltf_find_topology(p));
    else
        l->omitted.empty++;
    free(shapes.indices);
    return ok;
}

bool gltf_add_mesh(gltf_loader *l, size_t node, gltf_mesh_range *out)
{
    const gltf_node *n = &l->document->nodes[node];
    const gltf_mesh *mesh = &l->document->meshes[n->mesh];
    const bool own = n->skin >= 0 || n->weights.count;
    if (!own && l->mesh_map[n->mesh].first >= 0) {
        *out = l->mesh_map[n->mesh];
        return true;
    }
    *out = (gltf_mesh_range){0, 0};
    for (size_t i = 0; i < mesh->primitive_count; ++i)
        if (!add_primitive(l, &mesh->primitives[i], node, out))
            return false;
    if (!own)
        l->mesh_map[n->mesh] = *out;
    return true;
}
