/* SPDX-License-Identifier: MIT
 *
 * Loads a glTF file: opens and checks the document, sets the limits, builds the scene, cleans up.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_decoding.h"
#include "gltf_file.h"
#include "gltf_loader.h"

/* Elements are read again for each primitive that shares them: this bounds the time that a small file may take. */
static void set_limits(gltf_loader *l)
{
    const uint64_t bytes = l->document->source_bytes;
    l->reads_left = 16 * ((1u << 20) + 4 * bytes);
}

/* `count` numbers, all -1. */
static int *make_map(gltf_loader *l, size_t count)
{
    int *map = malloc((count + 1) * sizeof *map);
    if (!map)
        fault_set_memory(l->fault);
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
    l->mesh_map = malloc((d->mesh_count + 1) * sizeof *l->mesh_map);
    l->world_from_node = calloc(d->node_count + 1, sizeof *l->world_from_node);
    l->drawn = calloc(d->node_count + 1, sizeof *l->drawn);
    if (!l->world_from_node || !l->drawn || !l->mesh_map)
        fault_set_memory(l->fault);
    for (size_t i = 0; l->mesh_map && i < d->mesh_count; ++i)
        l->mesh_map[i] = (gltf_mesh_range){.first = -1};
    return !l->fault->set;
}

void gltf_loader_end(gltf_loader *l)
{
    gltf_decoding_end(l->decoding);
    gltf_free_vertices(&l->recent);
    free(l->world_from_node);
    free(l->drawn);
    free(l->mesh_map);
    free(l->image_map);
    free(l->texture_map);
    free(l->material_map);
    free(l->opaque_map);
    free(l->unlit_map);
}

bool gltf_warn_of_omissions(gltf_loader *l)
{
    const gltf_omissions *o = &l->omitted;
    const struct {
        unsigned count;
        const char *one, *more;
    } parts[] = {{o->without_positions, "primitive without positions", "primitives without positions"},
                 {o->empty, "primitive without a whole triangle, line or point",
                  "primitives without a whole triangle, line or point"},
                 {o->flattened, "instance that its transform makes a line or a point",
                  "instances that their transforms make lines or points"},
                 {o->cameras, "camera that cannot see", "cameras that cannot see"}};
    char line[400] = "";
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i)
        if (parts[i].count) {
            const size_t used = strlen(line);
            snprintf(line + used, sizeof line - used, "%s%u %s", used ? ", " : "left out: ", parts[i].count,
                     parts[i].count == 1 ? parts[i].one : parts[i].more);
        }
    const bool empty = !l->builder->made->instance_count;
    return (!*line || scene_warn(l->document->warnings, l->fault, "%s", line)) &&
           (!empty || scene_warn(l->document->warnings, l->fault, "the scene has nothing to draw"));
}

/* Whether a triangle's normals and its winding agree on which side of it is outside; 0: not known. */
static int agreement(const scene *s, const uint32_t *corners)
{
    const scene_vertex *v[3] = {&s->vertices[corners[0]], &s->vertices[corners[1]], &s->vertices[corners[2]]};
    double sides[2][3], dot = 0.0;
    for (int k = 0; k < 2; ++k)
        for (int axis = 0; axis < 3; ++axis)
            sides[k][axis] = (double)v[k + 1]->position[axis] - (double)v[0]->position[axis];
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        const double face = sides[0][next] * sides[1][last] - sides[0][last] * sides[1][next];
        for (int k = 0; k < 3; ++k)
            dot += face * (double)v[k]->normal[axis];
    }
    return dot > 0.0 ? 1 : dot < 0.0 ? -1 : 0;
}

/* Some programs write normals that point inwards. A few thousand triangles of each primitive are enough to tell. */
static bool warn_of_normals(gltf_loader *l)
{
    enum { TRIANGLES = 4096 };
    const scene *s = l->builder->made;
    uint64_t against = 0, seen = 0;
    for (uint32_t i = 0; i < s->primitive_count; ++i) {
        const scene_primitive *p = &s->primitives[i];
        const uint32_t triangles = p->topology == SCENE_TRIANGLES && !p->flat ? p->index_count / 3 : 0;
        const uint32_t stride = 1 + triangles / TRIANGLES;
        for (uint32_t k = 0; k < triangles; k += stride) {
            const int side = agreement(s, &s->indices[p->first_index + 3 * k]);
            against += side < 0 ? stride : 0;
            seen += side != 0 ? stride : 0;
        }
    }
    return against <= seen / 2 ||
           scene_warn(l->document->warnings, l->fault, "most normals point against the winding of their triangles");
}

/* The warnings become the scene's. */
static void hand_over(scene *made, scene_warnings *warnings)
{
    made->warnings = warnings->lines;
    made->warning_count = warnings->count;
    *warnings = (scene_warnings){.lines = NULL};
}

scene *scene_load_with(const char *path, const scene_load_options *options, failure *out_fault)
{
    failure fault = {.file = path, .text = out_fault->text, .size = out_fault->size};
    scene_warnings warnings = {.strict = options && options->strict};
    gltf_document document;
    scene_builder builder;
    scene *made = NULL;
    if (gltf_document_open(&document, path, options, &warnings, &fault)) {
        if (gltf_check(&document, &fault) && scene_builder_begin(&builder, gltf_file_name(path), &fault)) {
            gltf_loader loader = {.document = &document,
                                  .builder = &builder,
                                  .fault = &fault,
                                  .flat_normals = options && options->flat_normals};
            gltf_pose pose = {0};
            const bool timed = options && options->timed;
            if (gltf_loader_begin(&loader) && (!timed || gltf_animate(&loader, &document, options->time_s, &pose)) &&
                gltf_place_nodes(&loader) && gltf_decoding_begin(&loader) && gltf_add_scene(&loader) &&
                gltf_warn_of_omissions(&loader) && warn_of_normals(&loader))
                made = scene_builder_finish(&builder);
            else
                scene_builder_abandon(&builder);
            gltf_loader_end(&loader);
            gltf_free_pose(&pose);
        }
        gltf_document_close(&document);
    }
    if (made)
        hand_over(made, &warnings);
    scene_warnings_free(&warnings);
    return made;
}

scene *scene_load(const char *path, failure *fault)
{
    return scene_load_with(path, NULL, fault);
}
