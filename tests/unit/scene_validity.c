/* SPDX-License-Identifier: MIT
 *
 * The invariants of a scene.
 */
#include "scene_validity.h"

#include <math.h>

static bool all_finite(const float *values, int count)
{
    bool finite = true;
    for (int i = 0; i < count; ++i)
        finite = finite && isfinite(values[i]);
    return finite;
}

static const char *find_vertex_flaw(const scene *s)
{
    for (uint32_t i = 0; i < s->vertex_count; ++i) {
        const scene_vertex *v = &s->vertices[i];
        const double n[3] = {(double)v->normal[0], (double)v->normal[1], (double)v->normal[2]};
        if (!all_finite(v->position, 3) || !all_finite(v->uv[0], 4) || !all_finite(v->color, 4))
            return "a vertex is not finite";
        if (!(fabs(sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) - 1) < 1e-3))
            return "a normal is not of unit length";
    }
    return NULL;
}

static const char *find_primitive_flaw(const scene *s)
{
    for (uint32_t i = 0; i < s->primitive_count; ++i) {
        const scene_primitive *p = &s->primitives[i];
        const uint32_t corners = p->topology == SCENE_TRIANGLES ? 3 : p->topology == SCENE_LINES ? 2 : 1;
        if (p->index_count == 0 || p->index_count % corners || p->first_index > s->index_count ||
            p->index_count > s->index_count - p->first_index)
            return "a primitive's indices are not there";
        if (p->material < 0 || (uint32_t)p->material >= s->material_count)
            return "a primitive's material is not there";
        for (uint32_t k = p->first_index; k < p->first_index + p->index_count; ++k) {
            if (s->indices[k] >= s->vertex_count)
                return "an index is not within the vertices";
            for (int axis = 0; axis < 3; ++axis)
                if (!(s->vertices[s->indices[k]].position[axis] >= p->bounds_min[axis] &&
                      s->vertices[s->indices[k]].position[axis] <= p->bounds_max[axis]))
                    return "a primitive's bounds do not hold it";
        }
    }
    return NULL;
}

static bool is_sound_map(const scene *s, const scene_map *map)
{
    return !map->used || (map->texture >= 0 && map->texture < (int)s->texture_count && map->uv >= 0 &&
                          map->uv < (s->more_uvs ? SCENE_UV_COUNT : 2) && all_finite(map->uv_from_uv, 6));
}

