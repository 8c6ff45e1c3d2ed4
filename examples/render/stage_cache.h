/* SPDX-License-Identifier: MIT
 *
 * Keeps scenes ready for later jobs, up to a memory limit; the least recently used ones are freed first. A second
 * thread loads the scene of the next job. The context is current in all calls.
 */
#pragma once

#include "fault.h"
#include "options.h"
#include "stage.h"

typedef struct stage_cache stage_cache;

/* The scene in use is kept even if it exceeds the limit. NULL if memory is short. */
stage_cache *stage_cache_create(size_t most_bytes);
void stage_cache_destroy(stage_cache *c);

/* The stage of the options' scene. A file counts as unchanged if its path, size and times are; the files that it refers
 * to are not checked. Valid until the next call. NULL, with one line in `why`, on failure. */
stage *stage_cache_get(stage_cache *c, const options *o, failure *why);

/* Starts to load the options' scene unless it is there or another one is being loaded. True if it started. */
bool stage_cache_load_ahead(stage_cache *c, const options *o);
