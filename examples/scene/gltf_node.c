/* SPDX-License-Identifier: MIT
 *
 * Where things stand: world matrices down the node tree, the instances and cameras of the scene that the file shows.
 * gltf_check() has made sure that the tree is one, and not deeper than recursion may go.
 */
#define CGLM_ALL_UNALIGNED /* the scene's matrices are plain float[16] */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

enum { MOST_INSTANCES = 1 << 22 };

/* Translation, then rotation (a quaternion of any length but 0), then scale. */
static bool compose(const double t[3], const double r[4], const double s[3], mat4 out)
{
    const double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    if (!(length > 0))
        return false;
    versor q;
    for (int i = 0; i < 4; ++i)
        q[i] = (float)(r[i] / length);
    glm_quat_mat4(q, out);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            out[column][row] *= (float)s[column];
        out[3][column] = (float)t[column];
    }
    return true;
}

static bool matrix_is_finite(mat4 m)
{
    bool finite = true;
    for (int i = 0; i < 16; ++i)
        finite = finite && isfinite(m[i / 4][i % 4]);
    return finite;
}

static bool local_matrix(gltf_loader *l, size_t node, mat4 out)
{
    const gltf_node *n = &l->document->nodes[node];
    if (!n->has_matrix)
        return compose(n->translation, n->rotation, n->scale, out) ||
               scene_fail(l->fault, "node %zu: its rotation is 0", node);
    const double *m = n->matrix;
    if (fabs(m[3]) + fabs(m[7]) + fabs(m[11]) + fabs(m[15] - 1) > 1e-4)
        return scene_fail(l->fault, "node %zu: its matrix is not affine", node);
    for (int i = 0; i < 16; ++i)
        out[i / 4][i % 4] = i % 4 == 3 ? (float)(i == 15) : (float)m[i];
    return true;
}

static bool place_branch(gltf_loader *l, size_t node, mat4 world_from_parent)
{
    const gltf_node *n = &l->document->nodes[node];
    vec4 *world_from_node = (vec4 *)l->world_from_node[node];
    mat4 parent_from_node;
    if (!local_matrix(l, node, parent_from_node))
        return false;
    glm_mat4_mul(world_from_parent, parent_from_node, world_from_node);
    if (!matrix_is_finite(world_from_node))
        return scene_fail(l->fault, "node %zu: its transform is too large for single precision", node);
    for (size_t i = 0; i < n->child_count; ++i)
        if (!place_branch(l, (size_t)n->children[i], world_from_node))
            return false;
    return true;
}

/* The nodes that are nobody's children; NULL on failure. */
static bool *find_roots(gltf_loader *l)
{
    const gltf_document *d = l->document;
    bool *root = malloc(d->node_count + 1);
    if (!root) {
        scene_fail_memory(l->fault);
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
    mat4 identity = GLM_MAT4_IDENTITY_INIT;
    return place_branch(l, node, identity);
}

bool gltf_place_nodes(gltf_loader *l)
{
    return for_each_root(l, place_root);
}

/* A matrix that leaves nothing but a line or a point has only zeros for cofactors, and no normals to draw by. */
static bool leaves_area(mat4 m)
{
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) {
            const float *a = m[(c + 1) % 3], *b = m[(c + 2) % 3];
            most = fmax(most, fabs((double)a[(r + 1) % 3] * (double)b[(r + 2) % 3] -
                                   (double)a[(r + 2) % 3] * (double)b[(r + 1) % 3]));
        }
    return most > 0;
}

static bool add_instance(gltf_loader *l, int mesh, mat4 world_from_mesh)
{
    if (!leaves_area(world_from_mesh))
        return true;
    if (l->builder->made->instance_count >= MOST_INSTANCES)
        return scene_fail(l->fault, "more than %d instances", MOST_INSTANCES);
    return scene_builder_add_instance(l->builder, mesh, (const float *)world_from_mesh);
}

