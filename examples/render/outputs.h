/* SPDX-License-Identifier: MIT
 *
 * The files a run leaves: their names, whether they can be written, and having them read back.
 */
#ifndef GLSSAO_EXAMPLES_OUTPUTS_H
#define GLSSAO_EXAMPLES_OUTPUTS_H

#include "fault.h"
#include "inputs.h"
#include "options.h"
#include "pipeline.h"
#include "readback.h"

/* False, with one line that names the file, where one can't be written: known before the long work. */
bool outputs_check(const options *o, fault *why);

/* False, with one line that names both, where one would overwrite a file that the job reads: of the scene, the
 * environment or the list. */
bool outputs_spare_inputs(const options *o, const inputs *scene, fault *why);

/* Has what is wanted of the frame just drawn written. `number` is the turntable's frame, from 1; 0: not a turntable.
 * What becomes of it, the slip tells. */
bool outputs_take(const options *o, pipeline *p, const scene_view *view, int number, readback *r, writer_slip *slip,
                  fault *why);

/* The files of a job, without those of --stats; a turntable's are numbered. False at the first that `visit` refuses. */
bool outputs_each(const options *o, bool (*visit)(const char *path, void *user), void *user);

#endif
