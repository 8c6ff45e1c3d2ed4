/* SPDX-License-Identifier: MIT
 *
 * Checks every reference, range and count of a glTF document once, so that the loader may follow them. Values inside
 * buffers (vertex indices, joints, sparse positions) are checked when they are read.
 */
#include "gltf_document.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fault.h"

enum { MOST_NODE_DEPTH = 256 };
static const double rounding = 1e-4; /* by which a factor may be out of range */

int gltf_find_attribute(const gltf_attribute_list *list, const char *name)
{
    for (size_t i = 0; i < list->count; ++i)
        if (!strcmp(list->items[i].name, name))
            return list->items[i].accessor;
    return -1;
}

size_t gltf_component_size(int component_type)
{
    switch (component_type) {
    case GLTF_BYTE:
    case GLTF_UNSIGNED_BYTE:
        return 1;
    case GLTF_SHORT:
    case GLTF_UNSIGNED_SHORT:
        return 2;
    case GLTF_UNSIGNED_INT:
    case GLTF_FLOAT:
        return 4;
    default:
        return 0;
    }
}

size_t gltf_element_size(const gltf_accessor *accessor)
{
    size_t column = (size_t)accessor->rows * gltf_component_size(accessor->component_type);
    if (accessor->columns > 1)
        column = (column + 3) / 4 * 4;
    return column * (size_t)accessor->columns;
}

/* An owner's optional reference. */
static bool check_index(int index, size_t count, const char *owner, size_t number, const char *what, failure *fault)
{
    if (index == -1 || (index >= 0 && (size_t)index < count))
        return true;
    return fault_set(fault, "%s %zu: %s %d does not exist, there are %zu", owner, number, what, index, count);
}

/* A required reference. */
static bool need_index(int index, size_t count, const char *owner, size_t number, const char *what, failure *fault)
{
    if (index == -1)
        return fault_set(fault, "%s %zu: no %s", owner, number, what);
    return check_index(index, count, owner, number, what, fault);
}

static bool check_buffer_view(const gltf_document *d, size_t number, failure *fault)
{
    const gltf_buffer_view *view = &d->buffer_views[number];
    if (!need_index(view->buffer, d->buffer_count, "buffer view", number, "buffer", fault))
        return false;
    const size_t size = d->buffers[view->buffer].size;
    if (view->offset > size || view->length > size - view->offset)
        return fault_set(fault, "buffer view %zu: bytes %zu + %zu asked, its buffer holds %zu", number, view->offset,
                         view->length, size);
    return true;
}

/* Elements `stride` apart, the last of `size` bytes, from `offset` in a buffer view. */
static bool check_range(const gltf_document *d, size_t number, int view_index, int64_t offset, uint64_t count,
                        size_t stride, size_t size, failure *fault)
{
    if (!need_index(view_index, d->buffer_view_count, "accessor", number, "buffer view", fault))
        return false;
    const size_t length = d->buffer_views[view_index].length;
    if (offset < 0)
        return fault_set(fault, "accessor %zu: byte offset is negative", number);
    if ((uint64_t)offset <= length && size <= length - (size_t)offset &&
        count - 1 <= (length - (size_t)offset - size) / stride)
        return true;
    /* In floating point, where hostile numbers cannot overflow: the message needs no more. */
    const double asked = (double)offset + (double)(count - 1) * (double)stride + (double)size;
    return fault_set(fault, "accessor %zu: %.0f bytes asked, its buffer view holds %zu", number, asked, length);
}

/* The bytes of a matrix without the padding after its last column. */
static size_t last_element_size(const gltf_accessor *a)
{
    const size_t column = gltf_element_size(a) / (size_t)a->columns;
    return gltf_element_size(a) - column + (size_t)a->rows * gltf_component_size(a->component_type);
}

static bool check_sparse(const gltf_document *d, size_t number, failure *fault)
{
    const gltf_accessor *a = &d->accessors[number];
    const gltf_sparse *s = &a->sparse;
    if (s->count < 1 || (uint64_t)s->count > a->count)
        return fault_set(fault, "accessor %zu: a sparse count of %lld for %zu elements", number,
                         (long long)(s->count < 0 ? 0 : s->count), a->count);
    if (s->index_type != GLTF_UNSIGNED_BYTE && s->index_type != GLTF_UNSIGNED_SHORT &&
        s->index_type != GLTF_UNSIGNED_INT)
        return fault_set(fault, "accessor %zu: sparse indices of component type %d", number, s->index_type);
    const size_t index_size = gltf_component_size(s->index_type), size = gltf_element_size(a);
    const uint64_t count = (uint64_t)s->count;
    return check_range(d, number, s->index_view, s->index_offset, count, index_size, index_size, fault) &&
           check_range(d, number, s->value_view, s->value_offset, count, size, last_element_size(a), fault);
}

