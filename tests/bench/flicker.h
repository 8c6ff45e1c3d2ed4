/* SPDX-License-Identifier: MIT
 *
 * The frame change of configurations: each scene is drawn from a camera that moves about its target, and the frames are
 * computed in order by one effect, so that whatever an effect keeps from frame to frame counts.
 */
#ifndef GLSSAO_BENCH_FLICKER_H
#define GLSSAO_BENCH_FLICKER_H

#include "effects.h"
#include "results.h"

/* Fills frame_change of every level. False, with one line in `error`. */
bool flicker_measure(results *r, context *c, char *error, size_t error_size);

#endif
