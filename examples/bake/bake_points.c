/* SPDX-License-Identifier: MIT
 *
 * Where a part's rays start: centroids, vertices, or points spread over the triangles.
 */
#include "bake.h"

#include <math.h>
#include <stdlib.h>

typedef struct vector {
    double x[3];
} vector;

/* In the file's coordinates. */
static vector to_world(const double m[16], const bake_part *part, uint32_t vertex)
{
    double p[3];
    for (int k = 0; k < 3; k++)
        p[k] = (double)part->positions[vertex][k] + part->center[k];
    vector out;
    for (int r = 0; r < 3; r++)
        out.x[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
    return out;
}

static vector cross(vector a, vector b)
{
    return (vector){
        {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

static double dot(vector a, vector b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static vector minus(vector a, vector b)
{
    return (vector){{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}

static vector column(const double m[16], int c)
{
    return (vector){{m[4 * c], m[4 * c + 1], m[4 * c + 2]}};
}

static double mirror_sign(const double m[16])
{
    return dot(column(m, 0), cross(column(m, 1), column(m, 2))) < 0 ? -1 : 1;
}

/* Unit; upwards where the vector has no direction. */
static void store_unit(vector v, float out[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        out[i] = length > 0 ? (float)(v.x[i] / length) : (float)(i == 1);
}

/* Twice the triangle's area, along its front's normal. */
static vector face_vector(const bake_part *part, const double m[16], uint32_t triangle, vector corners[3])
{
    for (uint32_t k = 0; k < 3; k++)
        corners[k] = to_world(m, part, part->indices[3 * triangle + k]);
    const vector face = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const double sign = mirror_sign(m);
    return (vector){{sign * face.x[0], sign * face.x[1], sign * face.x[2]}};
}

double bake_part_area(const bake_part *part)
{
    double sum = 0;
    vector corners[3];
    for (uint32_t t = 0; part->instance_count && t < part->index_count / 3; t++) {
        const vector face = face_vector(part, part->world_from_mesh[0], t, corners);
        sum += sqrt(dot(face, face)) / 2;
    }
    return sum;
}

static bool make_room(bake_points *p, size_t count, bool on_triangles, failure *fault)
{
    *p = (bake_points){.count = count};
    p->positions = malloc((count + 1) * sizeof *p->positions);
    p->normals = malloc((count + 1) * sizeof *p->normals);
    bool ok = p->positions && p->normals;
    if (on_triangles) {
        p->triangles = malloc((count + 1) * sizeof *p->triangles);
        p->weights = malloc((count + 1) * sizeof *p->weights);
        p->areas = malloc((count + 1) * sizeof *p->areas);
        ok = ok && p->triangles && p->weights && p->areas;
    }
    if (!ok) {
        bake_points_free(p);
        return fault_set_memory(fault);
    }
    return true;
}

void bake_points_free(bake_points *p)
{
    free(p->positions);
    free(p->normals);
    free(p->triangles);
    free(p->weights);
    free(p->areas);
    *p = (bake_points){0};
}

/* The inverse transpose, up to a positive factor. */
static vector normal_to_world(const double m[16], const float n[3])
{
    const double sign = mirror_sign(m);
    vector out = {{0, 0, 0}};
    for (int c = 0; c < 3; c++) {
        const vector cofactors = cross(column(m, (c + 1) % 3), column(m, (c + 2) % 3));
        for (int r = 0; r < 3; r++)
            out.x[r] += sign * cofactors.x[r] * (double)n[c];
    }
    return out;
}

/* Rays from vertices start along the vertex normal. If the file has none, or it has no direction, the sum of the
 * adjacent faces' normals takes its place. */
static bool make_vertices(bake_points *p, const bake_part *part, const double m[16], const double origin[3],
                          failure *fault)
{
    vector *sums = calloc((size_t)part->vertex_count + 1, sizeof *sums);
    if (!sums || !make_room(p, part->vertex_count, false, fault)) {
        free(sums);
        return fault_set_memory(fault);
    }
    for (uint32_t t = 0; t < part->index_count / 3; t++) {
        vector corners[3];
        const vector face = face_vector(part, m, t, corners);
        for (uint32_t k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                sums[part->indices[3 * t + k]].x[i] += face.x[i];
    }
    for (uint32_t i = 0; i < part->vertex_count; i++) {
        const vector at = to_world(m, part, i);
        const vector given = part->normals ? normal_to_world(m, part->normals[i]) : (vector){{0, 0, 0}};
        store_unit(dot(given, given) > 0 ? given : sums[i], p->normals[i]);
        for (int k = 0; k < 3; k++)
            p->positions[i][k] = (float)(at.x[k] - origin[k]);
    }
    free(sums);
    return true;
}

/* 3 points, and more on triangles larger than the mean. The size in the first instance counts, so that the points of
 * all instances correspond. */
static uint32_t count_points(double area, double triangles_per_area)
{
    return (uint32_t)fmin(3 + 6 * area * triangles_per_area, 4096);
}

/* Point i of n on a triangle: the R2 sequence (Roberts 2018), folded from the square, 1 of n: the centroid. */
static void place_point(uint32_t i, uint32_t n, float weights[3])
{
    double u = fmod(0.5 + 0.7548776662466927 * (i + 1), 1), v = fmod(0.5 + 0.5698402909980532 * (i + 1), 1);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    weights[0] = n == 1 ? 1 / 3.0f : (float)(1 - u - v);
    weights[1] = n == 1 ? 1 / 3.0f : (float)u;
    weights[2] = n == 1 ? 1 / 3.0f : (float)v;
}

bool bake_points_make(bake_points *p, const bake_part *part, size_t instance, const double origin[3],
                      bake_method method, double triangles_per_area, failure *fault)
{
    const double *m = part->world_from_mesh[instance];
    if (method == BAKE_VERTICES)
        return make_vertices(p, part, m, origin, fault);
    const uint32_t triangles = part->index_count / 3;
    uint32_t *counts = malloc((size_t)(triangles + 1) * sizeof *counts);
    float *areas = malloc((size_t)(triangles + 1) * sizeof *areas);
    size_t total = 0;
    vector corners[3];
    for (uint32_t t = 0; counts && areas && t < triangles; t++) {
        const vector face = face_vector(part, part->world_from_mesh[0], t, corners);
        const double area = sqrt(dot(face, face)) / 2;
        counts[t] = method == BAKE_FIT ? count_points(area, triangles_per_area) : 1;
        areas[t] = (float)area / (float)counts[t];
        total += counts[t];
    }
    const bool ok = (counts && areas && make_room(p, total, true, fault)) || fault_set_memory(fault);
    size_t at = 0;
    for (uint32_t t = 0; ok && t < triangles; t++) {
        const vector face = face_vector(part, m, t, corners);
        for (uint32_t i = 0; i < counts[t]; i++, at++) {
            place_point(i, counts[t], p->weights[at]);
            for (int k = 0; k < 3; k++)
                p->positions[at][k] = (float)((double)p->weights[at][0] * (corners[0].x[k] - origin[k]) +
                                              (double)p->weights[at][1] * (corners[1].x[k] - origin[k]) +
                                              (double)p->weights[at][2] * (corners[2].x[k] - origin[k]));
            store_unit(face, p->normals[at]);
            p->triangles[at] = t;
            p->areas[at] = areas[t];
        }
    }
    free(counts);
    free(areas);
    return ok;
}
