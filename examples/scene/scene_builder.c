/* SPDX-License-Identifier: MIT
 *
 * Growing arrays and sorting of instances.
 */
#include "scene_builder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Which element of `room` belongs to which array. */
enum { VERTICES, INDICES, PRIMITIVES, MESHES, INSTANCES, MATERIALS, TEXTURES, IMAGES, CAMERAS, LIGHTS };

bool scene_builder_begin(scene_builder *b, const char *name, failure *fault)
{
    memset(b, 0, sizeof *b);
    b->fault = fault;
    b->made = calloc(1, sizeof *b->made);
    if (!b->made)
        return fault_set_memory(fault);
    snprintf(b->made->name, sizeof b->made->name, "%s", name);
    return true;
}

void scene_builder_abandon(scene_builder *b)
{
    scene_destroy(b->made);
    free(b->placements);
    free(b->centers);
    free(b->camera_places);
    free(b->light_places);
    memset(b, 0, sizeof *b);
}

/* The array, moved to where there is room for `add` more elements after `*count`. NULL on failure; the old array is
 * then as it was. */
static void *make_room(scene_builder *b, int which, void *array, uint32_t *count, uint32_t add, size_t element)
{
    const uint64_t needed = (uint64_t)*count + add;
    if (needed > UINT32_MAX || needed > SIZE_MAX / element) {
        fault_set_memory(b->fault);
        return NULL;
    }
    if (needed > b->room[which] || !array) {
        uint64_t room = b->room[which] + b->room[which] / 2u;
        room = room < needed ? needed : room;
        room = room < 16 ? 16 : room > UINT32_MAX ? UINT32_MAX : room;
        void *grown = realloc(array, (size_t)room * element);
        if (!grown) {
            fault_set_memory(b->fault);
            return NULL;
        }
        array = grown;
        b->room[which] = (uint32_t)room;
    }
    return array;
}

/* The same, with the new elements zeroed. */
static void *extend(scene_builder *b, int which, void *array, uint32_t *count, uint32_t add, size_t element)
{
    char *grown = make_room(b, which, array, count, add, element);
    if (grown)
        memset(grown + (size_t)*count * element, 0, (size_t)add * element);
    return grown;
}

scene_vertex *scene_builder_add_vertices(scene_builder *b, uint32_t count, uint32_t *out_first)
{
    scene *s = b->made;
    scene_vertex *all = make_room(b, VERTICES, s->vertices, &s->vertex_count, count, sizeof *all);
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
    uint32_t *all = make_room(b, INDICES, s->indices, &s->index_count, count, sizeof *all);
    if (!all)
        return NULL;
    s->indices = all;
    *out_first = s->index_count;
    s->index_count += count;
    return all + *out_first;
}

