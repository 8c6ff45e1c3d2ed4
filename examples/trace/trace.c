/* SPDX-License-Identifier: MIT
 *
 * Accessibility of pictures and of lists of points: jobs of a tile of pixels, or a run of points, each.
 */
#include "clock.h"
#include "trace_internal.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

enum { TILE = 8, POINTS_A_JOB = 64, MOST_SAMPLES = 1 << 24 };

typedef struct work {
    const trace_scene *trace;
    trace_samples samples;
    float radius, *out;
    atomic_uint_fast64_t rays;

    trace_eye eye; /* pixels */
    int width, height;
    size_t tiles_across;
    uint8_t *foreground;
    trace_fan_fn take; /* instead of `out` */
    void *take_user;

    const float (*positions)[3], (*normals)[3]; /* points */
    size_t count;
    float offset;
    bool (*stopped)(void *user);
    void *stopped_user;
} work;

static void trace_one(const work *w, uint64_t number, const trace_point *point)
{
    const float open =
        trace_point_accessibility(w->trace, &w->samples, w->radius, number, point, w->take, w->take_user);
    if (w->out)
        w->out[number] = open;
}

/* Once a job: a counter that every thread writes for every point leaves no core its copy of the members beside it. */
static void count_points(work *w, int points)
{
    atomic_fetch_add_explicit(&w->rays, (uint_fast64_t)points * (uint_fast64_t)w->samples.count, memory_order_relaxed);
}

/* What the pixel's centre sees. */
static bool find_point(const work *w, int x, int y, trace_point *out)
{
    double origin[3], length;
    trace_query query = {.trace = w->trace};
    double *direction = query.direction_world;
    if (!trace_eye_ray(&w->eye, 2 * (x + 0.5) / w->width - 1, 2 * (y + 0.5) / w->height - 1, origin, direction,
                       &length)) {
        return false;
    }
    embree_init_context(&query.embree);
    struct RTCRayHit ray = {.ray = {.org_x = (float)origin[0],
                                    .org_y = (float)origin[1],
                                    .org_z = (float)origin[2],
                                    .dir_x = (float)direction[0],
                                    .dir_y = (float)direction[1],
                                    .dir_z = (float)direction[2],
                                    .tfar = (float)length,
                                    .mask = UINT32_MAX},
                            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .instID = {RTC_INVALID_GEOMETRY_ID}}};
    embree_intersect(w->trace->world, &query.embree, &ray);
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID &&
           trace_resolve_hit(w->trace, &ray.hit, direction, 0.01 * (double)w->radius, out);
}

static void trace_tile(size_t tile, void *user)
{
    work *w = user;
    if (w->stopped && w->stopped(w->stopped_user))
        return;
    const int left = (int)(tile % w->tiles_across) * TILE, bottom = (int)(tile / w->tiles_across) * TILE;
    int points = 0;
    for (int y = bottom; y < bottom + TILE && y < w->height; y++)
        for (int x = left; x < left + TILE && x < w->width; x++) {
            const size_t pixel = (size_t)y * (size_t)w->width + (size_t)x;
            trace_point point;
            const bool seen = find_point(w, x, y, &point);
            points += seen;
            if (seen) {
                trace_one(w, pixel, &point);
            } else if (w->out) {
                w->out[pixel] = 1;
            }
            if (w->foreground)
                w->foreground[pixel] = seen;
        }
    count_points(w, points);
}

static void trace_run_of_points(size_t job, void *user)
{
    work *w = user;
    int points = 0;
    for (size_t i = job * POINTS_A_JOB; i < (job + 1) * POINTS_A_JOB && i < w->count; i++) {
        trace_point point;
        for (int k = 0; k < 3; k++) {
            point.normal[k] = (double)w->normals[i][k];
            point.origin[k] = (double)w->positions[i][k] + (double)w->offset * point.normal[k];
        }
        trace_one(w, i, &point);
        points++;
    }
    count_points(w, points);
}

