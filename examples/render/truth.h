/* SPDX-License-Identifier: MIT
 *
 * -t raytrace: accessibility of a frame by ray tracing, as a map that stands in for the effect's.
 */
#ifndef GLSSAO_EXAMPLES_TRUTH_H
#define GLSSAO_EXAMPLES_TRUTH_H

#include "fault.h"
#include "gl.h"
#include "trace.h"

#include <glssao/glssao.h>

typedef struct truth {
    const trace_scene *scene;
    float *accessibility; /* of the last frame, rows bottom to top, contrast applied */
    GLuint map;           /* the same, R32F */
    int width, height;
    trace_stats stats; /* summed over the frames */
} truth;

/* Makes room for frames of that size, where it is not there yet. False, with one line in `why`; truth_close is due in
 * either case. The scene must outlive it. */
bool truth_open(truth *t, const trace_scene *s, int width, int height, fault *why);
void truth_close(truth *t);

/* Traces a frame, with the radius, sample count and power of `settings`; progress to stderr. */
bool truth_trace(truth *t, const scene_view *view, const glssao_settings *settings, uint32_t seed, fault *why);

#endif
