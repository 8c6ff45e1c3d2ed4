/* SPDX-License-Identifier: MIT
 *
 * What options.c, options_table.c and options_check.c share.
 */
#pragma once

#include "fault.h"
#include "option.h"
#include "options.h"

/* options.c: what the program is called. */
const char *options_name(options_program program);

/* options_table.c: what a program, or a line of a batch, takes. */
option_set options_set(options_program program);

/* options_check.c: checks what no value alone tells, and the text of --set. False, with one line in `why`. */
bool options_check(const options *o, options_program program, failure *why);

/* options_depth.c: checks the options of a depth map; refuses those that differ from `start` and do not apply to it, or
 * only to it. False, with one line in `why`. */
bool options_check_depth_map(const options *start, const options *o, options_program program, failure *why);
