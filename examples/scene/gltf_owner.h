// SPDX-License-Identifier: MIT
//
// Owns the memory behind a gltf_document's pointers, for the files that fill the document. C++ only.
#pragma once

#include "gltf_document.h"
#include "gltf_file.h"
#include "gltf_json.h"

#include <cstdlib>
#include <deque>
#include <memory>
#include <string>
#include <vector>

struct free_bytes {
    void operator()(uint8_t *data) const
    {
        std::free(data);
    }
};

// A deque does not move its elements when it grows.
struct gltf_owner {
    gltf_file file{};
    std::vector<std::unique_ptr<uint8_t, free_bytes>> bytes; // external files, decoded data URIs, unpacked views
    std::deque<std::string> texts;
    std::deque<std::vector<int>> indices;
    std::deque<std::vector<double>> numbers;
    std::deque<std::vector<gltf_attribute>> attributes;
    std::deque<std::vector<gltf_attribute_list>> targets;
    std::deque<std::vector<gltf_primitive>> primitives;
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

    gltf_owner() = default;
    gltf_owner(const gltf_owner &) = delete;
    gltf_owner &operator=(const gltf_owner &) = delete;
    ~gltf_owner()
    {
        std::free(file.data);
    }

    const char *keep(std::string text)
    {
        texts.push_back(std::move(text));
        return texts.back().c_str();
    }

    // Takes bytes over that free() is for; NULL counts as memory that is short.
    uint8_t *keep(uint8_t *data)
    {
        std::unique_ptr<uint8_t, free_bytes> held(data);
        if (!data)
            throw std::bad_alloc();
        bytes.push_back(std::move(held));
        return data;
    }
};

// Where a part needs more than the document: limits, messages, and files beside the glTF file.
struct gltf_source {
    gltf_document *document;
    failure *fault;
    std::string folder;    // "" or with a slash at its end
    const char *root;      // NULL: the folder
    size_t bytes_read = 0; // of external files
};

// A fault is set already.
struct gltf_fault_is_set : std::exception {
};

// Charges the document's budget; throws.
inline void charge(gltf_source *source, uint64_t bytes, const std::string &what)
{
    if (!memory_budget_charge(&source->document->budget, bytes, what.c_str(), source->fault))
        throw gltf_fault_is_set();
}

// Warns; throws where warnings are faults.
inline void warn(gltf_source *source, const std::string &line)
{
    if (!scene_warn(source->document->warnings, source->fault, "%s", line.c_str()))
        throw gltf_fault_is_set();
}

// gltf_buffers.cpp: buffers and images with their bytes.
void gltf_read_buffers(gltf_owner *owner, gltf_source *source, const gltf_object &root);
void gltf_read_images(gltf_owner *owner, gltf_source *source, const gltf_object &root);

// gltf_meshopt.cpp: unpacks the buffer views that EXT_meshopt_compression packs.
void gltf_unpack_views(gltf_owner *owner, gltf_source *source, const gltf_object &root);

// gltf_draco.cpp: unpacks the primitives that KHR_draco_mesh_compression packs, into buffer views of their accessors.
void gltf_unpack_primitives(gltf_owner *owner, gltf_source *source, const gltf_object &root);

// gltf_extensions.cpp: refuses a file that requires an unknown extension, and warns of extensions that are
// approximated.
void gltf_check_extensions(gltf_source *source, const gltf_object &root);
