/* SPDX-License-Identifier: MIT
 *
 * MikkTSpace's steps: vertices that agree in position, normal and uv are one; the faces around a vertex that hang
 * together by edges and turn the same way on the texture form a group; a group's tangent is the mean of its faces'
 * directions of growing u, in the plane of the normal, weighted by the angle at the vertex. Its angular threshold is
 * the usual 180 degrees, so that a group is never cut further. v grows downwards in glTF and upwards there.
 */
#include "tangent_space.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NONE = -1 };

typedef struct face {
    uint32_t vertex[3]; /* of the vertices that agree, the first */
    int neighbour[3];   /* the face across the edge from that corner to the next */
    int group[3];       /* of each corner */
    double along_u[3];  /* unit direction in which u grows, on the face */
    bool degenerate;    /* two corners at one place: takes no part */
    bool any;           /* its uvs have no direction: it joins whichever group comes first */
    bool preserving;    /* turns on the texture the way it turns in space */
} face;

typedef struct group {
    double sum[3]; /* of along_u, weighted */
    bool preserving;
} group;

typedef struct edge {
    uint32_t low, high, face;
    uint32_t corner; /* where it starts, in the face's order */
} edge;

typedef struct work {
    const scene_vertex *vertices;
    int uv;
    face *faces;
    int face_count, group_count;
    group *groups;
    int *stack; /* faces still to visit */
} work;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double normalize(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] = length > 0 ? v[i] / length : 0;
    return length;
}

/* Into the plane of unit normal n, and unit there. */
static double project(const float normal[3], double v[3])
{
    const double n[3] = {normal[0], normal[1], normal[2]};
    const double along = dot(n, v);
    for (int i = 0; i < 3; i++)
        v[i] -= along * n[i];
    return normalize(v);
}

static bool agree(const work *w, uint32_t a, uint32_t b)
{
    const scene_vertex *x = &w->vertices[a], *y = &w->vertices[b];
    bool same = x->uv[w->uv][0] == y->uv[w->uv][0] && x->uv[w->uv][1] == y->uv[w->uv][1];
    for (int i = 0; i < 3; i++)
        same = same && x->position[i] == y->position[i] && x->normal[i] == y->normal[i];
    return same;
}

static uint32_t hash(const work *w, uint32_t index)
{
    const scene_vertex *v = &w->vertices[index];
    const float parts[8] = {v->position[0], v->position[1], v->position[2],   v->normal[0],
                            v->normal[1],   v->normal[2],   v->uv[w->uv][0], v->uv[w->uv][1]};
    uint32_t h = 2166136261u; /* FNV-1a, a word at a time */
    for (int i = 0; i < 8; i++) {
        uint32_t bits;
        const float part = parts[i] + 0.0f; /* -0 agrees with 0 */
        memcpy(&bits, &part, sizeof bits);
        h = (h ^ bits) * 16777619u;
        h ^= h >> 15;
    }
    return h;
}

/* Open addressing, twice as many places as corners. */
static bool weld(work *w, const uint32_t *indices, uint32_t count)
{
    uint32_t size = 4;
    while (size < 2 * (uint64_t)count && size < 1u << 31)
        size *= 2;
    uint32_t *table = malloc(size * sizeof *table);
    if (!table)
        return false;
    memset(table, 0xff, size * sizeof *table);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t at = hash(w, indices[i]) & (size - 1);
        while (table[at] != UINT32_MAX && !agree(w, table[at], indices[i]))
            at = (at + 1) & (size - 1);
        if (table[at] == UINT32_MAX)
            table[at] = indices[i];
        w->faces[i / 3].vertex[i % 3] = table[at];
    }
    free(table);
    return true;
}

static void subtract(const work *w, uint32_t a, uint32_t b, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)w->vertices[a].position[i] - (double)w->vertices[b].position[i];
}

static void measure_face(const work *w, face *f)
{
    double side[2][3], du[2], dv[2];
    for (int k = 0; k < 2; k++) {
        const float *uv0 = w->vertices[f->vertex[0]].uv[w->uv], *uv = w->vertices[f->vertex[k + 1]].uv[w->uv];
        subtract(w, f->vertex[k + 1], f->vertex[0], side[k]);
        du[k] = (double)uv[0] - (double)uv0[0];
        dv[k] = (double)uv0[1] - (double)uv[1]; /* upwards */
    }
    double between[3];
    subtract(w, f->vertex[2], f->vertex[1], between);
    f->degenerate = dot(side[0], side[0]) == 0 || dot(side[1], side[1]) == 0 || dot(between, between) == 0;
    const double area = du[0] * dv[1] - dv[0] * du[1];
    f->preserving = area > 0;
    for (int i = 0; i < 3; i++)
        f->along_u[i] = (f->preserving ? 1 : -1) * (dv[1] * side[0][i] - dv[0] * side[1][i]);
    f->any = !(fabs(area) > (double)FLT_MIN) || !(normalize(f->along_u) > 0);
    for (int k = 0; k < 3; k++)
        f->neighbour[k] = f->group[k] = NONE;
}

static int compare_edges(const void *a, const void *b)
{
    const edge *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return (x->face > y->face) - (x->face < y->face);
}

