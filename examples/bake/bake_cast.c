/* SPDX-License-Identifier: MIT
 *
 * Casts the rays of all parts: each instance's points in the world, the mean over a part's instances, then values at
 * vertices.
 */
#include "bake.h"

#include "progress.h"
#include "trace.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ERROR_LENGTH = 1024 };

typedef struct caster {
    const bake_options *options;
    const trace_scene *scene;
    failure *fault;
    const double *origin;
    progress bar;
    double triangles_per_area;
    size_t steps, steps_done; /* one for each instance of a triangle */
    size_t step;              /* of the part being cast */
    float offset;
    uint32_t calls;
    bake_stats stats;
} caster;

static void report(double done, void *user)
{
    caster *c = user;
    progress_share(((double)c->steps_done + done * (double)c->step) / (double)c->steps, &c->bar);
}

static bool cast_points(caster *c, const bake_points *p, float *out)
{
    char error[ERROR_LENGTH];
    /* Each call numbers its points from 0, so it needs a seed of its own. With one seed, calls would repeat each
     * other's directions. */
    const trace_options options = {.radius = c->options->distance,
                                   .samples = c->options->rays,
                                   .seed = c->options->seed + 0x9e3779b9u * c->calls++,
                                   .threads = c->options->threads,
                                   .progress = report,
                                   .progress_user = c};
    trace_stats stats;
    if (!trace_points(c->scene, (const float(*)[3])p->positions, (const float(*)[3])p->normals, p->count,
                      c->options->cosine ? TRACE_COSINE : TRACE_UNIFORM, c->offset, &options, out, &stats,
                      FAULT(error))) {
        return fault_set(c->fault, "%s", error);
    }
    c->stats.rays += stats.rays;
    c->stats.seconds += stats.seconds;
    return true;
}

/* The values of one instance. A double-sided surface takes the more accessible side, since the other may be the inside
 * of a closed object. */
static bool cast_instance(caster *c, const bake_part *part, bake_points *p, float *values, float *scratch)
{
    if (!cast_points(c, p, values))
        return false;
    if (!part->double_sided)
        return true;
    for (size_t i = 0; i < p->count; i++)
        for (int k = 0; k < 3; k++)
            p->normals[i][k] *= -1;
    if (!cast_points(c, p, scratch))
        return false;
    for (size_t i = 0; i < p->count; i++)
        values[i] = fmaxf(values[i], scratch[i]);
    return true;
}

static bool cast_part(caster *c, bake_part *part)
{
    const bake_method method = c->options->method;
    float *memory = NULL;
    bake_points points = {0};
    bool ok = true;
    c->step = part->index_count / 3;
    for (size_t i = 0; ok && i < part->instance_count; i++) {
        bake_points_free(&points);
        ok = bake_points_make(&points, part, i, c->origin, method, c->triangles_per_area, c->fault);
        if (ok && !memory) { /* as many points in every instance */
            memory = calloc(3 * points.count + 1, sizeof *memory);
            ok = memory || fault_set_memory(c->fault);
        }
        float *sums = memory, *values = memory + points.count, *scratch = values + points.count;
        ok = ok && cast_instance(c, part, &points, values, scratch);
        for (size_t k = 0; ok && k < points.count; k++)
            sums[k] += values[k] / (float)part->instance_count;
        c->steps_done += c->step;
    }
    for (size_t k = 0; ok && k < points.count; k++)
        memory[k] = fmaxf(memory[k], c->options->floor_value);
    ok = ok && (!part->instance_count || bake_spread(part, &points, memory, method, c->fault));
    for (uint32_t k = 0; !part->instance_count && k < part->vertex_count; k++)
        part->accessibility[k] = 1;
    bake_points_free(&points);
    free(memory);
    return ok;
}

/* 64 times the precision of a float at the scene's largest coordinate, for every point alike. The tracer's own offset
 * is computed likewise for each triangle. */
static float choose_offset(const scene *s)
{
    float largest = 0;
    for (int i = 0; i < 3; i++)
        largest = fmaxf(largest, fmaxf(fabsf(s->bounds_min[i]), fabsf(s->bounds_max[i])));
    return 0x1p-18f * largest;
}

bool bake_cast(bake_model *m, const bake_options *o, bake_stats *out, failure *fault)
{
    const scene_load_options file = bake_load_options(o);
    scene *s = scene_load_with(o->input, &file, fault);
    for (size_t i = 0; s && i < s->warning_count; i++)
        fprintf(stderr, "%s: warning: %s\n", o->input, s->warnings[i]);
    trace_scene *t = s ? trace_scene_create(s, fault) : NULL;
    if (!t) {
        scene_destroy(s);
        fault->set = true; /* both name the file themselves */
        return false;
    }
    caster c = {.options = o, .scene = t, .fault = fault, .bar = progress_start("casting")};
    c.origin = m->origin;
    for (int i = 0; i < 3; i++)
        m->origin[i] = s->origin[i];
    c.offset = o->offset >= 0 ? o->offset : choose_offset(s);
    double area = 0, triangles = 0;
    for (size_t i = 0; i < m->part_count; i++) {
        area += bake_part_area(&m->parts[i]);
        triangles += m->parts[i].index_count / 3;
        c.steps += m->parts[i].index_count / 3 * m->parts[i].instance_count;
    }
    c.triangles_per_area = area > 0 ? triangles / area : 0;
    bool ok = true;
    for (size_t i = 0; ok && i < m->part_count; i++)
        ok = cast_part(&c, &m->parts[i]);
    progress_clear();
    trace_scene_destroy(t);
    scene_destroy(s);
    *out = c.stats;
    return ok;
}
