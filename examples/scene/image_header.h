/* SPDX-License-Identifier: MIT
 *
 * Finds an image's kind and size from its first bytes, before a decoder sees it.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum image_kind {
    IMAGE_UNKNOWN,
    IMAGE_PNG,
    IMAGE_JPEG,
    IMAGE_WEBP,
    IMAGE_KTX2,
    IMAGE_AVIF,
    IMAGE_DDS
} image_kind;

image_kind image_find_kind(const uint8_t *data, size_t size);

/* The size in pixels of a PNG, a JPEG (the largest that it names) or a WebP. False for other kinds, and where the head
 * is damaged. */
bool image_measure(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height);
