/* SPDX-License-Identifier: MIT
 *
 * What the parts of a picture's tracing share: from texels to points (trace_lens.c), the rays of a block of texels
 * (trace_block.c), threads that take blocks (trace_picture.c).
 */
#ifndef GLSSAO_EXAMPLES_TRACE_PICTURE_H
#define GLSSAO_EXAMPLES_TRACE_PICTURE_H

#include "trace_internal.h"

#include <pthread.h>

enum { BLOCK = 16, BLOCK_TEXELS = BLOCK * BLOCK, MOST_RAYS = 64, MOST_THREADS = 256 };

/* How a texel leads to a point in the world, and how far off that may be. */
typedef struct trace_lens {
    float ndc[2][2];          /* x: ndc = column * [0] + [1]; y the same */
    float scale[2];           /* view x = scale (ndc w - shift[0] + shift[1] distance); y the same */
    float shift[2][2];        /* [x or y] */
    float w[2];               /* clip w = w[0] - w[1] distance */
    float depth_error;        /* view distance, per w^2 */
    float view_from_world[9]; /* rotation, columns of three */
    float eye[3];             /* in the world */
    float perspective;        /* 1, or 0 in an orthographic projection */
} trace_lens;

struct trace_picture {
    const trace_scene *trace;
    trace_lens lens;
    trace_seen seen;
    const uint8_t *counts;
    int width, height; /* texels */
    int blocks_across;
    float radius;
    float *out;
    trace_pattern pattern, more; /* more: where a texel gets more rays than options->samples */
    bool adaptive;
    bool (*stopped)(void *user);
    void *stopped_user;
    double start_ms;
    pthread_mutex_t lock; /* of the members below */
    pthread_cond_t fed;
    int rows, next, rays_known;
    bool is_stopped, is_ending;
    uint64_t rays;
    pthread_t threads[MOST_THREADS];
    int thread_count;
};

/* The texels of a block that show a surface. Arrays of one number each, so that compilers make vector code. */
typedef struct trace_block {
    int count;
    int texel[BLOCK_TEXELS]; /* index in the picture */
    float (*directions[BLOCK_TEXELS])[3], (*more[BLOCK_TEXELS])[3];
    int rays[BLOCK_TEXELS], blocked[BLOCK_TEXELS];
    float x[BLOCK_TEXELS], y[BLOCK_TEXELS], distance[BLOCK_TEXELS];
    float origin[3][BLOCK_TEXELS], normal[3][BLOCK_TEXELS]; /* the normal in view space, then a unit one in the world */
    float u[3][BLOCK_TEXELS], v[3][BLOCK_TEXELS];           /* a frame with the normal */
} trace_block;

/* trace_lens.c */

/* False where the view's matrices have no inverse. */
bool trace_lens_open(const scene_view *view, const trace_seen *seen, trace_lens *out);
/* From texels, distances and normals in view space to origins off the surface, unit normals in the world and frames
 * about them; of the first `count` texels of a block. */
void trace_lens_place(const trace_lens *l, float radius, int count, trace_block *b);

/* trace_block.c */

/* Traces all rays of a block of BLOCK x BLOCK texels, numbered along rows. Returns how many. */
uint64_t trace_block_run(const trace_picture *p, int number);

#endif
