/* SPDX-License-Identifier: MIT
 *
 * Loads a scene, draws it, traces it, classifies its pixels, and frees the scene.
 */
#include "views.h"

#include "peers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pixels within this distance of an edge count as near it: about the reach of the classic blur at half size, 5 texels.
 */
enum { EDGE_REACH = 10 };

static double inverse(const bench_view *v, size_t i)
{
    return v->distance[i] > 0 ? 1 / (double)v->distance[i] : 0;
}

/* View distance of pixel b from the plane through `before` and a. The inverse distance is linear over a plane. */
static double off_plane(const bench_view *v, size_t before, size_t a, size_t b)
{
    const double expected = 2 * inverse(v, a) - inverse(v, before);
    return fabs(inverse(v, b) - expected) * (double)v->distance[a] * (double)v->distance[b];
}

/* Whether there is an edge between neighbours a and b: sky on one side; normals more than 37 degrees apart; or a jump
 * of more than 0.4 of the radius from the plane of either side. The thresholds are those of the classic bilateral blur.
 */
static bool is_edge(const bench_view *v, size_t before, size_t a, size_t b, size_t after)
{
    if (!(v->distance[a] > 0) || !(v->distance[b] > 0))
        return v->distance[a] > 0 || v->distance[b] > 0;
    const float *n = &v->normals[3 * a], *m = &v->normals[3 * b];
    const double jump = fmin(off_plane(v, before, a, b), off_plane(v, after, b, a));
    return n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < 0.8f || jump > 0.4 * (double)v->radius;
}

/* Spreads marks by EDGE_REACH along rows (step 1) or columns (step width). */
static void spread(const uint8_t *from, uint8_t *to, int count, size_t step)
{
    int last = -EDGE_REACH - 1;
    for (int i = 0; i < count; i++) {
        last = from[(size_t)i * step] ? i : last;
        to[(size_t)i * step] = i - last <= EDGE_REACH;
    }
    last = count + EDGE_REACH;
    for (int i = count - 1; i >= 0; i--) {
        last = from[(size_t)i * step] ? i : last;
        to[(size_t)i * step] |= last - i <= EDGE_REACH;
    }
}

static void position(const bench_view *v, int x, int y, double out[3])
{
    const scene_view *view = &v->gbuffer.view;
    const float *c = view->clip_from_view;
    const double distance = (double)v->distance[(size_t)y * (size_t)view->width + (size_t)x];
    out[0] = ((2 * x + 1.0) / view->width - 1 + (double)c[8]) / (double)c[0] * distance;
    out[1] = ((2 * y + 1.0) / view->height - 1 + (double)c[9]) / (double)c[5] * distance;
    out[2] = -distance;
}

/* The pixels to the right and above must belong to the same surface. */
static bool is_tilted(const bench_view *v, int x, int y)
{
    const float *n = &v->normals[3 * ((size_t)y * (size_t)v->gbuffer.view.width + (size_t)x)];
    double p[3], u[3], w[3], dot = 0, length = 0;
    position(v, x, y, p);
    position(v, x + 1, y, u);
    position(v, x, y + 1, w);
    for (int k = 0; k < 3; k++) {
        u[k] -= p[k];
        w[k] -= p[k];
    }
    for (int k = 0; k < 3; k++) {
        const double across = u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3];
        dot += across * (double)n[k];
        length += across * across;
    }
    return dot < 0.7071 * sqrt(length);
}

static void count_shares(bench_view *v)
{
    const int w = v->gbuffer.view.width, h = v->gbuffer.view.height;
    double seen = 0, edges = 0, smooth = 0, tilted = 0;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            const uint8_t *c = &v->classes[(size_t)y * (size_t)w + (size_t)x];
            seen += *c != PIXEL_NONE;
            edges += *c == PIXEL_EDGE;
            if (x + 1 < w && y + 1 < h && c[0] == PIXEL_SMOOTH && c[1] == PIXEL_SMOOTH && c[w] == PIXEL_SMOOTH) {
                smooth++;
                tilted += is_tilted(v, x, y);
            }
        }
    v->coverage = seen / ((double)w * h);
    v->edge_share = seen > 0 ? edges / seen : 0;
    v->tilted_share = smooth > 0 ? tilted / smooth : 0;
}

