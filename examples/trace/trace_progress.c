/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "trace_progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

trace_progress trace_progress_start(const char *what)
{
    const double now = now_s();
    return (trace_progress){.what = what, .is_terminal = isatty(STDERR_FILENO), .start_s = now, .last_s = now};
}

void trace_progress_report(double done, void *user)
{
    enum { BAR = 30 };
    trace_progress *p = user;
    const double now = now_s();
    if (now - p->last_s < (p->is_terminal ? 0.1 : 5) || !(done > 0)) {
        return;
    }
    p->last_s = now;
    const double left_s = (now - p->start_s) * (1 - done) / done;
    const int full = (int)(BAR * done);
    if (p->is_terminal) {
        fprintf(stderr, "\r%s [%.*s%*s] %3.0f %%, %.0f s left   ", p->what, full, "##############################",
                BAR - full, "", 100 * done, left_s);
    } else {
        fprintf(stderr, "%s %.0f %%, %.0f s left\n", p->what, 100 * done, left_s);
    }
    fflush(stderr);
    p->shown = true;
}

void trace_progress_end(trace_progress *p)
{
    if (p->is_terminal && p->shown) {
        fprintf(stderr, "\r%79s\r", "");
    }
    p->shown = false;
}
