// SPDX-License-Identifier: MIT
//
// EXT_meshopt_compression: decodes each packed buffer view into a buffer of its own, so that the rest of the loader
// sees an ordinary file.
#include "gltf_owner.h"

#if GLSSAO_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace
{

const char *const names[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

#if GLSSAO_HAS_MESHOPT

// Decodes; NULL, or what is wrong.
const char *decode(const std::string &mode, uint8_t *out, size_t count, size_t stride, const uint8_t *data, size_t size)
{
    const char *damaged = "its packed bytes are damaged, or of a newer version than meshoptimizer knows here";
    if (mode == "ATTRIBUTES") {
        if (stride == 0 || stride > 256 || stride % 4)
            return "a byteStride that is no multiple of 4 up to 256";
        return meshopt_decodeVertexBuffer(out, count, stride, data, size) ? damaged : nullptr;
    }
    if (stride != 2 && stride != 4)
        return "indices that are neither 2 nor 4 bytes";
    if (mode == "TRIANGLES") {
        if (count % 3)
            return "a count of indices that makes no triangles";
        return meshopt_decodeIndexBuffer(out, count, stride, data, size) ? damaged : nullptr;
    }
    if (mode == "INDICES")
        return meshopt_decodeIndexSequence(out, count, stride, data, size) ? damaged : nullptr;
    return "a mode that is not known";
}

const char *apply_filter(const std::string &filter, uint8_t *data, size_t count, size_t stride)
{
    if (filter == "NONE")
        return nullptr;
    if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
        meshopt_decodeFilterOct(data, count, stride);
    else if (filter == "QUATERNION" && stride == 8)
        meshopt_decodeFilterQuat(data, count, stride);
    else if (filter == "EXPONENTIAL" && stride % 4 == 0)
        meshopt_decodeFilterExp(data, count, stride);
    else
        return "a filter that is not known, or not with its byteStride";
    return nullptr;
}

void unpack(gltf_owner *owner, gltf_source *source, const gltf_object &packed, gltf_buffer_view *view)
{
    const int index = packed.index("buffer");
    const size_t offset = packed.size("byteOffset", 0), length = packed.size("byteLength", 0);
    const size_t count = packed.size("count", 0), stride = packed.size("byteStride", 0);
    if (index < 0 || static_cast<size_t>(index) >= owner->buffers.size())
        packed.fail("buffer " + std::to_string(index) + " does not exist");
    const gltf_buffer from = owner->buffers[static_cast<size_t>(index)];
    if (offset > from.size || length > from.size - offset)
        packed.fail("its packed bytes do not lie in their buffer");
    if (!stride || count > SIZE_MAX / 2 / stride)
        packed.fail("its count or byteStride is out of range");
    charge(source, count * stride, packed.name() + ", unpacked,");
    uint8_t *data = owner->keep(static_cast<uint8_t *>(std::malloc(count * stride + 1)));
    const std::string mode = packed.text("mode", ""), filter = packed.text("filter", "NONE");
    const char *fault = decode(mode, data, count, stride, from.data + offset, length);
    fault = fault || mode != "ATTRIBUTES" ? fault : apply_filter(filter, data, count, stride);
    if (fault)
        packed.fail(fault);
    owner->buffers.push_back({data, count * stride});
    *view = {static_cast<int>(owner->buffers.size()) - 1, 0, count * stride, mode == "ATTRIBUTES" ? stride : 0};
    source->document->source_bytes += count * stride;
}

#else

// Only where the extension is not required, so that the view may have unpacked bytes, too.
void unpack(gltf_owner *owner, gltf_source *, const gltf_object &packed, gltf_buffer_view *view)
{
    if (view->buffer < 0 || static_cast<size_t>(view->buffer) >= owner->buffers.size() ||
        !owner->buffers[static_cast<size_t>(view->buffer)].data)
        packed.fail("it needs meshoptimizer, which this program was built without (Debian: libmeshoptimizer-dev)");
}

#endif

} // namespace

void gltf_unpack_views(gltf_owner *owner, gltf_source *source, const gltf_object &root)
{
    const json &views = root.list("bufferViews");
    for (size_t i = 0; i < views.size(); ++i) {
        const gltf_object view(views[i], "buffer view " + std::to_string(i));
        for (const char *name : names)
            if (view.uses(name))
                unpack(owner, source, view.extension(name), &owner->buffer_views[i]);
    }
}
