/* SPDX-License-Identifier: MIT
 *
 * Materials, textures and samplers: those that something drawn uses, each once.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

enum { NEAREST = 9728, NEAREST_MIPMAP_NEAREST = 9984, LINEAR_MIPMAP_LINEAR = 9987, NEAREST_MIPMAP_LINEAR = 9986 };
enum { MIRRORED_REPEAT = 33648, CLAMP_TO_EDGE = 33071 };

static scene_wrap wrap_of(int number)
{
    return number == MIRRORED_REPEAT ? SCENE_WRAP_MIRROR
           : number == CLAMP_TO_EDGE ? SCENE_WRAP_CLAMP
                                     : SCENE_WRAP_REPEAT;
}

/* Filters that the file leaves open are linear, with mipmaps. */
static scene_texture translate_sampler(const gltf_sampler *s)
{
    const bool min_given = s->min_filter >= 0;
    return (scene_texture){
        .wrap_u = wrap_of(s->wrap_s),
        .wrap_v = wrap_of(s->wrap_t),
        .min_nearest = s->min_filter == NEAREST || s->min_filter == NEAREST_MIPMAP_NEAREST ||
                       s->min_filter == NEAREST_MIPMAP_LINEAR,
        .mag_nearest = s->mag_filter == NEAREST,
        .mipmaps = !min_given || (s->min_filter >= NEAREST_MIPMAP_NEAREST && s->min_filter <= LINEAR_MIPMAP_LINEAR)};
}

/* -1 in `out_texture` where its image is left out. */
static bool add_texture(gltf_loader *l, int number, int *out_texture)
{
    const gltf_texture *from = &l->document->textures[number];
    const gltf_sampler open = {-1, -1, -1, -1};
    *out_texture = l->texture_map[number];
    if (*out_texture >= 0)
        return true;
    scene_texture texture = translate_sampler(from->sampler < 0 ? &open : &l->document->samplers[from->sampler]);
    if (!gltf_add_image(l, from->image, &texture.image))
        return false;
    if (texture.image < 0)
        return true;
    *out_texture = l->texture_map[number] = scene_builder_add_texture(l->builder, &texture);
    return *out_texture >= 0;
}

/* KHR_texture_transform: scaled, then turned, then moved. With v downwards a turn counter-clockwise, as it is seen on
 * the image, has the sine's sign of a clockwise one in other spaces: what the extension's test model and its
 * implementations agree on, against the listing in its text (KhronosGroup/glTF issue 1563). */
static bool uv_transform(const gltf_texture_use *from, float out[6])
{
    const double c = cos(from->rotation), s = sin(from->rotation);
    const double rows[6] = {c * from->scale[0],  s * from->scale[1], from->offset[0],
                            -s * from->scale[0], c * from->scale[1], from->offset[1]};
    bool finite = true;
    for (int i = 0; i < 6; ++i) {
        out[i] = (float)rows[i];
        finite = finite && isfinite(out[i]);
    }
    return finite;
}

/* The vertex's slot for a uv set of the material; sets past the fourth share the last slot, with a warning. */
static int find_slot(const gltf_uv_slots *slots, int uv_set)
{
    int slot = 0;
    while (slot + 1 < slots->count && slots->sets[slot] != uv_set)
        ++slot;
    return slot;
}

gltf_uv_slots gltf_find_uv_slots(const gltf_material *m)
{
    const gltf_texture_use *const maps[] = {&m->base_color_map, &m->normal_map, &m->metallic_roughness_map,
                                            &m->occlusion_map, &m->emissive_map};
    gltf_uv_slots slots = {.count = 0};
    for (size_t i = 0; i < sizeof maps / sizeof *maps; ++i) {
        bool known = maps[i]->texture < 0;
        for (int k = 0; k < slots.count; ++k)
            known = known || slots.sets[k] == maps[i]->uv_set;
        if (!known && slots.count < SCENE_UV_COUNT)
            slots.sets[slots.count++] = maps[i]->uv_set;
    }
    return slots;
}

/* Unused where the material names no texture, or one whose image is left out: the factor stands alone. */
static bool translate_map(gltf_loader *l, int material, const gltf_texture_use *from, scene_map *out)
{
    *out = (scene_map){.uv = 0};
    if (from->texture < 0 || l->document->textures[from->texture].image < 0)
        return true;
    const gltf_uv_slots slots = gltf_find_uv_slots(&l->document->materials[material]);
    out->uv = find_slot(&slots, from->uv_set);
    if (slots.sets[out->uv] != from->uv_set &&
        !scene_warn(l->document->warnings, l->fault, "material %d uses more than %d uv sets; set %d is left out",
                    material, SCENE_UV_COUNT, from->uv_set))
        return false;
    if (!uv_transform(from, out->uv_from_uv))
        return fault_set(l->fault, "material %d: its texture transform is out of range", material);
    if (!add_texture(l, from->texture, &out->texture))
        return false;
    out->used = out->texture >= 0;
    return true;
}

