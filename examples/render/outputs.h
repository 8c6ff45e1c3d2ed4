/* SPDX-License-Identifier: MIT
 *
 * The files a run leaves: their names, whether they can be written, and handing the pixels to the writer.
 */
#ifndef GLSSAO_EXAMPLES_OUTPUTS_H
#define GLSSAO_EXAMPLES_OUTPUTS_H

#include "options.h"
#include "pipeline.h"
#include "writer.h"

/* False, with one line that names the file, where one can't be written: known before the long work. */
bool outputs_check(const options *o, char *error, size_t error_size);

/* Reads back what is wanted of the frame just drawn, and hands it to the writer. `number` is the turntable's frame,
 * from 1; 0: not a turntable. */
bool outputs_take(const options *o, pipeline *p, const scene_view *view, int number, writer *w, char *error,
                  size_t error_size);

#endif
