/* SPDX-License-Identifier: MIT
 *
 * Images that are decoded ahead of their use.
 */
#pragma once

#include "gltf_loader.h"

#define GLTF_NOT_DECODED "it cannot be decoded"

typedef struct gltf_encoded {
    const uint8_t *data;
    size_t size;
    uint64_t pixels;
} gltf_encoded;

/* gltf_image.c: the bytes of an image that this program can decode, charged to the budget; otherwise why there are
 * none. The fault is set where the whole file fails. */
const char *gltf_find_image(gltf_loader *l, int image, gltf_encoded *out);

/* False where it cannot be decoded. */
bool gltf_decode(gltf_encoded encoded, scene_image *out);

/* Starts to decode the images that the shown nodes use. gltf_decoding_end is due in either case. False, with the fault
 * set, where the file fails. */
bool gltf_decoding_begin(gltf_loader *l);
void gltf_decoding_end(gltf_decoding *d);

/* The image, to be asked for once, waiting for it if need be: it is the caller's. Otherwise why there is none, or the
 * fault is set. */
const char *gltf_decoding_take(gltf_loader *l, int image, scene_image *out);
