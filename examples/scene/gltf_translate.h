// SPDX-License-Identifier: MIT
//
// What the files that translate tinygltf's model into gltf_document.h share; C++, and included by nobody else.
#ifndef GLSSAO_EXAMPLES_GLTF_TRANSLATE_H
#define GLSSAO_EXAMPLES_GLTF_TRANSLATE_H

#include "gltf_document.h"

#include "gltf_parse.h"

#include <algorithm>
#include <vector>

template <typename T> void point_to(const std::vector<T> &from, const T **out, size_t *out_count)
{
    *out = from.data();
    *out_count = from.size();
}

// True, and `out` filled, where the vector has as many numbers as `out`; an empty one leaves `out` as it is.
template <size_t N> bool copy_numbers(const std::vector<double> &from, double (&out)[N])
{
    if (from.size() == N)
        std::copy(from.begin(), from.end(), out);
    return from.empty() || from.size() == N;
}

// An extension's numbers, left as they are where the member is missing or is something else.
template <size_t N> void copy_member(const tinygltf::Value &object, const char *name, double (&out)[N])
{
    if (!object.Has(name) || object.Get(name).ArrayLen() != N)
        return;
    for (size_t i = 0; i < N; ++i)
        out[i] = object.Get(name).Get(static_cast<int>(i)).GetNumberAsDouble();
}

// An extension's index: `missing` where there is none, one that no check lets pass where it is no integer.
inline int index_member(const tinygltf::Value &object, const char *name, int missing)
{
    if (!object.IsObject() || !object.Has(name))
        return missing;
    const tinygltf::Value &value = object.Get(name);
    return value.IsInt() ? value.Get<int>() : -2;
}

inline const tinygltf::Value *find_extension(const tinygltf::ExtensionMap &extensions, const char *name)
{
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

// gltf_surfaces.cpp: pointers lead into `from`. False, with the fault set, where a list of numbers has another length.
bool gltf_translate(const tinygltf::Material &from, size_t number, gltf_material *out, scene_fault *fault);
bool gltf_translate(const tinygltf::Light &from, size_t number, gltf_light *out, scene_fault *fault);
gltf_image gltf_translate(const tinygltf::Image &from);
gltf_camera gltf_translate(const tinygltf::Camera &from);

#endif
