/* SPDX-License-Identifier: MIT
 *
 * The files that a job writes: their names, whether they can be written, and passing them to the read-back.
 */
#pragma once

#include "fault.h"
#include "inputs.h"
#include "options.h"
#include "pipeline.h"
#include "readback.h"

/* Checks early that all outputs can be written. False, with one line in `why` that names the file, if not. */
bool outputs_check(const options *o, failure *why);

/* False, with one line in `why` that names both, if an output would overwrite a file that the job reads: a file of the
 * scene, the environment or the list. */
bool outputs_spare_inputs(const options *o, const inputs *read, failure *why);

/* Passes the outputs of the last frame to the read-back. `number` is the frame of a turntable, from 1; 0: no turntable.
 * The slip tells the result. */
bool outputs_take(const options *o, pipeline *p, const scene_view *view, int number, readback *r, writer_slip *slip,
                  failure *why);

/* Visits the files of a job, without that of --stats. A turntable has numbered files. Stops and returns false when
 * `visit` does. */
bool outputs_each(const options *o, bool (*visit)(const char *path, void *user), void *user);
