/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* isatty */
#include "progress.h"

#include "clock.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <unistd.h>

progress progress_start(const char *what)
{
    const double now = clock_wall_ms();
    return (progress){.what = what, .start_ms = now, .last_ms = now};
}

static bool is_terminal(void)
{
    return isatty(STDERR_FILENO);
}

void progress_clear(void)
{
    if (is_terminal())
        fputs("\r\033[K", stderr); /* ECMA-48: to the start of the line; erase to its end */
}

static bool is_due(progress *p)
{
    const double now = clock_wall_ms();
    const bool due = now - p->last_ms >= (is_terminal() ? 100 : 5000);
    p->last_ms = due ? now : p->last_ms;
    return due;
}

void progress_count(progress *p, int done, int count)
{
    const bool is_last = done >= count;
    if (!is_due(p) && !is_last)
        return;
    const double rate = done / ((clock_wall_ms() - p->start_ms) / 1e3);
    progress_clear();
    fprintf(stderr, "%s %d of %d, %.1f a second, %.0f s left%s", p->what, done, count, rate, (count - done) / rate,
            is_terminal() && !is_last ? "" : "\n");
}

void progress_share(double done, void *user)
{
    progress *p = user;
    if (!(done > 0) || !is_due(p))
        return;
    progress_clear();
    fprintf(stderr, "%s %.0f %%, %.0f s left%s", p->what, 100 * done,
            (clock_wall_ms() - p->start_ms) / 1e3 * (1 - done) / done, is_terminal() ? "" : "\n");
}

void progress_show(const char *format, ...)
{
    va_list arguments;
    if (!is_terminal())
        return;
    progress_clear();
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
}
