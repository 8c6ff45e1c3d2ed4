/* SPDX-License-Identifier: MIT
 *
 * Reads a file's vertices node by node, in the pose that the renderer draws, with the file's own numbering, so that
 * the results can be written back.
 */
#include "bake.h"

#include "gltf_loader.h"

#include <stdlib.h>
#include <string.h>

typedef struct reader {
    gltf_loader loader; /* first: visitors get a pointer to it */
    bake_model *model;
    size_t room; /* allocated parts */
} reader;

/* An earlier part with the same vertices: the same accessors in the same node. */
static bake_part *find_part(bake_model *m, const gltf_mesh *mesh, size_t node, const gltf_primitive *p)
{
    for (size_t i = m->part_count; i-- > 0 && m->parts[i].node == node;) {
        const gltf_primitive *other = &mesh->primitives[m->parts[i].primitives[0]];
        const char *const names[] = {"POSITION", "NORMAL", "COLOR_0"};
        bool same = p->target_count == 0 && other->target_count == 0;
        for (int k = 0; k < 3; k++)
            same = same &&
                   gltf_find_attribute(&p->attributes, names[k]) == gltf_find_attribute(&other->attributes, names[k]);
        if (same)
            return &m->parts[i];
    }
    return NULL;
}

static double (*read_places(reader *r, size_t node, size_t *out_count))[16]
{
    const gltf_node *n = &r->loader.document->nodes[node];
    if (n->instanced && n->skin < 0)
        return gltf_read_instances(&r->loader, node, out_count);
    double(*place)[16] = calloc(1, sizeof *place);
    *out_count = 1;
    if (!place) {
        fault_set_memory(r->loader.fault);
        return NULL;
    }
    if (n->skin >= 0) { /* posed in world space */
        for (int i = 0; i < 16; i += 5)
            place[0][i] = 1;
    } else {
        memcpy(place[0], r->loader.world_from_node[node], sizeof place[0]);
    }
    return place;
}

static bake_part *add_part(reader *r)
{
    bake_model *m = r->model;
    if (m->part_count == r->room) {
        const size_t room = r->room ? 2 * r->room : 64;
        bake_part *parts = realloc(m->parts, room * sizeof *parts);
        if (!parts) {
            fault_set_memory(r->loader.fault);
            return NULL;
        }
        m->parts = parts;
        r->room = room;
    }
    m->parts[m->part_count] = (bake_part){0};
    return &m->parts[m->part_count++];
}

/* Appends; the arrays are few and short. */
static bool add_primitive_number(bake_part *part, size_t number, failure *fault)
{
    size_t *numbers = realloc(part->primitives, (part->primitive_count + 1) * sizeof *numbers);
    if (!numbers)
        return fault_set_memory(fault);
    part->primitives = numbers;
    part->primitives[part->primitive_count++] = number;
    return true;
}

static bool add_triangles(reader *r, bake_part *part, const gltf_primitive *p)
{
    gltf_triangles triangles;
    if (!gltf_make_triangles(&r->loader, p, &triangles))
        return false;
    uint32_t *indices = realloc(part->indices, ((size_t)part->index_count + triangles.count + 1) * sizeof *indices);
    if (indices) {
        part->indices = indices;
        if (triangles.count)
            memcpy(indices + part->index_count, triangles.indices, triangles.count * sizeof *indices);
        part->index_count += triangles.count;
    }
    free(triangles.indices);
    return indices || fault_set_memory(r->loader.fault);
}

/* The loader's arrays become the part's. */
static bool take_vertices(reader *r, bake_part *part, size_t node)
{
    gltf_vertices *v = &r->loader.recent;
    part->node = node;
    part->vertex_count = v->count;
    part->positions = v->positions;
    memcpy(part->center, v->center, sizeof part->center);
    part->normals = v->normals;
    part->colors = v->colors;
    v->positions = NULL;
    v->normals = NULL;
    v->colors = NULL;
    part->world_from_mesh = read_places(r, node, &part->instance_count);
    part->accessibility = malloc((size_t)part->vertex_count * sizeof *part->accessibility + 1);
    return part->world_from_mesh && (part->accessibility || fault_set_memory(r->loader.fault));
}

static bool read_primitive(reader *r, size_t node, const gltf_mesh *mesh, size_t number)
{
    const gltf_primitive *p = &mesh->primitives[number];
    if (p->mode < GLTF_TRIANGLES || gltf_find_attribute(&p->attributes, "POSITION") < 0)
        return true;
    gltf_free_vertices(&r->loader.recent); /* its arrays go to the part: nothing is read twice */
    if (!gltf_read_vertices(&r->loader, p, node, &(gltf_uv_slots){.count = 0}))
        return false;
    bake_part *part = find_part(r->model, mesh, node, p);
    if (!part) {
        part = add_part(r);
        if (!part)
            return false;
        part->node = node;
        if (!add_triangles(r, part, p) || !take_vertices(r, part, node))
            return false;
    } else if (!add_triangles(r, part, p)) {
        return false;
    }
    part->double_sided |= p->material >= 0 && r->loader.document->materials[p->material].double_sided;
    return add_primitive_number(part, number, r->loader.fault);
}

static bool read_branch(gltf_loader *l, size_t node)
{
    reader *r = (reader *)l; /* its first member */
    const gltf_document *d = l->document;
    const gltf_node *n = &d->nodes[node];
    if (l->drawn[node] || n->hidden)
        return true;
    l->drawn[node] = true;
    for (size_t i = 0; n->mesh >= 0 && i < d->meshes[n->mesh].primitive_count; i++)
        if (!read_primitive(r, node, &d->meshes[n->mesh], i))
            return false;
    for (size_t i = 0; i < n->child_count; i++)
        if (!read_branch(l, (size_t)n->children[i]))
            return false;
    return true;
}

scene_load_options bake_load_options(const bake_options *o)
{
    scene_load_options file = o->file;
    file.memory_bytes = (uint64_t)o->memory_mib << 20;
    return file;
}

bool bake_model_open(bake_model *m, const bake_options *o, failure *fault)
{
    const scene_load_options file = bake_load_options(o);
    *m = (bake_model){.warnings = {.strict = file.strict}};
    if (!gltf_document_open(&m->document, o->input, &file, &m->warnings, fault))
        return false;
    reader r = {.loader = {.document = &m->document, .fault = fault}, .model = m};
    if (!gltf_check(&m->document, fault))
        return false;
    const bool ok =
        gltf_loader_begin(&r.loader) && gltf_place_nodes(&r.loader) && gltf_visit_shown(&r.loader, read_branch);
    gltf_loader_end(&r.loader);
    return ok;
}

void bake_model_close(bake_model *m)
{
    for (size_t i = 0; i < m->part_count; i++) {
        bake_part *p = &m->parts[i];
        free(p->primitives);
        free(p->positions);
        free(p->normals);
        free(p->colors);
        free(p->indices);
        free(p->world_from_mesh);
        free(p->accessibility);
    }
    free(m->parts);
    scene_warnings_free(&m->warnings);
    if (m->document.owner)
        gltf_document_close(&m->document);
    *m = (bake_model){0};
}
