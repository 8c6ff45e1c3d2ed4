// SPDX-License-Identifier: MIT
//
// Opens a glTF file: has tinygltf parse its document and fills a gltf_document from the model. No exception leaves this
// file.
#include "gltf_document.h"

#include "gltf_model.h"

#include <exception>
#include <new>

namespace
{

// The variant's index for its name or its number from 1 on; -1: none is chosen.
int find_variant(const tinygltf::Model &model, const char *chosen)
{
    if (!chosen)
        return -1;
    const tinygltf::Value *extension = find_extension(model.extensions, "KHR_materials_variants");
    const tinygltf::Value::Array variants = extension ? list_of(*extension, "variants") : tinygltf::Value::Array();
    char *end = nullptr;
    const unsigned long number = std::strtoul(chosen, &end, 10);
    std::string names;
    for (size_t i = 0; i < variants.size(); ++i) {
        const std::string name = text_of(variants[i], "name");
        if (name == chosen || (!*end && number == i + 1))
            return static_cast<int>(i);
        names += (names.empty() ? ": " : ", ") + name;
    }
    throw gltf_json_error("it has no variant '" + std::string(chosen) + "'; there are " +
                          std::to_string(variants.size()) + names);
}

// The chosen one's index; `chosen` counts from 1, 0: `missing`.
int choose(int chosen, int missing, size_t count, const char *what)
{
    if (chosen > 0 && static_cast<size_t>(chosen) > count)
        throw gltf_json_error("it has no " + std::string(what) + " " + std::to_string(chosen) + "; there are " +
                              std::to_string(count));
    return chosen > 0 ? chosen - 1 : missing;
}

template <typename T> void point_to(const std::vector<T> &from, const T **out, size_t *out_count)
{
    *out = from.data();
    *out_count = from.size();
}

void point_to_all(const gltf_owner &owner, gltf_document *out)
{
    point_to(owner.buffers, &out->buffers, &out->buffer_count);
    point_to(owner.buffer_views, &out->buffer_views, &out->buffer_view_count);
    point_to(owner.accessors, &out->accessors, &out->accessor_count);
    point_to(owner.meshes, &out->meshes, &out->mesh_count);
    point_to(owner.nodes, &out->nodes, &out->node_count);
    point_to(owner.skins, &out->skins, &out->skin_count);
    point_to(owner.materials, &out->materials, &out->material_count);
    point_to(owner.textures, &out->textures, &out->texture_count);
    point_to(owner.samplers, &out->samplers, &out->sampler_count);
    point_to(owner.images, &out->images, &out->image_count);
    point_to(owner.cameras, &out->cameras, &out->camera_count);
    point_to(owner.lights, &out->lights, &out->light_count);
    point_to(owner.scenes, &out->scenes, &out->scene_count);
    point_to(owner.animation_samplers, &out->animation_samplers, &out->animation_sampler_count);
    point_to(owner.animation_channels, &out->animation_channels, &out->animation_channel_count);
}

tinygltf::Model parse(const std::string &text)
{
    if (text.size() > std::numeric_limits<unsigned>::max())
        throw gltf_json_error("its JSON is too large for tinygltf, which counts in unsigned int");
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string fault, warning;
    const bool parsed = parser.LoadASCIIFromString(&model, &fault, &warning, text.c_str(),
                                                   static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE);
    // tinygltf leaves out what it cannot parse, says so, and calls it success.
    if (!parsed || !fault.empty())
        throw gltf_json_error("tinygltf cannot parse it: " + fault.substr(0, fault.find('\n')).substr(0, 240));
    return model;
}

void read_all(gltf_owner *owner, gltf_source *source, const json &parsed, const scene_load_options &options)
{
    gltf_document *out = source->document;
    const gltf_object root(parsed, "the file");
    // Before types are checked: another version, or an unknown extension, may give members other types.
    out->version = owner->keep(gltf_object(root.object("asset").value(), "asset").text("version", ""));
    if (std::string(out->version).compare(0, 2, "2.") != 0)
        throw gltf_json_error("glTF version '" + std::string(out->version).substr(0, 16) + "', only 2 is known");
    gltf_check_extensions(source, root);
    root.extension("CESIUM_RTC").numbers("center", out->center);
    if (owner->file.unaligned)
        warn(source, "the length of a GLB chunk is no multiple of 4");
    const tinygltf::Model model = parse(gltf_outline(source, root));
    out->min_version = owner->keep(model.asset.minVersion);
    gltf_read_buffers(owner, source, root);
    gltf_read_geometry(owner, model, root, find_variant(model, options.variant));
    gltf_unpack_views(owner, source, root);
    gltf_unpack_primitives(owner, source, root);
    gltf_read_images(owner, source, root);
    gltf_read_surfaces(owner, model);
    out->animation = choose(options.animation, 0, model.animations.size(), "animation");
    out->animation_count = model.animations.size();
    if (!model.animations.empty())
        gltf_read_animation(owner, model.animations[static_cast<size_t>(out->animation)]);
    out->default_scene = choose(options.scene, model.defaultScene, model.scenes.size(), "scene");
    point_to_all(*owner, out);
    out->source_bytes += owner->file.size + source->bytes_read;
}

void open_document(gltf_document *out, const char *path, const scene_load_options &options, failure *fault)
{
    auto *owner = new gltf_owner;
    out->owner = owner;
    if (!gltf_file_open(&owner->file, path, &out->budget, fault))
        throw gltf_fault_is_set();
    gltf_source source{out, fault, std::string(path, gltf_file_name(path)), options.root};
    const char *text = reinterpret_cast<const char *>(owner->file.data) + owner->file.json_begin;
    const json parsed = json::parse(text, text + owner->file.json_size);
    read_all(owner, &source, parsed, options);
}

} // namespace

extern "C" bool gltf_document_open(gltf_document *out, const char *path, const scene_load_options *options,
                                   scene_warnings *warnings, failure *fault)
{
    const scene_load_options none{};
    *out = {};
    out->warnings = warnings;
    out->budget = memory_budget_begin(options ? options->memory_bytes : 0);
    bool opened = false;
    try {
        open_document(out, path, options ? *options : none, fault);
        opened = true;
    } catch (const gltf_fault_is_set &) {
        opened = false;
    } catch (const std::bad_alloc &) {
        fault_set_memory(fault);
    } catch (const json::exception &e) {
        // nlohmann's messages begin with a number of its own in brackets.
        const std::string text = e.what();
        const size_t bracket = text.find("] ");
        fault_set(fault, "JSON: %.240s", text.c_str() + (bracket == std::string::npos ? 0 : bracket + 2));
    } catch (const std::exception &e) {
        fault_set(fault, "%s", e.what());
    }
    if (!opened)
        gltf_document_close(out);
    return opened;
}

extern "C" void gltf_document_close(gltf_document *document)
{
    delete static_cast<gltf_owner *>(document->owner);
    *document = {};
}
