/* SPDX-License-Identifier: MIT
 *
 * Where things stand: world matrices down the node tree, the instances, cameras and lights of the scene that the file
 * shows; in double precision, since a node may lie millions of units from zero. gltf_check() has made sure that the
 * tree is one, and not deeper than recursion may go.
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

enum { MOST_INSTANCES = 1 << 22 };

static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/* Affine: the last row is 0, 0, 0, 1. */
static void multiply(const double a[16], const double b[16], double out[16])
{
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            double sum = 0;
            for (int k = 0; k < 4; ++k)
                sum += a[4 * k + r] * b[4 * c + k];
            out[4 * c + r] = sum;
        }
}

/* Translation, then rotation (a quaternion of any length but 0), then scale. */
static bool compose(const double t[3], const double r[4], const double s[3], double out[16])
{
    const double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    if (!(length > 0))
        return false;
    const double x = r[0] / length, y = r[1] / length, z = r[2] / length, w = r[3] / length;
    const double turn[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
                            2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
                            2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y)};
    memcpy(out, identity, sizeof identity);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            out[4 * column + row] = turn[3 * column + row] * s[column];
        out[12 + column] = t[column];
    }
    return true;
}

/* Also false for values that single precision cannot hold. */
static bool matrix_is_finite(const double m[16])
{
    bool finite = true;
    for (int i = 0; i < 16; ++i)
        finite = finite && fabs(m[i]) <= (double)FLT_MAX;
    return finite;
}

static bool local_matrix(gltf_loader *l, size_t node, double out[16])
{
    const gltf_node *n = &l->document->nodes[node];
    if (!n->has_matrix)
        return compose(n->translation, n->rotation, n->scale, out) ||
               fault_set(l->fault, "node %zu: its rotation is 0", node);
    const double *m = n->matrix;
    if (fabs(m[3]) + fabs(m[7]) + fabs(m[11]) + fabs(m[15] - 1) > 1e-4)
        return fault_set(l->fault, "node %zu: its matrix is not affine", node);
    for (int i = 0; i < 16; ++i)
        out[i] = i % 4 == 3 ? i == 15 : m[i];
    return true;
}

static bool place_branch(gltf_loader *l, size_t node, const double world_from_parent[16])
{
    const gltf_node *n = &l->document->nodes[node];
    double parent_from_node[16];
    if (!local_matrix(l, node, parent_from_node))
        return false;
    multiply(world_from_parent, parent_from_node, l->world_from_node[node]);
    if (!matrix_is_finite(l->world_from_node[node]))
        return fault_set(l->fault, "node %zu: its transform is too large for single precision", node);
    for (size_t i = 0; i < n->child_count; ++i)
        if (!place_branch(l, (size_t)n->children[i], l->world_from_node[node]))
            return false;
    return true;
}

/* The nodes without a parent; NULL on failure. */
static bool *find_roots(gltf_loader *l)
{
    const gltf_document *d = l->document;
    bool *root = malloc(d->node_count + 1);
    if (!root) {
        fault_set_memory(l->fault);
        return NULL;
    }
    memset(root, true, d->node_count);
    for (size_t n = 0; n < d->node_count; ++n)
        for (size_t i = 0; i < d->nodes[n].child_count; ++i)
            root[d->nodes[n].children[i]] = false;
    return root;
}

/* Calls `visit` for each root until it fails. */
static bool for_each_root(gltf_loader *l, bool (*visit)(gltf_loader *l, size_t node))
{
    bool *root = find_roots(l), ok = root;
    for (size_t n = 0; ok && n < l->document->node_count; ++n)
        ok = !root[n] || visit(l, n);
    free(root);
    return ok;
}

static bool place_root(gltf_loader *l, size_t node)
{
    double world_from_root[16];
    memcpy(world_from_root, identity, sizeof world_from_root);
    memcpy(world_from_root + 12, l->document->center, sizeof l->document->center);
    return place_branch(l, node, world_from_root);
}

bool gltf_place_nodes(gltf_loader *l)
{
    return for_each_root(l, place_root);
}

