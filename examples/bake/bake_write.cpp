// SPDX-License-Identifier: MIT
//
// Writes the file back as a GLB. Its JSON is edited, so that names, extras and unknown extensions stay as they were.
// All buffers and images become one BIN chunk. No exception leaves this file.
#include "bake.h"
#include "whole_file.h"

#include "gltf_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace
{

using json = nlohmann::ordered_json;

struct output {
    json root;
    std::string bin;
};

size_t align(std::string *bin)
{
    bin->append((8 - bin->size() % 8) % 8, '\0');
    return bin->size();
}

size_t append(output *out, const void *data, size_t size, int target)
{
    const size_t at = align(&out->bin);
    out->bin.append(static_cast<const char *>(data), size);
    json view = {{"buffer", 0}, {"byteOffset", at}, {"byteLength", size}};
    if (target)
        view["target"] = target;
    json &views = out->root["bufferViews"];
    views.push_back(std::move(view));
    return views.size() - 1;
}

// Joins all buffers into one. For a packed file, these are the unpacked buffers.
void merge_buffers(const gltf_document &document, output *out)
{
    std::vector<bool> used(document.buffer_count, false);
    for (size_t i = 0; i < document.buffer_view_count; ++i)
        used[static_cast<size_t>(document.buffer_views[i].buffer)] = true;
    std::vector<size_t> offsets;
    for (size_t i = 0; i < document.buffer_count; ++i) {
        offsets.push_back(align(&out->bin));
        if (used[i])
            out->bin.append(reinterpret_cast<const char *>(document.buffers[i].data), document.buffers[i].size);
    }
    json &views = out->root["bufferViews"];
    for (size_t i = 0; i < document.buffer_view_count; ++i) {
        const gltf_buffer_view &from = document.buffer_views[i];
        if (i == views.size())
            views.push_back(json::object());
        json &view = views[i];
        view["buffer"] = 0;
        view["byteOffset"] = offsets[static_cast<size_t>(from.buffer)] + from.offset;
        view["byteLength"] = from.length;
        if (from.stride)
            view["byteStride"] = from.stride;
    }
    if (views.empty())
        out->root.erase("bufferViews");
}

// Erases an extension from an object, and the list of extensions with its last.
void erase_extension(json *object, const char *name)
{
    if (!object->is_object() || !object->contains("extensions"))
        return;
    json &extensions = (*object)["extensions"];
    extensions.erase(name);
    if (extensions.empty())
        object->erase("extensions");
}

void erase_name(json *root, const char *list, const char *name)
{
    if (!root->contains(list))
        return;
    json &names = (*root)[list];
    names.erase(std::remove(names.begin(), names.end(), json(name)), names.end());
    if (names.empty())
        root->erase(list);
}

// The written file is unpacked. A viewer that knows the extension would read vertices in another order, or bytes that
// no longer exist.
void erase_packing(const gltf_document &document, json *root)
{
    static const char *const packings[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                           "KHR_meshopt_compression"};
    for (const char *packing : packings) {
        for (const char *list : {"bufferViews", "buffers"})
            if (root->contains(list))
                for (json &entry : (*root)[list])
                    erase_extension(&entry, packing);
        if (root->contains("meshes"))
            for (json &mesh : (*root)["meshes"])
                for (json &primitive : mesh["primitives"])
                    erase_extension(&primitive, packing);
        erase_name(root, "extensionsUsed", packing);
        erase_name(root, "extensionsRequired", packing);
    }
    for (size_t i = 0; i < document.accessor_count; ++i) {
        const gltf_accessor &from = document.accessors[i];
        json &to = (*root)["accessors"][i];
        if (from.buffer_view < 0 || to.value("bufferView", -1) == from.buffer_view)
            continue;
        to["bufferView"] = from.buffer_view;
        to["count"] = from.count;
        to["componentType"] = from.component_type;
        to.erase("byteOffset");
    }
}

// The media type by the image's first bytes; NULL if unknown.
const char *mime_type(const gltf_image &image)
{
    const std::string begin(reinterpret_cast<const char *>(image.encoded), std::min<size_t>(image.encoded_size, 4));
    return begin == "\x89PNG"                 ? "image/png"
           : begin.substr(0, 2) == "\xff\xd8" ? "image/jpeg"
           : begin == "RIFF"                  ? "image/webp"
                                              : nullptr;
}

// An image of unknown kind stays where it was.
void embed_images(const gltf_document &document, output *out)
{
    for (size_t i = 0; i < document.image_count; ++i) {
        const gltf_image &image = document.images[i];
        if (!image.encoded || !out->root["images"][i].contains("uri") || !mime_type(image))
            continue;
        const size_t view = append(out, image.encoded, image.encoded_size, 0);
        json &to = out->root["images"][i]; // not before: the root may have moved to take its buffer views
        to.erase("uri");
        to["bufferView"] = view;
        if (!to.contains("mimeType"))
            to["mimeType"] = mime_type(image);
    }
}

uint16_t to_unorm(float value)
{
    return static_cast<uint16_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535));
}

