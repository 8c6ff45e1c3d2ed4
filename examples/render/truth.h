/* SPDX-License-Identifier: MIT
 *
 * -t raytrace: ray-traced accessibility of a frame, as a map that replaces the one of the effect.
 */
#pragma once

#include "fault.h"
#include "gl.h"
#include "trace.h"

#include <glssao/glssao.h>

typedef struct truth {
    const trace_scene *scene;
    float *accessibility; /* of the last frame, rows bottom to top, after contrast */
    GLuint map;           /* the same as a texture, R32F */
    int width, height;
    trace_stats stats; /* sum over the frames */
} truth;

/* Allocates memory for frames of that size unless it exists. The scene must outlive it. False, with one line in `why`,
 * on failure. Call truth_close in either case. */
bool truth_open(truth *t, const trace_scene *s, int width, int height, failure *why);
void truth_close(truth *t);

/* Traces a frame with the radius, sample count and power of `settings`. Prints progress to stderr. */
bool truth_trace(truth *t, const scene_view *view, const glssao_settings *settings, uint32_t seed, failure *why);
