/* SPDX-License-Identifier: MIT
 *
 * Values at vertices from values at points: the mean of the triangles around, or the least-squares fit.
 */
#include "bake.h"

#include <math.h>
#include <stdlib.h>

/* The weight of a difference along a triangle's edges, relative to an error of the same size all over the triangle. It
 * steadies vertices that few points see. Tuned on the floor of test_bake and on a furnished room: from 0 to 0.05 the
 * error changes by a tenth, and no picture visibly. */
static const double smoothness = 0.02;

/* Every vertex gets the mean of its triangles' values; 1 without triangles. */
static bool spread_mean(bake_part *part, const bake_points *points, const float *values, failure *fault)
{
    struct {
        double sum;
        uint32_t count;
    } *sums = calloc((size_t)part->vertex_count + 1, sizeof *sums);
    if (!sums)
        return fault_set_memory(fault);
    for (size_t i = 0; i < points->count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t vertex = part->indices[3 * points->triangles[i] + k];
            sums[vertex].sum += (double)values[i];
            sums[vertex].count++;
        }
    for (uint32_t i = 0; i < part->vertex_count; i++)
        part->accessibility[i] = sums[i].count ? (float)(sums[i].sum / sums[i].count) : 1;
    free(sums);
    return true;
}

/* The normal equations of a part. The matrix is not stored, but applied point by point. */
typedef struct equations {
    const bake_part *part;
    const bake_points *points;
    size_t count; /* of vertices */
} equations;

/* The three corners of a point's triangle. */
static const uint32_t *corners_of(const equations *e, size_t point)
{
    return e->part->indices + 3 * (size_t)e->points->triangles[point];
}

/* out = A x, where x^T A x is the squared interpolated value over the points, weighted by area, and the squared
 * differences along the edges. */
static void apply(const equations *e, const double *x, double *out)
{
    for (size_t i = 0; i < e->count; i++)
        out[i] = 0;
    for (size_t i = 0; i < e->points->count; i++) {
        const uint32_t *c = corners_of(e, i);
        const float *w = e->points->weights[i];
        const double area = (double)e->points->areas[i];
        const double value = (double)w[0] * x[c[0]] + (double)w[1] * x[c[1]] + (double)w[2] * x[c[2]];
        const double mean = (x[c[0]] + x[c[1]] + x[c[2]]) / 3;
        for (int k = 0; k < 3; k++)
            out[c[k]] += area * ((double)w[k] * value + smoothness * (x[c[k]] - mean));
    }
}

static void find_diagonal(const equations *e, double *out)
{
    for (size_t i = 0; i < e->points->count; i++) {
        const uint32_t *c = corners_of(e, i);
        for (int k = 0; k < 3; k++) {
            const double w = (double)e->points->weights[i][k];
            out[c[k]] += (double)e->points->areas[i] * (w * w + smoothness * 2 / 3);
        }
    }
}

static double dot(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Conjugate gradients with the diagonal as preconditioner. Vertices without area have a zero row, and keep their x. */
static void solve(const equations *e, double *x, double *residual, const double *diagonal, double *direction,
                  double *image)
{
    const size_t n = e->count;
    apply(e, x, image);
    double error = 0;
    for (size_t i = 0; i < n; i++) {
        residual[i] -= image[i];
        direction[i] = diagonal[i] > 0 ? residual[i] / diagonal[i] : 0;
    }
    error = dot(residual, direction, n);
    const double enough = 1e-10 * error;
    for (int step = 0; step < 200 && error > enough && error > 0; step++) {
        apply(e, direction, image);
        const double length = error / dot(direction, image, n);
        double next = 0;
        for (size_t i = 0; i < n; i++) {
            x[i] += length * direction[i];
            residual[i] -= length * image[i];
            next += diagonal[i] > 0 ? residual[i] * residual[i] / diagonal[i] : 0;
        }
        for (size_t i = 0; i < n; i++)
            direction[i] = (diagonal[i] > 0 ? residual[i] / diagonal[i] : 0) + next / error * direction[i];
        error = next;
    }
}

/* Minimises the squared error of what interpolation makes of the vertices over the surface (as Kavan, Bargteil and
 * Sloan, "Least squares vertex baking", EGSR 2011, with an edge term that steadies vertices that few points see). */
static bool spread_fit(bake_part *part, const bake_points *points, const float *values, failure *fault)
{
    const size_t n = part->vertex_count;
    double *memory = calloc(5 * n + 1, sizeof *memory);
    if (!memory || !spread_mean(part, points, values, fault)) {
        free(memory);
        return fault_set_memory(fault);
    }
    double *x = memory, *right = x + n, *diagonal = right + n, *direction = diagonal + n, *image = direction + n;
    const equations e = {.part = part, .points = points, .count = n};
    for (size_t i = 0; i < n; i++)
        x[i] = (double)part->accessibility[i];
    for (size_t i = 0; i < points->count; i++)
        for (int k = 0; k < 3; k++)
            right[corners_of(&e, i)[k]] += (double)points->areas[i] * (double)points->weights[i][k] * (double)values[i];
    find_diagonal(&e, diagonal);
    solve(&e, x, right, diagonal, direction, image);
    for (size_t i = 0; i < n; i++)
        part->accessibility[i] = (float)fmin(fmax(x[i], 0), 1);
    free(memory);
    return true;
}

bool bake_spread(bake_part *part, const bake_points *points, const float *values, bake_method method, failure *fault)
{
    if (method == BAKE_FIT)
        return spread_fit(part, points, values, fault);
    if (method == BAKE_TRIANGLES)
        return spread_mean(part, points, values, fault);
    for (size_t i = 0; i < points->count; i++)
        part->accessibility[i] = values[i];
    return true;
}
