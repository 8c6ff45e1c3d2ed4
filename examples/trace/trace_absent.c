/* SPDX-License-Identifier: MIT
 *
 * The tracer of a build without Embree: it says so.
 */
#include "trace.h"

#include <stdio.h>

static bool absent(char *error, size_t error_size)
{
    snprintf(error, error_size, "this build is without Embree, and has no ray tracer");
    return false;
}

trace_scene *trace_scene_create(const scene *s, char *error, size_t error_size)
{
    (void)s;
    absent(error, error_size);
    return NULL;
}

void trace_scene_destroy(trace_scene *t)
{
    (void)t;
}

bool trace_accessibility(const trace_scene *t, const scene_view *view, const trace_options *options,
                         float *out_accessibility, uint8_t *out_foreground, trace_stats *out_stats, char *error,
                         size_t error_size)
{
    (void)t, (void)view, (void)options, (void)out_accessibility, (void)out_foreground, (void)out_stats;
    return absent(error, error_size);
}

bool trace_fans(const trace_scene *t, const scene_view *view, const trace_options *options, trace_fan_fn take,
                void *user, trace_stats *out_stats, char *error, size_t error_size)
{
    (void)t, (void)view, (void)options, (void)take, (void)user, (void)out_stats;
    return absent(error, error_size);
}

bool trace_open_directions(const trace_scene *t, const scene_view *view, const trace_options *options, float (*out)[3],
                           trace_stats *out_stats, char *error, size_t error_size)
{
    (void)t, (void)view, (void)options, (void)out, (void)out_stats;
    return absent(error, error_size);
}

bool trace_points(const trace_scene *t, const float (*positions)[3], const float (*normals)[3], size_t count,
                  trace_distribution distribution, float offset, const trace_options *options, float *out_accessibility,
                  trace_stats *out_stats, char *error, size_t error_size)
{
    (void)t, (void)positions, (void)normals, (void)count, (void)distribution, (void)offset, (void)options;
    (void)out_accessibility, (void)out_stats;
    return absent(error, error_size);
}

trace_picture *trace_picture_begin(const trace_scene *t, const scene_view *view, const trace_seen *seen,
                                   const uint8_t *counts, const trace_options *options, float *out, char *error,
                                   size_t error_size)
{
    (void)t, (void)view, (void)seen, (void)counts, (void)options, (void)out;
    absent(error, error_size);
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