static bool classify(bench_view *v)
{
    const int w = v->gbuffer.view.width, h = v->gbuffer.view.height;
    const size_t count = (size_t)w * (size_t)h;
    uint8_t *marks = calloc(2, count);
    v->classes = calloc(1, count);
    if (!marks || !v->classes) {
        free(marks);
        return false;
    }
    uint8_t *rows = marks + count;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            const size_t i = (size_t)y * (size_t)w + (size_t)x;
            const size_t left = x > 0 ? i - 1 : i, right = x + 2 < w ? i + 2 : i + 1;
            const size_t below = y > 0 ? i - (size_t)w : i, above = y + 2 < h ? i + 2 * (size_t)w : i + (size_t)w;
            marks[i] = (x + 1 < w && is_edge(v, left, i, i + 1, right)) ||
                       (y + 1 < h && is_edge(v, below, i, i + (size_t)w, above));
        }
    for (int y = 0; y < h; y++)
        spread(marks + (size_t)y * (size_t)w, rows + (size_t)y * (size_t)w, w, 1);
    for (int x = 0; x < w; x++)
        spread(rows + x, marks + x, h, (size_t)w);
    for (size_t i = 0; i < count; i++)
        if (v->distance[i] > 0 && v->truth.foreground[i])
            v->classes[i] = marks[i] ? PIXEL_EDGE : PIXEL_SMOOTH;
    count_shares(v);
    free(marks);
    return true;
}

static uint32_t count_triangles(const scene *s)
{
    uint32_t triangles = 0;
    for (uint32_t m = 0; m < s->mesh_count; m++)
        for (uint32_t p = 0; p < s->meshes[m].primitive_count; p++)
            triangles += s->primitives[s->meshes[m].first_primitive + p].index_count / 3 * s->meshes[m].instance_count;
    return triangles;
}

/* Gives each triangle vertices of its own, with its own normal. False when memory is short. */
static bool flatten(scene *s)
{
    scene_vertex *own = malloc(((size_t)s->index_count + 1) * sizeof *own);
    if (!own)
        return false;
    for (uint32_t i = 0; i < s->index_count; i++) {
        own[i] = s->vertices[s->indices[i]];
        s->indices[i] = i;
    }
    for (uint32_t i = 0; i + 2 < s->index_count; i += 3) {
        double u[3], w[3], n[3], length = 0;
        for (int k = 0; k < 3; k++) {
            u[k] = (double)own[i + 1].position[k] - (double)own[i].position[k];
            w[k] = (double)own[i + 2].position[k] - (double)own[i].position[k];
        }
        for (int k = 0; k < 3; k++) {
            n[k] = u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3];
            length += n[k] * n[k];
        }
        for (uint32_t c = i; length > 0 && c < i + 3; c++)
            for (int k = 0; k < 3; k++)
                own[c].normal[k] = (float)(n[k] / sqrt(length));
    }
    free(s->vertices);
    s->vertices = own;
    s->vertex_count = s->index_count;
    return true;
}

/* Both truths; the flat one last, because it changes the scene. */
static bool trace(bench_view *v, scene *s, const scene_view *view, const options *o, failure *fault)
{
    const truth_request request = {
        .name = v->name, .cache = o->cache, .radius = v->radius, .rays = o->rays, .seed = o->seed};
    if (!truth_get(&request, s, view, &v->truth, fault))
        return false;
    if (!o->flat)
        return true;
    if (!flatten(s))
        return fault_set_memory(fault);
    return truth_get(&request, s, view, &v->flat, fault);
}

bool bench_view_create(bench_view *v, const bench_scene *b, const options *o, failure *fault)
{
    *v = (bench_view){.radius = 0};
    memcpy(v->name, b->name, sizeof v->name);
    scene_view view;
    scene *s = bench_scene_open(b, o->size[0], o->size[1], &view, &v->radius, fault);
    if (!s)
        return false;
    v->triangles = count_triangles(s);
    bool made = gbuffer_draw(&v->gbuffer, s, &view, 0, fault) &&
                gbuffer_draw(&v->beyond, s, &view, gbuffer_margin(view.width), fault) && trace(v, s, &view, o, fault);
    scene_destroy(s);
    if (!made)
        return false;
    gbuffer_read(&v->gbuffer, &v->distance, &v->normals);
    if (v->distance)
        v->median_distance = peers_distance(v->distance, (size_t)view.width * (size_t)view.height);
    made = v->distance && classify(v) &&
           perception_create(&v->perception, v->truth.accessibility, v->classes, view.width, view.height) &&
           grain_create(&v->grain, v->truth.accessibility, v->classes, view.width, view.height);
    if (!made)
        fault_set_memory(fault);
    return made;
}

void bench_view_destroy(bench_view *v)
{
    gbuffer_destroy(&v->gbuffer);
    gbuffer_destroy(&v->beyond);
    truth_destroy(&v->truth);
    truth_destroy(&v->flat);
    perception_destroy(&v->perception);
    grain_destroy(&v->grain);
    free(v->distance);
    free(v->normals);
    free(v->classes);
    *v = (bench_view){.radius = 0};
}
