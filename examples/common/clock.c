/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "clock.h"

#include <time.h>

static double read_clock(clockid_t id)
{
    struct timespec t;
    clock_gettime(id, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

double clock_wall_ms(void)
{
    return read_clock(CLOCK_MONOTONIC);
}

double clock_cpu_ms(void)
{
    return read_clock(CLOCK_PROCESS_CPUTIME_ID);
}
