/* SPDX-License-Identifier: MIT
 *
 * What a PNG or JPEG says of itself, before a decoder may see it.
 */
#ifndef GLSSAO_EXAMPLES_IMAGE_HEADER_H
#define GLSSAO_EXAMPLES_IMAGE_HEADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The size in pixels, of a JPEG the largest that it names. False for other formats, and for a JPEG whose Huffman
 * tables are longer than 256 codes: stb_image before 2.28 writes past its own. */
bool image_measure(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height);

#endif
