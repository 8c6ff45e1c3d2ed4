/* SPDX-License-Identifier: MIT
 *
 * What must hold of any run, whatever the machine: no figure is bounded by a number that was measured once.
 */
#ifndef GLSSAO_BENCH_CHECK_H
#define GLSSAO_BENCH_CHECK_H

#include "results.h"
#include "scenes.h"

/* Every figure finite; no pixel that is no number; the best exponent no worse than the default one; and more rays
 * nearer to the converged truth, traced on the scene `on`. False, with one line in `error` that names the first fault.
 */
bool check_results(const results *r, const bench_scene *on, char *error, size_t error_size);

#endif
