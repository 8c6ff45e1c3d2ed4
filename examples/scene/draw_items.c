/* SPDX-License-Identifier: MIT
 *
 * Decides which draw calls a scene takes, in which order, and which of them a view shows.
 */
#include "draw_internal.h"
#include "matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool draw_normal_matrix(const float affine[16], float out[3][3])
{
    double normals[9];
    const bool mirrors = matrix_for_normals(affine, normals);
    for (int i = 0; i < 9; i++)
        out[i / 3][i % 3] = (float)normals[i];
    return mirrors;
}

static bool has_colors(const scene *s, const scene_primitive *p)
{
    for (uint32_t i = 0; i < p->index_count; i++) {
        const float *color = s->vertices[s->indices[p->first_index + i]].color;
        if (color[0] != 1.0f || color[1] != 1.0f || color[2] != 1.0f || color[3] != 1.0f)
            return true;
    }
    return false;
}

static bool reads_more_uvs(const scene_material *m)
{
    const scene_map *const maps[] = {&m->metallic_roughness_map, &m->normal_map, &m->occlusion_map, &m->emissive_map};
    bool any = false;
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++)
        any = any || (maps[i]->used && maps[i]->uv >= 2);
    return any;
}

/* The variant that the material and the vertices need in the main pass, before the options add to it. */
static unsigned choose_variant(const scene *s, const scene_material *m, bool colored)
{
    const struct {
        bool wanted;
        unsigned bits;
    } always[] =
        {
            {m->base_color_texture >= 0, VARIANT_BASE_MAPPED | VARIANT_TEXTURED},
            {colored, VARIANT_COLORED},
            {m->alpha == SCENE_ALPHA_MASK, VARIANT_MASKED},
            {m->alpha == SCENE_ALPHA_BLEND, VARIANT_BLENDED},
            {!m->unlit, VARIANT_LIT},
            {s->more_uvs && reads_more_uvs(m), VARIANT_MORE_UVS},
        },
      where_lit[] = {
          {m->double_sided, VARIANT_DOUBLE_SIDED},
          {m->normal_map.used && s->tangents && m->normal_scale != 0, VARIANT_NORMAL_MAPPED | VARIANT_TEXTURED},
          {m->metallic_roughness, VARIANT_REFLECTIVE},
          {m->metallic_roughness && m->metallic_roughness_map.used, VARIANT_ROUGHNESS_MAPPED | VARIANT_TEXTURED},
          {m->occlusion_map.used && m->occlusion_strength > 0, VARIANT_BAKED | VARIANT_TEXTURED},
          {m->emissive[0] > 0 || m->emissive[1] > 0 || m->emissive[2] > 0,
           VARIANT_EMISSIVE | (m->emissive_map.used ? VARIANT_EMISSION_MAPPED | VARIANT_TEXTURED : 0u)},
      };
    unsigned variant = 0;
    for (size_t i = 0; i < sizeof always / sizeof always[0]; i++)
        variant |= always[i].wanted ? always[i].bits : 0u;
    for (size_t i = 0; !m->unlit && i < sizeof where_lit / sizeof where_lit[0]; i++)
        variant |= where_lit[i].wanted ? where_lit[i].bits : 0u;
    return variant;
}

static draw_item *add_item(scene_renderer *r, uint32_t *capacity)
{
    if (r->item_count == *capacity) {
        if (*capacity > UINT32_MAX / 2)
            return NULL;
        uint32_t wanted = *capacity ? *capacity * 2 : 64;
        draw_item *items = realloc(r->items, wanted * sizeof *items);
        if (!items)
            return NULL;
        r->items = items;
        *capacity = wanted;
    }
    return &r->items[r->item_count++];
}

static void grow_bounds(draw_item *item, const scene_primitive *p, const draw_instance *instance)
{
    for (int corner = 0; corner < 8; corner++)
        for (int row = 0; row < 3; row++) {
            double at = instance->world_from_mesh[3][row];
            for (int c = 0; c < 3; c++)
                at += (double)instance->world_from_mesh[c][row] *
                      (double)(corner >> c & 1 ? p->bounds_max[c] : p->bounds_min[c]);
            item->bounds_min[row] = fmin(item->bounds_min[row], at);
            item->bounds_max[row] = fmax(item->bounds_max[row], at);
        }
}

/* The items of one primitive, for `count` instances from `first` on that all mirror or all do not. */
static bool add_primitive(scene_renderer *r, uint32_t *capacity, const scene_primitive *p, bool colored,
                          const draw_instance *instances, uint32_t first, uint32_t count, bool mirrored)
{
    const scene_material *m = &r->scene->materials[p->material];
    const bool blended = m->alpha == SCENE_ALPHA_BLEND;
    const uint32_t step = blended ? 1 : count;
    for (uint32_t i = 0; i < count; i += step) {
        draw_item *item = add_item(r, capacity);
        if (!item)
            return false;
        *item =
            (draw_item){.first_index = p->first_index,
                        .index_count = p->index_count,
                        .first_instance = first + i,
                        .instance_count = step,
                        .material = p->material,
                        .colored = colored,
                        .blended = blended,
                        .flat = p->flat,
                        .topology = p->topology,
                        .mirrored = mirrored,
                        .variant = choose_variant(r->scene, m, colored) | (p->flat && !m->unlit ? VARIANT_FLAT : 0u),
                        .bounds_min = {INFINITY, INFINITY, INFINITY},
                        .bounds_max = {-INFINITY, -INFINITY, -INFINITY}};
        for (uint32_t k = 0; k < step; k++)
            grow_bounds(item, p, &instances[first + i + k]);
    }
    return true;
}

