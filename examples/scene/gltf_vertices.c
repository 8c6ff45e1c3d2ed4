/* SPDX-License-Identifier: MIT
 *
 * Reads the vertices of a primitive: attributes, then morph targets by their default weights, then the skin. Positions
 * must be finite; normals are made unit or marked; texture coordinates and colours that are not finite become 0 and 1.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

void gltf_free_vertices(gltf_vertices *v)
{
    free(v->positions);
    free(v->normals);
    for (int slot = 0; slot < SCENE_UV_COUNT; ++slot)
        free(v->uvs[slot]);
    free(v->colors);
    free(v->tangents);
    memset(v, 0, sizeof *v);
}

static bool same_attributes(const gltf_attribute_list *a, const gltf_attribute_list *b)
{
    bool same = a->count == b->count;
    for (size_t i = 0; same && i < a->count; ++i)
        same = a->items[i].accessor == b->items[i].accessor && !strcmp(a->items[i].name, b->items[i].name);
    return same;
}

static bool same_source(const gltf_primitive *a, const gltf_primitive *b)
{
    bool same = same_attributes(&a->attributes, &b->attributes) && a->target_count == b->target_count;
    for (size_t t = 0; same && t < a->target_count; ++t)
        same = same_attributes(&a->targets[t], &b->targets[t]);
    return same;
}

/* NULL where the list has no attribute of that name, or on failure. */
static float *read_attribute(gltf_loader *l, const gltf_attribute_list *list, const char *name, int components,
                             gltf_scaling scaling)
{
    const int accessor = gltf_find_attribute(list, name);
    return accessor < 0 ? NULL : gltf_read_floats(l, accessor, components, scaling);
}

static float *read_uvs(gltf_loader *l, const gltf_vertices *v, int set)
{
    char name[32];
    snprintf(name, sizeof name, "TEXCOORD_%d", set);
    float *uvs = read_attribute(l, &v->source->attributes, name, 2, GLTF_AS_SAID);
    for (size_t i = 0; uvs && i < 2 * (size_t)v->count; ++i)
        uvs[i] = isfinite(uvs[i]) ? uvs[i] : 0;
    return uvs;
}

/* Three components get an alpha of 1. */
static float *read_colors(gltf_loader *l, gltf_vertices *v)
{
    const int accessor = gltf_find_attribute(&v->source->attributes, "COLOR_0");
    const int components = accessor >= 0 && l->document->accessors[accessor].rows == 3 ? 3 : 4;
    float *given = read_attribute(l, &v->source->attributes, "COLOR_0", components, GLTF_NORMALIZED);
    if (!given)
        return NULL;
    float *colors = malloc((size_t)v->count * 4 * sizeof *colors);
    for (size_t i = 0; colors && i < v->count; ++i) {
        for (int c = 0; c < 4; ++c) {
            const float value = c < components ? given[i * (size_t)components + (size_t)c] : 1;
            colors[4 * i + (size_t)c] = isfinite(value) ? fminf(fmaxf(value, 0), 1) : 1;
        }
        v->translucent = v->translucent || colors[4 * i + 3] < 1;
    }
    free(given);
    if (!colors)
        fault_set_memory(l->fault);
    return colors;
}

/* Adds a target's displacements, where it has any. */
static bool add_target(gltf_loader *l, const gltf_vertices *v, const gltf_attribute_list *target, const char *name,
                       double weight, float (*to)[3])
{
    float *by = to ? read_attribute(l, target, name, 3, GLTF_AS_SAID) : NULL;
    for (size_t i = 0; by && i < v->count; ++i)
        for (size_t axis = 0; axis < 3; ++axis)
            to[i][axis] += (float)(weight * (double)by[3 * i + axis]);
    free(by);
    return !l->fault->set;
}

static bool pose_targets(gltf_loader *l, gltf_vertices *v, const gltf_node *node)
{
    const gltf_weights *given = node->weights.count ? &node->weights : &l->document->meshes[node->mesh].weights;
    for (size_t t = 0; t < v->source->target_count && t < given->count; ++t) {
        const double weight = given->values[t];
        const gltf_attribute_list *target = &v->source->targets[t];
        if (weight != 0 && (!add_target(l, v, target, "POSITION", weight, v->positions) ||
                            !add_target(l, v, target, "NORMAL", weight, v->normals)))
            return false;
    }
    return true;
}

static bool check_positions(gltf_loader *l, const gltf_vertices *v)
{
    for (uint32_t i = 0; i < v->count; ++i)
        if (!isfinite(v->positions[i][0]) || !isfinite(v->positions[i][1]) || !isfinite(v->positions[i][2]))
            return fault_set(l->fault, "accessor %d: the position of vertex %u is not finite",
                             gltf_find_attribute(&v->source->attributes, "POSITION"), i);
    return true;
}