/* A matrix that leaves nothing but a line or a point has only zeros for cofactors, and no normals to draw by. */
static bool leaves_area(const double m[16])
{
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) {
            const double *a = m + 4 * ((c + 1) % 3), *b = m + 4 * ((c + 2) % 3);
            most = fmax(most, fabs((double)((float)a[(r + 1) % 3] * (float)b[(r + 2) % 3]) -
                                   (double)((float)a[(r + 2) % 3] * (float)b[(r + 1) % 3])));
        }
    return most > 0;
}

static bool add_instance(gltf_loader *l, gltf_mesh_range meshes, const double world_from_mesh[16])
{
    if (!leaves_area(world_from_mesh)) {
        l->omitted.flattened++;
        return true;
    }
    for (int mesh = meshes.first; mesh < meshes.first + meshes.count; ++mesh) {
        if (!l->builder->made->meshes[mesh].primitive_count)
            continue;
        if (l->builder->made->instance_count >= MOST_INSTANCES)
            return fault_set(l->fault, "more than %d instances", MOST_INSTANCES);
        if (!scene_builder_place(l->builder, mesh, world_from_mesh))
            return false;
    }
    return true;
}

/* One of EXT_mesh_gpu_instancing's accessors; NULL where there is none, or on failure. */
static float *read_attribute(gltf_loader *l, size_t node, int accessor, int components, size_t *count)
{
    if (accessor < 0)
        return NULL;
    const size_t here = l->document->accessors[accessor].count;
    if (*count && here != *count) {
        fault_set(l->fault, "node %zu: %zu and %zu instances", node, *count, here);
        return NULL;
    }
    *count = here;
    return gltf_read_floats(l, accessor, components, GLTF_AS_SAID);
}

/* `out` keeps its default where the attribute is missing. */
static void pick(const float *values, size_t index, size_t components, double *out)
{
    for (size_t c = 0; values && c < components; ++c)
        out[c] = (double)values[index * components + c];
}

double (*gltf_read_instances(gltf_loader *l, size_t node, size_t *out_count))[16]
{
    const gltf_node *n = &l->document->nodes[node];
    size_t count = 0;
    float *translations = read_attribute(l, node, n->instance_translation, 3, &count);
    float *rotations = read_attribute(l, node, n->instance_rotation, 4, &count);
    float *scales = read_attribute(l, node, n->instance_scale, 3, &count);
    double(*made)[16] = l->fault->set ? NULL : malloc((count + 1) * sizeof *made);
    if (!made)
        fault_set_memory(l->fault);
    for (size_t i = 0; made && i < count; ++i) {
        double t[3] = {0}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
        pick(translations, i, 3, t);
        pick(rotations, i, 4, r);
        pick(scales, i, 3, s);
        double node_from_mesh[16];
        const bool composed = compose(t, r, s, node_from_mesh);
        if (composed)
            multiply(l->world_from_node[node], node_from_mesh, made[i]);
        if (!composed || !matrix_is_finite(made[i])) {
            fault_set(l->fault, "node %zu: the transform of instance %zu is not a number, or 0", node, i);
            free(made);
            made = NULL;
        }
    }
    free(translations);
    free(rotations);
    free(scales);
    *out_count = count;
    return made;
}

static bool add_instances(gltf_loader *l, size_t node, gltf_mesh_range meshes)
{
    size_t count = 0;
    double(*world_from_mesh)[16] = gltf_read_instances(l, node, &count);
    bool ok = world_from_mesh;
    for (size_t i = 0; ok && i < count; ++i)
        ok = add_instance(l, meshes, world_from_mesh[i]);
    free(world_from_mesh);
    return ok;
}

static bool draw_node(gltf_loader *l, size_t node)
{
    const gltf_node *n = &l->document->nodes[node];
    gltf_mesh_range meshes;
    if (!gltf_add_mesh(l, node, &meshes))
        return false;
    if (n->skin >= 0) /* posed in world space */
        return add_instance(l, meshes, identity);
    return n->instanced ? add_instances(l, node, meshes) : add_instance(l, meshes, l->world_from_node[node]);
}

static double normalize(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3 && length > 0; ++i)
        v[i] /= length;
    return length;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Makes the axes perpendicular and of unit length; false if the node's axes are degenerate. */
