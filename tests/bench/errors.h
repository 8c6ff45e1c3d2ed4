/* SPDX-License-Identifier: MIT
 *
 * The error of every configuration on every view.
 */
#pragma once

#include "effects.h"
#include "results.h"

/* Runs one configuration on one view, with power 1 where `plain`. */
bool errors_run(const results *r, const bench_config *c, int view, bool plain, effects *e, map_reader *m, float *out,
                failure *fault);

/* Fills the error figures of r->configs. False, with one line in `error`. */
bool errors_measure(results *r, effects *e, map_reader *m, failure *fault);
