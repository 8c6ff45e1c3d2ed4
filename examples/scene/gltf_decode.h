/* SPDX-License-Identifier: MIT
 *
 * Decodes an image with what tinygltf brings along.
 */
#ifndef GLSSAO_EXAMPLES_GLTF_DECODE_H
#define GLSSAO_EXAMPLES_GLTF_DECODE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* RGBA, 8 bits a channel, rows top to bottom, in memory for free(). False where it cannot be decoded. */
bool gltf_decode_image(const uint8_t *data, size_t size, int *out_width, int *out_height, uint8_t **out_rgba);

#ifdef __cplusplus
}
#endif
#endif
