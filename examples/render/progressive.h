/* SPDX-License-Identifier: MIT
 *
 * --error and --budget: estimates are accumulated until the sampling error is small enough or the time is spent.
 */
#pragma once

#include <glssao/glssao.h>
#include <stdio.h>

typedef struct progressive_goal {
    double error;     /* of accessibility, RMS; 0: no limit */
    double budget_ms; /* 0: no limit */
} progressive_goal;

typedef struct progressive_report {
    int estimates;
    double sampling_error; /* negative: unknown, after a single estimate */
    double ms;             /* time spent, including the GPU's */
    bool reached;          /* all goals that were set */
    bool ended;            /* no further estimate brings more */
} progressive_report;

/* Runs at least one estimate. The mean becomes the result of the effect. The context is current. */
glssao_result progressive_run(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                              const progressive_goal *goal, progressive_report *out);
/* One more estimate. `out` is all 0 before the first. */
glssao_result progressive_step(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                               const progressive_goal *goal, progressive_report *out);
/* Prints one line. */
void progressive_print(FILE *out, const progressive_report *r, const progressive_goal *goal);
