/* SPDX-License-Identifier: MIT
 *
 * A glTF file's bytes: its JSON, and the BIN chunk of a GLB. Whatever is found here lies inside the file, and the JSON
 * is neither nested so deeply nor so full that parsing it would take the stack or the memory.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "fault.h"
#include "memory_budget.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gltf_file {
    uint8_t *data;
    size_t size;
    bool binary;                  /* GLB */
    bool unaligned;               /* a chunk's length is no multiple of 4 */
    size_t json_begin, json_size; /* in `data` */
    size_t bin_begin, bin_size;   /* of the GLB's BIN chunk; 0: no such chunk */
} gltf_file;

/* Reads a regular file of at most `limit` bytes, or standard input if the path is "-". The caller frees the result,
 * which is not NULL for an empty file. NULL on failure, with the reason in words. Git LFS pointers, HTML pages, gzip
 * and ZIP files are refused. */
uint8_t *gltf_read_file(const char *path, uint64_t limit, size_t *out_size, const char **out_reason);

/* Reads a .gltf or .glb file, told apart by its first bytes, and checks it. The caller frees `data`. */
bool gltf_file_open(gltf_file *out, const char *path, memory_budget *budget, failure *fault);

/* Where the name part of a path begins. */
const char *gltf_file_name(const char *path);

#ifdef __cplusplus
}
#endif
