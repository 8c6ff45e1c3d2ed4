// SPDX-License-Identifier: MIT
//
// Opens a glTF file: parses its JSON and fills a gltf_document with what is in it. No exception leaves this file.
#include "gltf_document.h"

#include "gltf_owner.h"

#include <exception>
#include <new>

namespace
{

gltf_sparse read_sparse(const gltf_object &accessor)
{
    gltf_sparse out{};
    if (!accessor.find("sparse"))
        return out;
    const gltf_object sparse = accessor.object("sparse");
    const gltf_object indices = sparse.object("indices"), values = sparse.object("values");
    const auto count = static_cast<int64_t>(sparse.number("count", 0));
    out.count = count ? count : -1; // 0 is not allowed, and stands for "not sparse" here
    out.index_view = indices.index("bufferView");
    out.index_type = indices.index("componentType");
    out.index_offset = static_cast<int64_t>(indices.number("byteOffset", 0));
    out.value_view = values.index("bufferView");
    out.value_offset = static_cast<int64_t>(values.number("byteOffset", 0));
    return out;
}

gltf_accessor read_accessor(const gltf_object &from)
{
    static const struct {
        const char *name;
        int rows, columns;
    } types[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1},
                 {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};
    gltf_accessor out{};
    out.buffer_view = from.index("bufferView");
    out.offset = from.size("byteOffset", 0);
    out.count = from.size("count", 0);
    out.component_type = from.index("componentType");
    out.normalized = from.flag("normalized");
    out.sparse = read_sparse(from);
    const std::string type = from.text("type", "");
    for (const auto &known : types)
        if (type == known.name) {
            out.rows = known.rows;
            out.columns = known.columns;
        }
    if (!out.rows)
        from.fail("type '" + type.substr(0, 32) + "'");
    return out;
}

gltf_attribute_list read_attributes(const gltf_object &from, gltf_owner *owner)
{
    owner->attributes.emplace_back();
    auto &list = owner->attributes.back();
    for (const auto &item : from.value().items())
        list.push_back({owner->keep(item.key()), from.index(item.key().c_str())});
    return {list.data(), list.size()};
}

// The material that a variant gives the primitive, else its own.
int read_material(const gltf_object &primitive, int variant)
{
    if (variant >= 0 && primitive.uses("KHR_materials_variants")) {
        const gltf_object extension = primitive.extension("KHR_materials_variants");
        for (const json &entry : extension.list("mappings")) {
            const gltf_object mapping(entry, primitive.name());
            for (const json &number : mapping.list("variants"))
                if (number.is_number_unsigned() && number.get<size_t>() == static_cast<size_t>(variant))
                    return mapping.index("material");
        }
    }
    return primitive.index("material");
}

gltf_weights read_weights(const gltf_object &from, gltf_owner *owner)
{
    owner->numbers.emplace_back();
    auto &list = owner->numbers.back();
    for (const json &weight : from.list("weights")) {
        if (!weight.is_number())
            from.fail("a weight is not a number");
        list.push_back(weight.get<double>());
    }
    return {list.data(), list.size()};
}

gltf_mesh read_mesh(const gltf_object &from, gltf_owner *owner, int variant)
{
    owner->primitives.emplace_back();
    auto &primitives = owner->primitives.back();
    for (const json &entry : from.list("primitives")) {
        const gltf_object primitive(entry, from.name());
        gltf_primitive out{};
        out.attributes = read_attributes(primitive.object("attributes"), owner);
        owner->targets.emplace_back();
        auto &targets = owner->targets.back();
        for (const json &target : primitive.list("targets"))
            targets.push_back(read_attributes({target, from.name()}, owner));
        out.targets = targets.data();
        out.target_count = targets.size();
        out.indices = primitive.index("indices");
        out.material = read_material(primitive, variant);
        out.mode = primitive.find("mode") ? primitive.index("mode") : static_cast<int>(GLTF_TRIANGLES);
        primitives.push_back(out);
    }
    gltf_mesh out{};
    out.primitives = primitives.data();
    out.primitive_count = primitives.size();
    out.weights = read_weights(from, owner);
    return out;
}

void read_indices(const gltf_object &from, const char *member, gltf_owner *owner, const int **out, size_t *out_count)
{
    owner->indices.emplace_back();
    auto &list = owner->indices.back();
    for (const json &index : from.list(member)) {
        if (!index.is_number_integer())
            from.fail("an element of " + std::string(member) + " is not an index");
        list.push_back(static_cast<int>(index.get<int64_t>()));
    }
    *out = list.data();
    *out_count = list.size();
}

gltf_node read_node(const gltf_object &from, gltf_owner *owner)
{
    gltf_node out{};
    out.mesh = from.index("mesh");
    out.skin = from.index("skin");
    out.camera = from.index("camera");
    out.light = from.extension("KHR_lights_punctual").index("light");
    const gltf_object visibility = from.extension("KHR_node_visibility");
    out.hidden = visibility.find("visible") && !visibility.flag("visible");
    read_indices(from, "children", owner, &out.children, &out.child_count);
    out.weights = read_weights(from, owner);
    out.has_matrix = from.find("matrix") != nullptr;
    out.rotation[3] = out.scale[0] = out.scale[1] = out.scale[2] = 1;
    from.numbers("matrix", out.matrix);
    from.numbers("translation", out.translation);
    from.numbers("rotation", out.rotation);
    from.numbers("scale", out.scale);
    const gltf_object instances = from.extension("EXT_mesh_gpu_instancing").object("attributes");
    out.instance_translation = instances.index("TRANSLATION");
    out.instance_rotation = instances.index("ROTATION");
    out.instance_scale = instances.index("SCALE");
    out.instanced = out.instance_translation != -1 || out.instance_rotation != -1 || out.instance_scale != -1;
    return out;
}

void read_animation(const gltf_object &from, gltf_owner *owner)
{
    for (const json &entry : from.list("samplers")) {
        const gltf_object sampler(entry, from.name());
        owner->animation_samplers.push_back(
            {sampler.index("input"), sampler.index("output"), owner->keep(sampler.text("interpolation", "LINEAR"))});
    }
    for (const json &entry : from.list("channels")) {
        const gltf_object channel(entry, from.name());
        const gltf_object target = channel.object("target");
        owner->animation_channels.push_back(
            {channel.index("sampler"), target.index("node"), owner->keep(target.text("path", ""))});
    }
}

// The variant's index for its name or its number from 1 on; -1: none is chosen.
int find_variant(const gltf_object &root, const char *chosen)
{
    if (!chosen)
        return -1;
    const json &variants = root.extension("KHR_materials_variants").list("variants");
    char *end = nullptr;
    const unsigned long number = std::strtoul(chosen, &end, 10);
    for (size_t i = 0; i < variants.size(); ++i)
        if (gltf_object(variants[i], "variant").text("name", "") == chosen || (!*end && number == i + 1))
            return static_cast<int>(i);
    std::string names;
    for (const json &variant : variants)
        names += (names.empty() ? ": " : ", ") + gltf_object(variant, "variant").text("name", "");
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

template <typename T, typename Read>
void read_list(const gltf_object &root, const char *member, const char *name, std::vector<T> *out, Read read)
{
    const json &list = root.list(member);
    out->reserve(list.size());
    for (size_t i = 0; i < list.size(); ++i)
        out->push_back(read(gltf_object(list[i], std::string(name) + " " + std::to_string(i))));
}

void read_geometry(gltf_owner *owner, gltf_source *source, const gltf_object &root, int variant)
{
    read_list(root, "accessors", "accessor", &owner->accessors, read_accessor);
    read_list(root, "meshes", "mesh", &owner->meshes,
              [&](const gltf_object &from) { return read_mesh(from, owner, variant); });
    read_list(root, "nodes", "node", &owner->nodes, [&](const gltf_object &from) { return read_node(from, owner); });
    read_list(root, "skins", "skin", &owner->skins, [&](const gltf_object &from) {
        gltf_skin out{};
        read_indices(from, "joints", owner, &out.joints, &out.joint_count);
        out.inverse_bind_matrices = from.index("inverseBindMatrices");
        return out;
    });
    read_list(root, "scenes", "scene", &owner->scenes, [&](const gltf_object &from) {
        gltf_scene out{};
        read_indices(from, "nodes", owner, &out.nodes, &out.node_count);
        return out;
    });
    gltf_unpack_views(owner, source, root);
    gltf_unpack_primitives(owner, source, root);
}

void read_all(gltf_owner *owner, gltf_source *source, const json &parsed, const scene_load_options &options)
{
    gltf_document *out = source->document;
    const gltf_object root(parsed, "the file");
    const gltf_object asset(root.object("asset").value(), "asset");
    out->version = owner->keep(asset.text("version", ""));
    out->min_version = owner->keep(asset.text("minVersion", ""));
    if (std::string(out->version).compare(0, 2, "2.") != 0)
        throw gltf_json_error("glTF version '" + std::string(out->version).substr(0, 16) + "', only 2 is known");
    gltf_check_extensions(source, root);
    if (owner->file.unaligned)
        warn(source, "the length of a GLB chunk is no multiple of 4");
    gltf_read_buffers(owner, source, root);
    read_geometry(owner, source, root, find_variant(root, options.variant));
    gltf_read_images(owner, source, root);
    gltf_read_surfaces(owner, root);
    gltf_read_views(owner, root);
    const json &animations = root.list("animations");
    out->animation = choose(options.animation, 0, animations.size(), "animation");
    out->animation_count = animations.size();
    if (!animations.empty())
        read_animation({animations[static_cast<size_t>(out->animation)], "animation " + std::to_string(out->animation)},
                       owner);
    out->default_scene = choose(options.scene, root.index("scene"), root.list("scenes").size(), "scene");
    point_to_all(*owner, out);
    out->source_bytes += owner->file.size + source->bytes_read;
}

void open_document(gltf_document *out, const char *path, const scene_load_options &options, scene_fault *fault)
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
                                   scene_warnings *warnings, scene_fault *fault)
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
        scene_fail_memory(fault);
    } catch (const json::exception &e) {
        // nlohmann's messages begin with a number of its own in brackets.
        const std::string text = e.what();
        const size_t bracket = text.find("] ");
        scene_fail(fault, "JSON: %.240s", text.c_str() + (bracket == std::string::npos ? 0 : bracket + 2));
    } catch (const std::exception &e) {
        scene_fail(fault, "%s", e.what());
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
