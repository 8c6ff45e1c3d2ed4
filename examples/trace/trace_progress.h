/* SPDX-License-Identifier: MIT
 *
 * A progress line on stderr, with the time left: overwritten in place on a terminal, now and then a new one elsewhere.
 */
#ifndef GLSSAO_EXAMPLES_TRACE_PROGRESS_H
#define GLSSAO_EXAMPLES_TRACE_PROGRESS_H

#include <stdbool.h>

typedef struct trace_progress {
    const char *what;
    bool is_terminal, shown;
    double start_s, last_s;
} trace_progress;

/* `what` begins the line, and must outlive it. */
trace_progress trace_progress_start(const char *what);

/* A trace_progress_fn; `user` is the trace_progress. */
void trace_progress_report(double done, void *user);

/* Takes the line away, where one can be. */
void trace_progress_end(trace_progress *p);

#endif
