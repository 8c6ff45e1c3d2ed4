/* SPDX-License-Identifier: MIT
 *
 * Configurations with a few rays that the host traces: BENCH_TRACED.
 */
#pragma once

#include "effects.h"
#include "rays.h"
#include "scenes.h"

/* A view's scene in Embree, and the textures of its rays. */
typedef struct host_rays {
    scene *scene;
    trace_scene *embree;
    map_reader draws; /* its renderer draws full-screen passes */
    rays rays;
    int offset[2];   /* of the pixel of each 2 x 2 at half size (rays.h) */
    double build_ms; /* of the acceleration structure, processor time of all threads */
} host_rays;

/* False, with one line in `error`; traced_close is due in either case. */
bool traced_open(host_rays *t, const bench_scene *b, int width, int height, failure *fault);
void traced_close(host_rays *t);

/* Reads surfaces back, traces the rays of the configuration and uploads them: t->rays.texture. */
bool traced_run(host_rays *t, const gbuffer *g, const bench_config *c, float radius, uint32_t seed, failure *fault);
