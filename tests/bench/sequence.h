/* SPDX-License-Identifier: MIT
 *
 * How much a result flickers: a camera moves, and each frame's error is compared with the last frame's at the same
 * point of the same surface.
 *
 * The true accessibility of a point that stands still is the same in both frames. So the change of the error is the
 * change of the result, and no truth has to be traced.
 */
#pragma once

#include "draw.h"

#include <stddef.h>

/* One frame: the view, and a value a pixel, rows bottom to top. */
typedef struct sequence_frame {
    scene_view view;
    const float *distance; /* view distance; 0: nothing there */
    const float *result;   /* accessibility, or its error */
} sequence_frame;

typedef struct frame_change {
    double sum2, pixels; /* RMS: sqrt(sum2 / pixels) */
} frame_change;

/* Adds the pixels of `now` whose points were seen in `before`, too: all four texels around a point's old place lie
 * within 1 % of the distance that it had there. The view is a perspective one. */
void sequence_compare(frame_change *c, const sequence_frame *before, const sequence_frame *now);

/* Sets a 1 for each pixel of `now` that shows a point that was not seen in `before`, by the same measure, else a 0. */
void sequence_find_new(const sequence_frame *before, const sequence_frame *now, unsigned char *out_new);
