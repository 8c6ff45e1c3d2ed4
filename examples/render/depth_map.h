/* SPDX-License-Identifier: MIT
 *
 * Jobs that estimate the occlusion of a depth map instead of drawing a scene.
 */
#pragma once

#include "fault.h"
#include "occlude.h"
#include "options.h"
#include "writer.h"

/* Kept between the jobs of a batch. Starts as 0. */
typedef struct depth_mapper {
    occlude *occlude; /* opened for the first job; NULL before */
    uint32_t seed;    /* of that */
} depth_mapper;

void depth_mapper_close(depth_mapper *d);

/* Reads the maps, estimates, and passes the pictures to the writer. The slip tells the result. False, with one line in
 * `why`, on failure. */
bool depth_mapper_run(depth_mapper *d, const options *o, bool quiet, writer *w, writer_slip *slip, failure *why);
