// SPDX-License-Identifier: MIT
//
// Materials, textures, samplers, cameras and lights.
#include "gltf_owner.h"

#include <algorithm>
#include <iterator>

namespace
{

gltf_texture_use read_use(const gltf_object &owner, const char *member)
{
    gltf_texture_use out{};
    const gltf_object from = owner.object(member);
    out.texture = from.index("index");
    out.uv_set = from.find("texCoord") ? from.index("texCoord") : 0;
    out.scale[0] = out.scale[1] = 1;
    if (from.uses("KHR_texture_transform")) {
        const gltf_object transform = from.extension("KHR_texture_transform");
        transform.numbers("offset", out.offset);
        transform.numbers("scale", out.scale);
        out.rotation = transform.number("rotation", 0);
        out.uv_set = transform.find("texCoord") ? transform.index("texCoord") : out.uv_set;
    }
    return out;
}

// The diffuse part of KHR_materials_pbrSpecularGlossiness, where it stands alone.
void read_specular_glossiness(const gltf_object &from, gltf_material *out)
{
    const gltf_object extension = from.extension("KHR_materials_pbrSpecularGlossiness");
    extension.numbers("diffuseFactor", out->base_color);
    out->base_color_map = read_use(extension, "diffuseTexture");
    out->metallic = 0;
    out->roughness = 1 - extension.number("glossinessFactor", 1);
}

gltf_material read_material(const gltf_object &from, gltf_owner *owner)
{
    gltf_material out{};
    const gltf_object pbr = from.object("pbrMetallicRoughness");
    std::fill(std::begin(out.base_color), std::end(out.base_color), 1.0);
    pbr.numbers("baseColorFactor", out.base_color);
    from.numbers("emissiveFactor", out.emissive);
    const double strength = from.extension("KHR_materials_emissive_strength").number("emissiveStrength", 1);
    for (double &channel : out.emissive)
        channel *= strength;
    out.base_color_map = read_use(pbr, "baseColorTexture");
    out.metallic_roughness_map = read_use(pbr, "metallicRoughnessTexture");
    out.normal_map = read_use(from, "normalTexture");
    out.occlusion_map = read_use(from, "occlusionTexture");
    out.emissive_map = read_use(from, "emissiveTexture");
    out.metallic = pbr.number("metallicFactor", 1);
    out.roughness = pbr.number("roughnessFactor", 1);
    out.normal_scale = from.object("normalTexture").number("scale", 1);
    out.occlusion_strength = from.object("occlusionTexture").number("strength", 1);
    out.transmission = from.extension("KHR_materials_transmission").number("transmissionFactor", 0);
    out.alpha_mode = owner->keep(from.text("alphaMode", "OPAQUE"));
    out.alpha_cutoff = from.number("alphaCutoff", 0.5);
    out.double_sided = from.flag("doubleSided");
    out.unlit = from.uses("KHR_materials_unlit");
    if (!from.find("pbrMetallicRoughness") && from.uses("KHR_materials_pbrSpecularGlossiness"))
        read_specular_glossiness(from, &out);
    return out;
}

// The image that can be decoded: WebP where this build can, else the one that glTF itself knows.
gltf_texture read_texture(const gltf_object &from)
{
    gltf_texture out{};
    out.sampler = from.index("sampler");
    out.image = from.index("source");
    if (from.uses("EXT_texture_webp") && (GLSSAO_HAS_WEBP || out.image == -1))
        out.image = from.extension("EXT_texture_webp").index("source");
    static const char *const others[] = {"KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"};
    for (const char *other : others)
        if (out.image == -1 && from.uses(other))
            out.image = from.extension(other).index("source");
    return out;
}

gltf_sampler read_sampler(const gltf_object &from)
{
    const int repeat = 10497;
    gltf_sampler out{};
    out.min_filter = from.index("minFilter");
    out.mag_filter = from.index("magFilter");
    out.wrap_s = from.find("wrapS") ? from.index("wrapS") : repeat;
    out.wrap_t = from.find("wrapT") ? from.index("wrapT") : repeat;
    return out;
}

gltf_camera read_camera(const gltf_object &from, gltf_owner *owner)
{
    gltf_camera out{};
    out.name = owner->keep(from.text("name", ""));
    out.orthographic = from.text("type", "") == "orthographic";
    const gltf_object lens = from.object(out.orthographic ? "orthographic" : "perspective");
    out.fov_y_rad = lens.number("yfov", 0);
    out.x_mag = lens.number("xmag", 0);
    out.y_mag = lens.number("ymag", 0);
    out.near_plane = lens.number("znear", 0);
    out.far_plane = lens.number("zfar", 0);
    return out;
}

gltf_light read_light(const gltf_object &from, gltf_owner *owner)
{
    gltf_light out{};
    const gltf_object spot = from.object("spot");
    std::fill(std::begin(out.color), std::end(out.color), 1.0);
    from.numbers("color", out.color);
    out.type = owner->keep(from.text("type", ""));
    out.intensity = from.number("intensity", 1);
    out.range = from.number("range", 0);
    out.inner_cone_rad = spot.number("innerConeAngle", 0);
    out.outer_cone_rad = spot.number("outerConeAngle", 0.7853981633974483);
    return out;
}

template <typename T, typename Read> void read_list(const json &list, const char *name, std::vector<T> *out, Read read)
{
    for (size_t i = 0; i < list.size(); ++i)
        out->push_back(read(gltf_object(list[i], std::string(name) + " " + std::to_string(i))));
}

} // namespace

void gltf_read_surfaces(gltf_owner *owner, const gltf_object &root)
{
    read_list(root.list("materials"), "material", &owner->materials,
              [&](const gltf_object &from) { return read_material(from, owner); });
    read_list(root.list("textures"), "texture", &owner->textures, read_texture);
    read_list(root.list("samplers"), "sampler", &owner->samplers, read_sampler);
}

void gltf_read_views(gltf_owner *owner, const gltf_object &root)
{
    read_list(root.list("cameras"), "camera", &owner->cameras,
              [&](const gltf_object &from) { return read_camera(from, owner); });
    read_list(root.extension("KHR_lights_punctual").list("lights"), "light", &owner->lights,
              [&](const gltf_object &from) { return read_light(from, owner); });
}
