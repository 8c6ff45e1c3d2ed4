/* SPDX-License-Identifier: MIT
 *
 * What a projection matrix says about depth.
 */
#ifndef GLSSAO_INPUT_PROJECTION_H
#define GLSSAO_INPUT_PROJECTION_H

#include "log.h"

/* The distance between two values that a depth format tells apart: `step`, or `step` times the value. */
typedef struct glssao__precision {
    double step;
    bool relative;
} glssao__precision;

typedef struct glssao__projection {
    float view_from_clip[16];
    float distance_from_depth[4], ray_origin[4], ray_direction[4]; /* as in cbFrame */
    float sky_depth;
    float sky_distance; /* scene units; infinite where the far plane is */
    double ends[4];     /* distance_from_depth, not rounded */
} glssao__projection;

/* False where the column-major matrix is singular to working precision, or its inverse overflows a float. */
bool glssao__invert(const double m[16], double out[16]);

/* False, with the reason logged, where no depth map can come from the matrix. */
bool glssao__projection_analyse(const float projection[16], bool clip_zero_to_one, const glssao__log *log,
                                glssao__projection *out);

/* The constant c of logarithmic depth: the field 0 stands for 1. */
double glssao__projection_log_constant(const glssao_frame *frame);

/* Coefficients of 1, t and t^2 of a depth step in view distance (scene units) at the view distance t. */
void glssao__projection_depth_step(const glssao_frame *frame, const glssao__projection *projection,
                                   const glssao__precision *precision, float out_step[4]);

#endif