static float share(double value)
{
    return (float)fmin(fmax(value, 0), 1);
}

/* KHR_materials_transmission as blending: a transmitting surface keeps a fifth of its alpha, so that clear glass is
 * still seen. Blended surfaces get no occlusion, and hide nothing from rays. */
static void blend_glass(double transmission, scene_material *out)
{
    if (!(transmission > 0))
        return;
    out->alpha = SCENE_ALPHA_BLEND;
    out->base_color[3] *= 1 - 0.8f * share(transmission);
}

static bool translate_material(gltf_loader *l, int number, scene_material *out)
{
    const gltf_material *from = &l->document->materials[number];
    scene_map base_color;
    if (!translate_map(l, number, &from->base_color_map, &base_color))
        return false;
    for (int i = 0; i < 4; ++i)
        out->base_color[i] = share(from->base_color[i]);
    if (base_color.used) {
        out->base_color_texture = base_color.texture;
        out->base_color_uv = base_color.uv;
        memcpy(out->base_color_uv_from_uv, base_color.uv_from_uv, sizeof base_color.uv_from_uv);
    }
    out->alpha = !strcmp(from->alpha_mode, "MASK")    ? SCENE_ALPHA_MASK
                 : !strcmp(from->alpha_mode, "BLEND") ? SCENE_ALPHA_BLEND
                                                      : SCENE_ALPHA_OPAQUE;
    blend_glass(from->transmission, out);
    out->alpha_cutoff = (float)fmax(from->alpha_cutoff, 0);
    out->double_sided = from->double_sided;
    out->unlit = from->unlit;
    if (out->unlit) /* no other property shows */
        return true;
    out->metallic = share(from->metallic);
    out->roughness = share(from->roughness);
    out->normal_scale = (float)from->normal_scale;
    out->occlusion_strength = share(from->occlusion_strength);
    for (int i = 0; i < 3; ++i)
        out->emissive[i] = (float)fmax(from->emissive[i], 0);
    const bool glows = out->emissive[0] > 0 || out->emissive[1] > 0 || out->emissive[2] > 0;
    const gltf_texture_use none = {.texture = -1};
    return translate_map(l, number, &from->metallic_roughness_map, &out->metallic_roughness_map) &&
           translate_map(l, number, &from->normal_map, &out->normal_map) &&
           translate_map(l, number, &from->occlusion_map, &out->occlusion_map) &&
           translate_map(l, number, glows ? &from->emissive_map : &none, &out->emissive_map);
}

int gltf_add_material(gltf_loader *l, int number)
{
    int *made = number < 0 ? &l->default_material : &l->material_map[number];
    if (*made >= 0)
        return *made;
    scene_material material = scene_default_material();
    material.metallic_roughness = true;
    if (number >= 0 && !translate_material(l, number, &material))
        return -1;
    return *made = scene_builder_add_material(l->builder, &material);
}

/* A variation of a material, made once; `map` (may be NULL yet) holds the scene's index + 1 for each of its materials.
 */
static int add_variation(gltf_loader *l, int material, int **map, size_t *room, scene_material changed)
{
    const size_t needed = (size_t)material + 1;
    if (needed > *room) {
        int *grown = realloc(*map, 2 * needed * sizeof *grown);
        if (!grown) {
            fault_set_memory(l->fault);
            return -1;
        }
        memset(grown + *room, 0, (2 * needed - *room) * sizeof *grown);
        *map = grown;
        *room = 2 * needed;
    }
    if (!(*map)[material])
        (*map)[material] = scene_builder_add_material(l->builder, &changed) + 1;
    return (*map)[material] - 1;
}

int gltf_add_unlit(gltf_loader *l, int material)
{
    scene_material unlit = l->builder->made->materials[material];
    unlit.unlit = true;
    unlit.double_sided = true;
    unlit.normal_map.used = false;
    return add_variation(l, material, &l->unlit_map, &l->unlit_room, unlit);
}

int gltf_add_opaque(gltf_loader *l, int material)
{
    const scene *s = l->builder->made;
    scene_material opaque = s->materials[material];
    const float full = 254.5f / 255; /* eight bits round it to 1 */
    const int texture = opaque.base_color_texture;
    if (opaque.alpha != SCENE_ALPHA_BLEND || opaque.base_color[3] < full ||
        (texture >= 0 && !s->images[s->textures[texture].image].opaque))
        return material;
    opaque.alpha = SCENE_ALPHA_OPAQUE;
    return add_variation(l, material, &l->opaque_map, &l->opaque_room, opaque);
}
