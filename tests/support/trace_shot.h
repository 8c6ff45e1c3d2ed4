/* SPDX-License-Identifier: MIT
 *
 * Small traced pictures and single points for the tests of the ray tracer. A failure of the tracer fails the test.
 */
#pragma once

#include "testing.h"
#include "trace.h"

SCOPED_BY(traced, trace_scene, trace_scene_destroy)

enum { TRACE_SHOT_SIDE = 32, TRACE_SHOT_PIXELS = TRACE_SHOT_SIDE * TRACE_SHOT_SIDE };

typedef struct trace_shot {
    float accessibility[TRACE_SHOT_PIXELS];
    uint8_t foreground[TRACE_SHOT_PIXELS];
    trace_stats stats;
} trace_shot;

trace_scene *trace_shot_open(const scene *s);
/* Accessibility of one point whose normal is +y. */
double trace_shot_point(const trace_scene *t, float x, float y, float z, float radius, int samples);

/* A view of the small picture's size; `scale` multiplies lengths. */
scene_view trace_shot_view(const float eye[3], const float target[3], float scale);
trace_shot trace_shot_take(const scene *s, const scene_view *view, trace_options options);
int trace_shot_foreground(const trace_shot *p);                         /* pixels that see a surface */
double trace_shot_difference(const trace_shot *a, const trace_shot *b); /* mean, absolute */
