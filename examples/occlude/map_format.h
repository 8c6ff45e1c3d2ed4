/* SPDX-License-Identifier: MIT
 *
 * What map_file.c and the readers of the formats share; nobody else includes it.
 */
#pragma once

#include "map_file.h"

#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { MAP_LARGEST_SIDE = 65536 };

typedef struct map_reader {
    FILE *file; /* at its beginning */
    const char *path;
    int wanted; /* channels; 0: any. A format that names its channels looks for these */
    char *error;
    size_t error_size;
} map_reader;

/* Writes "PATH: ..." to the reader's error and returns false. */
bool map_fail(const map_reader *r, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/* Checks size and channels, fills them in, and allocates the values. */
bool map_allocate(const map_reader *r, long long width, long long height, long long channels, map_file *out_map);

/* Reads the rest of the file, which must be exactly `size` bytes; the caller frees. NULL with the reason in the error.
 */
uint8_t *map_read_rest(const map_reader *r, size_t size);

typedef enum map_number { MAP_UNSIGNED, MAP_SIGNED, MAP_FLOAT } map_number;

/* `size` bytes (1, 2, 4; 4 and, for floats, 8) as a number. */
float map_decode(const uint8_t *bytes, map_number kind, int size, bool big_endian);

bool map_read_pfm(const map_reader *r, map_file *out_map);
bool map_read_png(const map_reader *r, map_file *out_map);
bool map_read_npy(const map_reader *r, map_file *out_map);
bool map_read_exr(const map_reader *r, map_file *out_map);

#ifdef __cplusplus
}
#endif
