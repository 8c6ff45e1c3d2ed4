/* SPDX-License-Identifier: MIT
 *
 * Ambient occlusion of depth maps, without a window: arrays in, an array out. An `occlude` owns an offscreen OpenGL
 * context and the thread on which that context is current, so a caller's own contexts stay as they are.
 *
 * Threads: any thread may call. Calls with the same `occlude` wait for each other; several run at the same time.
 * Errors: a call that fails writes one line to `error` and leaves everything usable.
 * Arrays hold rows from the top of the picture to its bottom, each from left to right.
 */
#pragma once

#include <glssao/glssao.h>
#include <stddef.h>

typedef struct occlude occlude;

typedef struct occlude_input { /* zero a field that you don't use */
    int width, height;         /* pixels */
    const float *depth;        /* width * height view distances in scene units; no surface: 0, infinite or NaN */
    const float *normals;      /* width * height * 3: xyz in view space, any length; NULL: rebuilt from depth */
    float projection[16];      /* column-major clip_from_view, as in glssao_frame */
    bool clip_zero_to_one;     /* as in glssao_frame */
    bool window_depth;         /* depth holds what a depth buffer stores, 0 to 1; no surface: the far end */
    bool solid;    /* with view distance: what is seen reaches down without end, as in a height map. Else the
                      horizon technique guesses how thick an occluder is */
    int estimates; /* horizon, 1 to 65536: the mean of so many full-size estimates; 0: one frame */
    float error;   /* with estimates: enough of them once their sampling error is at most this; 0: all of them */
} occlude_input;

/* Opens a context; NULL on failure. `seed` is that of glssao_config. */
occlude *occlude_create(uint32_t seed, char *error, size_t error_size);

/* Closes it. NULL is fine. */
void occlude_destroy(occlude *o);

/* Which driver computes, for a person; valid until occlude_destroy. */
const char *occlude_description(const occlude *o);

/* Writes width * height accessibilities: 1 is open, 0 fully occluded, 1 where there is no surface. A half-size estimate
 * is always brought to full size along surfaces, whatever settings.upsample says. Where the radius of the horizon
 * technique is more than 48 pixels, smaller radii are estimated too, and each pixel keeps the darkest: one estimate
 * has at most 16 samples on a side, which would pass over what is near. */
bool occlude_compute(occlude *o, const occlude_input *input, const glssao_settings *settings, float *out_accessibility,
                     char *error, size_t error_size);

/* The diagonal of the box around the map's surfaces, scene units; 0 where it shows none. Nothing is farther away, so a
 * larger radius changes nothing. The input must hold depth. */
float occlude_extent(const occlude_input *input);

/* For terrain and other height maps: turns heights into what an orthographic camera sees that looks straight down.
 * `heights` and `spacing`, the distance between neighbouring heights, are scene units; a height that is not finite is a
 * hole. Fills `out_depth` (width * height, may be `heights` itself) and `out_projection` for occlude_input, in which
 * `solid` should be true. */
bool occlude_look_down(const float *heights, int width, int height, float spacing, float *out_depth,
                       float out_projection[16], char *error, size_t error_size);
