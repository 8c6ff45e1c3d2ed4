/* SPDX-License-Identifier: MIT
 *
 * The tables of glssao-bench, in the output folder. Each call returns false, with one line in `error`, where a file
 * could not be written.
 */
#pragma once

#include "results.h"

/* accuracy.tsv: one row for each configuration and scene. */
bool report_accuracy(const results *r, failure *fault);
/* scenes.tsv: one row a scene. */
bool report_scenes(const results *r, failure *fault);
/* split.tsv: one row for each split configuration, scene and step; oracle.tsv: for each scene and thickness. */
bool report_split(const results *r, failure *fault);
