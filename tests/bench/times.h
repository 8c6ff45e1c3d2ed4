/* SPDX-License-Identifier: MIT
 *
 * Milliseconds of glssao_compute. The configurations take turns, so that whatever else the machine does hits all alike.
 */
#ifndef GLSSAO_BENCH_TIMES_H
#define GLSSAO_BENCH_TIMES_H

#include "effects.h"
#include "results.h"
#include "scenes.h"

/* Times every configuration on the scene `on`, at the options' time_size. `of_view` is the index of the view's results
 * to fill, -1: those of the configuration as a whole. False, with one line in `error`. */
bool times_measure(results *r, effects *e, const bench_scene *on, int of_view, char *error, size_t error_size);

#endif
