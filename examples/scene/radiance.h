/* SPDX-License-Identifier: MIT
 *
 * Radiance's picture format (.hdr, .pic) after Ward 1991, "Real Pixels", and the file format's own description: colours
 * of three mantissas and a common exponent, rows from the top, flat or in runs. No OpenGL.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A file in memory, read row by row; it must outlive the reader. */
typedef struct radiance {
    const uint8_t *data;
    size_t size, at;
    int width, height;
} radiance;

/* Reads the head. False where the file is of another kind, has no size from 1 to 65535 a side, or is laid out other
 * than from the top row down and from left to right. */
bool radiance_open(radiance *r, const uint8_t *data, size_t size);

/* The next row: linear RGB, `width` of them; `scratch` has room for 4 bytes of each. False where the file is cut off or
 * damaged. */
bool radiance_read_row(radiance *r, uint8_t *scratch, float *out_rgb);
