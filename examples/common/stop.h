/* SPDX-License-Identifier: MIT
 *
 * Ends a program in good order: on SIGINT and SIGTERM, and when its time is up. Files that are half written
 * (whole_file.h) are removed in any case.
 */
#pragma once

#include <stdbool.h>

/* A signal removes half-written files and then ends the program as it would have without this. */
void stop_at_once(void);

/* The first signal is only noted; a second one ends the program as above. */
void stop_when_asked(void);
/* The signal that was noted, 0: none. Any thread. */
int stop_signal(void);

/* After so many seconds, removes half-written files, prints `message` and a line break to stderr, and exits with
 * `code`. `message` must live until then. 0 takes it back. */
void stop_after(double seconds, const char *message, int code);
