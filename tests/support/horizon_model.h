/* SPDX-License-Identifier: MIT
 *
 * The horizon estimate in double precision, written from its formulas and not from the shader, to compare pixel by
 * pixel. Its tuned constants are the shader's own (glsl/shared/tuned.glsl).
 *
 * The estimate makes discrete decisions: a sample snaps to a texel, a change of height is a jump or not, a horizon
 * rounds to one of 31 sectors. The model makes each with a bound on the float program's rounding (rounded.h). Where
 * that bound leaves a decision open, the model takes both ways, and the result is an interval: the sectors that are
 * certainly hidden, and those that may be.
 */
#pragma once

#include <stdbool.h>

typedef struct horizon_constants {
    double jump, alike, open_end, width, veil, veil_width, veil_reach, veil_far, reach_on, rise, calibration;
    double plan_width, plan_from, plan_to; /* of runs, in orthographic projections about points that face the eye */
    double second;                         /* used with a second layer only */
} horizon_constants;

typedef struct horizon_input {
    int full_width, full_height, factor; /* factor: full-size texels per texel of the estimate */
    int width, height;                   /* of the estimate */
    const float *distance;               /* view distance at the estimate's size; 1e15 on sky */
    const float *layers;  /* two floats per pixel: thickness (not above 0: minus the least that it is), and the distance
                             to the next front face  behind; NULL: none known */
    const float *normals; /* xyz a pixel, view space, full size */
    float projection[16];
    double radius, power;
    bool radius_in_pixels; /* of the full size; pixels that are no squares count as squares of the same area */
    double thickness;      /* multiplies what is estimated */
    double fade_far[2];    /* view distance where the fade starts and ends; 0, 0: none */
    double depth_step[3];  /* step of the depth format at distance t: coefficients of 1, t, t^2 */
    int slices, steps;
    double noise_offset[2]; /* added to the tile's angle and jitter; both wrap at 1 */
    bool turned_over;       /* swap the tile's angle and jitter */
    horizon_constants constants;
} horizon_input;

/* Accessibility of a pixel of the estimate lies in *out_low .. *out_high. */
void horizon_model(const horizon_input *in, int x, int y, double *out_low, double *out_high);

/* The open vector of a pixel: 2/3 of its normal without the directions that the hidden sectors stand for, which are
 * integrated numerically. Not of unit length; bent normals point along it. False where rounding leaves a sector open,
 * or the side of the surface. */
bool horizon_model_open(const horizon_input *in, int x, int y, double out[3]);

/* The measure of the angles from 0 to acos(c) on one side of a slice, for a normal that leans to that side by an angle
 * of the given cosine and sine. A polynomial approximates the integral of cos(t - g) sin(t). */
double horizon_measure(double cos_g, double sin_g, double c);
