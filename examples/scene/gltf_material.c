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
static void set_uv_transform(scene_material *m, const gltf_material *from)
{
    const double c = cos(from->uv_rotation), s = sin(from->uv_rotation);
    const double rows[6] = {c * from->uv_scale[0],  s * from->uv_scale[1], from->uv_offset[0],
                            -s * from->uv_scale[0], c * from->uv_scale[1], from->uv_offset[1]};
    for (int i = 0; i < 6; ++i)
        m->base_color_uv_from_uv[i] = (float)rows[i];
}

int gltf_add_material(gltf_loader *l, int number)
{
    int *made = number < 0 ? &l->default_material : &l->material_map[number];
    if (*made >= 0)
        return *made;
    scene_material material = scene_default_material();
    if (number >= 0) {
        const gltf_material *from = &l->document->materials[number];
        for (int i = 0; i < 4; ++i)
            material.base_color[i] = (float)from->base_color[i];
        /* A texture without an image is one whose image an extension supplies; the factor stands alone then. */
        if (from->texture >= 0 && l->document->textures[from->texture].image >= 0) {
            material.base_color_texture = add_texture(l, from->texture);
            if (material.base_color_texture < 0)
                return -1;
            material.base_color_uv = from->uv_set > 0;
            set_uv_transform(&material, from);
        }
        material.alpha = !strcmp(from->alpha_mode, "MASK")    ? SCENE_ALPHA_MASK
                         : !strcmp(from->alpha_mode, "BLEND") ? SCENE_ALPHA_BLEND
                                                              : SCENE_ALPHA_OPAQUE;
        material.alpha_cutoff = (float)from->alpha_cutoff;
        material.double_sided = from->double_sided;
        material.unlit = from->unlit;
    }
    for (int i = 0; i < 6; ++i)
        if (!isfinite(material.base_color_uv_from_uv[i])) {
            scene_fail(l->fault, "material %d: its texture transform is out of range", number);
            return -1;
        }
    return *made = scene_builder_add_material(l->builder, &material);
}
