// SPDX-License-Identifier: MIT
//
// KHR_draco_mesh_compression: decodes each packed primitive into buffer views that its accessors then name, so that the
// rest of the loader sees an ordinary file.
#include "gltf_owner.h"

#if GLSSAO_HAS_DRACO
#include <draco/compression/decode.h>

#include <map>
#endif

namespace
{

#if GLSSAO_HAS_DRACO

struct packed_bytes {
    const uint8_t *data;
    size_t size;
};

// The head of Draco's bitstream: read here because the decoder allocates what the head says before it looks further.
class header
{
  public:
    explicit header(packed_bytes bytes) : bytes_(bytes)
    {
    }

    // Both counts; false where the bytes are no mesh. Zeros where metadata comes first, which is not followed.
    bool read(uint64_t *out_faces, uint64_t *out_points)
    {
        enum { VERSION = 5, KIND = 7, METHOD = 8, FLAGS = 10, SIZE = 11, MESH = 1, EDGEBREAKER = 1, METADATA = 0x80 };
        *out_faces = *out_points = 0;
        if (bytes_.size < SIZE || memcmp(bytes_.data, "DRACO", VERSION) != 0 || bytes_.data[KIND] != MESH)
            return false;
        version_ = bytes_.data[VERSION] << 8 | bytes_.data[VERSION + 1];
        at_ = SIZE;
        if (bytes_.data[FLAGS] & METADATA)
            return true;
        if (bytes_.data[METHOD] == EDGEBREAKER) {
            ++at_; // the traversal's kind
            if (version_ < 0x202)
                number(0x200); // vertices that splits add
            *out_points = number(0x200);
            *out_faces = number(0x200);
        } else {
            *out_faces = number(0x202);
            *out_points = number(0x202);
        }
        return at_ <= bytes_.size;
    }

  private:
    // Four bytes before the version, groups of seven bits from it on.
    uint64_t number(int since)
    {
        uint64_t value = 0;
        for (unsigned shift = 0; shift < 35; shift += version_ < since ? 8 : 7) {
            if (at_ >= bytes_.size || (version_ < since && shift == 32)) {
                at_ += at_ >= bytes_.size;
                break;
            }
            const uint64_t byte = bytes_.data[at_++];
            value |= (version_ < since ? byte : byte & 0x7f) << shift;
            if (version_ >= since && !(byte & 0x80))
                break;
        }
        return value;
    }

    packed_bytes bytes_;
    int version_ = 0;
    size_t at_ = 0;
};

packed_bytes find_view(const gltf_owner &owner, const gltf_object &primitive, int index)
{
    if (index < 0 || static_cast<size_t>(index) >= owner.buffer_views.size())
        primitive.fail("buffer view " + std::to_string(index) + " does not exist");
    const gltf_buffer_view &view = owner.buffer_views[static_cast<size_t>(index)];
    if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= owner.buffers.size())
        primitive.fail("buffer " + std::to_string(view.buffer) + " does not exist");
    const gltf_buffer &buffer = owner.buffers[static_cast<size_t>(view.buffer)];
    if (view.offset > buffer.size || view.length > buffer.size - view.offset)
        primitive.fail("its packed bytes do not lie in their buffer");
    return {buffer.data + view.offset, view.length};
}

std::unique_ptr<draco::Mesh> decode(packed_bytes bytes, gltf_source *source, const gltf_object &primitive)
{
    uint64_t faces = 0, points = 0;
    if (!header(bytes).read(&faces, &points))
        primitive.fail("its Draco data is no mesh");
    const uint64_t face_bytes = 48, point_bytes = 64; // with the decoder's tables
    charge(source, faces * face_bytes + points * point_bytes, primitive.name() + ", unpacked,");
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char *>(bytes.data), bytes.size);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        primitive.fail("Draco cannot decode it: " + decoded.status().error_msg_string());
    return std::move(decoded).value();
}

// A new buffer and a view of all of it.
int add_view(gltf_owner *owner, gltf_source *source, const gltf_object &primitive, size_t size, size_t stride,
             uint8_t **out_data)
{
    charge(source, size, primitive.name() + ", unpacked,");
    *out_data = owner->keep(static_cast<uint8_t *>(std::malloc(size + 1)));
    owner->buffers.push_back({*out_data, size});
    owner->buffer_views.push_back({static_cast<int>(owner->buffers.size()) - 1, 0, size, stride});
    source->document->source_bytes += size;
    return static_cast<int>(owner->buffer_views.size()) - 1;
}

template <typename T>
bool convert(const draco::Mesh &mesh, const draco::PointAttribute &from, int components, size_t stride, uint8_t *out)
{
    T values[16] = {};
    for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
        if (!from.ConvertValue<T>(from.mapped_index(i), static_cast<int8_t>(components), values))
            return false;
        memcpy(out, values, static_cast<size_t>(components) * sizeof(T));
        out += stride;
    }
    return true;
}