static bool check_accessor(const gltf_document *d, size_t number, failure *fault)
{
    enum { MOST_ZEROS = 1 << 22 }; /* elements that cost the file nothing */
    const gltf_accessor *a = &d->accessors[number];
    if (!gltf_component_size(a->component_type))
        return fault_set(fault, "accessor %zu: component type %d is not one of glTF's", number, a->component_type);
    if (!a->count)
        return fault_set(fault, "accessor %zu: no elements", number);
    if (a->sparse.count && !check_sparse(d, number, fault))
        return false;
    if (a->buffer_view == -1)
        return a->count <= MOST_ZEROS ||
               fault_set(fault, "accessor %zu: %zu elements without a buffer view", number, a->count);
    if (!check_index(a->buffer_view, d->buffer_view_count, "accessor", number, "buffer view", fault))
        return false;
    const size_t size = gltf_element_size(a), given = d->buffer_views[a->buffer_view].stride;
    if (given && given < size)
        return fault_set(fault, "accessor %zu: elements of %zu bytes, %zu apart", number, size, given);
    if (a->offset > INT64_MAX)
        return fault_set(fault, "accessor %zu: byte offset %zu", number, a->offset);
    return check_range(d, number, a->buffer_view, (int64_t)a->offset, a->count, given ? given : size,
                       last_element_size(a), fault);
}

/* Every attribute has a value for each vertex, `count` of them; 0 where there is no position to count by. */
static bool check_attributes(const gltf_document *d, const gltf_attribute_list *list, size_t count, size_t mesh,
                             failure *fault)
{
    for (size_t i = 0; i < list->count; ++i) {
        const gltf_attribute *a = &list->items[i];
        if (!need_index(a->accessor, d->accessor_count, "mesh", mesh, "accessor", fault))
            return false;
        if (count && d->accessors[a->accessor].count != count)
            return fault_set(fault, "mesh %zu: %zu times %.32s for %zu vertices", mesh, d->accessors[a->accessor].count,
                             a->name, count);
        if (!strncmp(a->name, "JOINTS_", 7)) {
            char weights[32];
            snprintf(weights, sizeof weights, "WEIGHTS_%.16s", a->name + 7);
            if (gltf_find_attribute(list, weights) < 0)
                return fault_set(fault, "mesh %zu: %.32s without weights", mesh, a->name);
        }
    }
    return true;
}

static bool check_primitive(const gltf_document *d, size_t mesh, const gltf_primitive *p, failure *fault)
{
    if (p->mode < GLTF_POINTS || p->mode > GLTF_TRIANGLE_FAN)
        return fault_set(fault, "mesh %zu: primitive mode %d", mesh, p->mode);
    const int positions = gltf_find_attribute(&p->attributes, "POSITION");
    const bool counted = positions >= 0 && (size_t)positions < d->accessor_count;
    const size_t count = counted ? d->accessors[positions].count : 0;
    if (!check_index(p->indices, d->accessor_count, "mesh", mesh, "index accessor", fault) ||
        !check_index(p->material, d->material_count, "mesh", mesh, "material", fault) ||
        !check_attributes(d, &p->attributes, count, mesh, fault))
        return false;
    for (size_t t = 0; t < p->target_count; ++t)
        if (!check_attributes(d, &p->targets[t], count, mesh, fault))
            return false;
    const size_t weights = d->meshes[mesh].weights.count;
    return !weights || weights == p->target_count ||
           fault_set(fault, "mesh %zu: %zu weights for %zu morph targets", mesh, weights, p->target_count);
}

static bool check_mesh(const gltf_document *d, size_t number, failure *fault)
{
    for (size_t i = 0; i < d->meshes[number].primitive_count; ++i)
        if (!check_primitive(d, number, &d->meshes[number].primitives[i], fault))
            return false;
    return true;
}

static bool check_node(const gltf_document *d, size_t number, failure *fault)
{
    const gltf_node *n = &d->nodes[number];
    for (size_t i = 0; i < n->child_count; ++i)
        if (!need_index(n->children[i], d->node_count, "node", number, "child", fault))
            return false;
    return check_index(n->mesh, d->mesh_count, "node", number, "mesh", fault) &&
           check_index(n->skin, d->skin_count, "node", number, "skin", fault) &&
           check_index(n->camera, d->camera_count, "node", number, "camera", fault) &&
           check_index(n->light, d->light_count, "node", number, "light", fault) &&
           check_index(n->instance_translation, d->accessor_count, "node", number, "accessor", fault) &&
           check_index(n->instance_rotation, d->accessor_count, "node", number, "accessor", fault) &&
           check_index(n->instance_scale, d->accessor_count, "node", number, "accessor", fault);
}

