/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* isatty */
#include "progress.h"

#include "clock.h"

#include <stdbool.h>
#include <stdio.h>
#include <unistd.h>

progress progress_start(const char *what, int count)
{
    const double now = clock_wall_ms();
    return (progress){.what = what, .count = count, .start_ms = now, .last_ms = now};
}

void progress_show(progress *p, int done)
{
    const double now = clock_wall_ms();
    const bool is_terminal = isatty(STDERR_FILENO), is_last = done >= p->count;
    if (!is_last && now - p->last_ms < (is_terminal ? 100 : 5000)) {
        return;
    }
    p->last_ms = now;
    const double rate = done / ((now - p->start_ms) / 1e3);
    fprintf(stderr, "%s%s %d of %d, %.1f a second, %.0f s left%s", is_terminal ? "\r" : "", p->what, done, p->count,
            rate, (p->count - done) / rate,
            is_terminal && !is_last ? "   "
            : is_terminal           ? "   \n"
                                    : "\n");
}

void progress_wipe(const progress *p)
{
    if (p->last_ms > p->start_ms && isatty(STDERR_FILENO)) {
        fprintf(stderr, "\r%79s\r", "");
    }
}