bool convert(const draco::Mesh &mesh, const draco::PointAttribute &from, const gltf_accessor &to, size_t stride,
             uint8_t *out)
{
    const int components = to.rows * to.columns;
    switch (to.component_type) {
    case GLTF_BYTE:
        return convert<int8_t>(mesh, from, components, stride, out);
    case GLTF_UNSIGNED_BYTE:
        return convert<uint8_t>(mesh, from, components, stride, out);
    case GLTF_SHORT:
        return convert<int16_t>(mesh, from, components, stride, out);
    case GLTF_UNSIGNED_SHORT:
        return convert<uint16_t>(mesh, from, components, stride, out);
    case GLTF_UNSIGNED_INT:
        return convert<uint32_t>(mesh, from, components, stride, out);
    case GLTF_FLOAT:
        return convert<float>(mesh, from, components, stride, out);
    default:
        return false;
    }
}

gltf_accessor *find_accessor(gltf_owner *owner, const gltf_object &primitive, int index)
{
    if (index < 0 || static_cast<size_t>(index) >= owner->accessors.size())
        primitive.fail("accessor " + std::to_string(index) + " does not exist");
    return &owner->accessors[static_cast<size_t>(index)];
}

void fill_attribute(gltf_owner *owner, gltf_source *source, const gltf_object &primitive, const draco::Mesh &mesh,
                    gltf_accessor *to, int id)
{
    const draco::PointAttribute *from = id < 0 ? nullptr : mesh.GetAttributeByUniqueId(static_cast<uint32_t>(id));
    if (!from)
        primitive.fail("its Draco data has no attribute " + std::to_string(id));
    uint8_t *data = nullptr;
    const size_t size =
        static_cast<size_t>(to->rows) * static_cast<size_t>(to->columns) * gltf_component_size(to->component_type);
    const size_t stride = (size + 3) / 4 * 4; // as glTF asks of vertices
    to->buffer_view = add_view(owner, source, primitive, mesh.num_points() * stride, stride, &data);
    to->offset = 0;
    to->count = mesh.num_points();
    if (!size || !convert(mesh, *from, *to, stride, data))
        primitive.fail("attribute " + std::to_string(id) + " of its Draco data does not fit its accessor");
}

void fill_indices(gltf_owner *owner, gltf_source *source, const gltf_object &primitive, const draco::Mesh &mesh,
                  gltf_accessor *to)
{
    uint8_t *data = nullptr;
    to->buffer_view = add_view(owner, source, primitive, static_cast<size_t>(mesh.num_faces()) * 12, 0, &data);
    to->offset = 0;
    to->count = static_cast<size_t>(mesh.num_faces()) * 3;
    to->component_type = GLTF_UNSIGNED_INT;
    for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i)
        for (const draco::PointIndex &corner : mesh.face(i)) {
            const uint32_t index = corner.value();
            memcpy(data, &index, sizeof index);
            data += sizeof index;
        }
}

// Accessors that primitives share are filled once, by the view that packs them.
using filled_accessors = std::map<int, int>;

void unpack(gltf_owner *owner, gltf_source *source, const gltf_object &primitive, filled_accessors *filled)
{
    const gltf_object extension = primitive.extension("KHR_draco_mesh_compression");
    const gltf_object attributes = primitive.object("attributes");
    const int view = extension.index("bufferView");
    std::unique_ptr<draco::Mesh> mesh;
    const auto needs = [&](int accessor) {
        const auto found = filled->find(accessor);
        if (found != filled->end() && found->second == view)
            return false;
        if (!mesh)
            mesh = decode(find_view(*owner, primitive, view), source, primitive);
        (*filled)[accessor] = view;
        return true;
    };
    const gltf_object ids = extension.object("attributes");
    for (const auto &item : ids.value().items()) {
        const int accessor = attributes.index(item.key().c_str());
        if (accessor != -1 && needs(accessor))
            fill_attribute(owner, source, primitive, *mesh, find_accessor(owner, primitive, accessor),
                           ids.index(item.key().c_str()));
    }
    const int indices = primitive.index("indices");
    if (indices != -1 && needs(indices))
        fill_indices(owner, source, primitive, *mesh, find_accessor(owner, primitive, indices));
}

#else

struct filled_accessors {
};

// Only where the extension is not required, so that the accessors may have unpacked bytes, too.
void unpack(gltf_owner *owner, gltf_source *, const gltf_object &primitive, filled_accessors *)
{
    const int positions = primitive.object("attributes").index("POSITION");
    if (positions < 0 || static_cast<size_t>(positions) >= owner->accessors.size() ||
        owner->accessors[static_cast<size_t>(positions)].buffer_view < 0)
        primitive.fail("it needs Draco, which this program was built without (Debian: libdraco-dev)");
}

#endif

} // namespace

void gltf_unpack_primitives(gltf_owner *owner, gltf_source *source, const gltf_object &root)
{
    filled_accessors filled;
    const json &meshes = root.list("meshes");
    for (size_t i = 0; i < meshes.size(); ++i) {
        const std::string name = "mesh " + std::to_string(i);
        for (const json &entry : gltf_object(meshes[i], name).list("primitives")) {
            const gltf_object primitive(entry, name);
            if (primitive.uses("KHR_draco_mesh_compression"))
                unpack(owner, source, primitive, &filled);
        }
    }
}
