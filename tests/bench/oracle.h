/* SPDX-License-Identifier: MIT
 *
 * The best that one depth layer can give: rays marched densely through the depth map, in plain C, written to be read.
 * What it gets wrong against the truth, no screen-space technique that sees only this layer can know, except by a
 * better guess of how thick things are.
 */
#ifndef GLSSAO_BENCH_ORACLE_H
#define GLSSAO_BENCH_ORACLE_H

#include "results.h"
#include "views.h"

/* The pixels of a view on which the error is split. */
typedef struct sampled_pixels {
    int count;
    int *index; /* into the picture; malloc */
} sampled_pixels;

/* One foreground pixel at random of every step x step, the same for the same seed: a fixed one would always hit the
 * same cell of a noise tile. index is NULL where memory is short. */
sampled_pixels oracle_pixels(const bench_view *v, int step, uint32_t seed);

/* out[k][i]: accessibility of pixel i where what is seen is thickness[k] times the radius thick. False where memory or
 * threads are short. */
bool oracle_march(const bench_view *v, const sampled_pixels *pixels, int rays, int threads, uint32_t seed,
                  const double thickness[THICKNESS_COUNT], float *const out[THICKNESS_COUNT]);

#endif
