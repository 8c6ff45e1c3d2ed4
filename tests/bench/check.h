/* SPDX-License-Identifier: MIT
 *
 * What must hold of any run on any machine. No bound is a number that was measured once.
 */
#pragma once

#include "results.h"

/* Every figure is finite and in its range, so is every pixel; the best exponent is no worse than the default; and more
 * rays come nearer to the converged truth, traced on the first scene. False, with one line in `error` that names the
 * first fault. */
bool check_results(const results *r, failure *fault);
