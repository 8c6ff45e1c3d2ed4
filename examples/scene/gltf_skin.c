/* SPDX-License-Identifier: MIT
 *
 * Bakes a skin's pose into the vertices: the weighted mean of its joints' matrices takes each vertex to world space.
 * As glTF says, the transform of the node that draws the mesh is ignored.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_loader.h"

enum { MOST_SETS = 4 }; /* of four joints each */

typedef struct joint_sets {
    uint32_t *joints[MOST_SETS];
    float *weights[MOST_SETS];
    int count;
} joint_sets;

/* Column-major; the last row is 0, 0, 0, 1. */
static void multiply(const double a[16], const float b[16], double out[16])
{
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            double sum = 0;
            for (int k = 0; k < 4; ++k)
                sum += a[4 * k + r] * (double)b[4 * c + k];
            out[4 * c + r] = sum;
        }
}

/* World from the mesh at rest, for each joint; NULL on failure. */
static double (*read_joints(gltf_loader *l, int number))[16]
{
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const gltf_skin *skin = &l->document->skins[number];
    const int accessor = skin->inverse_bind_matrices;
    if (skin->joint_count > l->reads_left) {
        fault_set(l->fault, "skin %d: the file asks for more joints than its size allows", number);
        return NULL;
    }
    l->reads_left -= skin->joint_count;
    float *inverse_bind = accessor < 0 ? NULL : gltf_read_floats(l, accessor, 16, GLTF_AS_SAID);
    double(*joints)[16] = malloc(skin->joint_count * sizeof *joints);
    if (!joints)
        fault_set_memory(l->fault);
    for (size_t j = 0; !l->fault->set && j < skin->joint_count; ++j)
        multiply(l->world_from_node[skin->joints[j]], inverse_bind ? inverse_bind + 16 * j : identity, joints[j]);
    free(inverse_bind);
    if (!l->fault->set)
        return joints;
    free(joints);
    return NULL;
}

static int find_set(const gltf_vertices *v, const char *what, int set)
{
    char name[32];
    snprintf(name, sizeof name, "%s_%d", what, set);
    return gltf_find_attribute(&v->source->attributes, name);
}

static bool read_sets(gltf_loader *l, const gltf_vertices *v, joint_sets *sets)
{
    for (int set = 0; set < MOST_SETS; ++set) {
        const int joints = find_set(v, "JOINTS", set), weights = find_set(v, "WEIGHTS", set);
        if (joints < 0 || weights < 0)
            return true;
        sets->joints[set] = gltf_read_indices(l, joints, 4);
        sets->weights[set] = gltf_read_floats(l, weights, 4, GLTF_NORMALIZED);
        sets->count = set + 1;
        if (!sets->joints[set] || !sets->weights[set])
            return false;
    }
    return true;
}

/* The weighted mean of a vertex's joints; `fallback` where it has no weight. */
static bool blend(gltf_loader *l, const joint_sets *sets, uint32_t vertex, double (*joints)[16], int skin,
                  const double fallback[16], double out[16])
{
    const size_t joint_count = l->document->skins[skin].joint_count;
    double total = 0;
    memset(out, 0, 16 * sizeof *out);
    for (int i = 0; i < 4 * sets->count; ++i) {
        const uint32_t joint = sets->joints[i / 4][4 * (size_t)vertex + (size_t)(i % 4)];
        const double weight = (double)sets->weights[i / 4][4 * (size_t)vertex + (size_t)(i % 4)];
        if (weight == 0)
            continue;
        if (joint >= joint_count)
            return fault_set(l->fault, "skin %d: vertex %u names joint %u, there are %zu", skin, vertex, joint,
                             joint_count);
        for (int m = 0; m < 16; ++m)
            out[m] += weight * joints[joint][m];
        total += weight;
    }
    for (int m = 0; m < 16; ++m)
        out[m] = total > 0 ? out[m] / total : fallback[m];
    return true;
}

/* Moves one vertex; the sign of the matrix's determinant is returned. Normals go by its cofactors, times that sign. */
static int pose_vertex(const double m[16], const double p[3], double *out_position, float *normal)
{
    double cofactors[9], determinant = 0;
    for (int c = 0; c < 3; ++c) {
        const double *a = m + 4 * ((c + 1) % 3), *b = m + 4 * ((c + 2) % 3);
        for (int r = 0; r < 3; ++r)
            cofactors[3 * c + r] = a[(r + 1) % 3] * b[(r + 2) % 3] - a[(r + 2) % 3] * b[(r + 1) % 3];
    }
    for (int r = 0; r < 3; ++r)
        determinant += m[r] * cofactors[r];
    const int sign = determinant < 0 ? -1 : 1;
    for (int r = 0; r < 3; ++r)
        out_position[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
    if (normal) {
        const double n[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
        for (int r = 0; r < 3; ++r)
            normal[r] = (float)(sign * (cofactors[r] * n[0] + cofactors[3 + r] * n[1] + cofactors[6 + r] * n[2]));
    }
    return sign;
}

/* Poses all vertices into `world`, in double precision: the joints may stand far from zero. */
static bool pose_all(gltf_loader *l, gltf_vertices *v, int skin, size_t node, double (*joints)[16], double (*world)[3])
{
    joint_sets sets = {0};
    bool ok = read_sets(l, v, &sets);
    int64_t signs = 0;
    for (uint32_t i = 0; ok && i < v->count; ++i) {
        double matrix[16], rest[3];
        for (int axis = 0; axis < 3; ++axis)
            rest[axis] = (double)v->positions[i][axis] + v->center[axis];
        ok = blend(l, &sets, i, joints, skin, l->world_from_node[node], matrix);
        if (ok)
            signs += pose_vertex(matrix, rest, world[i], v->normals ? v->normals[i] : NULL);
    }
    v->mirrored = signs < 0;
    for (int set = 0; set < MOST_SETS; ++set) {
        free(sets.joints[set]);
        free(sets.weights[set]);
    }
    return ok;
}

bool gltf_pose_skin(gltf_loader *l, gltf_vertices *v, int skin, size_t node)
{
    double(*joints)[16] = read_joints(l, skin);
    double(*world)[3] = joints ? malloc(((size_t)v->count + 1) * sizeof *world) : NULL;
    const bool ok = joints && (world || fault_set_memory(l->fault)) && pose_all(l, v, skin, node, joints, world);
    if (ok)
        gltf_center_vertices(v, world);
    free(world);
    free(joints);
    return ok;
}
