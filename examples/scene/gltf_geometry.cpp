// SPDX-License-Identifier: MIT
//
// Buffer views, accessors, meshes, nodes, skins, scenes and animations, from tinygltf's model. tinygltf::Value stands
// for extensions.
#include "gltf_model.h"

namespace
{

gltf_accessor read_accessor(const tinygltf::Accessor &from)
{
    gltf_accessor out{};
    out.buffer_view = from.bufferView;
    out.offset = from.byteOffset;
    out.count = from.count;
    out.component_type = from.componentType;
    out.normalized = from.normalized;
    out.columns = 1;
    switch (from.type) {
    case TINYGLTF_TYPE_SCALAR:
        out.rows = 1;
        break;
    case TINYGLTF_TYPE_MAT2:
    case TINYGLTF_TYPE_MAT3:
    case TINYGLTF_TYPE_MAT4:
        out.rows = out.columns = from.type - TINYGLTF_TYPE_MAT2 + 2;
        break;
    default:
        out.rows = from.type - TINYGLTF_TYPE_VEC2 + 2;
        break;
    }
    if (from.sparse.isSparse) {
        const auto count = static_cast<int64_t>(from.sparse.count);
        out.sparse.count = count ? count : -1; // 0 is not allowed, and stands for "not sparse" here
        out.sparse.index_view = from.sparse.indices.bufferView;
        out.sparse.index_type = from.sparse.indices.componentType;
        out.sparse.index_offset = static_cast<int64_t>(from.sparse.indices.byteOffset);
        out.sparse.value_view = from.sparse.values.bufferView;
        out.sparse.value_offset = static_cast<int64_t>(from.sparse.values.byteOffset);
    }
    return out;
}

gltf_attribute_list read_attributes(const std::map<std::string, int> &from, gltf_owner *owner)
{
    owner->attributes.emplace_back();
    auto &list = owner->attributes.back();
    for (const auto &[name, accessor] : from)
        list.push_back({owner->keep(name), accessor});
    return {list.data(), list.size()};
}

// The material that a variant gives the primitive, else its own.
int read_material(const tinygltf::Primitive &primitive, int variant)
{
    const tinygltf::Value *extension = find_extension(primitive.extensions, "KHR_materials_variants");
    if (variant >= 0 && extension)
        for (const tinygltf::Value &mapping : list_of(*extension, "mappings"))
            for (const tinygltf::Value &number : list_of(mapping, "variants"))
                if (number.GetNumberAsInt() == variant)
                    return index_of(mapping, "material");
    return primitive.material;
}

gltf_weights read_weights(const std::vector<double> &from, gltf_owner *owner)
{
    owner->numbers.push_back(from);
    return {owner->numbers.back().data(), from.size()};
}

gltf_mesh read_mesh(const tinygltf::Mesh &from, const gltf_object &file_mesh, gltf_owner *owner, int variant)
{
    owner->primitives.emplace_back();
    auto &primitives = owner->primitives.back();
    const json &file_primitives = file_mesh.list("primitives");
    for (size_t i = 0; i < from.primitives.size(); ++i) {
        const tinygltf::Primitive &primitive = from.primitives[i];
        gltf_primitive out{};
        out.attributes = read_attributes(primitive.attributes, owner);
        owner->targets.emplace_back();
        auto &targets = owner->targets.back();
        for (const auto &target : primitive.targets)
            targets.push_back(read_attributes(target, owner));
        out.targets = targets.data();
        out.target_count = targets.size();
        out.indices = gltf_object(file_primitives[i], file_mesh.name()).index("indices");
        out.material = read_material(primitive, variant);
        out.mode = primitive.mode;
        primitives.push_back(out);
    }
    gltf_mesh out{};
    out.primitives = primitives.data();
    out.primitive_count = primitives.size();
    out.weights = read_weights(from.weights, owner);
    return out;
}

void read_indices(const std::vector<int> &from, gltf_owner *owner, const int **out, size_t *out_count)
{
    owner->indices.push_back(from);
    *out = owner->indices.back().data();
    *out_count = from.size();
}

void read_node_extensions(const tinygltf::ExtensionMap &from, gltf_node *out)
{
    const tinygltf::Value none;
    const tinygltf::Value *light = find_extension(from, "KHR_lights_punctual");
    const tinygltf::Value *visibility = find_extension(from, "KHR_node_visibility");
    const tinygltf::Value *instancing = find_extension(from, "EXT_mesh_gpu_instancing");
    out->light = light ? index_of(*light, "light") : -1;
    out->hidden = visibility && visibility->Has("visible") && !visibility->Get("visible").Get<bool>();
    const bool instanced = instancing && instancing->Has("attributes");
    const tinygltf::Value &attributes = instanced ? instancing->Get("attributes") : none;
    out->instance_translation = index_of(attributes, "TRANSLATION");
    out->instance_rotation = index_of(attributes, "ROTATION");
    out->instance_scale = index_of(attributes, "SCALE");
    out->instanced = out->instance_translation != -1 || out->instance_rotation != -1 || out->instance_scale != -1;
}

gltf_node read_node(const tinygltf::Node &from, gltf_owner *owner)
{
    gltf_node out{};
    out.mesh = from.mesh;
    out.skin = from.skin;
    out.camera = from.camera;
    read_indices(from.children, owner, &out.children, &out.child_count);
    out.weights = read_weights(from.weights, owner);
    out.has_matrix = !from.matrix.empty();
    out.rotation[3] = out.scale[0] = out.scale[1] = out.scale[2] = 1;
    copy_numbers(from.matrix, out.matrix);
    copy_numbers(from.translation, out.translation);
    copy_numbers(from.rotation, out.rotation);
    copy_numbers(from.scale, out.scale);
    read_node_extensions(from.extensions, &out);
    return out;
}

} // namespace

void gltf_read_geometry(gltf_owner *owner, const tinygltf::Model &model, const gltf_object &root, int variant)
{
    const json &file_views = root.list("bufferViews"), &file_meshes = root.list("meshes");
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        const tinygltf::BufferView &from = model.bufferViews[i];
        const size_t stride = gltf_object(file_views[i], "buffer view " + std::to_string(i)).size("byteStride", 0);
        owner->buffer_views.push_back({from.buffer, from.byteOffset, from.byteLength, stride});
    }
    for (const tinygltf::Accessor &from : model.accessors)
        owner->accessors.push_back(read_accessor(from));
    for (size_t i = 0; i < model.meshes.size(); ++i)
        owner->meshes.push_back(
            read_mesh(model.meshes[i], {file_meshes[i], "mesh " + std::to_string(i)}, owner, variant));
    for (const tinygltf::Node &from : model.nodes)
        owner->nodes.push_back(read_node(from, owner));
    for (const tinygltf::Skin &from : model.skins) {
        gltf_skin out{};
        read_indices(from.joints, owner, &out.joints, &out.joint_count);
        out.inverse_bind_matrices = from.inverseBindMatrices;
        owner->skins.push_back(out);
    }
    for (const tinygltf::Scene &from : model.scenes) {
        gltf_scene out{};
        read_indices(from.nodes, owner, &out.nodes, &out.node_count);
        owner->scenes.push_back(out);
    }
}

void gltf_read_animation(gltf_owner *owner, const tinygltf::Animation &from)
{
    for (const tinygltf::AnimationSampler &sampler : from.samplers)
        owner->animation_samplers.push_back({sampler.input, sampler.output, owner->keep(sampler.interpolation)});
    for (const tinygltf::AnimationChannel &channel : from.channels)
        owner->animation_channels.push_back({channel.sampler, channel.target_node, owner->keep(channel.target_path)});
}
