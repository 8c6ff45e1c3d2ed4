/* SPDX-License-Identifier: MIT
 *
 * Ray-traced accessibility in the background: rounds of few rays a pixel, whose mean gets better and can be shown at
 * any time, until it is good or somebody moves.
 */
#ifndef GLSSAO_EXAMPLES_TRUTH_JOB_H
#define GLSSAO_EXAMPLES_TRUTH_JOB_H

#include "draw.h"
#include "fault.h"
#include "scene.h"

#include <stdbool.h>
#include <stdint.h>

enum { TRUTH_ROUNDS = 16, TRUTH_ROUND_RAYS = 32 };

typedef struct truth_job truth_job;

/* Starts tracing. `wake` is called on the job's thread after each round. The scene must outlive the job. NULL where
 * memory or threads are short. */
truth_job *truth_job_start(const scene *s, const scene_view *view, float radius, uint32_t seed, void (*wake)(void));

/* How many of TRUTH_ROUNDS are done, and their mean, rows bottom to top, into out[width * height] where there is one
 * (out may be NULL). Negative: it failed, for the reason in `error`. */
int truth_job_read(truth_job *j, float *out, fault *why);

/* Ends it, within moments. NULL is fine. */
void truth_job_stop(truth_job *j);

#endif