/* Unit length; one that has no direction becomes 0, 0, 0 and is counted as wrong. */
static void normalize_normals(gltf_vertices *v)
{
    v->normals_ok = true;
    for (uint32_t i = 0; v->normals && i < v->count; ++i) {
        float *n = v->normals[i];
        const double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
        const bool ok = length > 0 && isfinite(length);
        for (int axis = 0; axis < 3; ++axis)
            n[axis] = ok ? (float)(n[axis] / length) : 0;
        v->normals_ok = v->normals_ok && ok;
    }
}

void gltf_center_vertices(gltf_vertices *v, double (*positions)[3])
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < v->count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = fmin(low[axis], positions[i][axis]);
            high[axis] = fmax(high[axis], positions[i][axis]);
        }
    const bool far = scene_is_far(low, high);
    for (int axis = 0; axis < 3; ++axis)
        v->center[axis] = far ? 0.5 * low[axis] + 0.5 * high[axis] : 0;
    for (uint32_t i = 0; i < v->count; ++i)
        for (int axis = 0; axis < 3; ++axis)
            v->positions[i][axis] = (float)(positions[i][axis] - v->center[axis]);
}

/* The same in place, for positions that the file stores near zero as a rule: then nothing changes. */
static void center_in_place(gltf_vertices *v)
{
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < v->count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = v->positions[i][axis] < low[axis] ? v->positions[i][axis] : low[axis];
            high[axis] = v->positions[i][axis] > high[axis] ? v->positions[i][axis] : high[axis];
        }
    double wide_low[3], wide_high[3];
    for (int axis = 0; axis < 3; ++axis) {
        wide_low[axis] = (double)low[axis];
        wide_high[axis] = (double)high[axis];
    }
    if (!scene_is_far(wide_low, wide_high))
        return;
    for (int axis = 0; axis < 3; ++axis)
        v->center[axis] = 0.5 * wide_low[axis] + 0.5 * wide_high[axis];
    for (uint32_t i = 0; i < v->count; ++i)
        for (int axis = 0; axis < 3; ++axis)
            v->positions[i][axis] = (float)((double)v->positions[i][axis] - v->center[axis]);
}

static bool is_recent(const gltf_vertices *v, const gltf_primitive *primitive, size_t pose, const gltf_uv_slots *slots)
{
    return v->source && v->pose == pose && v->slots.count == slots->count &&
           !memcmp(v->slots.sets, slots->sets, (size_t)slots->count * sizeof *slots->sets) &&
           same_source(v->source, primitive);
}

static bool read_all(gltf_loader *l, gltf_vertices *v)
{
    const gltf_attribute_list *attributes = &v->source->attributes;
    v->positions = (float(*)[3])read_attribute(l, attributes, "POSITION", 3, GLTF_AS_SAID);
    if (!l->flat_normals)
        v->normals = (float(*)[3])read_attribute(l, attributes, "NORMAL", 3, GLTF_AS_SAID);
    for (int slot = 0; slot < v->slots.count; ++slot)
        v->uvs[slot] = (float(*)[2])read_uvs(l, v, v->slots.sets[slot]);
    v->colors = (float(*)[4])read_colors(l, v);
    if (v->pose == SIZE_MAX && v->normals)
        v->tangents = (float(*)[4])read_attribute(l, attributes, "TANGENT", 4, GLTF_AS_SAID);
    return !l->fault->set;
}

bool gltf_read_vertices(gltf_loader *l, const gltf_primitive *primitive, size_t node_number, const gltf_uv_slots *slots)
{
    const gltf_node *node = &l->document->nodes[node_number];
    const size_t pose = node->skin >= 0 || primitive->target_count ? node_number : SIZE_MAX;
    gltf_vertices *v = &l->recent;
    if (is_recent(v, primitive, pose, slots))
        return true;
    gltf_free_vertices(v);
    v->source = primitive;
    v->pose = pose;
    v->slots = *slots;
    const int positions = gltf_find_attribute(&primitive->attributes, "POSITION");
    const size_t count = l->document->accessors[positions].count;
    if (count > UINT32_MAX)
        return fault_set(l->fault, "accessor %d: too many vertices, %zu", positions, count);
    v->count = (uint32_t)count;
    if (!read_all(l, v) || !check_positions(l, v))
        return false;
    center_in_place(v);
    if (!pose_targets(l, v, node) || !check_positions(l, v) ||
        (node->skin >= 0 && (!gltf_pose_skin(l, v, node->skin, node_number) || !check_positions(l, v))))
        return false;
    normalize_normals(v);
    return true;
}
