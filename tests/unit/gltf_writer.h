/* SPDX-License-Identifier: MIT
 *
 * Writes small glTF files for tests into a temporary folder, which is removed at the end, and loads them. JSON may
 * have ' in the place of ".
 */
#pragma once

#include "scene.h"

#include <stddef.h>
#include <stdint.h>

typedef struct gltf_writer {
    uint8_t bin[8192]; /* one buffer for everything */
    size_t size;
    char views[4096], accessors[8192]; /* JSON, with a comma after each element */
    int view_count, accessor_count;
} gltf_writer;

extern const float gltf_triangle[9]; /* (0, 0, 0), (1, 0, 0), (0, 1, 0) */
/* A mesh of accessor 0, and a node that draws it. */
#define GLTF_MESH "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]"
#define GLTF_NODE "'nodes':[{'mesh':0}]"
/* The URI of a picture of 2 x 1 pixels, red and blue. */
#define GLTF_RED_BLUE                                                                                                  \
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR42mP4zwAE/wEHAAH/"                   \
    "PX2MSQAAAABJRU5ErkJggg=="

/* Group setup and teardown for cmocka. */
int gltf_writer_setup(void **state);
int gltf_writer_teardown(void **state);

/* The path of this name in the temporary folder; valid until the second next call. */
const char *gltf_writer_path(const char *name);

/* One that has gltf_triangle as accessor 0. */
gltf_writer gltf_begin(void);

/* Adds a buffer view with these bytes, 4-byte aligned, and returns its index. Stride 0: none. */
int gltf_put_view(gltf_writer *w, const void *data, size_t bytes, int stride);

/* Adds an accessor of that view (-1: none) and returns its index. `more` is further JSON that begins with a comma, or
 * "". */
int gltf_put_accessor(gltf_writer *w, int view, int component_type, const char *type, size_t count, const char *more);

/* View and accessor in one, of float vectors: "VEC3" and so on. */
int gltf_put_floats(gltf_writer *w, const char *type, size_t count, const float *values);

/* Writes the collected parts and the rest of the JSON, and returns the path. If `rest` is a whole file, `w` is NULL. */
const char *gltf_write(const gltf_writer *w, const char *name, const char *rest);
const char *gltf_write_glb(const gltf_writer *w, const char *name, const char *rest);

/* Writes any bytes and returns the path. */
const char *gltf_write_bytes(const char *name, const void *data, size_t size);

/* The scene of a file that must load and be valid, until the test ends. Options may be NULL. */
scene *gltf_scene(const char *path, const scene_load_options *options);
