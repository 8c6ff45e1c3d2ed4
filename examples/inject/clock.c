/* SPDX-License-Identifier: MIT
 *
 * The clock, apart from the rest so that tests can put another in its place.
 */
#define _POSIX_C_SOURCE 200809L
#include "inject.h"

#include <time.h>

double inject_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
