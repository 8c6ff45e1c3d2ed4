/* SPDX-License-Identifier: MIT
 *
 * A job in a process of its own: whatever kills it, a driver's fault or the end of its time, costs that job alone.
 */
#pragma once

#include "fault.h"
#include "options.h"

#include <stddef.h>

/* Renders the job, for --timeout's time at most, or until a signal stops the batch (stop.h). The calling process has
 * one thread and no context. False, with one line in `why`, where the job could not be done. */
bool batch_run_isolated(const options *o, bool quiet, size_t *out_pictures, failure *why);
