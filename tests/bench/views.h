/* SPDX-License-Identifier: MIT
 *
 * A view, measured: what the effect is given, what the truth is, and which pixels count.
 */
#ifndef GLSSAO_BENCH_VIEWS_H
#define GLSSAO_BENCH_VIEWS_H

#include "gbuffer.h"
#include "measure.h"
#include "options.h"
#include "scenes.h"
#include "truth.h"

typedef struct bench_view {
    char name[64];
    float radius;            /* scene units */
    gbuffer gbuffer, beyond; /* the view proper; the same with a margin and a second layer */
    bench_truth truth;
    float *distance;     /* 0: nothing there */
    float *normals;      /* three a pixel, view space */
    uint8_t *classes;    /* pixel_class; a pixel counts where both the tracer and OpenGL see a surface */
    double coverage;     /* share of the picture */
    double edge_share;   /* of the pixels that count */
    double tilted_share; /* of the smooth ones: normals more than 45 degrees off the surface, which no one can trust */
    uint32_t triangles;
} bench_view;

/* False, with one line in `error`; bench_view_destroy is due in either case. */
bool bench_view_create(bench_view *v, const bench_scene *b, const options *o, char *error, size_t error_size);
void bench_view_destroy(bench_view *v);

#endif
