/* SPDX-License-Identifier: MIT
 *
 * A thread that traces accessibility in rounds whose mean improves: from the surfaces of a frame, or from all that a
 * view shows. It builds the scene's acceleration structure first. A new request ends the last one within moments, and
 * no call waits for tracing but the last.
 */
#pragma once

#include "fault.h"
#include "trace.h"

enum { RAY_ROUNDS = 16, TRUTH_ROUND_RAYS = 32 };

typedef struct ray_worker ray_worker;

typedef struct ray_request {
    scene_view view;
    float (
        *surfaces)[4]; /* as trace_seen has them, row by row; the worker frees them. NULL: rays of the view find them */
    int step;          /* 1, or 2 with surfaces */
    float radius;
    int rays;      /* a texel and round */
    bool adaptive; /* about so many: trace_options.adaptive */
    uint32_t seed;
} ray_request;

/* `wake` is called on the worker's thread after each round, and where it failed. The scene must outlive the worker.
 * NULL without memory or a thread. */
ray_worker *ray_worker_start(const scene *s, void (*wake)(void));
/* Takes the place of any earlier request. */
void ray_worker_ask(ray_worker *w, const ray_request *request);
/* Ends the current request. */
void ray_worker_forget(ray_worker *w);
/* Returns how many rounds of the current request are done. If there is one and `out` is not NULL, copies the mean:
 * where `surfaces` has none it is negative. Negative, with the reason in `why`: the tracing failed. */
int ray_worker_read(ray_worker *w, float *out, failure *why);
/* Waits for the thread, at most for an acceleration structure that is being built. NULL is allowed. */
void ray_worker_stop(ray_worker *w);
