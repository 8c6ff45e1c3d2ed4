/* SPDX-License-Identifier: MIT
 *
 * Ray-traced ambient accessibility, through Embree: the truth that the screen-space techniques are measured against,
 * and what glssao-bake bakes. Knows nothing of OpenGL. Builds with Embree 3 and 4.
 *
 * Opaque and alpha-tested triangles block rays from both sides. Texels below an alpha test's cut-off let rays through.
 * Blended materials, lines and points block nothing, as they are not in the depth buffer either.
 */
#pragma once

#include "draw.h"
#include "scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct trace_scene trace_scene;

/* Builds the acceleration structure. The scene must outlive it. NULL on failure, with one line in `error`. */
trace_scene *trace_scene_create(const scene *s, failure *fault);
void trace_scene_destroy(trace_scene *t);

/* Called on the calling thread now and then; `done` in 0..1. */
typedef void (*trace_progress_fn)(double done, void *user);

typedef struct trace_options {
    float radius;               /* scene units: a hit farther away does not block (hard cut) */
    int samples;                /* rays a pixel or point, >= 1 */
    bool adaptive;              /* trace_picture alone: see trace_picture_begin */
    uint32_t seed;              /* the same seed gives the same bits for any number of threads */
    int threads;                /* 0: as many as there are cores */
    trace_progress_fn progress; /* may be NULL */
    void *progress_user;
    bool (*stopped)(void *user); /* may be NULL; asked on any thread: true ends the tracing, which then fails */
    void *stopped_user;
} trace_options;

typedef struct trace_stats {
    uint64_t rays;  /* occlusion rays cast */
    double seconds; /* wall clock of the tracing alone */
} trace_stats;

/* Accessibility of each pixel seen by `view` (1 where nothing is seen), rows bottom to top: one ray through each
 * pixel's centre finds the point as the rasteriser does (back faces of single-sided materials culled, alpha test
 * applied), then `samples` rays, cosine-weighted about the interpolated shading normal (turned to the viewer's side on
 * double-sided materials), from the point moved along the geometric normal. out_foreground (may be NULL) is 1 where
 * something is seen. design: accessibility = 1 - blocked share. */
bool trace_accessibility(const trace_scene *t, const scene_view *view, const trace_options *options,
                         float *out_accessibility, uint8_t *out_foreground, trace_stats *out_stats, failure *fault);

/* Some of the rays of one pixel. */
typedef struct trace_fan {
    size_t pixel;                 /* its number, rows bottom to top */
    const double *normal;         /* unit, world space: they are cosine-weighted about it */
    const float (*directions)[3]; /* unit, world space */
    const bool *blocked;          /* by something within the radius */
    int count;
} trace_fan;
/* Called on any thread; all rays of a pixel come from one thread, one fan after another. */
typedef void (*trace_fan_fn)(const trace_fan *fan, void *user);

/* The rays of trace_accessibility, handed to a function instead of counted. Pixels that see nothing have none. */
bool trace_fans(const trace_scene *t, const scene_view *view, const trace_options *options, trace_fan_fn take,
                void *user, trace_stats *out_stats, failure *fault);
/* Of each pixel, the mean of the open directions in view space, not of unit length: 2/3 of the normal where all is
 * open. 0 where nothing is seen. Cosine-weighted rays make it the mean weighted by the cosine (H. Landis, 2002). */
bool trace_open_directions(const trace_scene *t, const scene_view *view, const trace_options *options, float (*out)[3],
                           trace_stats *out_stats, failure *fault);

/* What a rasteriser saw of a view: a normal in view space, of any length, and in the fourth component a view distance.
 * Where nothing is seen the distance is 0. A texel stands for the one of `step` x `step` pixels of the view at
 * `offset`; there are (width + step - 1) / step of them in a row. */
typedef struct trace_seen {
    const float (*const *rows)[4]; /* bottom to top */
    int step;                      /* 1 or 2 */
    int offset[2];                 /* x, y, below step */
    int margin;                    /* pixels of the view on each side whose texels get no rays */
    double depth_step;             /* of the window depth that the distances come from, for instance 2^-24 */
} trace_seen;

/* A picture whose surfaces are known already: rays start where the rasteriser found a surface, and no primary rays are
 * cast. Neighbouring pixels share out the directions: the rays of any 4 x 4 texels, `samples` each, are stratified
 * together, so that a blur of that size takes out most of the noise. Each call of a frame comes from one thread; others
 * trace meanwhile. */
typedef struct trace_picture trace_picture;

/* Starts to trace a picture. `out`: accessibility of each texel, negative where there is no surface. `counts`: NULL, or
 * rays for each texel, at most options->samples; those with 0 become negative. All must live until trace_picture_end.
 * options->samples is 1 to 64. `seed` turns the pattern. NULL, with one line in `error`, on failure.
 *
 * options->adaptive (no `counts`, at most 16 samples): as many rays as a blur over 4 x 4 needs. Texels get two or four
 * times options->samples where few neighbours lie on their surface, and only the first quarter of them (at least one)
 * where those of all 16 x 16 texels say the same. */
trace_picture *trace_picture_begin(const trace_scene *t, const scene_view *view, const trace_seen *seen,
                                   const uint8_t *counts, const trace_options *options, float *out, failure *fault);
/* So many rows of texels (and counts) are there now, from the bottom; further pointers of seen->rows may be set before.
 */
void trace_picture_feed(trace_picture *p, int rows);
/* Traces what is left, waits for the other threads, and frees the picture. False where options->stopped ended it. */
bool trace_picture_end(trace_picture *p, trace_stats *out_stats);

typedef enum trace_distribution { TRACE_COSINE = 0, TRACE_UNIFORM } trace_distribution;

/* Accessibility of given points in world space with unit normals; the rays start `offset` scene units along them.
 * radius may be INFINITY. */
bool trace_points(const trace_scene *t, const float (*positions)[3], const float (*normals)[3], size_t count,
                  trace_distribution distribution, float offset, const trace_options *options, float *out_accessibility,
                  trace_stats *out_stats, failure *fault);