static bool make_axes(const double world_from_node[16], float out[16])
{
    double axes[3][3];
    memcpy(axes[2], world_from_node + 8, sizeof axes[2]);
    bool sound = normalize(axes[2]) > 0;
    cross(world_from_node + 4, axes[2], axes[0]);
    sound = normalize(axes[0]) > 0 && sound;
    cross(axes[2], axes[0], axes[1]);
    for (int i = 0; i < 16; ++i)
        out[i] = i % 4 == 3 || i >= 12 ? (float)(i == 15) : (float)axes[i / 4][i % 4];
    for (int i = 0; i < 16; ++i)
        sound = sound && isfinite(out[i]);
    return sound;
}

/* A camera that cannot see is left out. */
static bool add_camera(gltf_loader *l, size_t node)
{
    const gltf_camera *from = &l->document->cameras[l->document->nodes[node].camera];
    const bool lens = from->orthographic ? from->x_mag != 0 && from->y_mag != 0 && from->near_plane >= 0
                                         : from->fov_y_rad > 0 && from->fov_y_rad < 3.14 && from->near_plane > 0;
    const bool planes = from->far_plane > from->near_plane || (!from->orthographic && from->far_plane == 0);
    scene_camera camera = {.orthographic = from->orthographic,
                           .fov_y_rad = (float)from->fov_y_rad,
                           .half_width = (float)fabs(from->x_mag),
                           .half_height = (float)fabs(from->y_mag),
                           .near_plane = (float)from->near_plane,
                           .far_plane = (float)from->far_plane};
    snprintf(camera.name, sizeof camera.name, "%s", from->name);
    if (!lens || !planes || !make_axes(l->world_from_node[node], camera.world_from_view) ||
        !isfinite(camera.far_plane) || !isfinite(camera.half_width) || !isfinite(camera.half_height)) {
        l->omitted.cameras++;
        return true;
    }
    return scene_builder_add_camera(l->builder, &camera, l->world_from_node[node] + 12) >= 0;
}

/* A light shines along -z of its node; the node's scale does not matter. */
static bool add_light(gltf_loader *l, size_t node)
{
    const gltf_light *from = &l->document->lights[l->document->nodes[node].light];
    scene_light light = {.kind = !strcmp(from->type, "point")  ? SCENE_LIGHT_POINT
                                 : !strcmp(from->type, "spot") ? SCENE_LIGHT_SPOT
                                                               : SCENE_LIGHT_DIRECTIONAL,
                         .range = (float)from->range,
                         .inner_cos = (float)cos(from->inner_cone_rad),
                         .outer_cos = (float)cos(from->outer_cone_rad)};
    const double *m = l->world_from_node[node];
    double back[3] = {m[8], m[9], m[10]};
    const double length = normalize(back);
    bool shines = light.kind == SCENE_LIGHT_POINT || (length > 0 && isfinite(length));
    bool bright = false;
    for (int i = 0; i < 3; ++i) {
        light.color[i] = (float)(from->color[i] * from->intensity);
        light.direction_world[i] = length > 0 ? (float)-back[i] : 0;
        bright = bright || light.color[i] > 0;
        shines = shines && isfinite(light.color[i]);
    }
    return !shines || !bright || scene_builder_add_light(l->builder, &light, m + 12) >= 0;
}

/* Each node once, also where a scene names it and its parent. */
static bool add_branch(gltf_loader *l, size_t node)
{
    const gltf_node *n = &l->document->nodes[node];
    if (l->drawn[node] || n->hidden)
        return true;
    l->drawn[node] = true;
    if ((n->camera >= 0 && !add_camera(l, node)) || (n->light >= 0 && !add_light(l, node)) ||
        (n->mesh >= 0 && !draw_node(l, node)))
        return false;
    for (size_t i = 0; i < n->child_count; ++i)
        if (!add_branch(l, (size_t)n->children[i]))
            return false;
    return true;
}

bool gltf_visit_shown(gltf_loader *l, bool (*visit)(gltf_loader *l, size_t node))
{
    const gltf_document *d = l->document;
    if (!d->scene_count)
        return for_each_root(l, visit);
    const gltf_scene *shown = &d->scenes[d->default_scene < 0 ? 0 : d->default_scene];
    for (size_t i = 0; i < shown->node_count; ++i)
        if (!visit(l, (size_t)shown->nodes[i]))
            return false;
    return true;
}

bool gltf_add_scene(gltf_loader *l)
{
    return gltf_visit_shown(l, add_branch);
}
