/* SPDX-License-Identifier: MIT
 *
 * Images: found, measured and decoded only for what is drawn. Only PNG and JPEG, as glTF says: what else the decoder
 * would take never reaches it, nor does an image whose header asks for more pixels than allowed.
 */
#include "gltf_decode.h"
#include "gltf_loader.h"
#include "image_header.h"

enum { MOST_SIDE = 16384 };

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
    if (!image_measure(data, size, &width, &height))
        return fail_image(l, number, "neither a sound PNG nor a JPEG");
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
