/* SPDX-License-Identifier: MIT
 *
 * Milliseconds of glssao_compute. The configurations take turns, so that a busy machine slows all of them alike.
 */
#pragma once

#include "effects.h"
#include "results.h"

/* Times every configuration on one of the scenes, at the options' time_size. False, with one line in `error`. */
bool times_measure(results *r, effects *e, int of_view, failure *fault);
