/* SPDX-License-Identifier: MIT
 *
 * A view to measure: the effect's inputs, the truth, and the pixels that count.
 */
#pragma once

#include "gbuffer.h"
#include "measure.h"
#include "options.h"
#include "perception.h"
#include "scenes.h"
#include "structure.h"
#include "truth.h"

typedef struct bench_view {
    char name[64];
    float radius;            /* scene units */
    float median_distance;   /* of what is seen, scene units */
    gbuffer gbuffer, beyond; /* the view proper; the same with a margin and a second layer */
    bench_truth truth;
    bench_truth flat; /* about the triangles' own normals, as depth alone shows them; where options.flat */
    perception perception;
    grain_places grain;
    float *distance;     /* 0: nothing there */
    float *normals;      /* three a pixel, view space */
    uint8_t *classes;    /* pixel_class; a pixel counts where both the tracer and OpenGL see a surface */
    double coverage;     /* share of the picture */
    double edge_share;   /* of the pixels that count */
    double tilted_share; /* of the smooth ones: shading normals more than 45 degrees off the surface */
    uint32_t triangles;
} bench_view;

/* False, with one line in `error`; bench_view_destroy is due in either case. */
bool bench_view_create(bench_view *v, const bench_scene *b, const options *o, failure *fault);
void bench_view_destroy(bench_view *v);
