/* SPDX-License-Identifier: MIT
 *
 * What has to hold before tinygltf may see a file: it is a regular file of a sane size, a GLB's chunks lie inside it,
 * and its JSON is neither nested so deeply nor so full that parsing would take the stack or the memory.
 */
#ifndef GLSSAO_EXAMPLES_GLTF_FILE_H
#define GLSSAO_EXAMPLES_GLTF_FILE_H

#include <stddef.h>
#include <stdint.h>

#include "scene_fault.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gltf_file {
    uint8_t *data;
    size_t size;       /* what tinygltf is to see: without chunks it does not know */
    bool binary;       /* GLB */
    size_t json_begin; /* where the JSON lies in `data` */
    size_t json_size;
    size_t bin_size; /* of the GLB's BIN chunk */
} gltf_file;

/* Reads a .gltf or .glb file, told apart by its first bytes, and checks it. The caller frees `data`. */
bool gltf_file_open(gltf_file *out, const char *path, scene_fault *fault);

/* Where the name part of a path begins. */
const char *gltf_file_name(const char *path);

/* Whether a decoded URI names a file in the glTF file's own folder or below: relative, no scheme, no "..". */
bool gltf_uri_is_local(const char *uri);

#ifdef __cplusplus
}
#endif
#endif
