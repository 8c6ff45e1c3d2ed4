// SPDX-License-Identifier: MIT
//
// Translates tinygltf's model into the plain C of gltf_document.h; surfaces are gltf_surfaces.cpp's. No exception leaves
// this file.
#include "gltf_document.h"

#include "gltf_file.h"
#include "gltf_parse.h"
#include "gltf_translate.h"

#include <cstdlib>
#include <deque>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace
{

// What a document's pointers lead into.
struct document_owner {
    tinygltf::Model model;
    std::vector<gltf_buffer> buffers;
    std::vector<gltf_buffer_view> buffer_views;
    std::vector<gltf_accessor> accessors;
    std::vector<gltf_mesh> meshes;
    std::vector<gltf_node> nodes;
    std::vector<gltf_skin> skins;
    std::vector<gltf_material> materials;
    std::vector<gltf_texture> textures;
    std::vector<gltf_sampler> samplers;
    std::vector<gltf_image> images;
    std::vector<gltf_camera> cameras;
    std::vector<gltf_light> lights;
    std::vector<gltf_scene> scenes;
    std::vector<gltf_animation_sampler> animation_samplers;
    std::vector<gltf_animation_channel> animation_channels;
    // A deque does not move its elements when it grows.
    std::deque<std::vector<gltf_attribute>> attributes;
    std::deque<std::vector<gltf_attribute_list>> targets;
    std::deque<std::vector<gltf_primitive>> primitives;
};

gltf_accessor translate(const tinygltf::Accessor &from)
{
    gltf_accessor out{};
    out.buffer_view = from.bufferView;
    out.offset = from.byteOffset;
    out.count = from.count;
    out.component_type = from.componentType;
    out.normalized = from.normalized;
    switch (from.type) {
    case TINYGLTF_TYPE_SCALAR:
        out.rows = out.columns = 1;
        break;
    case TINYGLTF_TYPE_VEC2:
    case TINYGLTF_TYPE_VEC3:
    case TINYGLTF_TYPE_VEC4:
        out.rows = from.type - TINYGLTF_TYPE_VEC2 + 2;
        out.columns = 1;
        break;
    default:
        out.rows = out.columns = from.type - TINYGLTF_TYPE_MAT2 + 2;
        break;
    }
    if (from.sparse.isSparse) {
        // A sparse count of 0 is not allowed, and 0 stands for "not sparse" here.
        const auto count = static_cast<int64_t>(from.sparse.count);
        out.sparse.count = count ? count : -1;
        out.sparse.index_view = from.sparse.indices.bufferView;
        out.sparse.index_type = from.sparse.indices.componentType;
        out.sparse.index_offset = static_cast<int64_t>(from.sparse.indices.byteOffset);
        out.sparse.value_view = from.sparse.values.bufferView;
        out.sparse.value_offset = static_cast<int64_t>(from.sparse.values.byteOffset);
    }
    return out;
}

gltf_attribute_list translate(const std::map<std::string, int> &from, document_owner *owner)
{
    owner->attributes.emplace_back();
    for (const auto &[name, accessor] : from)
        owner->attributes.back().push_back({name.c_str(), accessor});
    gltf_attribute_list out{};
    point_to(owner->attributes.back(), &out.items, &out.count);
    return out;
}

gltf_mesh translate(const tinygltf::Mesh &from, document_owner *owner)
{
    owner->primitives.emplace_back();
    for (const tinygltf::Primitive &primitive : from.primitives) {
        gltf_primitive out{};
        out.attributes = translate(primitive.attributes, owner);
        owner->targets.emplace_back();
        for (const auto &target : primitive.targets)
            owner->targets.back().push_back(translate(target, owner));
        point_to(owner->targets.back(), &out.targets, &out.target_count);
        out.indices = primitive.indices;
        out.material = primitive.material;
        out.mode = primitive.mode < 0 ? GLTF_TRIANGLES : primitive.mode;
        owner->primitives.back().push_back(out);
    }
    gltf_mesh out{};
    point_to(owner->primitives.back(), &out.primitives, &out.primitive_count);
    point_to(from.weights, &out.weights.values, &out.weights.count);
    return out;
}

bool translate(const tinygltf::Node &from, size_t number, gltf_node *out, scene_fault *fault)
{
    out->mesh = from.mesh;
    out->skin = from.skin;
    out->camera = from.camera;
    out->light = -1;
    if (const tinygltf::Value *light = find_extension(from.extensions, "KHR_lights_punctual"))
        out->light = index_member(*light, "light", -1);
    point_to(from.children, &out->children, &out->child_count);
    point_to(from.weights, &out->weights.values, &out->weights.count);
    out->has_matrix = !from.matrix.empty();
    out->rotation[3] = out->scale[0] = out->scale[1] = out->scale[2] = 1;
    if (!copy_numbers(from.matrix, out->matrix) || !copy_numbers(from.translation, out->translation) ||
        !copy_numbers(from.rotation, out->rotation) || !copy_numbers(from.scale, out->scale))
        return scene_fail(fault, "node %zu: its transform has too few or too many numbers", number);
    out->instance_translation = out->instance_rotation = out->instance_scale = -1;
    const tinygltf::Value *instancing = find_extension(from.extensions, "EXT_mesh_gpu_instancing");
    if (instancing && instancing->Has("attributes") && instancing->Get("attributes").IsObject()) {
        const tinygltf::Value &attributes = instancing->Get("attributes");
        out->instance_translation = index_member(attributes, "TRANSLATION", -1);
        out->instance_rotation = index_member(attributes, "ROTATION", -1);
        out->instance_scale = index_member(attributes, "SCALE", -1);
        out->instanced = out->instance_translation != -1 || out->instance_rotation != -1 || out->instance_scale != -1;
    }
    return true;
}

void translate(const tinygltf::Animation &from, document_owner *owner, gltf_document *out)
{
    for (const tinygltf::AnimationSampler &sampler : from.samplers)
        owner->animation_samplers.push_back({sampler.input, sampler.output, sampler.interpolation.c_str()});
    for (const tinygltf::AnimationChannel &channel : from.channels)
        owner->animation_channels.push_back({channel.sampler, channel.target_node, channel.target_path.c_str()});
    point_to(owner->animation_samplers, &out->animation_samplers, &out->animation_sampler_count);
    point_to(owner->animation_channels, &out->animation_channels, &out->animation_channel_count);
}

bool translate_all(document_owner *owner, gltf_document *out, scene_fault *fault)
{
    const tinygltf::Model &model = owner->model;
    for (const tinygltf::Buffer &buffer : model.buffers)
        owner->buffers.push_back({buffer.data.data(), buffer.data.size()});
    for (const tinygltf::BufferView &view : model.bufferViews)
        owner->buffer_views.push_back({view.buffer, view.byteOffset, view.byteLength, view.byteStride});
    for (const tinygltf::Accessor &accessor : model.accessors)
        owner->accessors.push_back(translate(accessor));
    for (const tinygltf::Mesh &mesh : model.meshes)
        owner->meshes.push_back(translate(mesh, owner));
    owner->nodes.resize(model.nodes.size());
    for (size_t i = 0; i < model.nodes.size(); ++i)
        if (!translate(model.nodes[i], i, &owner->nodes[i], fault))
            return false;
    for (const tinygltf::Skin &skin : model.skins) {
        owner->skins.push_back({nullptr, 0, skin.inverseBindMatrices});
        point_to(skin.joints, &owner->skins.back().joints, &owner->skins.back().joint_count);
    }
    owner->materials.resize(model.materials.size());
    for (size_t i = 0; i < model.materials.size(); ++i)
        if (!gltf_translate(model.materials[i], i, &owner->materials[i], fault))
            return false;
    for (const tinygltf::Texture &texture : model.textures)
        owner->textures.push_back({texture.sampler, texture.source});
    for (const tinygltf::Sampler &sampler : model.samplers)
        owner->samplers.push_back({sampler.minFilter, sampler.magFilter, sampler.wrapS, sampler.wrapT});
    for (const tinygltf::Image &image : model.images)
        owner->images.push_back(gltf_translate(image));
    for (const tinygltf::Camera &camera : model.cameras)
        owner->cameras.push_back(gltf_translate(camera));
    owner->lights.resize(model.lights.size());
    for (size_t i = 0; i < model.lights.size(); ++i)
        if (!gltf_translate(model.lights[i], i, &owner->lights[i], fault))
            return false;
    for (const tinygltf::Scene &scene : model.scenes)
        owner->scenes.push_back({scene.nodes.data(), scene.nodes.size()});

    out->animation_count = model.animations.size();
    if (!model.animations.empty())
        translate(model.animations[0], owner, out);

    out->version = model.asset.version.c_str();
    out->min_version = model.asset.minVersion.c_str();
    out->default_scene = model.defaultScene;
    point_to(owner->buffers, &out->buffers, &out->buffer_count);
    point_to(owner->buffer_views, &out->buffer_views, &out->buffer_view_count);
    point_to(owner->accessors, &out->accessors, &out->accessor_count);
    point_to(owner->meshes, &out->meshes, &out->mesh_count);
    point_to(owner->nodes, &out->nodes, &out->node_count);
    point_to(owner->skins, &out->skins, &out->skin_count);
    point_to(owner->materials, &out->materials, &out->material_count);
    point_to(owner->textures, &out->textures, &out->texture_count);
    point_to(owner->samplers, &out->samplers, &out->sampler_count);
    point_to(owner->images, &out->images, &out->image_count);
    point_to(owner->cameras, &out->cameras, &out->camera_count);
    point_to(owner->lights, &out->lights, &out->light_count);
    point_to(owner->scenes, &out->scenes, &out->scene_count);
    return true;
}

bool open_document(gltf_document *out, const gltf_file &file, const char *path, scene_fault *fault)
{
    auto *owner = new document_owner;
    out->owner = owner;
    size_t external_bytes = 0;
    if (!gltf_parse(&owner->model, file, path, &external_bytes, fault) || !translate_all(owner, out, fault))
        return false;
    out->source_bytes = file.size + external_bytes;
    return true;
}

} // namespace

extern "C" bool gltf_document_open(gltf_document *out, const char *path, scene_fault *fault)
{
    *out = {};
    gltf_file file;
    if (!gltf_file_open(&file, path, fault))
        return false;
    bool opened = false;
    try {
        opened = open_document(out, file, path, fault);
    } catch (const std::bad_alloc &) {
        scene_fail_memory(fault);
    } catch (const std::exception &e) {
        scene_fail(fault, "tinygltf cannot parse it: %s", e.what());
    }
    std::free(file.data);
    if (!opened)
        gltf_document_close(out);
    return opened;
}

extern "C" void gltf_document_close(gltf_document *document)
{
    delete static_cast<document_owner *>(document->owner);
    *document = {};
}
