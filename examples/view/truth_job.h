/* SPDX-License-Identifier: MIT
 *
 * Traces accessibility in the background, in rounds of a few rays a pixel. Their mean improves with each round and can
 * be shown at any time.
 */
#pragma once

#include "draw.h"
#include "fault.h"
#include "scene.h"

#include <stdbool.h>
#include <stdint.h>

enum { TRUTH_ROUNDS = 16, TRUTH_ROUND_RAYS = 32 };

typedef struct truth_job truth_job;

/* Starts tracing. `wake` is called on the job's thread after each round. The scene must outlive the job. NULL without
 * memory or a thread. */
truth_job *truth_job_start(const scene *s, const scene_view *view, float radius, uint32_t seed, void (*wake)(void));

/* Returns how many of TRUTH_ROUNDS are done. If there is one, copies the mean to out[width * height], rows bottom to
 * top; `out` may be NULL. Negative, with the reason in `why`: the tracing failed. */
int truth_job_read(truth_job *j, float *out, failure *why);

/* Ends the tracing within moments. NULL is allowed. */
void truth_job_stop(truth_job *j);
