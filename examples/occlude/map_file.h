/* SPDX-License-Identifier: MIT
 *
 * Reads depth maps, normal maps and other arrays from PFM, PNG, NumPy's .npy and, where the library was there at build
 * time, OpenEXR. The first bytes of a file tell which it is; its name does not matter. No call crashes on a hostile
 * file: each fails with one line that names the file and the fault.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct map_file {
    int width, height;
    int channels;  /* 1 to 4 */
    int full;      /* the value that stands for 1: 255 or 65535 in a PNG, 1 in files of real numbers */
    float *values; /* width * height * channels, rows from the top; map_file_free frees it */
} map_file;

/* On failure *out_map is zero. */
bool map_file_read(const char *path, map_file *out_map, char *error, size_t error_size);

/* One channel, each value times `scale`. A PNG must have 16 bits: 256 steps are too few for depth. */
bool map_file_read_depth(const char *path, float scale, map_file *out_map, char *error, size_t error_size);

/* Three channels, -1 to 1. A PNG stores 0 to 1 for that, as glssao-render --normals writes it. */
bool map_file_read_normals(const char *path, map_file *out_map, char *error, size_t error_size);

/* A map of zero is fine. */
void map_file_free(map_file *map);
