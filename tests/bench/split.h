/* SPDX-License-Identifier: MIT
 *
 * What each choice costs in accuracy: one depth layer, the estimator, half size, sample noise, denoising, contrast.
 */
#pragma once

#include "effects.h"
#include "results.h"

/* Fills r->oracle and r->splits for each technique whose default level was measured (its exponent is used). False, with
 * one line in `error`; split_destroy is due in either case. */
bool split_measure(results *r, context *c, map_reader *m, failure *fault);
void split_destroy(results *r);
