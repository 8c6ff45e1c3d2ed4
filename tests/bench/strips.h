/* SPDX-License-Identifier: MIT
 *
 * Pictures of the error. In all of them blue is too dark and red-orange is too bright.
 */
#pragma once

#include "effects.h"
#include "results.h"

/* strip-SCENE-NAME.png in the output folder, for the default level of every technique and for every peer: truth,
 * result, error. For contrast techniques and peers a second row has result and error with the best exponent. */
bool strips_write(const results *r, effects *e, map_reader *m, failure *fault);

/* worst-horizon.png in the output folder. For each scene, down the left half and then the right: truth, result and
 * error at the place where the level `high` of horizon is worst, in full size. Nothing where pictures are smaller than
 * a place. */
bool strips_write_worst(const results *r, effects *e, map_reader *m, failure *fault);
