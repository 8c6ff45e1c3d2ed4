/* SPDX-License-Identifier: MIT
 *
 * Images: found, measured and decoded only for what is drawn. Only PNG and JPEG, as glTF says: what else the decoder
 * would take never reaches it, nor does an image whose header asks for more pixels than allowed.
 */
#include "gltf_decode.h"

#include <string.h>

#include "gltf_loader.h"

enum { MOST_SIDE = 16384 };

static unsigned read_be16(const uint8_t *at)
{
    return (unsigned)at[0] << 8 | at[1];
}

/* The size stands in the first chunk. */
static bool measure_png(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    static const uint8_t magic[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    if (size < 33 || memcmp(data, magic, sizeof magic) != 0 || memcmp(data + 12, "IHDR", 4) != 0)
        return false;
    /* More than 16 bits is too large whatever the rest says. */
    *out_width = read_be16(data + 16) ? UINT16_MAX : read_be16(data + 18);
    *out_height = read_be16(data + 20) ? UINT16_MAX : read_be16(data + 22);
    return true;
}

/* Every frame header is looked at, not only the first, since the decoder may take another: the largest counts. */
static bool measure_jpeg(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    *out_width = *out_height = 0;
    if (size < 4 || data[0] != 0xff || data[1] != 0xd8)
        return false;
    for (size_t at = 2; at + 9 <= size; ++at) {
        const uint8_t marker = data[at + 1];
        /* SOF0 to SOF15 but for DHT, JPG and DAC, which share the range. */
        if (data[at] != 0xff || marker < 0xc0 || marker > 0xcf || marker == 0xc4 || marker == 0xc8 || marker == 0xcc)
            continue;
        /* Frame headers are 8 bytes and 3 for each of 1 to 4 components: entropy-coded data has no such marker. */
        const unsigned length = read_be16(data + at + 2);
        if (length < 11 || length > 20)
            continue;
        const unsigned height = read_be16(data + at + 5), width = read_be16(data + at + 7);
        *out_height = height > *out_height ? height : *out_height;
        *out_width = width > *out_width ? width : *out_width;
    }
    return *out_width && *out_height;
}

/* Fails with a fault that names the image by number and name. */
static int fail_image(gltf_loader *l, int number, const char *what)
{
    const char *name = l->document->images[number].name;
    scene_fail(l->fault, *name ? "image %d (%.120s): %s" : "image %d%s: %s", number, name, what);
    return -1;
}

int gltf_add_image(gltf_loader *l, int number)
{
    const gltf_document *d = l->document;
    const gltf_image *from = &d->images[number];
    if (l->image_map[number] >= 0)
        return l->image_map[number];
    const uint8_t *data = from->encoded;
    size_t size = from->encoded_size;
    if (from->buffer_view >= 0) {
        const gltf_buffer_view *view = &d->buffer_views[from->buffer_view];
        data = d->buffers[view->buffer].data + view->offset;
        size = view->length;
    }
    if (!data)
        return fail_image(l, number, "it is missing, or not a file in the glTF file's folder");
    unsigned width = 0, height = 0;
    if (!measure_png(data, size, &width, &height) && !measure_jpeg(data, size, &width, &height))
        return fail_image(l, number, "neither a PNG nor a JPEG");
    if (width > MOST_SIDE || height > MOST_SIDE)
        return fail_image(l, number, "too large, more than 16384 pixels on a side");
    if ((uint64_t)width * height > l->pixels_left)
        return fail_image(l, number, "too many pixels in all images together");
    scene_image image = {0};
    if (!gltf_decode_image(data, size, &image.width, &image.height, &image.rgba))
        return fail_image(l, number, "it cannot be decoded");
    l->pixels_left -= (uint64_t)width * height;
    return l->image_map[number] = scene_builder_add_image(l->builder, &image);
}
