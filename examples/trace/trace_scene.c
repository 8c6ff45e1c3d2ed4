/* SPDX-License-Identifier: MIT
 *
 * Builds a scene's triangles in Embree. A mesh with one instance is placed in the world. Other meshes are built once
 * and instanced, so that thousands of copies take little memory.
 */
#include "trace_internal.h"

#include "matrix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void prepare_instance(const float m[16], trace_instance *out)
{
    out->world_from_mesh = m;
    out->mirrored = matrix_for_normals(m, out->normal_from_mesh);
}

/* Embree transforms rays to mesh space and back. A flat or very uneven matrix would lose all precision in the inverse.
 */
static bool can_be_instanced(const float m[16])
{
    double longest = 0, shortest = INFINITY, determinant = 0, lengths = 1;
    for (int c = 0; c < 3; c++) {
        const double length = sqrt((double)m[4 * c] * (double)m[4 * c] + (double)m[4 * c + 1] * (double)m[4 * c + 1] +
                                   (double)m[4 * c + 2] * (double)m[4 * c + 2]);
        longest = fmax(longest, length);
        shortest = fmin(shortest, length);
        lengths *= length;
        const int r = (c + 1) % 3, s = (c + 2) % 3;
        determinant += (double)m[c] * ((double)m[4 + r] * (double)m[8 + s] - (double)m[4 + s] * (double)m[8 + r]);
    }
    return shortest > 1e-3 * longest && fabs(determinant) > 1e-3 * lengths;
}

static bool is_solid(const scene *s, uint32_t primitive)
{
    const scene_primitive *p = &s->primitives[primitive];
    return s->materials[p->material].alpha != SCENE_ALPHA_BLEND && p->topology == SCENE_TRIANGLES;
}

/* The part's triangles as a committed geometry. In mesh space Embree reads the scene's own arrays. */
static RTCGeometry make_triangles(RTCDevice device, const trace_part *part, bool alpha_tested)
{
    const scene *s = part->scene;
    const scene_primitive *p = part->primitive;
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (!g)
        return NULL;
    if (!part->instance) {
        rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, s->vertices,
                                   offsetof(scene_vertex, position), sizeof(scene_vertex), s->vertex_count);
        rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, s->indices + p->first_index, 0,
                                   3 * sizeof(uint32_t), p->index_count / 3);
    } else {
        const uint32_t *from = s->indices + p->first_index;
        uint32_t first = UINT32_MAX, last = 0;
        for (uint32_t i = 0; i < p->index_count; i++) {
            first = from[i] < first ? from[i] : first;
            last = from[i] > last ? from[i] : last;
        }
        float(*positions)[3] = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                       sizeof *positions, last - first + 1);
        uint32_t *indices = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof *indices,
                                                    p->index_count / 3);
        if (!positions || !indices) {
            rtcReleaseGeometry(g);
            return NULL;
        }
        const float *m = part->instance->world_from_mesh;
        for (uint32_t i = first; i <= last; i++) {
            const float *at = s->vertices[i].position;
            for (int r = 0; r < 3; r++)
                positions[i - first][r] = (float)((double)m[r] * (double)at[0] + (double)m[4 + r] * (double)at[1] +
                                                  (double)m[8 + r] * (double)at[2] + (double)m[12 + r]);
        }
        for (uint32_t i = 0; i < p->index_count; i++)
            indices[i] = from[i] - first;
    }
    trace_filter_install(g, part, alpha_tested);
    rtcCommitGeometry(g);
    return g;
}

static bool attach(RTCScene to, RTCGeometry g, unsigned number)
{
    if (g) {
        rtcAttachGeometryByID(to, g, number);
        rtcReleaseGeometry(g);
    }
    return g;
}

static RTCScene new_scene(RTCDevice device)
{
    RTCScene made = rtcNewScene(device);
    if (made) {
        /* No ray slips through the edge between two triangles. */
        rtcSetSceneFlags(made, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(made, RTC_BUILD_QUALITY_HIGH);
    }
    return made;
}

static bool build_mesh(trace_scene *t, uint32_t mesh, const bool *alpha_tested)
{
    const scene_mesh *m = &t->scene->meshes[mesh];
    t->meshes[mesh] = new_scene(t->device);
    for (uint32_t i = 0; t->meshes[mesh] && i < m->primitive_count; i++) {
        const uint32_t p = m->first_primitive + i;
        if (is_solid(t->scene, p) &&
            !attach(t->meshes[mesh], make_triangles(t->device, &t->mesh_parts[p], alpha_tested[p]), i)) {
            return false;
        }
    }
    if (t->meshes[mesh])
        rtcCommitScene(t->meshes[mesh]);
    return t->meshes[mesh];
}

static bool place_in_world(trace_scene *t, const scene_mesh *m, uint32_t instance, uint32_t *part_count,
                           const bool *alpha_tested)
{
    for (uint32_t p = m->first_primitive; p < m->first_primitive + m->primitive_count; p++) {
        if (!is_solid(t->scene, p))
            continue;
        trace_part *part = &t->world_parts[*part_count];
        *part = t->mesh_parts[p];
        part->instance = &t->instances[instance];
        if (!attach(t->world, make_triangles(t->device, part, alpha_tested[p]),
                    t->scene->instance_count + *part_count)) {
            return false;
        }
        ++*part_count;
    }
    return true;
}

static bool instantiate(trace_scene *t, uint32_t mesh, uint32_t instance)
{
    RTCGeometry g = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_INSTANCE);
    if (!g)
        return false;
    rtcSetGeometryInstancedScene(g, t->meshes[mesh]);
    rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, t->instances[instance].world_from_mesh);
    rtcCommitGeometry(g);
    return attach(t->world, g, instance);
}

