/* SPDX-License-Identifier: MIT
 *
 * --batch: many jobs in one process and one context. Scenes, shaders and targets are kept from job to job, pictures are
 * read back and encoded while the next ones are drawn, and a job that fails does not keep the rest from being done.
 */
#pragma once

#include "options.h"

/* Renders the list of o->batch, or the shard of it; the command line's other options hold for all jobs. Prints a line
 * on stderr for each job that fails, and a summary. False where any did. */
bool batch_run(const options *o);
