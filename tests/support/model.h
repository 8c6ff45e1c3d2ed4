/* SPDX-License-Identifier: MIT
 *
 * The classic and hemisphere estimates and the blur in plain double precision, written from design formulas and not
 * from the shaders, to compare with pixel by pixel.
 *
 * The formulas have thresholds, where a float and a double may fall on different sides and no tolerance on the result
 * would be tight and true. So the model gives an interval: at each threshold that the inputs' float precision can't
 * decide, both sides are taken. Elsewhere the interval has no width.
 */
#ifndef GLSSAO_TESTS_MODEL_H
#define GLSSAO_TESTS_MODEL_H

#include <glssao/glssao.h>

typedef struct model_input {
    int width, height; /* full size */
    int ambient_width, ambient_height;
    const float *depth;          /* as the texture holds it, of frame->depth_kind */
    const float *normals;        /* xyz a pixel */
    const float *random_vectors; /* rgb a pixel of the ambient map, 0..1, as the sampler delivers them */
    const glssao_frame *frame;
    const glssao_settings *settings;
    const glssao_constants *constants;
    const float *depth_step;  /* coefficients of 1, t, t^2 in what a step of the depth format comes to at distance t */
    const float (*kernel)[4]; /* hemisphere: sample positions about +z */
    const float (*rotations)[4]; /* hemisphere: the 4x4 tile, row by row from the bottom */
} model_input;

/* Accessibility of an ambient pixel lies in *out_low .. *out_high. */
void model_classic(const model_input *in, int x, int y, double *out_low, double *out_high);

void model_hemisphere(const model_input *in, int x, int y, double *out_low, double *out_high);

/* One direction of the blur of `ambient` (an ambient map's texels). Returns false where a tap's threshold can't be
 * decided in float. */
bool model_blur(const model_input *in, const float *ambient, bool horizontal, int x, int y, double *out_value);

#endif
