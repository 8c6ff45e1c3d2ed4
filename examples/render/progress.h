/* SPDX-License-Identifier: MIT
 *
 * How far a long run is: one line on stderr that a terminal shows in place, elsewhere a line now and then.
 */
#ifndef GLSSAO_EXAMPLES_PROGRESS_H
#define GLSSAO_EXAMPLES_PROGRESS_H

typedef struct progress {
    const char *what; /* "frame" */
    int count;
    double start_ms, last_ms;
} progress;

progress progress_start(const char *what, int count);
void progress_show(progress *p, int done);
/* Where a line is shown in place: wipes it, so that another can be printed. */
void progress_wipe(const progress *p);

#endif
