/* SPDX-License-Identifier: MIT
 *
 * Streams that are closed or full.
 */
#define _POSIX_C_SOURCE 200809L
#include "streams.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *name;
static int failed_code;

static void check_output(void)
{
    errno = 0;
    if (!fflush(stdout) && !ferror(stdout))
        return;
    fprintf(stderr, "%s: standard output: %s\n", name, errno ? strerror(errno) : "it was not all written");
    _exit(failed_code);
}

void streams_guard(const char *program, int code)
{
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
        if (fcntl(number, F_GETFD) == -1) /* the lowest free number is the one that open takes */
            (void)!open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error of its write, not the end */
    name = program;
    failed_code = code;
    atexit(check_output);
}
