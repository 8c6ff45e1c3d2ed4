/* SPDX-License-Identifier: MIT
 *
 * How far a long run is, on stderr: one line that a terminal shows in place; elsewhere a new line every five seconds.
 */
#pragma once

typedef struct progress {
    const char *what; /* begins the line: "frame"; must outlive it */
    double start_ms, last_ms;
} progress;

progress progress_start(const char *what);
/* "frame 3 of 10, 1.5 a second, 5 s left". */
void progress_count(progress *p, int done, int count);
/* "tracing 40 %, 5 s left"; `done` is 0 to 1, `user` a progress. Fits trace_progress_fn. */
void progress_share(double done, void *user);

/* A line in place, on a terminal only. */
#ifdef __GNUC__
__attribute__((format(printf, 1, 2)))
#endif
void progress_show(const char *format, ...);
/* Erases the line in place, so that something else can be printed. */
void progress_clear(void);
