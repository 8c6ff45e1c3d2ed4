/* SPDX-License-Identifier: MIT
 *
 * Loads a glTF file: opens and checks the document, sets the limits, builds the scene, cleans up.
 */
#include <stdlib.h>

#include "gltf_file.h"
#include "gltf_loader.h"

enum { MOST_VERTICES = 1 << 25, MOST_PIXELS = 1 << 28 };

static uint64_t smaller(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

/* The file's size sets most limits: instances aside, what is in memory is some times what is on disk at most, and
 * some ten megabytes. */
static void set_limits(gltf_loader *l)
{
    const uint64_t bytes = l->document->source_bytes;
    l->vertices_left = smaller((1u << 20) + 4 * bytes, MOST_VERTICES);
    l->indices_left = 4 * l->vertices_left;
    l->reads_left = 16 * l->vertices_left;
    l->pixels_left = smaller((1u << 24) + 64 * bytes, MOST_PIXELS);
}

/* `count` numbers, all -1. */
static int *make_map(gltf_loader *l, size_t count)
{
    int *map = malloc((count + 1) * sizeof *map);
    if (!map)
        scene_fail_memory(l->fault);
    for (size_t i = 0; map && i < count; ++i)
        map[i] = -1;
    return map;
}

bool gltf_loader_begin(gltf_loader *l)
{
    const gltf_document *d = l->document;
    set_limits(l);
    l->default_material = -1;
    l->material_map = make_map(l, d->material_count);
    l->texture_map = make_map(l, d->texture_count);
    l->image_map = make_map(l, d->image_count);
    l->mesh_map = make_map(l, d->mesh_count);
    l->world_from_node = calloc(d->node_count + 1, sizeof *l->world_from_node);
    if (!l->world_from_node)
        scene_fail_memory(l->fault);
    return !l->fault->set;
}

void gltf_loader_end(gltf_loader *l)
{
    gltf_free_vertices(&l->recent);
    free(l->world_from_node);
    free(l->mesh_map);
    free(l->image_map);
    free(l->texture_map);
    free(l->material_map);
}

static scene *load(const char *path, const double *time_s, char *error, size_t error_size)
{
    scene_fault fault = {.file = path, .text = error, .size = error_size};
    gltf_document document;
    scene_builder builder;
    scene *made = NULL;
    if (!gltf_document_open(&document, path, &fault))
        return NULL;
    if (gltf_check(&document, &fault) && scene_builder_begin(&builder, gltf_file_name(path), &fault)) {
        gltf_loader loader = {.document = &document, .builder = &builder, .fault = &fault};
        gltf_pose pose = {0};
        if (gltf_loader_begin(&loader) && (!time_s || gltf_animate(&loader, &document, *time_s, &pose)) &&
            gltf_place_nodes(&loader) && gltf_add_scene(&loader))
            made = scene_builder_finish(&builder);
        else
            scene_builder_abandon(&builder);
        gltf_loader_end(&loader);
        gltf_free_pose(&pose);
    }
    gltf_document_close(&document);
    return made;
}

scene *scene_load(const char *path, char *error, size_t error_size)
{
    return load(path, NULL, error, error_size);
}

scene *scene_load_at(const char *path, double time_s, char *error, size_t error_size)
{
    return load(path, &time_s, error, error_size);
}