static bool check_skin(const gltf_document *d, size_t number, failure *fault)
{
    const gltf_skin *skin = &d->skins[number];
    if (!skin->joint_count)
        return fault_set(fault, "skin %zu: no joints", number);
    for (size_t i = 0; i < skin->joint_count; ++i)
        if (!need_index(skin->joints[i], d->node_count, "skin", number, "joint", fault))
            return false;
    if (!check_index(skin->inverse_bind_matrices, d->accessor_count, "skin", number, "accessor", fault))
        return false;
    const gltf_accessor *inverse = skin->inverse_bind_matrices < 0 ? NULL : &d->accessors[skin->inverse_bind_matrices];
    return !inverse ||
           (inverse->rows == 4 && inverse->columns == 4 && inverse->component_type == GLTF_FLOAT &&
            inverse->count >= skin->joint_count) ||
           fault_set(fault, "skin %zu: accessor %d is not one matrix for each of its %zu joints", number,
                     skin->inverse_bind_matrices, skin->joint_count);
}

static bool is_share(double value)
{
    return value >= -rounding && value <= 1 + rounding;
}

static bool check_material(const gltf_document *d, size_t number, failure *fault)
{
    const gltf_material *m = &d->materials[number];
    const gltf_texture_use *const maps[] = {&m->base_color_map, &m->metallic_roughness_map, &m->normal_map,
                                            &m->occlusion_map, &m->emissive_map};
    for (size_t i = 0; i < sizeof maps / sizeof *maps; ++i) {
        if (!check_index(maps[i]->texture, d->texture_count, "material", number, "texture", fault))
            return false;
        if (maps[i]->uv_set < 0)
            return fault_set(fault, "material %zu: texCoord is not a number from 0", number);
    }
    if (strcmp(m->alpha_mode, "OPAQUE") != 0 && strcmp(m->alpha_mode, "MASK") != 0 &&
        strcmp(m->alpha_mode, "BLEND") != 0)
        return fault_set(fault, "material %zu: alphaMode '%.32s'", number, m->alpha_mode);
    for (int i = 0; i < 4; ++i)
        if (!is_share(m->base_color[i]))
            return fault_set(fault, "material %zu: base colour %g is not within 0 and 1", number, m->base_color[i]);
    if (!is_share(m->metallic) || !is_share(m->roughness))
        return fault_set(fault, "material %zu: metallic %g and roughness %g are not within 0 and 1", number,
                         m->metallic, m->roughness);
    if (!is_share(m->occlusion_strength) || !isfinite(m->normal_scale))
        return fault_set(fault, "material %zu: occlusion strength %g or normal scale %g is out of range", number,
                         m->occlusion_strength, m->normal_scale);
    for (int i = 0; i < 3; ++i)
        if (!(m->emissive[i] >= -rounding && isfinite(m->emissive[i])))
            return fault_set(fault, "material %zu: emission %g is negative or not finite", number, m->emissive[i]);
    return m->alpha_cutoff >= -rounding || fault_set(fault, "material %zu: alphaCutoff is negative", number);
}

static bool check_light(const gltf_document *d, size_t number, failure *fault)
{
    const gltf_light *light = &d->lights[number];
    if (strcmp(light->type, "directional") != 0 && strcmp(light->type, "point") != 0 &&
        strcmp(light->type, "spot") != 0)
        return fault_set(fault, "light %zu: type '%.32s'", number, light->type);
    for (int i = 0; i < 3; ++i)
        if (!(light->color[i] >= 0 && isfinite(light->color[i] * light->intensity)))
            return fault_set(fault, "light %zu: its colour or intensity is negative or not finite", number);
    const bool cones =
        light->inner_cone_rad >= 0 && light->inner_cone_rad < light->outer_cone_rad &&
        light->outer_cone_rad <= 1.5707964; /* half of pi, rounded up, since files write it with few digits */
    return (light->intensity >= 0 && light->range >= 0 && isfinite(light->range) &&
            (strcmp(light->type, "spot") != 0 || cones)) ||
           fault_set(fault, "light %zu: its intensity, range or cone is out of range", number);
}

