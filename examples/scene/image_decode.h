/* SPDX-License-Identifier: MIT
 *
 * Decodes PNG, JPEG and, where this was built with libwebp, WebP.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* RGBA, 8 bits a channel, rows top to bottom, in memory for free(). Colour profiles and gamma are ignored, as glTF
 * asks. False where it cannot be decoded; the caller has looked at the size with image_measure. */
bool image_decode(const uint8_t *data, size_t size, int *out_width, int *out_height, uint8_t **out_rgba);
