// SPDX-License-Identifier: MIT
//
// Materials, images, cameras and lights, from tinygltf's model to gltf_document.h.
#include "gltf_translate.h"

namespace
{

// Of a TextureInfo, and of those for normals and occlusion, which share its members.
template <typename Info> gltf_texture_use translate_use(const Info &from)
{
    gltf_texture_use out{};
    out.texture = from.index;
    out.uv_set = from.texCoord;
    out.scale[0] = out.scale[1] = 1;
    if (const tinygltf::Value *transform = find_extension(from.extensions, "KHR_texture_transform")) {
        copy_member(*transform, "offset", out.offset);
        copy_member(*transform, "scale", out.scale);
        if (transform->Has("rotation"))
            out.rotation = transform->Get("rotation").GetNumberAsDouble();
        out.uv_set = index_member(*transform, "texCoord", out.uv_set);
    }
    return out;
}

} // namespace

bool gltf_translate(const tinygltf::Material &from, size_t number, gltf_material *out, scene_fault *fault)
{
    const tinygltf::PbrMetallicRoughness &pbr = from.pbrMetallicRoughness;
    std::fill(out->base_color, out->base_color + 4, 1.0);
    if (!copy_numbers(pbr.baseColorFactor, out->base_color))
        return scene_fail(fault, "material %zu: its baseColorFactor does not have four numbers", number);
    if (!copy_numbers(from.emissiveFactor, out->emissive))
        return scene_fail(fault, "material %zu: its emissiveFactor does not have three numbers", number);
    if (const tinygltf::Value *emission = find_extension(from.extensions, "KHR_materials_emissive_strength"))
        for (double &channel : out->emissive)
            channel *= emission->Has("emissiveStrength") ? emission->Get("emissiveStrength").GetNumberAsDouble() : 1;
    out->base_color_map = translate_use(pbr.baseColorTexture);
    out->metallic_roughness_map = translate_use(pbr.metallicRoughnessTexture);
    out->normal_map = translate_use(from.normalTexture);
    out->occlusion_map = translate_use(from.occlusionTexture);
    out->emissive_map = translate_use(from.emissiveTexture);
    out->metallic = pbr.metallicFactor;
    out->roughness = pbr.roughnessFactor;
    out->normal_scale = from.normalTexture.scale;
    out->occlusion_strength = from.occlusionTexture.strength;
    out->alpha_mode = from.alphaMode.c_str();
    out->alpha_cutoff = from.alphaCutoff;
    out->double_sided = from.doubleSided;
    out->unlit = find_extension(from.extensions, "KHR_materials_unlit") != nullptr;
    return true;
}

gltf_image gltf_translate(const tinygltf::Image &from)
{
    gltf_image out{};
    // A data URI with a type that tinygltf does not know ends up here as if it were a file's name.
    const bool has_file_name = !from.uri.empty() && from.uri.compare(0, 5, "data:") != 0;
    out.name = has_file_name ? from.uri.c_str() : from.name.c_str();
    out.buffer_view = from.bufferView;
    out.encoded = from.image.empty() ? nullptr : from.image.data();
    out.encoded_size = from.image.size();
    return out;
}

gltf_camera gltf_translate(const tinygltf::Camera &from)
{
    gltf_camera out{};
    out.name = from.name.c_str();
    out.orthographic = from.type == "orthographic";
    out.fov_y_rad = from.perspective.yfov;
    out.x_mag = from.orthographic.xmag;
    out.y_mag = from.orthographic.ymag;
    out.near_plane = out.orthographic ? from.orthographic.znear : from.perspective.znear;
    out.far_plane = out.orthographic ? from.orthographic.zfar : from.perspective.zfar;
    return out;
}

bool gltf_translate(const tinygltf::Light &from, size_t number, gltf_light *out, scene_fault *fault)
{
    std::fill(out->color, out->color + 3, 1.0);
    out->type = from.type.c_str();
    out->intensity = from.intensity;
    out->range = from.range;
    out->inner_cone_rad = from.spot.innerConeAngle;
    out->outer_cone_rad = from.spot.outerConeAngle;
    return copy_numbers(from.color, out->color) ||
           scene_fail(fault, "light %zu: its color does not have three numbers", number);
}
