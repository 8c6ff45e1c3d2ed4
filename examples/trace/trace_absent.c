/* SPDX-License-Identifier: MIT
 *
 * The tracer of a build without Embree: it says so.
 */
#include "trace.h"

#include <stdio.h>

static bool absent(failure *fault)
{
    return fault_set(fault, "this build is without Embree, and has no ray tracer");
}

trace_scene *trace_scene_create(const scene *s, failure *fault)
{
    (void)s;
    absent(fault);
    return NULL;
}

void trace_scene_destroy(trace_scene *t)
{
    (void)t;
}

bool trace_accessibility(const trace_scene *t, const scene_view *view, const trace_options *options,
                         float *out_accessibility, uint8_t *out_foreground, trace_stats *out_stats, failure *fault)
{
    (void)t, (void)view, (void)options, (void)out_accessibility, (void)out_foreground, (void)out_stats;
    return absent(fault);
}

bool trace_fans(const trace_scene *t, const scene_view *view, const trace_options *options, trace_fan_fn take,
                void *user, trace_stats *out_stats, failure *fault)
{
    (void)t, (void)view, (void)options, (void)take, (void)user, (void)out_stats;
    return absent(fault);
}

bool trace_open_directions(const trace_scene *t, const scene_view *view, const trace_options *options, float (*out)[3],
                           trace_stats *out_stats, failure *fault)
{
    (void)t, (void)view, (void)options, (void)out, (void)out_stats;
    return absent(fault);
}

bool trace_points(const trace_scene *t, const float (*positions)[3], const float (*normals)[3], size_t count,
                  trace_distribution distribution, float offset, const trace_options *options, float *out_accessibility,
                  trace_stats *out_stats, failure *fault)
{
    (void)t, (void)positions, (void)normals, (void)count, (void)distribution, (void)offset, (void)options;
    (void)out_accessibility, (void)out_stats;
    return absent(fault);
}

trace_picture *trace_picture_begin(const trace_scene *t, const scene_view *view, const trace_seen *seen,
                                   const uint8_t *counts, const trace_options *options, float *out, failure *fault)
{
    (void)t, (void)view, (void)seen, (void)counts, (void)options, (void)out;
    absent(fault);
    return NULL;
}

void trace_picture_feed(trace_picture *p, int rows)
{
    (void)p, (void)rows;
}

bool trace_picture_end(trace_picture *p, trace_stats *out_stats)
{
    (void)p, (void)out_stats;
    return false;
}
