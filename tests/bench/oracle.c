/* SPDX-License-Identifier: MIT
 *
 * Distances of the ray and of the surface are kept as their inverses, which are linear over the screen along a straight
 * line and over a plane.
 */
#define _POSIX_C_SOURCE 200809L
#include "oracle.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

enum { LEAST_STEPS = 32, MAX_THREADS = 64 };
static const double two_pi = 6.283185307179586;

typedef struct march {
    const bench_view *view;
    const sampled_pixels *pixels;
    int rays, threads;
    uint32_t seed;
    const double *thickness;
    float *const *out;
    double *inverse, *slope_x, *slope_y; /* a pixel: 1 / view distance (0: sky), its change to the next pixel */
    double radius;
    double pixel; /* its size at view distance 1 */
} march;

typedef struct worker {
    pthread_t thread;
    const march *march;
    int number;
} worker;

static uint32_t hash(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du; /* Wellons, "Prospecting for hash functions" */
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

sampled_pixels oracle_pixels(const bench_view *v, int step, uint32_t seed)
{
    const int w = v->gbuffer.view.width, h = v->gbuffer.view.height;
    sampled_pixels p = {0, malloc(((size_t)(w / step) + 1) * ((size_t)(h / step) + 1) * sizeof *p.index)};
    for (int y = 0; p.index && y < h; y += step)
        for (int x = 0; x < w; x += step) {
            const uint32_t random = hash(hash((uint32_t)(y * w + x)) ^ seed);
            const int px = x + (int)(random % (uint32_t)step), py = y + (int)(random / 65536u % (uint32_t)step);
            if (px < w && py < h && v->classes[py * w + px] != PIXEL_NONE)
                p.index[p.count++] = py * w + px;
        }
    return p;
}

static bool agree(double a, double b)
{
    return fabs(a - b) < 0.5 * fmin(fabs(a), fabs(b));
}

/* The change of the inverse distance to the next pixel, where `at` is pixel `i` of `count` in a row. The smaller
 * one-sided difference belongs to the surface that the pixel shows, if its slope is at most 4 pixel sizes a pixel, or
 * if the pixels on both sides, or the next two, lie in one plane. Otherwise the pixel shows something thin:
 * `from_normal`. */
static double slope(const march *m, int at, int step, int i, int count, double from_normal)
{
    const double *v = m->inverse, here = v[at], gentle = 4 * here * m->pixel;
    const double before = i > 0 ? here - v[at - step] : INFINITY;
    const double after = i + 1 < count ? v[at + step] - here : INFINITY;
    if (fabs(before) < fabs(after)) {
        const bool plane = agree(before, after) || (i > 1 && agree(before, v[at - step] - v[at - 2 * step]));
        return plane || fabs(before) < gentle ? before : from_normal;
    }
    const bool plane = agree(before, after) || (i + 2 < count && agree(after, v[at + 2 * step] - v[at + step]));
    return plane || fabs(after) < gentle ? after : from_normal;
}

/* Both slopes by the stored normal. Over a plane n . x = n . p the inverse distance is n . r / n . p, where r is the
 * point of the pixel's ray at distance 1. */
static void slopes_of_normal(const march *m, int x, int y, double out[2])
{
    const scene_view *view = &m->view->gbuffer.view;
    const int at = y * view->width + x;
    const float *c = view->clip_from_view, *n = &m->view->normals[3 * (size_t)at];
    const double rx = ((2 * x + 1.0) / view->width - 1 + (double)c[8]) / (double)c[0];
    const double ry = ((2 * y + 1.0) / view->height - 1 + (double)c[9]) / (double)c[5];
    const double facing = (double)n[0] * rx + (double)n[1] * ry - (double)n[2];
    const double scale = fabs(facing) > 0.05 ? m->inverse[at] / facing : 0; /* shading normals may look away */
    out[0] = scale * (double)n[0] * 2 / (view->width * (double)c[0]);
    out[1] = scale * (double)n[1] * 2 / (view->height * (double)c[5]);
}

static bool prepare(march *m)
{
    const int w = m->view->gbuffer.view.width, h = m->view->gbuffer.view.height;
    const size_t count = (size_t)w * (size_t)h;
    m->inverse = calloc(3 * count, sizeof *m->inverse);
    if (!m->inverse)
        return false;
    m->slope_x = m->inverse + count;
    m->slope_y = m->slope_x + count;
    for (size_t i = 0; i < count; i++)
        m->inverse[i] = m->view->distance[i] > 0 ? 1 / (double)m->view->distance[i] : 0;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            const int i = y * w + x;
            double from_normal[2];
            slopes_of_normal(m, x, y, from_normal);
            m->slope_x[i] = slope(m, i, 1, x, w, from_normal[0]);
            m->slope_y[i] = slope(m, i, w, y, h, from_normal[1]);
        }
    return true;
}

typedef struct ray_end {
    double x, y, inverse; /* pixels, pixel centres at halves; 1 / view distance */
} ray_end;

/* Projects a view-space point. */
static ray_end project(const march *m, const double p[3])
{
    const scene_view *view = &m->view->gbuffer.view;
    const float *c = view->clip_from_view;
    const double inverse = -1 / p[2];
    return (ray_end){((double)c[0] * p[0] * inverse - (double)c[8] + 1) * 0.5 * view->width,
                     ((double)c[5] * p[1] * inverse - (double)c[9] + 1) * 0.5 * view->height, inverse};
}

/* The least distance by which the ray lies behind the visible surface; INFINITY: it never does. `tolerance` times the
 * square of the distance is the depth buffer's resolution. */
