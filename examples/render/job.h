/* SPDX-License-Identifier: MIT
 *
 * One picture or turntable, with a context of its own.
 */
#pragma once

#include "fault.h"
#include "options.h"

#include <stddef.h>

/* Renders what the options say, which began at `start_ms` (clock.h); says on stderr how far it is and what the context
 * is unless it is `quiet`. False, with one line in `why`, where it could not. */
bool job_run(const options *o, bool quiet, double start_ms, size_t *out_pictures, failure *why);