static bool add_mesh(scene_renderer *r, uint32_t *capacity, const scene_mesh *mesh, draw_instance *instances)
{
    const scene *s = r->scene;
    /* Mirrored instances fill the mesh's range from its end, the others from its start. */
    uint32_t split = mesh->first_instance, end = mesh->first_instance + mesh->instance_count;
    for (uint32_t i = mesh->first_instance; i < mesh->first_instance + mesh->instance_count; i++) {
        const float *world_from_mesh = s->instances[i].world_from_mesh;
        draw_instance instance;
        bool mirrored = draw_normal_matrix(world_from_mesh, instance.normal_world_from_mesh);
        for (int c = 0; c < 4; c++)
            memcpy(instance.world_from_mesh[c], world_from_mesh + 4 * c, sizeof instance.world_from_mesh[c]);
        instances[mirrored ? --end : split++] = instance;
    }
    uint32_t plain_count = split - mesh->first_instance, mirrored_count = mesh->instance_count - plain_count;
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        const scene_primitive *p = &s->primitives[mesh->first_primitive + i];
        if (!p->index_count)
            continue;
        bool colored = !p->white && has_colors(s, p);
        if (!add_primitive(r, capacity, p, colored, instances, mesh->first_instance, plain_count, false) ||
            !add_primitive(r, capacity, p, colored, instances, split, mirrored_count, true))
            return false;
    }
    return true;
}

/* Opaque triangles, opaque lines and points, blended items. */
static int group_of(const draw_item *item)
{
    return item->blended ? 2 : item->topology != SCENE_TRIANGLES;
}

/* A total order, so that every platform draws the same scene in the same order. */
static int compare_items(const void *a, const void *b)
{
    const draw_item *x = a, *y = b;
    if (group_of(x) != group_of(y))
        return group_of(x) - group_of(y);
    if (x->variant != y->variant && !x->blended)
        return x->variant < y->variant ? -1 : 1;
    if (x->material != y->material && !x->blended)
        return x->material - y->material;
    if (x->first_index != y->first_index)
        return x->first_index < y->first_index ? -1 : 1;
    return (x->first_instance > y->first_instance) - (x->first_instance < y->first_instance);
}

bool draw_plan_items(scene_renderer *r, draw_instance *instances)
{
    uint32_t capacity = 0;
    for (uint32_t i = 0; i < r->scene->mesh_count; i++)
        if (!add_mesh(r, &capacity, &r->scene->meshes[i], instances))
            return false;
    if (r->item_count)
        qsort(r->items, r->item_count, sizeof *r->items, compare_items);
    while (r->opaque_count < r->item_count && group_of(&r->items[r->opaque_count]) == 0)
        r->opaque_count++;
    r->first_blended = r->opaque_count;
    while (r->first_blended < r->item_count && !r->items[r->first_blended].blended)
        r->first_blended++;
    r->blended_order = calloc((size_t)(r->item_count - r->first_blended) + 1, sizeof *r->blended_order);
    return r->blended_order != NULL;
}

/* Outside where all eight corners are beyond one plane of the clip volume. The vertex shader's single precision may
 * differ from this by less than the slack. */
bool draw_item_is_seen(const draw_item *item, const double clip_from_world[16])
{
    enum { ALL = 63 };
    const double slack = 1e-4;
    unsigned beyond_all = ALL;
    for (int corner = 0; corner < 8 && beyond_all; corner++) {
        double clip[4], largest = 0;
        for (int row = 0; row < 4; row++) {
            clip[row] = clip_from_world[12 + row];
            largest = fmax(largest, fabs(clip[row]));
            for (int c = 0; c < 3; c++) {
                const double part =
                    clip_from_world[4 * c + row] * (corner >> c & 1 ? item->bounds_max[c] : item->bounds_min[c]);
                clip[row] += part;
                largest = fmax(largest, fabs(part));
            }
        }
        unsigned beyond = 0;
        for (unsigned axis = 0; axis < 3; axis++) {
            /* Comparisons with NaN are false, so an item with invalid bounds is drawn. */
            beyond |= clip[axis] < -clip[3] - slack * largest ? 1u << (2 * axis) : 0u;
            beyond |= clip[axis] > clip[3] + slack * largest ? 2u << (2 * axis) : 0u;
        }
        beyond_all &= beyond;
    }
    return !beyond_all;
}
