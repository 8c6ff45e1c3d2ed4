// SPDX-License-Identifier: MIT
//
// Copies from the file's JSON what tinygltf is to parse. The tables name each member with its type. Wrong types throw
// here, because tinygltf ignores some of them, truncates others to int, and names no object in its messages. A member
// that tinygltf insists on gets a default.
#include "gltf_model.h"

namespace
{

enum class kind {
    INDEX,
    SIZE,
    NUMBER,
    FLAG,
    TEXT,
    NAME, // text; "" where it is something else
    COMPONENT_TYPE,
    ACCESSOR_TYPE,
    CAMERA_TYPE,
    NUMBERS, // as many as `count` says; 0: any number
    INDICES,
    ATTRIBUTES, // an object of indices
    OBJECT,
    LIST
};

struct member {
    const char *name;
    kind what;
    bool always; // written even where the file has none
    double missing;
    size_t count;
    const member *inner; // of the object, or of each element of the list
    size_t inner_count;
    const char *element;  // the elements' name in messages; NULL: the owner's
    size_t element_bytes; // of tinygltf's structure
};

constexpr member index(const char *name)
{
    return {name, kind::INDEX, false, 0, 0, nullptr, 0, nullptr, 0};
}

constexpr member index(const char *name, int missing)
{
    return {name, kind::INDEX, true, static_cast<double>(missing), 0, nullptr, 0, nullptr, 0};
}

constexpr member size(const char *name)
{
    return {name, kind::SIZE, true, 0, 0, nullptr, 0, nullptr, 0};
}

constexpr member number(const char *name)
{
    return {name, kind::NUMBER, false, 0, 0, nullptr, 0, nullptr, 0};
}

constexpr member number(const char *name, double missing)
{
    return {name, kind::NUMBER, true, missing, 0, nullptr, 0, nullptr, 0};
}

constexpr member flag(const char *name)
{
    return {name, kind::FLAG, false, 0, 0, nullptr, 0, nullptr, 0};
}

constexpr member text(const char *name)
{
    return {name, kind::TEXT, false, 0, 0, nullptr, 0, nullptr, 0};
}

constexpr member needed(const char *name, kind what)
{
    return {name, what, true, 0, 0, nullptr, 0, nullptr, 0};
}

constexpr member numbers(const char *name, size_t count)
{
    return {name, kind::NUMBERS, false, 0, count, nullptr, 0, nullptr, 0};
}

constexpr member indices(const char *name)
{
    return {name, kind::INDICES, false, 0, 0, nullptr, 0, nullptr, 0};
}

template <size_t N> constexpr member object(const char *name, const member (&inner)[N], bool always = false)
{
    return {name, kind::OBJECT, always, 0, 0, inner, N, nullptr, 0};
}

constexpr member object(const char *name)
{
    return {name, kind::OBJECT, false, 0, 0, nullptr, 0, nullptr, 0};
}

template <typename T, size_t N> constexpr member list(const char *name, const char *element, const member (&inner)[N])
{
    return {name, kind::LIST, false, 0, 0, inner, N, element, sizeof(T)};
}

// "byteStride" is missing: tinygltf refuses some that gltf_check() can judge better.
constexpr member view[] = {index("buffer", -1), size("byteOffset"), size("byteLength")};

constexpr member sparse_indices[] = {index("bufferView", -1), index("componentType", -1), index("byteOffset")};
constexpr member sparse_values[] = {index("bufferView", -1), index("byteOffset")};
constexpr member sparse[] = {index("count", 0), object("indices", sparse_indices, true),
                             object("values", sparse_values, true)};
constexpr member accessor[] = {index("bufferView"),
                               size("byteOffset"),
                               size("count"),
                               flag("normalized"),
                               needed("componentType", kind::COMPONENT_TYPE),
                               needed("type", kind::ACCESSOR_TYPE),
                               object("sparse", sparse)};

// "indices" is missing: tinygltf refuses indices without a buffer view, which Draco's files have.
constexpr member mapping[] = {index("material", -1), indices("variants")};
constexpr member mappings[] = {list<tinygltf::Value>("mappings", nullptr, mapping)};
constexpr member primitive_extensions[] = {object("KHR_materials_variants", mappings)};
constexpr member primitive[] = {needed("attributes", kind::ATTRIBUTES),
                                {"targets", kind::LIST, false, 0, 0, nullptr, 0, nullptr, 64},
                                index("material"),
                                index("mode"),
                                object("extensions", primitive_extensions)};
constexpr member mesh[] = {list<tinygltf::Primitive>("primitives", nullptr, primitive), numbers("weights", 0)};

constexpr member node_light[] = {index("light")};
constexpr member visibility[] = {flag("visible")};
constexpr member instance_attributes[] = {index("TRANSLATION"), index("ROTATION"), index("SCALE")};
constexpr member instancing[] = {object("attributes", instance_attributes)};
constexpr member node_extensions[] = {object("KHR_lights_punctual", node_light),
                                      object("KHR_node_visibility", visibility),
                                      object("EXT_mesh_gpu_instancing", instancing)};
constexpr member node[] = {index("mesh"),
                           index("skin"),
                           index("camera"),
                           indices("children"),
                           numbers("weights", 0),
                           numbers("matrix", 16),
                           numbers("translation", 3),
                           numbers("rotation", 4),
                           numbers("scale", 3),
                           object("extensions", node_extensions)};

constexpr member skin[] = {needed("joints", kind::INDICES), index("inverseBindMatrices", -1)};
constexpr member one_scene[] = {indices("nodes")};

constexpr member transform[] = {numbers("offset", 2), numbers("scale", 2), number("rotation"), index("texCoord")};
constexpr member use_extensions[] = {object("KHR_texture_transform", transform)};
constexpr member use[] = {index("index", -1), index("texCoord"), number("scale"), number("strength"),
                          object("extensions", use_extensions)};
// With one member at least, so that tinygltf's model shows whether the file has the object.
constexpr member metallic_roughness[] = {numbers("baseColorFactor", 4), number("metallicFactor", 1),
                                         number("roughnessFactor"), object("baseColorTexture", use),
                                         object("metallicRoughnessTexture", use)};
constexpr member specular_glossiness[] = {numbers("diffuseFactor", 4), object("diffuseTexture", use),
                                          number("glossinessFactor")};
constexpr member emission[] = {number("emissiveStrength")};
constexpr member transmission[] = {number("transmissionFactor")};
constexpr member material_extensions[] = {object("KHR_materials_emissive_strength", emission),
                                          object("KHR_materials_pbrSpecularGlossiness", specular_glossiness),
                                          object("KHR_materials_transmission", transmission),
                                          object("KHR_materials_unlit")};
constexpr member material[] = {numbers("emissiveFactor", 3),
                               text("alphaMode"),
                               number("alphaCutoff"),
                               flag("doubleSided"),
                               object("pbrMetallicRoughness", metallic_roughness),
                               object("normalTexture", use),
                               object("occlusionTexture", use),
                               object("emissiveTexture", use),
                               object("extensions", material_extensions)};

constexpr member source_image[] = {index("source")};
constexpr member texture_extensions[] = {
    object("EXT_texture_webp", source_image), object("KHR_texture_basisu", source_image),
    object("EXT_texture_avif", source_image), object("MSFT_texture_dds", source_image)};
constexpr member texture[] = {index("sampler"), index("source"), object("extensions", texture_extensions)};
constexpr member sampler[] = {index("minFilter"), index("magFilter"), index("wrapS"), index("wrapT")};

constexpr member perspective[] = {number("yfov", 0), number("znear", 0), number("zfar", 0)};
constexpr member orthographic[] = {number("xmag", 0), number("ymag", 0), number("znear", 0), number("zfar", 0)};
constexpr member camera[] = {text("name"), needed("type", kind::CAMERA_TYPE), object("perspective", perspective, true),
                             object("orthographic", orthographic, true)};

constexpr member spot[] = {number("innerConeAngle"), number("outerConeAngle", 0.7853981633974483)};
constexpr member light[] = {needed("type", kind::TEXT), numbers("color", 3), number("intensity"), number("range"),
                            object("spot", spot, true)};

constexpr member animation_sampler[] = {index("input", -1), index("output", -1), text("interpolation")};
constexpr member channel_target[] = {index("node", -1), needed("path", kind::TEXT)};
constexpr member channel[] = {index("sampler", -1), object("target", channel_target, true)};
constexpr member animation[] = {list<tinygltf::AnimationSampler>("samplers", nullptr, animation_sampler),
                                list<tinygltf::AnimationChannel>("channels", nullptr, channel)};

constexpr member variant[] = {needed("name", kind::NAME)};
constexpr member variants[] = {list<tinygltf::Value>("variants", "variant", variant)};
constexpr member lights[] = {list<tinygltf::Light>("lights", "light", light)};
constexpr member file_extensions[] = {object("KHR_lights_punctual", lights),
                                      object("KHR_materials_variants", variants)};
constexpr member asset[] = {text("version"), text("minVersion")};
constexpr member file[] = {object("asset", asset, true),
                           index("scene"),
                           list<tinygltf::BufferView>("bufferViews", "buffer view", view),
                           list<tinygltf::Accessor>("accessors", "accessor", accessor),
                           list<tinygltf::Mesh>("meshes", "mesh", mesh),
                           list<tinygltf::Node>("nodes", "node", node),
                           list<tinygltf::Skin>("skins", "skin", skin),
                           list<tinygltf::Scene>("scenes", "scene", one_scene),
                           list<tinygltf::Material>("materials", "material", material),
                           list<tinygltf::Texture>("textures", "texture", texture),
                           list<tinygltf::Sampler>("samplers", "sampler", sampler),
                           list<tinygltf::Camera>("cameras", "camera", camera),
                           list<tinygltf::Animation>("animations", "animation", animation),
                           object("extensions", file_extensions)};

json copy_object(gltf_source *source, const gltf_object &from, const member *members, size_t count);

json copy_component_type(const gltf_object &from, const char *name)
{
    const int type = from.index(name);
    if (type < TINYGLTF_COMPONENT_TYPE_BYTE || type > TINYGLTF_COMPONENT_TYPE_DOUBLE)
        from.fail("component type " + std::to_string(type) + " is not one of glTF's");
    return static_cast<unsigned>(type);
}

json copy_accessor_type(const gltf_object &from, const char *name)
{
    static const char *const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    std::string type = from.text(name, "");
    if (std::find(std::begin(types), std::end(types), type) == std::end(types))
        from.fail("type '" + type.substr(0, 32) + "'");
    return type;
}

json copy_numbers(const gltf_object &from, const member &m)
{
    const json *found = from.find(m.name);
    json out = json::array();
    bool fits = found->is_array() && (!m.count || found->size() == m.count);
    for (size_t i = 0; fits && i < found->size(); ++i) {
        fits = (*found)[i].is_number();
        if (fits)
            out.push_back((*found)[i].get<double>());
    }
    if (!fits)
        from.fail("its " + std::string(m.name) +
                  (m.count ? " does not have " + std::to_string(m.count) + " numbers" : " are not a list of numbers"));
    return out;
}

json copy_indices(const gltf_object &from, const char *name)
{
    json out = json::array();
    for (const json &value : from.list(name)) {
        const double number = value.is_number_integer() ? value.get<double>() : HUGE_VAL;
        if (std::fabs(number) > std::numeric_limits<int>::max())
            from.fail("an element of " + std::string(name) + " is not an index");
        out.push_back(static_cast<int>(number));
    }
    return out;
}

json copy_attributes(gltf_source *source, const gltf_object &from)
{
    const uint64_t entry_bytes = 300; // of tinygltf's JSON, its map and the document
    json out = json::object();
    charge(source, from.value().size() * entry_bytes, "its attributes");
    for (const auto &item : from.value().items())
        out[item.key()] = from.index(item.key().c_str());
    return out;
}

json copy_list(gltf_source *source, const gltf_object &from, const member &m)
{
    json out = json::array();
    const json &list = from.list(m.name);
    // A growing vector holds up to three times its elements. The rest is for members with defaults, and extensions.
    charge(source, list.size() * uint64_t{3 * m.element_bytes + 1024}, "its " + std::string(m.name));
    for (size_t i = 0; i < list.size(); ++i) {
        const gltf_object element(list[i], m.element ? std::string(m.element) + " " + std::to_string(i) : from.name());
        out.push_back(m.inner ? copy_object(source, element, m.inner, m.inner_count)
                              : copy_attributes(source, element));
    }
    return out;
}

json copy_member(gltf_source *source, const gltf_object &from, const member &m)
{
    switch (m.what) {
    case kind::INDEX:
        return from.find(m.name) ? from.index(m.name) : static_cast<int>(m.missing);
    case kind::SIZE:
        return from.size(m.name, 0);
    case kind::NUMBER:
        return from.number(m.name, m.missing);
    case kind::FLAG:
        return from.flag(m.name);
    case kind::TEXT:
        return from.text(m.name, "");
    case kind::NAME:
        return from.find(m.name) && from.find(m.name)->is_string() ? from.text(m.name, "") : "";
    case kind::COMPONENT_TYPE:
        return copy_component_type(from, m.name);
    case kind::ACCESSOR_TYPE:
        return copy_accessor_type(from, m.name);
    case kind::CAMERA_TYPE:
        return from.text(m.name, "") == "orthographic" ? "orthographic" : "perspective";
    case kind::NUMBERS:
        return copy_numbers(from, m);
    case kind::INDICES:
        return copy_indices(from, m.name);
    case kind::ATTRIBUTES:
        return copy_attributes(source, from.object(m.name));
    case kind::OBJECT:
        return copy_object(source, from.object(m.name), m.inner, m.inner_count);
    case kind::LIST:
        return copy_list(source, from, m);
    }
    return nullptr;
}

json copy_object(gltf_source *source, const gltf_object &from, const member *members, size_t count)
{
    json out = json::object();
    for (size_t i = 0; i < count; ++i)
        if (members[i].always || from.find(members[i].name))
            out[members[i].name] = copy_member(source, from, members[i]);
    return out;
}

} // namespace

std::string gltf_outline(gltf_source *source, const gltf_object &root)
{
    return copy_object(source, root, file, std::size(file)).dump();
}
