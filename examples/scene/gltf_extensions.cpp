// SPDX-License-Identifier: MIT
//
// Extensions that a file requires: drawn as they say, drawn in another way with a warning, or refused.
#include "gltf_owner.h"

#include <algorithm>
#include <iterator>

namespace
{

// Drawn as they say, or without influence on a picture.
const char *const known[] = {"EXT_mesh_gpu_instancing",
                             "KHR_lights_punctual",
                             "KHR_materials_emissive_strength",
                             "KHR_materials_unlit",
                             "KHR_materials_variants",
                             "KHR_mesh_quantization",
                             "KHR_node_visibility",
                             "KHR_texture_transform",
                             "EXT_feature_metadata",
                             "EXT_instance_features",
                             "EXT_mesh_features",
                             "EXT_structural_metadata",
                             "KHR_node_hoverability",
                             "KHR_node_selectability",
                             "KHR_xmp_json_ld",
                             "CESIUM_RTC"};

// Drawn with glTF's own description of the surface or the node.
const struct {
    const char *name, *instead;
} approximated[] = {
    {"KHR_materials_pbrSpecularGlossiness", "with its diffuse part"},
    {"KHR_materials_transmission", "as blended glass"},
    {"KHR_animation_pointer", "without what it animates"},
    {"EXT_lights_image_based", "without its light"},
    {"KHR_texture_basisu", "without its textures, which need a decoder for Basis Universal that this program lacks"},
    {"EXT_texture_avif", "without its textures, which need a decoder for AVIF that this program lacks"},
    {"MSFT_texture_dds", "without its textures, which need a decoder for DDS that this program lacks"},
    {"EXT_texture_webp", "without its textures: this program was built without libwebp (Debian: libwebp-dev)"},
};

// Those that need a library, which may not have been there when this was built.
const struct {
    const char *name;
    bool built;
    const char *package;
} packed[] = {{"KHR_draco_mesh_compression", GLSSAO_HAS_DRACO, "Draco (Debian: libdraco-dev)"},
              {"EXT_meshopt_compression", GLSSAO_HAS_MESHOPT, "meshoptimizer (Debian: libmeshoptimizer-dev)"},
              {"KHR_meshopt_compression", GLSSAO_HAS_MESHOPT, "meshoptimizer (Debian: libmeshoptimizer-dev)"}};

void check_extension(gltf_source *source, const std::string &name)
{
    for (const auto &extension : packed)
        if (name == extension.name) {
            if (!extension.built)
                throw gltf_json_error("it requires " + name + ": this program was built without " + extension.package);
            return;
        }
    if (std::find(std::begin(known), std::end(known), name) != std::end(known) ||
        (GLSSAO_HAS_WEBP && name == "EXT_texture_webp"))
        return;
    for (const auto &extension : approximated)
        if (name == extension.name) {
            warn(source, "it requires " + name + ", and is drawn " + extension.instead);
            return;
        }
    for (const char *prefix : {"KHR_materials_", "EXT_materials_"})
        if (name.rfind(prefix, 0) == 0) {
            warn(source, "it requires " + name + ", and is drawn with the core material");
            return;
        }
    throw gltf_json_error("the extension " + name.substr(0, 80) + " is required but not supported");
}

} // namespace

void gltf_check_extensions(gltf_source *source, const gltf_object &root)
{
    for (const json &name : root.list("extensionsRequired")) {
        if (!name.is_string())
            root.fail("extensionsRequired holds something other than names");
        check_extension(source, name.get<std::string>());
    }
}
