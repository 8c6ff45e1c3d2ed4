/* SPDX-License-Identifier: MIT
 *
 * What a projection matrix says about depth.
 */
#ifndef GLSSAO_INPUT_PROJECTION_H
#define GLSSAO_INPUT_PROJECTION_H

#include "input/matrix.h"

/* The distance between two values that a depth format tells apart: `step`, or `step` times the value. */
typedef struct glssao__precision {
    double step;
    bool relative;
} glssao__precision;

typedef struct glssao__projection {
    /* Of the passes' view space: the host's, turned about the view axis where the projection turns the picture. */
    float clip_from_view[16], view_from_clip[16];
    float turn[2]; /* cosine and sine, as in glssao__matrix */
    double eye;    /* how much farther view distance reaches from the host's eye, scene units */
    bool is_turned, is_orthographic;
    float distance_from_depth[4], ray_origin[4], ray_direction[4]; /* as in cbFrame */
    bool
        is_oblique; /* distance_from_depth changes over the picture, so window depth is copied to view distance first */
    float oblique[4]; /* as in cbFrame */
    float sky_depth;
    double ends[4]; /* distance_from_depth, not rounded */
    enum glssao__doubt doubt;
} glssao__projection;

/* False, with the reason logged, where no depth map can come from the frame's projection. */
bool glssao__projection_analyse(const glssao_frame *frame, const glssao__log *log, glssao__projection *out);

/* Whether the passes read window depth as the host stores it. */
bool glssao__projection_reads_window_depth(const glssao_frame *frame, bool is_oblique);

/* The constant c of logarithmic depth: the field 0 stands for 1. */
double glssao__projection_log_constant(const glssao_frame *frame);

/* Coefficients of 1, t and t^2 of a depth step in view distance (scene units) at the view distance t. */
void glssao__projection_depth_step(const glssao_frame *frame, const glssao__projection *projection,
                                   const glssao__precision *precision, float out_step[4]);

#endif
