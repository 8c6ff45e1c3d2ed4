// SPDX-License-Identifier: MIT
//
// tinygltf's model of the document, for the files that fill a gltf_document from it. C++ only.
#pragma once

#include "gltf_owner.h"

#include <algorithm>

#include <tiny_gltf.h>

// gltf_outline.cpp: the JSON text that tinygltf parses. It holds only members that the loader uses, each with its type
// checked, and neither buffers nor images: tinygltf would copy and decode their bytes.
std::string gltf_outline(gltf_source *source, const gltf_object &root);

// gltf_geometry.cpp: all but surfaces and bytes. `root` is the file's own JSON.
void gltf_read_geometry(gltf_owner *owner, const tinygltf::Model &model, const gltf_object &root, int variant);
void gltf_read_animation(gltf_owner *owner, const tinygltf::Animation &from);

// gltf_surfaces.cpp: materials, textures, samplers, cameras, lights.
void gltf_read_surfaces(gltf_owner *owner, const tinygltf::Model &model);

// NULL where the object does not use the extension.
inline const tinygltf::Value *find_extension(const tinygltf::ExtensionMap &extensions, const char *name)
{
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

// Members of an extension's object, whose types gltf_outline() has checked.
inline double number_of(const tinygltf::Value &object, const char *member, double missing)
{
    return object.Has(member) ? object.Get(member).GetNumberAsDouble() : missing;
}

inline int index_of(const tinygltf::Value &object, const char *member, int missing = -1)
{
    return object.Has(member) ? object.Get(member).GetNumberAsInt() : missing;
}

inline std::string text_of(const tinygltf::Value &object, const char *member)
{
    return object.Has(member) ? object.Get(member).Get<std::string>() : std::string();
}

// An empty array where it is missing.
inline const tinygltf::Value::Array &list_of(const tinygltf::Value &object, const char *member)
{
    static const tinygltf::Value::Array empty;
    return object.Has(member) ? object.Get(member).Get<tinygltf::Value::Array>() : empty;
}

// Leaves `out` as it is where the file gives no numbers.
template <size_t N> void copy_numbers(const std::vector<double> &from, double (&out)[N])
{
    if (from.size() == N)
        std::copy(from.begin(), from.end(), out);
}

template <size_t N> void copy_numbers(const tinygltf::Value &object, const char *member, double (&out)[N])
{
    const tinygltf::Value::Array &from = list_of(object, member);
    if (from.size() == N)
        std::transform(from.begin(), from.end(), out,
                       [](const tinygltf::Value &value) { return value.GetNumberAsDouble(); });
}
