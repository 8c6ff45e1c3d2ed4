/* SPDX-License-Identifier: MIT
 *
 * Writes small glTF files for tests, into a temporary folder that is removed at the end.
 */
#ifndef GLSSAO_TESTS_GLTF_WRITER_H
#define GLSSAO_TESTS_GLTF_WRITER_H

#include <stddef.h>
#include <stdint.h>

typedef struct gltf_writer {
    uint8_t bin[8192]; /* one buffer holds everything */
    size_t size;
    char views[4096], accessors[8192]; /* JSON, comma after each */
    int view_count, accessor_count;
} gltf_writer;

/* Group setup and teardown for cmocka. */
int gltf_writer_setup(void **state);
int gltf_writer_teardown(void **state);

/* The temporary folder's path with this name appended; lives until the second next call. */
const char *gltf_writer_path(const char *name);

/* A new buffer view that holds these bytes, 4-byte aligned; its index. Stride 0: none. */
int gltf_put_view(gltf_writer *w, const void *data, size_t bytes, int stride);

/* A new accessor of that view (-1: none); `more` is further JSON that begins with a comma, or "". Its index. */
int gltf_put_accessor(gltf_writer *w, int view, int component_type, const char *type, size_t count, const char *more);

/* View and accessor in one, of float vectors: "VEC3" and so on. */
int gltf_put_floats(gltf_writer *w, const char *type, size_t count, const float *values);

/* Writes the file with what was put and the rest of its JSON; the path. With `rest` of a whole file, NULL for `w`. */
const char *gltf_write(const gltf_writer *w, const char *name, const char *rest);
const char *gltf_write_glb(const gltf_writer *w, const char *name, const char *rest);

/* Writes any bytes; the path. */
const char *gltf_write_bytes(const char *name, const void *data, size_t size);

#endif
