/* SPDX-License-Identifier: MIT
 *
 * Growing arrays, sorting of instances, bounds.
 */
#include "scene_builder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Which element of `room` belongs to which array. */
enum { VERTICES, INDICES, PRIMITIVES, MESHES, INSTANCES, MATERIALS, TEXTURES, IMAGES, CAMERAS, LIGHTS };

bool scene_builder_begin(scene_builder *b, const char *name, scene_fault *fault)
{
    memset(b, 0, sizeof *b);
    b->fault = fault;
    b->made = calloc(1, sizeof *b->made);
    if (!b->made)
        return scene_fail_memory(fault);
    snprintf(b->made->name, sizeof b->made->name, "%s", name);
    return true;
}

void scene_builder_abandon(scene_builder *b)
{
    scene_destroy(b->made);
    free(b->instance_mesh);
    memset(b, 0, sizeof *b);
}

/* The array, moved to where there is room for `add` more elements after `*count`, those zeroed and counted. NULL on
 * failure; the old array is then as it was. */
static void *extend(scene_builder *b, int which, void *array, uint32_t *count, uint32_t add, size_t element)
{
    const uint64_t needed = (uint64_t)*count + add;
    if (needed > UINT32_MAX || needed > SIZE_MAX / element) {
        scene_fail_memory(b->fault);
        return NULL;
    }
    if (needed > b->room[which] || !array) {
        uint64_t room = b->room[which] + b->room[which] / 2u;
        room = room < needed ? needed : room;
        room = room < 16 ? 16 : room > UINT32_MAX ? UINT32_MAX : room;
        void *grown = realloc(array, (size_t)room * element);
        if (!grown) {
            scene_fail_memory(b->fault);
            return NULL;
        }
        array = grown;
        b->room[which] = (uint32_t)room;
    }
    memset((char *)array + (size_t)*count * element, 0, (size_t)add * element);
    return array;
}

scene_vertex *scene_builder_add_vertices(scene_builder *b, uint32_t count, uint32_t *out_first)
{
    scene *s = b->made;
    scene_vertex *all = extend(b, VERTICES, s->vertices, &s->vertex_count, count, sizeof *all);
    if (!all)
        return NULL;
    s->vertices = all;
    *out_first = s->vertex_count;
    s->vertex_count += count;
    return all + *out_first;
}

uint32_t *scene_builder_add_indices(scene_builder *b, uint32_t count, uint32_t *out_first)
{
    scene *s = b->made;
    uint32_t *all = extend(b, INDICES, s->indices, &s->index_count, count, sizeof *all);
    if (!all)
        return NULL;
    s->indices = all;
    *out_first = s->index_count;
    s->index_count += count;
    return all + *out_first;
}

int scene_builder_add_material(scene_builder *b, const scene_material *material)
{
    scene *s = b->made;
    scene_material *all = extend(b, MATERIALS, s->materials, &s->material_count, 1, sizeof *all);
    if (!all)
        return -1;
    s->materials = all;
    all[s->material_count] = *material;
    return (int)s->material_count++;
}

int scene_builder_add_texture(scene_builder *b, const scene_texture *texture)
{
    scene *s = b->made;
    scene_texture *all = extend(b, TEXTURES, s->textures, &s->texture_count, 1, sizeof *all);
    if (!all)
        return -1;
    s->textures = all;
    all[s->texture_count] = *texture;
    return (int)s->texture_count++;
}

int scene_builder_add_image(scene_builder *b, const scene_image *image)
{
    scene *s = b->made;
    scene_image *all = extend(b, IMAGES, s->images, &s->image_count, 1, sizeof *all);
    if (!all) {
        free(image->rgba);
        return -1;
    }
    s->images = all;
    all[s->image_count] = *image;
    return (int)s->image_count++;
}

int scene_builder_add_camera(scene_builder *b, const scene_camera *camera)
{
    scene *s = b->made;
    scene_camera *all = extend(b, CAMERAS, s->cameras, &s->camera_count, 1, sizeof *all);
    if (!all)
        return -1;
    s->cameras = all;
    all[s->camera_count] = *camera;
    return (int)s->camera_count++;
}

int scene_builder_add_light(scene_builder *b, const scene_light *light)
{
    scene *s = b->made;
    scene_light *all = extend(b, LIGHTS, s->lights, &s->light_count, 1, sizeof *all);
    if (!all)
        return -1;
    s->lights = all;
    all[s->light_count] = *light;
    return (int)s->light_count++;
}

