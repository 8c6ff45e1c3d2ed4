/* SPDX-License-Identifier: MIT
 *
 * --error and --budget: estimates are accumulated until the sampling error is small enough or the time is spent.
 */
#ifndef GLSSAO_EXAMPLES_PROGRESSIVE_H
#define GLSSAO_EXAMPLES_PROGRESSIVE_H

#include <glssao/glssao.h>
#include <stdio.h>

typedef struct progressive_goal {
    double error;     /* of accessibility, RMS; 0: none */
    double budget_ms; /* 0: none */
} progressive_goal;

typedef struct progressive_report {
    int estimates;
    double sampling_error; /* negative: a single estimate has none */
    double ms;             /* spent, waited for */
    bool reached;          /* the goals that there are */
} progressive_report;

/* At least one estimate; leaves the mean as the effect's result. The context is current. */
glssao_result progressive_run(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                              const progressive_goal *goal, progressive_report *out);
/* One line. */
void progressive_print(FILE *out, const progressive_report *r, const progressive_goal *goal);

#endif