static double least_depth_behind(const march *m, ray_end from, ray_end to, double tolerance)
{
    const int w = m->view->gbuffer.view.width, h = m->view->gbuffer.view.height;
    const double dx = to.x - from.x, dy = to.y - from.y, di = to.inverse - from.inverse;
    const double length = ceil(fmax(fabs(dx), fabs(dy)));
    const int steps = length > LEAST_STEPS ? (int)length : LEAST_STEPS;
    double least = INFINITY;
    for (int s = 1; s <= steps; s++) {
        const double t = (double)s / steps, x = from.x + t * dx, y = from.y + t * dy;
        if (!(x >= 0 && y >= 0 && x < w && y < h))
            break;
        const int px = (int)x, py = (int)y, at = py * w + px;
        if (!(m->inverse[at] > 0))
            continue;
        const double surface = m->inverse[at] + m->slope_x[at] * (x - px - 0.5) + m->slope_y[at] * (y - py - 0.5);
        const double ray = from.inverse + t * di;
        if (ray >= surface)
            continue;
        const double distance = 1 / ray, behind = distance - 1 / surface;
        if (behind > 0.005 * m->radius + tolerance * distance * distance && behind < least)
            least = behind;
    }
    return least;
}

/* Two unit vectors orthogonal to n and to each other (Duff et al. 2017). */
static void basis(const double n[3], double t[3], double b[3])
{
    const double sign = copysign(1, n[2]), a = -1 / (sign + n[2]), c = n[0] * n[1] * a;
    t[0] = 1 + sign * n[0] * n[0] * a;
    t[1] = sign * c;
    t[2] = -sign * n[0];
    b[0] = c;
    b[1] = sign + n[1] * n[1] * a;
    b[2] = -n[1];
}

static void march_pixel(const march *m, int i)
{
    const scene_view *view = &m->view->gbuffer.view;
    const int at = m->pixels->index[i], x = at % view->width, y = at / view->width;
    const float *c = view->clip_from_view, *stored = &m->view->normals[3 * (size_t)at];
    const double distance = (double)m->view->distance[at];
    const double p[3] = {((2 * x + 1.0) / view->width - 1 + (double)c[8]) / (double)c[0] * distance,
                         ((2 * y + 1.0) / view->height - 1 + (double)c[9]) / (double)c[5] * distance, -distance};
    double n[3] = {(double)stored[0], (double)stored[1], (double)stored[2]}, t[3], b[3];
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        n[k] = length > 0 ? n[k] / length : k == 2;
    basis(n, t, b);
    const double tolerance = 2 * gbuffer_depth_step(&m->view->gbuffer, 1);
    const uint32_t random = hash(hash((uint32_t)at) ^ m->seed);
    const double turn = random * 0x1p-32, shift = hash(random) * 0x1p-32;
    int blocked[THICKNESS_COUNT] = {0};
    const ray_end from = project(m, p);
    for (int r = 0; r < m->rays; r++) {
        /* Cosine-weighted: uniform on the disc, raised to the hemisphere. Strata in the radius, golden angles. */
        const double u = fmod((r + 0.5) / m->rays + shift, 1), angle = two_pi * fmod(r * 0.6180339887498949 + turn, 1);
        const double side_t = sqrt(u) * cos(angle), side_b = sqrt(u) * sin(angle), up = sqrt(1 - u);
        double q[3], reach = m->radius;
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = side_t * t[k] + side_b * b[k] + up * n[k];
        if (p[2] + reach * d[2] > -0.01 * distance) /* towards the eye: stop short of it */
            reach = (-0.01 * distance - p[2]) / d[2];
        for (int k = 0; k < 3; k++)
            q[k] = p[k] + reach * d[k];
        const double behind = least_depth_behind(m, from, project(m, q), tolerance);
        for (int k = 0; k < THICKNESS_COUNT; k++)
            blocked[k] += behind < m->thickness[k] * m->radius;
    }
    for (int k = 0; k < THICKNESS_COUNT; k++)
        m->out[k][i] = 1 - (float)blocked[k] / (float)m->rays;
}

/* Neighbouring pixels go to different threads, so that the work is balanced. */
static void *run_worker(void *argument)
{
    const worker *w = argument;
    for (int i = w->number; i < w->march->pixels->count; i += w->march->threads)
        march_pixel(w->march, i);
    return NULL;
}

bool oracle_march(const bench_view *v, const sampled_pixels *pixels, int rays, int threads, uint32_t seed,
                  const double thickness[THICKNESS_COUNT], float *const out[THICKNESS_COUNT])
{
    worker workers[MAX_THREADS];
    march m = {.view = v,
               .pixels = pixels,
               .rays = rays,
               .threads = threads < 1             ? 1
                          : threads > MAX_THREADS ? MAX_THREADS
                                                  : threads,
               .seed = seed,
               .thickness = thickness,
               .out = out,
               .radius = (double)v->radius,
               .pixel = 2 / (v->gbuffer.view.height * (double)v->gbuffer.view.clip_from_view[5])};
    if (!prepare(&m))
        return false;
    int started = 0;
    for (; started < m.threads; started++) {
        workers[started] = (worker){.march = &m, .number = started};
        if (pthread_create(&workers[started].thread, NULL, run_worker, &workers[started]) != 0)
            break;
    }
    for (int i = 0; i < started; i++)
        pthread_join(workers[i].thread, NULL);
    free(m.inverse);
    return started == m.threads;
}
