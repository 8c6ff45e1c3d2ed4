/* SPDX-License-Identifier: MIT
 *
 * Scenes kept from job to job, ready to be drawn, up to a bound on their memory: those used longest ago go first. The
 * next job's scene is loaded on a thread beside. The context is current throughout.
 */
#ifndef GLSSAO_EXAMPLES_STAGE_CACHE_H
#define GLSSAO_EXAMPLES_STAGE_CACHE_H

#include "fault.h"
#include "options.h"
#include "stage.h"

typedef struct stage_cache stage_cache;

/* The scene in use is kept, however large. NULL where memory is short. */
stage_cache *stage_cache_create(size_t most_bytes);
void stage_cache_destroy(stage_cache *c);

/* The stage of the options' scene: a file is the same as one loaded before if its path, size and times are, those of
 * the files that it names are not looked at. Valid until the next call; NULL, with one line in `why`, on failure. */
stage *stage_cache_get(stage_cache *c, const options *o, fault *why);

/* Starts loading the options' scene where it is not there and no other is being loaded; true where it did. */
bool stage_cache_load_ahead(stage_cache *c, const options *o);

#endif