static bool run(work *w, trace_distribution distribution, const trace_options *o, size_t jobs,
                void (*job)(size_t job, void *user), trace_stats *out_stats, failure *fault)
{
    if (o->samples < 1 || o->samples > MOST_SAMPLES || !(o->radius >= 0))
        return fault_set(fault, "%d rays within a radius of %g: out of range", o->samples, (double)o->radius);
    if (!trace_samples_open(&w->samples, o->samples, distribution, o->seed))
        return fault_set(fault, "%d rays: out of memory", o->samples);
    w->radius = o->radius;
    w->stopped = o->stopped;
    w->stopped_user = o->stopped_user;
    const double start = clock_wall_ms();
    trace_run_jobs(o->threads, jobs, job, w, o->progress, o->progress_user);
    if (out_stats)
        *out_stats = (trace_stats){.rays = atomic_load(&w->rays), .seconds = (clock_wall_ms() - start) * 1e-3};
    trace_samples_close(&w->samples);
    if (w->stopped && w->stopped(w->stopped_user))
        return fault_set(fault, "stopped");
    return true;
}

static bool run_view(work *w, const scene_view *view, const trace_options *options, trace_stats *out_stats,
                     failure *fault)
{
    w->width = view->width;
    w->height = view->height;
    w->tiles_across = ((size_t)view->width + TILE - 1) / TILE;
    if (!trace_eye_open(view, &w->eye))
        return fault_set(fault, "the view's matrices have no inverse");
    const size_t tiles = w->tiles_across * (((size_t)view->height + TILE - 1) / TILE);
    return run(w, TRACE_COSINE, options, tiles, trace_tile, out_stats, fault);
}

bool trace_accessibility(const trace_scene *t, const scene_view *view, const trace_options *options,
                         float *out_accessibility, uint8_t *out_foreground, trace_stats *out_stats, failure *fault)
{
    work w = {.trace = t, .out = out_accessibility, .foreground = out_foreground};
    return run_view(&w, view, options, out_stats, fault);
}

bool trace_fans(const trace_scene *t, const scene_view *view, const trace_options *options, trace_fan_fn take,
                void *user, trace_stats *out_stats, failure *fault)
{
    work w = {.trace = t, .take = take, .take_user = user};
    return run_view(&w, view, options, out_stats, fault);
}

typedef struct open_sum {
    const float *view_from_world;
    int samples;
    float (*out)[3];
} open_sum;

static void add_open(const trace_fan *fan, void *user)
{
    const open_sum *s = user;
    const float *m = s->view_from_world;
    for (int i = 0; i < fan->count; i++) {
        const float *d = fan->directions[i];
        for (int k = 0; k < 3 && !fan->blocked[i]; k++)
            s->out[fan->pixel][k] += (m[k] * d[0] + m[4 + k] * d[1] + m[8 + k] * d[2]) / (float)s->samples;
    }
}

bool trace_open_directions(const trace_scene *t, const scene_view *view, const trace_options *options, float (*out)[3],
                           trace_stats *out_stats, failure *fault)
{
    open_sum sum = {view->view_from_world, options->samples, out};
    memset(out, 0, sizeof *out * (size_t)view->width * (size_t)view->height);
    return trace_fans(t, view, options, add_open, &sum, out_stats, fault);
}

bool trace_points(const trace_scene *t, const float (*positions)[3], const float (*normals)[3], size_t count,
                  trace_distribution distribution, float offset, const trace_options *options, float *out_accessibility,
                  trace_stats *out_stats, failure *fault)
{
    work w = {.trace = t, .out = out_accessibility, .positions = positions, .normals = normals, .offset = offset};
    w.count = count;
    return run(&w, distribution, options, (count + POINTS_A_JOB - 1) / POINTS_A_JOB, trace_run_of_points, out_stats,
               fault);
}
