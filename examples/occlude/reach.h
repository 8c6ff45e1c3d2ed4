/* SPDX-License-Identifier: MIT
 *
 * How far away occluders can be in a depth map, and how many pixels that is.
 */
#pragma once

#include "occlude.h"

typedef struct reach {
    float extent;          /* the diagonal of the box around the map's surfaces in view space; 0: unknown */
    float pixels_per_unit; /* how many pixels a scene unit has in the picture, on average over the surfaces */
} reach;

/* Any projection and any depth are allowed; what has no finite place is left out. */
reach reach_measure(const occlude_input *input);
