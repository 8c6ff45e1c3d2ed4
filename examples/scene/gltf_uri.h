/* SPDX-License-Identifier: MIT
 *
 * URIs in glTF files: data URIs, and names of files beside the glTF file.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

bool gltf_uri_is_data(const char *uri);

/* Decodes a data URI (RFC 2397) into memory for free(), which is not NULL for zero bytes. The media type and its
 * parameters are ignored, since files get them wrong. NULL if the text is not base64, or without memory. */
uint8_t *gltf_uri_decode_data(const char *uri, size_t *out_size);

/* The path, in memory for free(), of the file that a relative URI names, `folder` being "" or ending in a slash.
 * Percent signs are decoded where two hexadecimal digits follow and the decoded name exists; ".." is resolved in the
 * text. A name that leads out of `folder` is allowed where `root` (may be NULL) holds the file it leads to. NULL where
 * the URI has a scheme, is absolute, leads elsewhere, or memory is short. */
char *gltf_uri_find_file(const char *uri, const char *folder, const char *root);

#ifdef __cplusplus
}
#endif
