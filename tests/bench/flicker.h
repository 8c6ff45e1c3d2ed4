/* SPDX-License-Identifier: MIT
 *
 * How much results change though the scene stands still: from frame to frame while the camera turns by half a degree
 * about its target, and between views that are rolled by 25 degrees. One effect computes the frames in order, so that
 * whatever it keeps from frame to frame counts.
 */
#pragma once

#include "effects.h"
#include "results.h"

/* Fills frame_change and roll_change of every level and peer. False, with one line in `error`. */
bool flicker_measure(results *r, context *c, failure *fault);