/* Faces are neighbours where they run along an edge in opposite directions; each edge of a face has one at most. */
static bool find_neighbours(work *w)
{
    edge *edges = malloc(((size_t)w->face_count * 3 + 1) * sizeof *edges);
    if (!edges)
        return false;
    size_t count = 0;
    for (int f = 0; f < w->face_count; f++)
        for (uint32_t k = 0; k < 3 && !w->faces[f].degenerate; k++) {
            const uint32_t a = w->faces[f].vertex[k], b = w->faces[f].vertex[(k + 1) % 3];
            edges[count++] = (edge){a < b ? a : b, a < b ? b : a, (uint32_t)f, k};
        }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (size_t i = 0; i < count; i++) {
        face *one = &w->faces[edges[i].face];
        for (size_t j = i + 1; j < count && edges[j].low == edges[i].low && edges[j].high == edges[i].high &&
                               one->neighbour[edges[i].corner] == NONE;
             j++) {
            face *other = &w->faces[edges[j].face];
            if (other->neighbour[edges[j].corner] == NONE &&
                one->vertex[edges[i].corner] != other->vertex[edges[j].corner]) {
                one->neighbour[edges[i].corner] = (int)edges[j].face;
                other->neighbour[edges[j].corner] = (int)edges[i].face;
            }
        }
    }
    free(edges);
    return true;
}

static void add_to_group(const work *w, const face *f, int corner, group *g)
{
    if (f->any)
        return;
    const uint32_t here = f->vertex[corner];
    const float *normal = w->vertices[here].normal;
    double along[3], to_next[3], to_last[3];
    memcpy(along, f->along_u, sizeof along);
    subtract(w, f->vertex[(corner + 1) % 3], here, to_next);
    subtract(w, f->vertex[(corner + 2) % 3], here, to_last);
    project(normal, along);
    project(normal, to_next);
    project(normal, to_last);
    const double angle = acos(fmax(-1, fmin(1, dot(to_next, to_last))));
    for (int i = 0; i < 3; i++)
        g->sum[i] += angle * along[i];
}

/* Everything that hangs together with that corner, around its vertex. */
static void make_group(work *w, int first, int first_corner)
{
    const int number = w->group_count++;
    group *g = &w->groups[number];
    const uint32_t vertex = w->faces[first].vertex[first_corner];
    *g = (group){.preserving = w->faces[first].preserving};
    int waiting = 0;
    w->stack[waiting++] = first;
    while (waiting) {
        face *f = &w->faces[w->stack[--waiting]];
        const int corner = f->vertex[0] == vertex ? 0 : f->vertex[1] == vertex ? 1 : 2;
        if (f->group[corner] != NONE)
            continue;
        if (f->any && f->group[0] == NONE && f->group[1] == NONE && f->group[2] == NONE)
            f->preserving = g->preserving;
        if (f->preserving != g->preserving)
            continue;
        f->group[corner] = number;
        add_to_group(w, f, corner, g);
        /* The stack holds two a face at most, as a face is taken once. */
        for (int side = 0; side < 3; side += 2)
            if (f->neighbour[(corner + side) % 3] != NONE)
                w->stack[waiting++] = f->neighbour[(corner + side) % 3];
    }
}

static void any_tangent(const float normal[3], float out[4])
{
    double v[3] = {0, 0, 0};
    v[fabsf(normal[0]) < 0.6f ? 0 : 1] = 1;
    project(normal, v);
    for (int i = 0; i < 3; i++)
        out[i] = (float)v[i];
    out[3] = 1;
}

static void write_tangent(const work *w, int number, const float normal[3], float out[4])
{
    double sum[3] = {0, 0, 0};
    if (number != NONE)
        memcpy(sum, w->groups[number].sum, sizeof sum);
    if (!(normalize(sum) > 0)) {
        any_tangent(normal, out);
        return;
    }
    for (int i = 0; i < 3; i++)
        out[i] = (float)sum[i];
    out[3] = w->groups[number].preserving ? 1 : -1;
}

static void make_groups(work *w)
{
    for (int f = 0; f < w->face_count; f++)
        for (int k = 0; k < 3; k++)
            if (!w->faces[f].degenerate && !w->faces[f].any && w->faces[f].group[k] == NONE)
                make_group(w, f, k);
}

bool tangent_space_make(const scene_vertex *vertices, int uv, const uint32_t *indices, uint32_t index_count,
                        float (*out)[4])
{
    work w = {.vertices = vertices, .uv = uv, .face_count = (int)(index_count / 3)};
    const size_t corners = (size_t)w.face_count * 3;
    w.faces = malloc(((size_t)w.face_count + 1) * sizeof *w.faces);
    w.groups = malloc((corners + 1) * sizeof *w.groups);
    w.stack = malloc((2 * (size_t)w.face_count + 3) * sizeof *w.stack);
    bool done = w.faces && w.groups && w.stack && weld(&w, indices, (uint32_t)corners);
    for (int f = 0; done && f < w.face_count; f++)
        measure_face(&w, &w.faces[f]);
    done = done && find_neighbours(&w);
    if (done) {
        make_groups(&w);
        for (size_t i = 0; i < corners; i++)
            write_tangent(&w, w.faces[i / 3].group[i % 3], vertices[indices[i]].normal, out[i]);
    }
    free(w.faces);
    free(w.groups);
    free(w.stack);
    return done;
}
