/* SPDX-License-Identifier: MIT
 *
 * The images of materials that are drawn. An image that is missing or cannot be decoded is left out with a
 * warning, and the material keeps its factor alone.
 */
#include "gltf_decoding.h"
#include "image_header.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SIDE = 16384 };

typedef struct image_bytes {
    const uint8_t *data;
    size_t size;
} image_bytes;

static image_bytes find_bytes(const gltf_document *d, const gltf_image *from)
{
    if (from->buffer_view < 0)
        return (image_bytes){from->encoded, from->encoded_size};
    const gltf_buffer_view *view = &d->buffer_views[from->buffer_view];
    return (image_bytes){d->buffers[view->buffer].data + view->offset, view->length};
}

/* Why this build cannot decode images of that kind; NULL if it can. */
static const char *find_obstacle(image_kind kind)
{
    switch (kind) {
    case IMAGE_PNG:
    case IMAGE_JPEG:
        return NULL;
    case IMAGE_WEBP:
        return GLSSAO_HAS_WEBP ? NULL
                               : "WebP needs libwebp, which this program was built without (Debian: libwebp-dev)";
    case IMAGE_KTX2:
        return "KTX 2 with Basis Universal, which this program has no decoder for";
    case IMAGE_AVIF:
        return "AVIF, which this program has no decoder for";
    case IMAGE_DDS:
        return "DDS, which this program has no decoder for";
    default:
        return "neither PNG, JPEG nor WebP";
    }
}

const char *gltf_find_image(gltf_loader *l, int image, gltf_encoded *out)
{
    const gltf_image *from = &l->document->images[image];
    const image_bytes bytes = find_bytes(l->document, from);
    if (!bytes.data)
        return from->fault ? from->fault : "it has no bytes";
    const char *obstacle = find_obstacle(image_find_kind(bytes.data, bytes.size));
    unsigned width = 0, height = 0;
    if (obstacle)
        return obstacle;
    if (!image_measure(bytes.data, bytes.size, &width, &height))
        return "its head is damaged";
    if (width > MOST_SIDE || height > MOST_SIDE)
        return "too large, more than 16384 pixels on a side";
    *out = (gltf_encoded){bytes.data, bytes.size, (uint64_t)width * height};
    memory_budget_charge(&l->document->budget, 4 * out->pixels, "the file's images", l->fault);
    return NULL;
}

bool gltf_add_image(gltf_loader *l, int number, int *out_image)
{
    enum { LEFT_OUT = -2 };
    int *made = &l->image_map[number];
    *out_image = *made >= 0 ? *made : -1;
    if (*made >= 0 || *made == LEFT_OUT)
        return true;
    const gltf_image *from = &l->document->images[number];
    scene_image image = {0};
    const char *fault = gltf_decoding_take(l, number, &image);
    if (l->fault->set)
        return false;
    if (fault) {
        *made = LEFT_OUT;
        return scene_warn(l->document->warnings, l->fault, *from->name ? "image %d (%.120s): %s" : "image %d%s: %s",
                          number, from->name, fault);
    }
    *made = *out_image = scene_builder_add_image(l->builder, &image);
    return *made >= 0;
}
