/* SPDX-License-Identifier: MIT
 *
 * Materials, textures and samplers: those that something drawn uses, each once.
 */
#include <math.h>
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

static int add_texture(gltf_loader *l, int number)
{
    const gltf_texture *from = &l->document->textures[number];
    const gltf_sampler open = {-1, -1, -1, -1};
    if (l->texture_map[number] >= 0)
        return l->texture_map[number];
    scene_texture texture = translate_sampler(from->sampler < 0 ? &open : &l->document->samplers[from->sampler]);
    texture.image = gltf_add_image(l, from->image);
    if (texture.image < 0)
        return -1;
    return l->texture_map[number] = scene_builder_add_texture(l->builder, &texture);
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

/* Unused where the material names no texture, or one whose image an extension supplies: the factor stands alone. */
static bool translate_map(gltf_loader *l, int material, const gltf_texture_use *from, scene_map *out)
{
    *out = (scene_map){.uv = from->uv_set > 0};
    if (from->texture < 0 || l->document->textures[from->texture].image < 0)
        return true;
    if (!uv_transform(from, out->uv_from_uv))
        return scene_fail(l->fault, "material %d: its texture transform is out of range", material);
    out->texture = add_texture(l, from->texture);
    out->used = out->texture >= 0;
    return out->used;
}

static bool translate_material(gltf_loader *l, int number, scene_material *out)
{
    const gltf_material *from = &l->document->materials[number];
    scene_map base_color;
    if (!translate_map(l, number, &from->base_color_map, &base_color))
        return false;
    for (int i = 0; i < 4; ++i)
        out->base_color[i] = (float)from->base_color[i];
    if (base_color.used) {
        out->base_color_texture = base_color.texture;
        out->base_color_uv = base_color.uv;
        memcpy(out->base_color_uv_from_uv, base_color.uv_from_uv, sizeof base_color.uv_from_uv);
    }
    out->alpha = !strcmp(from->alpha_mode, "MASK")    ? SCENE_ALPHA_MASK
                 : !strcmp(from->alpha_mode, "BLEND") ? SCENE_ALPHA_BLEND
                                                      : SCENE_ALPHA_OPAQUE;
    out->alpha_cutoff = (float)from->alpha_cutoff;
    out->double_sided = from->double_sided;
    out->unlit = from->unlit;
    if (out->unlit) /* nothing else of it is seen */
        return true;
    out->metallic = (float)from->metallic;
    out->roughness = (float)from->roughness;
    out->normal_scale = (float)from->normal_scale;
    out->occlusion_strength = (float)from->occlusion_strength;
    for (int i = 0; i < 3; ++i)
        out->emissive[i] = (float)from->emissive[i];
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