static bool check_texture(const gltf_document *d, size_t number, failure *fault)
{
    return check_index(d->textures[number].sampler, d->sampler_count, "texture", number, "sampler", fault) &&
           check_index(d->textures[number].image, d->image_count, "texture", number, "image", fault);
}

static bool check_image(const gltf_document *d, size_t number, failure *fault)
{
    return check_index(d->images[number].buffer_view, d->buffer_view_count, "image", number, "buffer view", fault);
}

/* Each node has one parent at most, no node is its own ancestor, and no branch is deeper than MOST_NODE_DEPTH:
 * `parent` holds -1 for a root; `depth` is 0 until it is known. */
static bool check_ancestors(const gltf_document *d, int *parent, int *depth, failure *fault)
{
    for (size_t n = 0; n < d->node_count; ++n)
        parent[n] = -1;
    for (size_t n = 0; n < d->node_count; ++n)
        for (size_t i = 0; i < d->nodes[n].child_count; ++i) {
            const int child = d->nodes[n].children[i];
            if (parent[child] != -1)
                return fault_set(fault, "node %d: two parents, nodes %d and %zu", child, parent[child], n);
            parent[child] = (int)n;
        }
    for (size_t n = 0; n < d->node_count; ++n) {
        int steps = 0, up = (int)n;
        while (up != -1 && !depth[up] && (size_t)steps <= d->node_count) {
            up = parent[up];
            ++steps;
        }
        if ((size_t)steps > d->node_count)
            return fault_set(fault, "node %zu: a cycle of nodes", n);
        const int total = steps + (up == -1 ? 0 : depth[up]);
        if (total > MOST_NODE_DEPTH)
            return fault_set(fault, "node %zu: nested more than %d deep", n, MOST_NODE_DEPTH);
        for (int below = 0, at = (int)n; at != up; ++below, at = parent[at])
            depth[at] = total - below;
    }
    return true;
}

static bool check_scenes(const gltf_document *d, const int *parent, int *listed, failure *fault)
{
    for (size_t s = 0; s < d->scene_count; ++s)
        for (size_t i = 0; i < d->scenes[s].node_count; ++i) {
            const int node = d->scenes[s].nodes[i];
            if (!need_index(node, d->node_count, "scene", s, "node", fault))
                return false;
            if (parent[node] != -1 &&
                !scene_warn(d->warnings, fault, "scene %zu names nodes that are children of others; each is drawn once",
                            s))
                return false;
            if (listed[node] == (int)s + 1 &&
                !scene_warn(d->warnings, fault, "scene %zu names node %d twice; it is drawn once", s, node))
                return false;
            listed[node] = (int)s + 1;
        }
    return d->default_scene == -1 || (d->default_scene >= 0 && (size_t)d->default_scene < d->scene_count) ||
           fault_set(fault, "scene %d does not exist, there are %zu", d->default_scene, d->scene_count);
}

static bool check_tree(const gltf_document *d, failure *fault)
{
    /* Parents, then depths or the scene that last listed a node. */
    int *parent = calloc(3 * d->node_count + 1, sizeof *parent);
    if (!parent)
        return fault_set_memory(fault);
    const bool ok = check_ancestors(d, parent, parent + d->node_count, fault) &&
                    check_scenes(d, parent, parent + 2 * d->node_count, fault);
    free(parent);
    return ok;
}

static bool check_version(const gltf_document *d, failure *fault)
{
    const char *needed = *d->min_version ? d->min_version : "2.0";
    if (strncmp(d->version, "2.", 2) != 0)
        return fault_set(fault, "glTF version '%.16s', only 2 is known", d->version);
    return !strcmp(needed, "2.0") || fault_set(fault, "glTF version '%.16s' is needed, 2.0 is known", needed);
}

bool gltf_check(const gltf_document *d, failure *fault)
{
    typedef bool check_fn(const gltf_document *, size_t, failure *);
    const struct {
        check_fn *check;
        size_t count;
    } lists[] = {{check_buffer_view, d->buffer_view_count},
                 {check_accessor, d->accessor_count},
                 {check_mesh, d->mesh_count},
                 {check_node, d->node_count},
                 {check_skin, d->skin_count},
                 {check_material, d->material_count},
                 {check_light, d->light_count},
                 {check_texture, d->texture_count},
                 {check_image, d->image_count}};
    if (!check_version(d, fault))
        return false;
    for (size_t l = 0; l < sizeof lists / sizeof *lists; ++l)
        for (size_t i = 0; i < lists[l].count; ++i)
            if (!lists[l].check(d, i, fault))
                return false;
    return check_tree(d, fault);
}