static bool place_mesh(trace_scene *t, uint32_t mesh, uint32_t *part_count, const bool *alpha_tested)
{
    const scene_mesh *m = &t->scene->meshes[mesh];
    for (uint32_t i = m->first_instance; i < m->first_instance + m->instance_count; i++) {
        t->instances[i].parts = &t->mesh_parts[m->first_primitive];
        if (m->instance_count == 1 || !can_be_instanced(t->instances[i].world_from_mesh)) {
            if (!place_in_world(t, m, i, part_count, alpha_tested))
                return false;
        } else if ((!t->meshes[mesh] && !build_mesh(t, mesh, alpha_tested)) || !instantiate(t, mesh, i)) {
            return false;
        }
    }
    return true;
}

/* The number of parts placed in the world without an instance. */
static size_t count_world_parts(const scene *s)
{
    size_t count = 0;
    for (uint32_t i = 0; i < s->mesh_count; i++) {
        const scene_mesh *m = &s->meshes[i];
        for (uint32_t k = m->first_instance; k < m->first_instance + m->instance_count; k++)
            if (m->instance_count == 1 || !can_be_instanced(s->instances[k].world_from_mesh))
                count += m->primitive_count;
    }
    return count;
}

static bool build(trace_scene *t)
{
    const scene *s = t->scene;
    t->world = new_scene(t->device);
    t->meshes = calloc((size_t)s->mesh_count + 1, sizeof *t->meshes);
    t->instances = calloc((size_t)s->instance_count + 1, sizeof *t->instances);
    t->mesh_parts = calloc((size_t)s->primitive_count + 1, sizeof *t->mesh_parts);
    t->world_parts = calloc(count_world_parts(s) + 1, sizeof *t->world_parts);
    bool *alpha_tested = calloc((size_t)s->primitive_count + 1, sizeof *alpha_tested);
    bool ok = t->world && t->meshes && t->instances && t->mesh_parts && t->world_parts && alpha_tested;
    for (uint32_t i = 0; ok && i < s->primitive_count; i++) {
        t->mesh_parts[i] = (trace_part){.scene = s, .primitive = &s->primitives[i]};
        alpha_tested[i] = trace_filter_needed(s, &s->primitives[i]);
    }
    for (uint32_t i = 0; ok && i < s->instance_count; i++)
        prepare_instance(s->instances[i].world_from_mesh, &t->instances[i]);
    uint32_t part_count = 0;
    for (uint32_t i = 0; ok && i < s->mesh_count; i++)
        ok = place_mesh(t, i, &part_count, alpha_tested);
    free(alpha_tested);
    if (ok)
        rtcCommitScene(t->world);
    return ok && rtcGetDeviceError(t->device) == RTC_ERROR_NONE;
}

trace_scene *trace_scene_create(const scene *s, failure *fault)
{
    trace_scene *t = calloc(1, sizeof *t);
    if (t) {
        t->scene = s;
        t->device = rtcNewDevice(NULL);
        if (t->device && build(t))
            return t;
        const enum RTCError code = rtcGetDeviceError(t->device);
        fault_set(fault, "%s: Embree can't take the scene%s", s->name,
                  code == RTC_ERROR_UNSUPPORTED_CPU ? ": it does not know this processor" : ", out of memory");
        trace_scene_destroy(t);
    } else {
        fault_set(fault, "%s: out of memory", s->name);
    }
    return NULL;
}

void trace_scene_destroy(trace_scene *t)
{
    if (!t)
        return;
    if (t->world)
        rtcReleaseScene(t->world);
    for (uint32_t i = 0; t->meshes && i < t->scene->mesh_count; i++)
        if (t->meshes[i])
            rtcReleaseScene(t->meshes[i]);
    if (t->device)
        rtcReleaseDevice(t->device);
    free(t->meshes);
    free(t->instances);
    free(t->mesh_parts);
    free(t->world_parts);
    free(t);
}