float (*scene_builder_tangents(scene_builder *b))[4]
{
    scene *s = b->made;
    if (s->tangents && b->tangent_count == s->vertex_count)
        return s->tangents;
    float(*grown)[4] = realloc(s->tangents, ((size_t)b->room[VERTICES] + 1) * sizeof *grown);
    if (!grown) {
        scene_fail_memory(b->fault);
        return NULL;
    }
    s->tangents = grown;
    memset(grown + b->tangent_count, 0, (s->vertex_count - b->tangent_count) * sizeof *grown);
    b->tangent_count = s->vertex_count;
    return grown;
}

int scene_builder_add_mesh(scene_builder *b)
{
    scene *s = b->made;
    scene_mesh *all = extend(b, MESHES, s->meshes, &s->mesh_count, 1, sizeof *all);
    if (!all)
        return -1;
    s->meshes = all;
    all[s->mesh_count].first_primitive = s->primitive_count;
    return (int)s->mesh_count++;
}

static void empty_bounds(float *bounds_min, float *bounds_max)
{
    for (int axis = 0; axis < 3; ++axis) {
        bounds_min[axis] = INFINITY;
        bounds_max[axis] = -INFINITY;
    }
}

static void grow_bounds(float *bounds_min, float *bounds_max, const float *point)
{
    for (int axis = 0; axis < 3; ++axis) {
        bounds_min[axis] = fminf(bounds_min[axis], point[axis]);
        bounds_max[axis] = fmaxf(bounds_max[axis], point[axis]);
    }
}

bool scene_builder_add_primitive(scene_builder *b, uint32_t first_index, int material)
{
    scene *s = b->made;
    scene_primitive *all = extend(b, PRIMITIVES, s->primitives, &s->primitive_count, 1, sizeof *all);
    if (!all)
        return false;
    s->primitives = all;
    scene_primitive *p = &all[s->primitive_count++];
    p->first_index = first_index;
    p->index_count = s->index_count - first_index;
    p->material = material;
    empty_bounds(p->bounds_min, p->bounds_max);
    for (uint32_t i = first_index; i < s->index_count; ++i)
        grow_bounds(p->bounds_min, p->bounds_max, s->vertices[s->indices[i]].position);
    s->meshes[s->mesh_count - 1].primitive_count++;
    return true;
}

bool scene_builder_add_instance(scene_builder *b, int mesh, const float *world_from_mesh)
{
    scene *s = b->made;
    const uint32_t old_room = b->room[INSTANCES];
    scene_instance *all = extend(b, INSTANCES, s->instances, &s->instance_count, 1, sizeof *all);
    if (!all)
        return false;
    s->instances = all;
    if (b->room[INSTANCES] != old_room) {
        int *meshes = realloc(b->instance_mesh, b->room[INSTANCES] * sizeof *meshes);
        if (!meshes)
            return scene_fail_memory(b->fault);
        b->instance_mesh = meshes;
    }
    b->instance_mesh[s->instance_count] = mesh;
    memcpy(all[s->instance_count++].world_from_mesh, world_from_mesh, sizeof all->world_from_mesh);
    return true;
}

scene_material scene_default_material(void)
{
    return (scene_material){.base_color = {1, 1, 1, 1},
                            .base_color_texture = -1,
                            .base_color_uv_from_uv = {1, 0, 0, 0, 1, 0},
                            .alpha = SCENE_ALPHA_OPAQUE,
                            .alpha_cutoff = 0.5f,
                            .metallic = 1,
                            .roughness = 1,
                            .normal_scale = 1,
                            .occlusion_strength = 1};
}

/* A counting sort: instances keep their order within a mesh. */
static bool sort_instances(scene_builder *b)
{
    scene *s = b->made;
    if (!s->instance_count)
        return true;
    scene_instance *sorted = malloc(s->instance_count * sizeof *sorted);
    if (!sorted)
        return scene_fail_memory(b->fault);
    for (uint32_t i = 0; i < s->instance_count; ++i)
        s->meshes[b->instance_mesh[i]].instance_count++;
    uint32_t first = 0;
    for (uint32_t m = 0; m < s->mesh_count; ++m) {
        s->meshes[m].first_instance = first;
        first += s->meshes[m].instance_count;
        s->meshes[m].instance_count = 0;
    }
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        scene_mesh *mesh = &s->meshes[b->instance_mesh[i]];
        sorted[mesh->first_instance + mesh->instance_count++] = s->instances[i];
    }
    free(s->instances);
    s->instances = sorted;
    return true;
}

