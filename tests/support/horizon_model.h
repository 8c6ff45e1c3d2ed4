/* SPDX-License-Identifier: MIT
 *
 * The horizon estimate in double precision, written from its formulas and not from the shader, to compare with pixel by
 * pixel. Its tuned constants are the shader's own (see shader_constants.h).
 *
 * The estimate is made of steps: a sample is snapped to a texel, a change of height is a jump or is none, a horizon is
 * rounded to one of 31 sectors. Each is decided here with a bound on the float program's rounding (rounded.h); where
 * that leaves it open, both ways are taken, and the result is an interval: sectors that are surely hidden, and sectors
 * that may be.
 */
#ifndef GLSSAO_TESTS_HORIZON_MODEL_H
#define GLSSAO_TESTS_HORIZON_MODEL_H

#include <stdbool.h>

typedef struct horizon_constants {
    double jump, alike, open_end, width, veil, veil_width, calibration;
    double second; /* with layers alone */
} horizon_constants;

/* False where a constant is not found in the pieces of the fragment shader's source. */
bool horizon_read_constants(const char *const *pieces, int count, bool layers, horizon_constants *out);

typedef struct horizon_input {
    int full_width, full_height, factor; /* factor: full-size texels per texel of the estimate */
    int width, height;                   /* of the estimate */
    const float *distance;               /* view distance at the estimate's size; 1e15 on sky */
    const float *layers;  /* two a pixel: thickness, negative where it is not known, and how far behind the next front
                             face lies; NULL: none known */
    const float *normals; /* xyz a pixel, view space, full size */
    float projection[16];
    double radius, power;
    double depth_step[3]; /* coefficients of 1, t, t^2 in what a step of the depth format comes to at distance t */
    int slices, steps;
    double noise_offset[2]; /* added to the tile's angle and jitter, which wrap at 1 */
    bool turned_over;       /* the tile's angle and jitter change places */
    horizon_constants constants;
} horizon_input;

/* Accessibility of a pixel of the estimate lies in *out_low .. *out_high. */
void horizon_model(const horizon_input *in, int x, int y, double *out_low, double *out_high);

/* The measure of the angles from 0 to acos(c) on one side of a slice, for a normal that leans to that side by an angle
 * of the given cosine and sine: the polynomial that stands for the integral of cos(t - g) sin(t). */
double horizon_measure(double cos_g, double sin_g, double c);

#endif