size_t add_colors(const bake_part &part, bool accessibility_only, output *out)
{
    std::string bytes;
    for (uint32_t i = 0; i < part.vertex_count; ++i)
        for (int c = 0; c < 4; ++c) {
            const float given = part.colors && !(accessibility_only && c < 3) ? part.colors[i][c] : 1;
            const uint16_t value = to_unorm(c < 3 ? given * part.accessibility[i] : given);
            bytes += static_cast<char>(value & 0xff);
            bytes += static_cast<char>(value >> 8);
        }
    const int unsigned_short = 5123, array_buffer = 34962;
    const size_t view = append(out, bytes.data(), bytes.size(), array_buffer);
    json &accessors = out->root["accessors"];
    accessors.push_back({{"bufferView", view},
                         {"componentType", unsigned_short},
                         {"normalized", true},
                         {"count", part.vertex_count},
                         {"type", "VEC4"}});
    return accessors.size() - 1;
}

void set_color(json *primitive, size_t accessor)
{
    (*primitive)["attributes"]["COLOR_0"] = accessor;
}

// The mesh for a node: the first node keeps its own, each further one gets a copy. A node that is not shown keeps its
// mesh unchanged.
class mesh_copies
{
  public:
    mesh_copies(const bake_model &model, output *out) : out_(out), original_(out->root.value("meshes", json::array()))
    {
        std::vector<bool> shown(model.document.node_count, false);
        for (size_t i = 0; i < model.part_count; ++i)
            shown[model.parts[i].node] = true;
        used_.resize(model.document.mesh_count, false);
        for (size_t i = 0; i < model.document.node_count; ++i)
            if (!shown[i] && model.document.nodes[i].mesh >= 0)
                used_[static_cast<size_t>(model.document.nodes[i].mesh)] = true;
    }

    json &of_node(const gltf_document &document, size_t node)
    {
        const auto found = of_node_.find(node);
        if (found != of_node_.end())
            return out_->root["meshes"][found->second];
        const auto mesh = static_cast<size_t>(document.nodes[node].mesh);
        size_t number = mesh;
        json &meshes = out_->root["meshes"];
        if (used_[mesh]) {
            meshes.push_back(original_[mesh]);
            number = meshes.size() - 1;
            out_->root["nodes"][node]["mesh"] = number;
        }
        used_[mesh] = true;
        of_node_[node] = number;
        return meshes[number];
    }

  private:
    output *out_;
    json original_;
    std::vector<bool> used_;
    std::map<size_t, size_t> of_node_;
};

void put_u32(std::string *to, size_t value)
{
    for (int i = 0; i < 4; ++i)
        *to += static_cast<char>(value >> 8 * i & 0xff);
}

bool write_glb(const std::string &text, const std::string &bin, const char *path, failure *fault)
{
    const size_t size = 12 + 8 + text.size() + (bin.empty() ? 0 : 8 + bin.size());
    if (size > UINT32_MAX)
        return fault_set(fault, "%zu bytes are more than a GLB holds", size);
    std::string head = "glTF", second;
    put_u32(&head, 2);
    put_u32(&head, size);
    put_u32(&head, text.size());
    head += "JSON";
    put_u32(&second, bin.size());
    second.append("BIN\0", 4);
    whole_file whole;
    fault->file = nullptr; // whole_file names it
    if (!whole_file_open(&whole, path, fault))
        return false;
    FILE *file = whole.file;
    bool ok = std::fwrite(head.data(), 1, head.size(), file) == head.size() &&
              std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if (!bin.empty())
        ok = ok && std::fwrite(second.data(), 1, second.size(), file) == second.size() &&
             std::fwrite(bin.data(), 1, bin.size(), file) == bin.size();
    return whole_file_close(&whole, ok, fault) || fault_set(fault, "%s: it could not be written in full", path);
}

bool write(const bake_model &model, const bake_options &options, const gltf_file &file, failure *fault)
{
    output out;
    const char *text = reinterpret_cast<const char *>(file.data) + file.json_begin;
    out.root = json::parse(text, text + file.json_size);
    merge_buffers(model.document, &out);
    erase_packing(model.document, &out.root);
    embed_images(model.document, &out);
    mesh_copies copies(model, &out);
    for (size_t i = 0; i < model.part_count; ++i) {
        const bake_part &part = model.parts[i];
        const size_t accessor = add_colors(part, options.accessibility_only, &out);
        json &mesh = copies.of_node(model.document, part.node);
        for (size_t k = 0; k < part.primitive_count; ++k)
            set_color(&mesh["primitives"][part.primitives[k]], accessor);
    }
    align(&out.bin);
    if (!out.bin.empty()) {
        json buffer = out.root.contains("buffers") && !out.root["buffers"].empty() ? out.root["buffers"][0] : json();
        if (buffer.is_object())
            buffer.erase("uri");
        buffer["byteLength"] = out.bin.size();
        out.root["buffers"] = json::array({buffer});
    }
    std::string written = out.root.dump(-1, ' ', false, json::error_handler_t::replace);
    written.append((4 - written.size() % 4) % 4, ' ');
    return write_glb(written, out.bin, options.output, fault);
}

} // namespace

extern "C" bool bake_write(const bake_model *m, const bake_options *o, failure *fault)
{
    gltf_file file;
    memory_budget budget = memory_budget_begin(0);
    if (!gltf_file_open(&file, o->input, &budget, fault))
        return false;
    failure output_fault = *fault;
    output_fault.file = o->output;
    bool written = false;
    try {
        written = write(*m, *o, file, &output_fault);
    } catch (const std::bad_alloc &) {
        fault_set_memory(&output_fault);
    } catch (const std::exception &e) {
        fault_set(&output_fault, "it can't be made: %s", e.what());
    }
    std::free(file.data);
    return written;
}