bool scene_builder_take_indices(scene_builder *b, uint32_t *indices, uint32_t count, uint32_t *out_first)
{
    if (b->made->index_count == 0) {
        free(b->made->indices);
        b->made->indices = indices;
        b->room[INDICES] = b->made->index_count = count;
        *out_first = 0;
        return true;
    }
    uint32_t *to = scene_builder_add_indices(b, count, out_first);
    if (to)
        memcpy(to, indices, count * sizeof *to);
    free(indices);
    return to;
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

/* A list beside one of the scene's, made as long as that one has room. */
static bool follow(scene_builder *b, int which, void *list, size_t element)
{
    void **at = list;
    void *grown = realloc(*at, b->room[which] * element);
    if (!grown)
        return fault_set_memory(b->fault);
    *at = grown;
    return true;
}

int scene_builder_add_camera(scene_builder *b, const scene_camera *camera, const double place[3])
{
    scene *s = b->made;
    scene_camera *all = extend(b, CAMERAS, s->cameras, &s->camera_count, 1, sizeof *all);
    if (!all)
        return -1;
    s->cameras = all;
    if (!follow(b, CAMERAS, &b->camera_places, sizeof *b->camera_places))
        return -1;
    all[s->camera_count] = *camera;
    memcpy(b->camera_places[s->camera_count], place, sizeof *b->camera_places);
    return (int)s->camera_count++;
}

int scene_builder_add_light(scene_builder *b, const scene_light *light, const double place[3])
{
    scene *s = b->made;
    scene_light *all = extend(b, LIGHTS, s->lights, &s->light_count, 1, sizeof *all);
    if (!all)
        return -1;
    s->lights = all;
    if (!follow(b, LIGHTS, &b->light_places, sizeof *b->light_places))
        return -1;
    all[s->light_count] = *light;
    memcpy(b->light_places[s->light_count], place, sizeof *b->light_places);
    return (int)s->light_count++;
}

/* An array beside the vertices, as long as those have room, zeroed where it grew. */
static void *extend_beside(scene_builder *b, void *array, uint32_t *count, size_t element)
{
    const uint32_t needed = b->made->vertex_count;
    if (array && *count == needed)
        return array;
    char *grown = realloc(array, ((size_t)b->room[VERTICES] + 1) * element);
    if (!grown) {
        fault_set_memory(b->fault);
        return NULL;
    }
    memset(grown + *count * element, 0, (needed - *count) * element);
    *count = needed;
    return grown;
}

float (*scene_builder_tangents(scene_builder *b))[4]
{
    float(*all)[4] = extend_beside(b, b->made->tangents, &b->tangent_count, sizeof *all);
    b->made->tangents = all ? all : b->made->tangents;
    return all;
}

float (*scene_builder_more_uvs(scene_builder *b))[2][2]
{
    float(*all)[2][2] = extend_beside(b, b->made->more_uvs, &b->more_uv_count, sizeof *all);
    b->made->more_uvs = all ? all : b->made->more_uvs;
    return all;
}

int scene_builder_add_mesh_about(scene_builder *b, const double center[3])
{
    scene *s = b->made;
    scene_mesh *all = extend(b, MESHES, s->meshes, &s->mesh_count, 1, sizeof *all);
    if (!all)
        return -1;
    s->meshes = all;
    if (!follow(b, MESHES, &b->centers, sizeof *b->centers))
        return -1;
    all[s->mesh_count].first_primitive = s->primitive_count;
    memcpy(b->centers[s->mesh_count], center, sizeof *b->centers);
    return (int)s->mesh_count++;
}

int scene_builder_add_mesh(scene_builder *b)
{
    return scene_builder_add_mesh_about(b, (const double[3]){0, 0, 0});
}

static void empty_bounds(float *bounds_min, float *bounds_max)
{
    for (int axis = 0; axis < 3; ++axis) {
        bounds_min[axis] = INFINITY;
        bounds_max[axis] = -INFINITY;
    }
}

/* The point is finite: without fminf's care for NaN, compilers make vector code of it. */
static void grow_bounds(float *bounds_min, float *bounds_max, const float *point)
{
    for (int axis = 0; axis < 3; ++axis) {
        bounds_min[axis] = point[axis] < bounds_min[axis] ? point[axis] : bounds_min[axis];
        bounds_max[axis] = point[axis] > bounds_max[axis] ? point[axis] : bounds_max[axis];
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

bool scene_builder_place(scene_builder *b, int mesh, const double world_from_mesh[16])
{
    scene *s = b->made;
    scene_instance *all = extend(b, INSTANCES, s->instances, &s->instance_count, 1, sizeof *all);
    if (!all)
        return false;
    s->instances = all;
    if (!follow(b, INSTANCES, &b->placements, sizeof *b->placements))
        return false;
    scene_placement *to = &b->placements[s->instance_count++];
    const double *center = b->centers[mesh];
    to->mesh = mesh;
    memcpy(to->world_from_mesh, world_from_mesh, sizeof to->world_from_mesh);
    for (int row = 0; row < 3; ++row)
        for (int c = 0; c < 3; ++c)
            to->world_from_mesh[12 + row] += world_from_mesh[4 * c + row] * center[c];
    return true;
}

bool scene_builder_add_instance(scene_builder *b, int mesh, const float *world_from_mesh)
{
    double wide[16];
    for (int i = 0; i < 16; ++i)
        wide[i] = (double)world_from_mesh[i];
    return scene_builder_place(b, mesh, wide);
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
static bool sort_placements(scene_builder *b)
{
    scene *s = b->made;
    scene_placement *sorted = malloc((s->instance_count + 1u) * sizeof *sorted);
    if (!sorted)
        return fault_set_memory(b->fault);
    for (uint32_t i = 0; i < s->instance_count; ++i)
        s->meshes[b->placements[i].mesh].instance_count++;
    uint32_t first = 0;
    for (uint32_t m = 0; m < s->mesh_count; ++m) {
        s->meshes[m].first_instance = first;
        first += s->meshes[m].instance_count;
        s->meshes[m].instance_count = 0;
    }
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        scene_mesh *mesh = &s->meshes[b->placements[i].mesh];
        sorted[mesh->first_instance + mesh->instance_count++] = b->placements[i];
    }
    free(b->placements);
    b->placements = sorted;
    return true;
}

scene *scene_builder_finish(scene_builder *b)
{
    const scene_material plain = scene_default_material();
    const bool has_material = b->made->material_count || scene_builder_add_material(b, &plain) >= 0;
    const bool has_tangents = !b->made->tangents || scene_builder_tangents(b);
    const bool has_uvs = !b->made->more_uvs || scene_builder_more_uvs(b);
    if (b->fault->set || !has_material || !has_tangents || !has_uvs || !sort_placements(b) ||
        !scene_builder_settle(b)) {
        scene_builder_abandon(b);
        return NULL;
    }
    scene *made = b->made;
    b->made = NULL;
    scene_builder_abandon(b);
    return made;
}
