/* SPDX-License-Identifier: MIT
 *
 * Writes and reads pictures: PNG, JPEG, WebP, and PFM (Portable Float Map, little-endian float32) for linear data. Rows
 * go from bottom to top, as OpenGL reads them.
 */
#pragma once

#include "fault.h"

#include <stdbool.h>
#include <stdint.h>

/* PNG with 8 bits a channel; channels 1 (grey), 3 (RGB) or 4 (RGBA). False, with one line in `error`, on failure. The
 * file appears whole or not at all (whole_file.h). Any thread. */
bool picture_write_png(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault);

/* JPEG (quality 92, colour at full resolution): channels 1 or 3. */
bool picture_write_jpeg(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault);

/* Whether the program was built with libwebp. */
bool picture_has_webp(void);
/* WebP (quality 92): channels 3 or 4. Fails if the program was built without libwebp. */
bool picture_write_webp(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault);

/* Writes the format of the extension: .jpg, .jpeg or .webp; PNG for all others and for "-", standard output. */
bool picture_write(const char *path, int width, int height, int channels, const uint8_t *pixels, failure *fault);

/* channels 1 ("Pf") or 3 ("PF"). */
bool picture_write_pfm(const char *path, int width, int height, int channels, const float *pixels, failure *fault);

/* Reads a file that picture_write_pfm wrote. The caller frees the pixels. NULL, with one line in `error`, on failure.
 */
float *picture_read_pfm(const char *path, int *out_width, int *out_height, int *out_channels, failure *fault);

/* Reads an 8-bit PNG as RGBA, rows bottom to top. The caller frees the pixels. NULL, with one line in `error`, on
 * failure. */
uint8_t *picture_read_png(const char *path, int *out_width, int *out_height, failure *fault);
