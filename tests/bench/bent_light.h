/* SPDX-License-Identifier: MIT
 *
 * What bent normals are worth: a matte and a glossy surface under a sky with a lamp, lit by accessibility alone, by
 * bent normals, and by rays.
 */
#pragma once

#include "results.h"

/* A view with its traced pictures, linear, three floats a pixel. */
typedef struct bent_light {
    const bench_view *view;
    scene_view at;
    float *matte, *glossy;
} bent_light;

/* RMSE over the surfaces of pictures as a display shows them, sRGB from 0 to 1. `lobe` is the specular occlusion that
 * accessibility alone gives. */
typedef struct bent_light_error {
    double matte, matte_bent, glossy, glossy_lobe, glossy_bent;
} bent_light_error;

/* Traces both. False, with one line in `error`; bent_light_close is due in either case. */
bool bent_light_open(bent_light *b, const bench_view *v, const scene *s, const scene_view *at, const options *o,
                     failure *fault);
void bent_light_close(bent_light *b);

/* `bent`: direction in view space and accessibility, four floats a pixel. */
bent_light_error bent_light_measure(const bent_light *b, const float *bent);

/* Writes a picture: by accessibility, by bent normals, by rays; matte above, glossy below. */
bool bent_light_write(const bent_light *b, const float *bent, const char *path, failure *fault);
