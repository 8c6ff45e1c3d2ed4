// SPDX-License-Identifier: MIT
//
// Buffers and images: from the BIN chunk, from data URIs, from files beside the glTF file. Images stay
// encoded here.
#include "gltf_owner.h"

#include "gltf_uri.h"

namespace
{

struct found_bytes {
    const uint8_t *data = nullptr;
    size_t size = 0;
    std::string fault; // empty: found
};

std::string shortened(const std::string &text)
{
    return text.size() > 200 ? text.substr(0, 200) + "..." : text;
}

found_bytes read_file(gltf_owner *owner, gltf_source *source, const std::string &uri)
{
    found_bytes out;
    char *path = gltf_uri_find_file(uri.c_str(), source->folder.c_str(), source->root);
    if (!path) {
        out.fault = "'" + shortened(uri) + "' is not a file in the glTF file's folder";
        out.fault += source->root ? " or below --root" : "";
        return out;
    }
    const char *reason = nullptr;
    uint8_t *data = gltf_read_file(path, source->document->budget.left, &out.size, &reason);
    std::free(path);
    if (!data) {
        out.fault = shortened(uri) + ": " + reason;
        return out;
    }
    out.data = owner->keep(data);
    charge(source, out.size, shortened(uri));
    source->bytes_read += out.size;
    return out;
}

found_bytes find_bytes(gltf_owner *owner, gltf_source *source, const std::string &uri)
{
    if (!gltf_uri_is_data(uri.c_str()))
        return read_file(owner, source, uri);
    found_bytes out;
    charge(source, uri.size(), "a data URI");
    uint8_t *data = gltf_uri_decode_data(uri.c_str(), &out.size);
    if (!data)
        out.fault = "its data URI cannot be decoded";
    else
        out.data = owner->keep(data);
    return out;
}

bool is_placeholder(const gltf_object &buffer)
{
    return buffer.extension("EXT_meshopt_compression").flag("fallback") ||
           buffer.extension("KHR_meshopt_compression").flag("fallback");
}

gltf_buffer read_buffer(gltf_owner *owner, gltf_source *source, const gltf_object &from, bool is_first)
{
    if (!from.find("uri")) {
        // Without a URI only the first buffer is the BIN chunk. A buffer that unpacking fills needs no bytes of its
        // own.
        if (is_first && owner->file.bin_size && !is_placeholder(from))
            return {owner->file.data + owner->file.bin_begin, owner->file.bin_size};
        return {nullptr, 0};
    }
    const found_bytes found = find_bytes(owner, source, from.text("uri", ""));
    if (!found.fault.empty())
        from.fail(found.fault);
    return {found.data, found.size};
}

} // namespace

void gltf_read_buffers(gltf_owner *owner, gltf_source *source, const gltf_object &root)
{
    const json &buffers = root.list("buffers");
    for (size_t i = 0; i < buffers.size(); ++i) {
        const gltf_object from(buffers[i], "buffer " + std::to_string(i));
        gltf_buffer buffer = read_buffer(owner, source, from, i == 0);
        const size_t wanted = from.size("byteLength", 0);
        if (buffer.size < wanted && buffer.data)
            from.fail(std::to_string(wanted) + " bytes said, " + std::to_string(buffer.size) + " found");
        owner->buffers.push_back(buffer);
    }
}

void gltf_read_images(gltf_owner *owner, gltf_source *source, const gltf_object &root)
{
    const json &images = root.list("images");
    for (size_t i = 0; i < images.size(); ++i) {
        const gltf_object from(images[i], "image " + std::to_string(i));
        gltf_image out{};
        out.buffer_view = from.index("bufferView");
        const std::string uri = from.text("uri", "");
        const bool is_data = gltf_uri_is_data(uri.c_str());
        out.name = owner->keep(uri.empty() || is_data ? from.text("name", "") : uri);
        if (out.buffer_view == -1) {
            const found_bytes found =
                uri.empty() ? found_bytes{nullptr, 0, "it has no bytes"} : find_bytes(owner, source, uri);
            out.encoded = found.data;
            out.encoded_size = found.size;
            out.fault = found.fault.empty() ? nullptr : owner->keep(found.fault);
        }
        owner->images.push_back(out);
    }
}
