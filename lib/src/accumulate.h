/* SPDX-License-Identifier: MIT
 *
 * The running mean of glssao_accumulate, and its error.
 */
#ifndef GLSSAO_ACCUMULATE_H
#define GLSSAO_ACCUMULATE_H

#include "frame/uniforms.h"
#include "gpu/functions.h"
#include "gpu/textures.h"

typedef struct glssao__accumulation {
    glssao_frame frame; /* what the estimates were computed from */
    glssao_settings settings;
    int count[2];          /* estimates in each replicate */
    gl_uint probe_buffer;  /* the probe's pixels on their way to the processor */
    gl_sync probe_fence;   /* NULL: none on their way */
    double sampling_error; /* of the whole mean; negative: not known yet */
} glssao__accumulation;

/* How many estimates the mean has with the next one; 1 where this is another view than before. */
int glssao__accumulate_next(const glssao__accumulation *a, const glssao_frame *frame, const glssao_settings *settings);

/* Counts the next estimate. */
void glssao__accumulate_begin(glssao__accumulation *a, const glssao__gl *gl, const glssao_frame *frame,
                              const glssao_settings *settings);

/* The members of cbFrame that the estimate, its mean and the probe read. The probe covers the given pixels: x, y,
 * width, height. */
void glssao__accumulate_fill(const glssao__accumulation *a, uint32_t seed, const int probed[4],
                             glssao__frame_block *block);

/* Starts reading the probe's pixels back. Runs between saving and restoring the host's state. */
void glssao__accumulate_read_probe(glssao__accumulation *a, const glssao__gl *gl, const glssao__target *probe);

/* The error as far as it is known; negative: not yet. Never waits. */
double glssao__accumulate_error(glssao__accumulation *a, const glssao__gl *gl);

/* The next estimate is the first. */
void glssao__accumulate_stop(glssao__accumulation *a, const glssao__gl *gl);
void glssao__accumulate_destroy(glssao__accumulation *a, const glssao__gl *gl);

#endif