/* Where a normal map is read, each corner has a unit tangent and a sign. */
static const char *find_tangent_flaw(const scene *s)
{
    for (uint32_t i = 0; i < s->primitive_count; ++i) {
        const scene_primitive *p = &s->primitives[i];
        if (!s->materials[p->material].normal_map.used || p->topology != SCENE_TRIANGLES)
            continue;
        if (!s->tangents)
            return "a normal map has no tangents";
        for (uint32_t k = p->first_index; k < p->first_index + p->index_count; ++k) {
            const float *t = s->tangents[s->indices[k]];
            const float length = sqrtf(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
            if (fabsf(t[3]) != 1 || !(length == 0 || fabsf(length - 1) < 1e-4f))
                return "a tangent is not one";
        }
    }
    return NULL;
}

static const char *find_light_flaw(const scene *s)
{
    for (uint32_t i = 0; i < s->light_count; ++i) {
        const scene_light *l = &s->lights[i];
        if (!all_finite(l->color, 3) || !all_finite(l->position_world, 3) || !all_finite(l->direction_world, 3) ||
            !(l->range >= 0))
            return "a light is not finite";
    }
    return NULL;
}

static const char *find_material_flaw(const scene *s)
{
    if (!s->material_count)
        return "no material";
    for (uint32_t i = 0; i < s->material_count; ++i) {
        const scene_material *m = &s->materials[i];
        if (m->base_color_texture < -1 || m->base_color_texture >= (int)s->texture_count)
            return "a material's texture is not there";
        if (m->base_color_uv < 0 || m->base_color_uv > 1)
            return "a material's uv set is not there";
        if (!all_finite(m->base_color, 4) || !all_finite(m->base_color_uv_from_uv, 6) || !isfinite(m->alpha_cutoff))
            return "a material is not finite";
        if (!is_sound_map(s, &m->normal_map) || !is_sound_map(s, &m->metallic_roughness_map) ||
            !is_sound_map(s, &m->occlusion_map) || !is_sound_map(s, &m->emissive_map))
            return "a material's map is not sound";
        if (!all_finite(m->emissive, 3) || !isfinite(m->normal_scale + m->metallic + m->roughness))
            return "a material is not finite";
    }
    for (uint32_t i = 0; i < s->texture_count; ++i)
        if (s->textures[i].image < 0 || (uint32_t)s->textures[i].image >= s->image_count)
            return "a texture's image is not there";
    for (uint32_t i = 0; i < s->image_count; ++i)
        if (s->images[i].width < 1 || s->images[i].height < 1 || !s->images[i].rgba)
            return "an image is empty";
    return NULL;
}

/* Do the corners of a primitive's box lie within the scene's bounds, except for rounding? */
static bool holds(const scene *s, const scene_primitive *p, const float *m)
{
    for (uint32_t i = p->first_index; i < p->first_index + p->index_count; ++i) {
        const float *at = s->vertices[s->indices[i]].position;
        for (int axis = 0; axis < 3; ++axis) {
            const float world = m[axis] * at[0] + m[4 + axis] * at[1] + m[8 + axis] * at[2] + m[12 + axis];
            const float slack = 1e-4f * (1 + fabsf(s->bounds_min[axis]) + fabsf(s->bounds_max[axis]));
            if (!(world >= s->bounds_min[axis] - slack && world <= s->bounds_max[axis] + slack))
                return false;
        }
    }
    return true;
}

static const char *find_instance_flaw(const scene *s)
{
    uint32_t next = 0;
    for (uint32_t m = 0; m < s->mesh_count; ++m) {
        const scene_mesh *mesh = &s->meshes[m];
        if (mesh->first_instance != next && mesh->instance_count)
            return "instances are not sorted by mesh";
        next += mesh->instance_count;
        if (mesh->first_primitive > s->primitive_count ||
            mesh->primitive_count > s->primitive_count - mesh->first_primitive || next > s->instance_count)
            return "a mesh's primitives or instances are not there";
        for (uint32_t i = next - mesh->instance_count; i < next; ++i) {
            const float *matrix = s->instances[i].world_from_mesh;
            if (!all_finite(matrix, 16))
                return "a matrix is not finite";
            if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1)
                return "a matrix is not affine";
            /* Many instances: enough of their corners have been checked. */
            for (uint32_t p = 0; p < mesh->primitive_count && i < next - mesh->instance_count + 50; ++p)
                if (!holds(s, &s->primitives[mesh->first_primitive + p], matrix))
                    return "the scene's bounds do not hold an instance";
        }
    }
    return next == s->instance_count ? NULL : "an instance has no mesh";
}

const char *scene_find_flaw(const scene *s)
{
    const char *flaw = find_vertex_flaw(s);
    flaw = flaw ? flaw : find_primitive_flaw(s);
    flaw = flaw ? flaw : find_material_flaw(s);
    flaw = flaw ? flaw : find_tangent_flaw(s);
    flaw = flaw ? flaw : find_light_flaw(s);
    flaw = flaw ? flaw : find_instance_flaw(s);
    if (!flaw && (!all_finite(s->bounds_min, 3) || !all_finite(s->bounds_max, 3)))
        flaw = "the bounds are not finite";
    if (!flaw && !isfinite(s->origin[0] + s->origin[1] + s->origin[2]))
        flaw = "the origin is not finite";
    for (size_t i = 0; !flaw && i < s->warning_count; ++i)
        if (!*s->warnings[i])
            flaw = "a warning is empty";
    for (uint32_t i = 0; !flaw && i < s->camera_count; ++i)
        if (!all_finite(s->cameras[i].world_from_view, 16))
            flaw = "a camera is not finite";
    return flaw;
}
