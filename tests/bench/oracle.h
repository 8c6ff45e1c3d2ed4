/* SPDX-License-Identifier: MIT
 *
 * The best that one depth layer can give: rays marched densely through the depth map, in plain C. Its error is the
 * error of every screen-space technique that sees only this layer, except for a better estimate of thickness.
 */
#pragma once

#include "results.h"
#include "views.h"

/* The pixels of a view on which the error is split. */
typedef struct sampled_pixels {
    int count;
    int *index; /* into the picture; malloc */
} sampled_pixels;

/* One random foreground pixel of every step x step. A fixed one would always hit the same cell of a noise tile. index
 * is NULL when memory is short. */
sampled_pixels oracle_pixels(const bench_view *v, int step, uint32_t seed);

/* out[k][i]: accessibility of pixel i if every surface is thickness[k] radii thick. False when memory or threads are
 * short. */
bool oracle_march(const bench_view *v, const sampled_pixels *pixels, int rays, int threads, uint32_t seed,
                  const double thickness[THICKNESS_COUNT], float *const out[THICKNESS_COUNT]);