/* The mesh's vertices, each once, in points[0 .. result); `seen` holds the mesh + 1 that last counted a vertex. */
static uint32_t collect_points(const scene *s, uint32_t mesh, uint32_t *seen, float (*points)[3])
{
    uint32_t count = 0;
    const scene_mesh *m = &s->meshes[mesh];
    for (uint32_t p = m->first_primitive; p < m->first_primitive + m->primitive_count; ++p) {
        const scene_primitive *primitive = &s->primitives[p];
        for (uint32_t i = 0; i < primitive->index_count; ++i) {
            const uint32_t v = s->indices[primitive->first_index + i];
            if (seen[v] != mesh + 1) {
                seen[v] = mesh + 1;
                memcpy(points[count++], s->vertices[v].position, sizeof points[0]);
            }
        }
    }
    return count;
}

/* The eight corners of the mesh's box, for meshes whose every vertex in every instance would take too long. */
static uint32_t collect_corners(const scene *s, uint32_t mesh, float (*points)[3])
{
    float low[3], high[3];
    empty_bounds(low, high);
    const scene_mesh *m = &s->meshes[mesh];
    for (uint32_t p = m->first_primitive; p < m->first_primitive + m->primitive_count; ++p) {
        grow_bounds(low, high, s->primitives[p].bounds_min);
        grow_bounds(low, high, s->primitives[p].bounds_max);
    }
    for (uint32_t corner = 0; corner < 8; ++corner)
        for (uint32_t axis = 0; axis < 3; ++axis)
            points[corner][axis] = corner >> axis & 1 ? high[axis] : low[axis];
    return 8;
}

/* False where a point leaves what single precision holds; fmin and fmax pass over NaN, so the bounds do not show it. */
static bool grow_bounds_of_instance(scene *s, const scene_instance *instance, const float (*points)[3], uint32_t count)
{
    bool finite = true;
    const float *m = instance->world_from_mesh;
    for (uint32_t i = 0; i < count; ++i) {
        const float *p = points[i];
        const float world[3] = {m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12],
                                m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13],
                                m[2] * p[0] + m[6] * p[1] + m[10] * p[2] + m[14]};
        finite = finite && isfinite(world[0] + world[1] + world[2]);
        grow_bounds(s->bounds_min, s->bounds_max, world);
    }
    return finite;
}

static bool measure_bounds(scene_builder *b)
{
    enum { MOST_POINTS = 1 << 26 }; /* about a quarter of a second */
    scene *s = b->made;
    if (!s->instance_count)
        return true;
    uint32_t *seen = calloc(s->vertex_count + 1u, sizeof *seen);
    float(*points)[3] = malloc((s->vertex_count + 8u) * sizeof *points);
    if (!seen || !points) {
        free(seen);
        free(points);
        return scene_fail_memory(b->fault);
    }
    bool finite = true, any = false;
    empty_bounds(s->bounds_min, s->bounds_max);
    for (uint32_t m = 0; m < s->mesh_count && finite; ++m) {
        const scene_mesh *mesh = &s->meshes[m];
        if (!mesh->instance_count || !mesh->primitive_count)
            continue;
        uint32_t count = collect_points(s, m, seen, points);
        if ((uint64_t)count * mesh->instance_count > MOST_POINTS)
            count = collect_corners(s, m, points);
        any = true;
        for (uint32_t i = 0; i < mesh->instance_count && finite; ++i)
            finite =
                grow_bounds_of_instance(s, &s->instances[mesh->first_instance + i], (const float(*)[3])points, count);
    }
    free(seen);
    free(points);
    for (int axis = 0; axis < 3; ++axis) {
        if (!any)
            s->bounds_min[axis] = s->bounds_max[axis] = 0;
        finite = finite && isfinite(s->bounds_max[axis] - s->bounds_min[axis]);
    }
    return finite || scene_fail(b->fault, "the scene is too large for single precision");
}

scene *scene_builder_finish(scene_builder *b)
{
    const scene_material plain = scene_default_material();
    const bool has_material = b->made->material_count || scene_builder_add_material(b, &plain) >= 0;
    const bool has_tangents = !b->made->tangents || scene_builder_tangents(b);
    if (b->fault->set || !has_material || !has_tangents || !sort_instances(b) || !measure_bounds(b)) {
        scene_builder_abandon(b);
        return NULL;
    }
    scene *made = b->made;
    b->made = NULL;
    scene_builder_abandon(b);
    return made;
}
