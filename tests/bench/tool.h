/* SPDX-License-Identifier: MIT
 *
 * How each program of the bench begins and ends.
 */
#pragma once

#include "context.h"
#include "options.h"

/* Parses the options of the program of this name. Negative: it may go on; else the code that it exits with. */
int tool_begin(const char *name, int argc, char **argv, options *out);

/* Makes the output folder, and a context with its functions in `gl`. NULL, with one line in `error`, on failure. */
context *tool_open(const options *o, failure *fault);

/* Prints the error of a run that failed. Returns the code to exit with. */
int tool_end(const char *name, bool done, const char *error);
