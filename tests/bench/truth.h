/* SPDX-License-Identifier: MIT
 *
 * Ray-traced accessibility of a view, traced once and kept on disk under a hash of all that it depends on.
 */
#pragma once

#include "draw.h"
#include "scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct bench_truth {
    float *accessibility; /* a pixel; rows bottom to top */
    uint8_t *foreground;  /* 1 where something is seen */
    uint64_t rays;        /* cast; 0: read from the cache */
    double seconds;
} bench_truth;

typedef struct truth_request {
    const char *name;  /* begins the names of the cached files */
    const char *cache; /* folder, made when needed; NULL: traced in any case, and not kept */
    float radius;
    int rays;
    uint32_t seed;
} truth_request;

/* False, with one line in `error`. truth_destroy is due in either case. */
bool truth_get(const truth_request *r, const scene *s, const scene_view *view, bench_truth *out, failure *fault);
/* The mean open direction of each pixel (trace_open_directions), three floats. The caller frees it. NULL, with one line
 * in `error`, on failure. */
float *truth_get_open(const truth_request *r, const scene *s, const scene_view *view, failure *fault);
void truth_destroy(bench_truth *t);

/* Makes the folder and those above it. */
bool make_folder(const char *path);