/* One of EXT_mesh_gpu_instancing's accessors; NULL where there is none, or on failure. */
static float *read_attribute(gltf_loader *l, size_t node, int accessor, int components, size_t *count)
{
    if (accessor < 0)
        return NULL;
    const size_t here = l->document->accessors[accessor].count;
    if (*count && here != *count) {
        scene_fail(l->fault, "node %zu: %zu and %zu instances", node, *count, here);
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

float (*gltf_read_instances(gltf_loader *l, size_t node, size_t *out_count))[16]
{
    const gltf_node *n = &l->document->nodes[node];
    size_t count = 0;
    float *translations = read_attribute(l, node, n->instance_translation, 3, &count);
    float *rotations = read_attribute(l, node, n->instance_rotation, 4, &count);
    float *scales = read_attribute(l, node, n->instance_scale, 3, &count);
    float(*made)[16] = l->fault->set ? NULL : malloc((count + 1) * sizeof *made);
    if (!made)
        scene_fail_memory(l->fault);
    for (size_t i = 0; made && i < count; ++i) {
        double t[3] = {0}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
        pick(translations, i, 3, t);
        pick(rotations, i, 4, r);
        pick(scales, i, 3, s);
        mat4 node_from_mesh, world_from_mesh;
        const bool composed = compose(t, r, s, node_from_mesh);
        if (composed)
            glm_mat4_mul((vec4 *)l->world_from_node[node], node_from_mesh, world_from_mesh);
        if (!composed || !matrix_is_finite(world_from_mesh)) {
            scene_fail(l->fault, "node %zu: the transform of instance %zu is not a number, or 0", node, i);
            free(made);
            made = NULL;
        } else
            memcpy(made[i], world_from_mesh, sizeof made[i]);
    }
    free(translations);
    free(rotations);
    free(scales);
    *out_count = count;
    return made;
}

static bool add_instances(gltf_loader *l, size_t node, int mesh)
{
    size_t count = 0;
    float(*world_from_mesh)[16] = gltf_read_instances(l, node, &count);
    bool ok = world_from_mesh;
    for (size_t i = 0; ok && i < count; ++i)
        ok = add_instance(l, mesh, (vec4 *)world_from_mesh[i]);
    free(world_from_mesh);
    return ok;
}

static bool draw_node(gltf_loader *l, size_t node)
{
    const gltf_node *n = &l->document->nodes[node];
    mat4 identity = GLM_MAT4_IDENTITY_INIT;
    const int mesh = gltf_add_mesh(l, node);
    if (mesh < 0)
        return false;
    if (!l->builder->made->meshes[mesh].primitive_count)
        return true;
    if (n->skin >= 0) /* baked in world space */
        return add_instance(l, mesh, identity);
    return n->instanced ? add_instances(l, node, mesh) : add_instance(l, mesh, (vec4 *)l->world_from_node[node]);
}

/* Axes at right angles and of unit length whatever the node's scale. A camera that cannot see is left out. */
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
    mat4 world_from_node, world_from_view = GLM_MAT4_IDENTITY_INIT;
    memcpy(world_from_node, l->world_from_node[node], sizeof world_from_node);
    glm_vec3_copy(world_from_node[3], world_from_view[3]);
    glm_vec3_normalize_to(world_from_node[2], world_from_view[2]);
    glm_vec3_cross(world_from_node[1], world_from_view[2], world_from_view[0]);
    glm_vec3_normalize(world_from_view[0]);
    glm_vec3_cross(world_from_view[2], world_from_view[0], world_from_view[1]);
    const bool axes = fabsf(glm_mat4_det(world_from_view) - 1) < 1e-3f;
    memcpy(camera.world_from_view, world_from_view, sizeof camera.world_from_view);
    if (!lens || !planes || !axes || !matrix_is_finite(world_from_view) || !isfinite(camera.far_plane) ||
        !isfinite(camera.half_width) || !isfinite(camera.half_height))
        return true;
    return scene_builder_add_camera(l->builder, &camera) >= 0;
}

/* It shines along -z of its node, whatever the node's scale. */
static bool add_light(gltf_loader *l, size_t node)
{
    const gltf_light *from = &l->document->lights[l->document->nodes[node].light];
    scene_light light = {.kind = !strcmp(from->type, "point")  ? SCENE_LIGHT_POINT
                                 : !strcmp(from->type, "spot") ? SCENE_LIGHT_SPOT
                                                               : SCENE_LIGHT_DIRECTIONAL,
                         .range = (float)from->range,
                         .inner_cos = (float)cos(from->inner_cone_rad),
                         .outer_cos = (float)cos(from->outer_cone_rad)};
    const float *m = l->world_from_node[node];
    const float length = sqrtf(m[8] * m[8] + m[9] * m[9] + m[10] * m[10]);
    bool shines = light.kind == SCENE_LIGHT_POINT || (length > 0 && isfinite(length));
    bool bright = false;
    for (int i = 0; i < 3; ++i) {
        light.color[i] = (float)(from->color[i] * from->intensity);
        light.position_world[i] = m[12 + i];
        light.direction_world[i] = length > 0 ? -m[8 + i] / length : 0;
        bright = bright || light.color[i] > 0;
        shines = shines && isfinite(light.color[i]);
    }
    return !shines || !bright || scene_builder_add_light(l->builder, &light) >= 0;
}

static bool add_branch(gltf_loader *l, size_t node)
{
    const gltf_node *n = &l->document->nodes[node];
    if ((n->camera >= 0 && !add_camera(l, node)) || (n->light >= 0 && !add_light(l, node)) ||
        (n->mesh >= 0 && !draw_node(l, node)))
        return false;
    for (size_t i = 0; i < n->child_count; ++i)
        if (!add_branch(l, (size_t)n->children[i]))
            return false;
    return true;
}

bool gltf_add_scene(gltf_loader *l)
{
    const gltf_document *d = l->document;
    if (!d->scene_count)
        return for_each_root(l, add_branch);
    const gltf_scene *shown = &d->scenes[d->default_scene < 0 ? 0 : d->default_scene];
    for (size_t i = 0; i < shown->node_count; ++i)
        if (!add_branch(l, (size_t)shown->nodes[i]))
            return false;
    return true;
}
