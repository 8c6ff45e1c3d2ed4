// SPDX-License-Identifier: MIT
//
// Materials, textures, samplers, cameras and lights, from tinygltf's model.
#include "gltf_model.h"

#include <iterator>

namespace
{

void read_transform(const tinygltf::Value &transform, gltf_texture_use *out)
{
    copy_numbers(transform, "offset", out->offset);
    copy_numbers(transform, "scale", out->scale);
    out->rotation = number_of(transform, "rotation", 0);
    out->uv_set = index_of(transform, "texCoord", out->uv_set);
}

// Of a TextureInfo, and of those for normals and occlusion, which share these members.
template <typename Info> gltf_texture_use read_use(const Info &from)
{
    gltf_texture_use out{};
    out.texture = from.index;
    out.uv_set = from.texCoord;
    out.scale[0] = out.scale[1] = 1;
    if (const tinygltf::Value *transform = find_extension(from.extensions, "KHR_texture_transform"))
        read_transform(*transform, &out);
    return out;
}

// Of a texture that an extension names.
gltf_texture_use read_use(const tinygltf::Value &owner, const char *member)
{
    tinygltf::TextureInfo info;
    if (!owner.Has(member))
        return read_use(info);
    const tinygltf::Value &from = owner.Get(member);
    info.index = index_of(from, "index");
    info.texCoord = index_of(from, "texCoord", 0);
    if (from.Has("extensions"))
        info.extensions = from.Get("extensions").Get<tinygltf::Value::Object>();
    return read_use(info);
}

// The diffuse part of KHR_materials_pbrSpecularGlossiness.
void read_specular_glossiness(const tinygltf::Value &from, gltf_material *out)
{
    copy_numbers(from, "diffuseFactor", out->base_color);
    out->base_color_map = read_use(from, "diffuseTexture");
    out->metallic = 0;
    out->roughness = 1 - number_of(from, "glossinessFactor", 1);
}

gltf_material read_material(const tinygltf::Material &from, gltf_owner *owner)
{
    gltf_material out{};
    const tinygltf::PbrMetallicRoughness &pbr = from.pbrMetallicRoughness;
    copy_numbers(pbr.baseColorFactor, out.base_color);
    copy_numbers(from.emissiveFactor, out.emissive);
    if (const tinygltf::Value *emission = find_extension(from.extensions, "KHR_materials_emissive_strength"))
        for (double &channel : out.emissive)
            channel *= number_of(*emission, "emissiveStrength", 1);
    out.base_color_map = read_use(pbr.baseColorTexture);
    out.metallic_roughness_map = read_use(pbr.metallicRoughnessTexture);
    out.normal_map = read_use(from.normalTexture);
    out.occlusion_map = read_use(from.occlusionTexture);
    out.emissive_map = read_use(from.emissiveTexture);
    out.metallic = pbr.metallicFactor;
    out.roughness = pbr.roughnessFactor;
    out.normal_scale = from.normalTexture.scale;
    out.occlusion_strength = from.occlusionTexture.strength;
    if (const tinygltf::Value *transmission = find_extension(from.extensions, "KHR_materials_transmission"))
        out.transmission = number_of(*transmission, "transmissionFactor", 0);
    out.alpha_mode = owner->keep(from.alphaMode);
    out.alpha_cutoff = from.alphaCutoff;
    out.double_sided = from.doubleSided;
    out.unlit = find_extension(from.extensions, "KHR_materials_unlit") != nullptr;
    // `values` holds the members of pbrMetallicRoughness: the extension counts where it stands alone.
    const tinygltf::Value *glossy = find_extension(from.extensions, "KHR_materials_pbrSpecularGlossiness");
    if (glossy && from.values.empty())
        read_specular_glossiness(*glossy, &out);
    return out;
}

// The image that can be decoded: WebP where this build can, else the one that glTF itself knows.
gltf_texture read_texture(const tinygltf::Texture &from)
{
    gltf_texture out{};
    out.sampler = from.sampler;
    out.image = from.source;
    const tinygltf::Value *webp = find_extension(from.extensions, "EXT_texture_webp");
    if (webp && (GLSSAO_HAS_WEBP || out.image == -1))
        out.image = index_of(*webp, "source");
    static const char *const others[] = {"KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"};
    for (const char *other : others)
        if (const tinygltf::Value *extension = find_extension(from.extensions, other))
            out.image = out.image == -1 ? index_of(*extension, "source") : out.image;
    return out;
}

gltf_camera read_camera(const tinygltf::Camera &from, gltf_owner *owner)
{
    gltf_camera out{};
    out.name = owner->keep(from.name);
    out.orthographic = from.type == "orthographic";
    out.fov_y_rad = from.perspective.yfov;
    out.x_mag = from.orthographic.xmag;
    out.y_mag = from.orthographic.ymag;
    out.near_plane = out.orthographic ? from.orthographic.znear : from.perspective.znear;
    out.far_plane = out.orthographic ? from.orthographic.zfar : from.perspective.zfar;
    return out;
}

gltf_light read_light(const tinygltf::Light &from, gltf_owner *owner)
{
    gltf_light out{};
    std::fill(std::begin(out.color), std::end(out.color), 1.0);
    copy_numbers(from.color, out.color);
    out.type = owner->keep(from.type);
    out.intensity = from.intensity;
    out.range = from.range;
    // tinygltf reads the cone of spot lights only.
    out.inner_cone_rad = from.spot.innerConeAngle;
    out.outer_cone_rad = from.spot.outerConeAngle;
    return out;
}

} // namespace

void gltf_read_surfaces(gltf_owner *owner, const tinygltf::Model &model)
{
    for (const tinygltf::Material &from : model.materials)
        owner->materials.push_back(read_material(from, owner));
    for (const tinygltf::Texture &from : model.textures)
        owner->textures.push_back(read_texture(from));
    for (const tinygltf::Sampler &from : model.samplers)
        owner->samplers.push_back({from.minFilter, from.magFilter, from.wrapS, from.wrapT});
    for (const tinygltf::Camera &from : model.cameras)
        owner->cameras.push_back(read_camera(from, owner));
    for (const tinygltf::Light &from : model.lights)
        owner->lights.push_back(read_light(from, owner));
}
