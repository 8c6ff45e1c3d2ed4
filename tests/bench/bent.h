/* SPDX-License-Identifier: MIT
 *
 * How far bent normals are off the traced mean open direction.
 */
#pragma once

#include "effects.h"
#include "results.h"

/* Measures every level of horizon on every view and writes bent.tsv, bent-light.tsv and a strip of each view. With
 * r->options->check it also fails where a level is no better than the normal itself. False, with one line in `error`.
 */
bool bent_measure(const results *r, effects *e, failure *fault);
