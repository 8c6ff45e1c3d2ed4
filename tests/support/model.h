/* SPDX-License-Identifier: MIT
 *
 * The classic and hemisphere estimates and the blur in plain double precision, written from the design's formulas and
 * not from the shaders, to compare pixel by pixel.
 *
 * At a threshold a float and a double may fall on different sides, and no tolerance on the result would be both tight
 * and true. So the model returns an interval: at each threshold that the float precision of the inputs cannot decide,
 * it takes both sides. Elsewhere the interval has no width.
 */
#pragma once

#include <glssao/glssao.h>

typedef struct model_input {
    int width, height; /* full size */
    int ambient_width, ambient_height;
    const float *depth;          /* as the texture holds it, of frame->depth_kind */
    const float *normals;        /* xyz a pixel */
    const float *random_vectors; /* rgb per pixel of the ambient map, 0..1, as the sampler returns them */
    const glssao_frame *frame;
    const glssao_settings *settings;
    const glssao_constants *constants;
    double filter_error;         /* how far the driver's linear filter puts a sample off, in texels */
    const float *depth_step;     /* step of the depth format at distance t: coefficients of 1, t, t^2 */
    const float (*kernel)[4];    /* hemisphere: sample positions about +z */
    const float (*rotations)[4]; /* hemisphere: the 4x4 tile, row by row from the bottom */
} model_input;

/* Accessibility of an ambient pixel lies in *out_low .. *out_high. */
void model_classic(const model_input *in, int x, int y, double *out_low, double *out_high);

void model_hemisphere(const model_input *in, int x, int y, double *out_low, double *out_high);

/* One direction of the blur of `ambient` (an ambient map's texels). Returns false if float precision cannot decide a
 * tap's threshold. */
bool model_blur(const model_input *in, const float *ambient, bool horizontal, int x, int y, double *out_value);
