/* SPDX-License-Identifier: MIT
 *
 * A list of jobs as text: one job on each line, with words quoted as in a shell. Nothing is expanded.
 */
#pragma once

#include "fault.h"
#include "options.h"

#include <stddef.h>

typedef struct batch_job {
    int line; /* counted from 1 */
    options options;
    char *error; /* one line, without the name of the list: why the line is no valid job; NULL: it is valid */
} batch_job;

typedef struct batch_list {
    char *text; /* the strings of the options point into it */
    batch_job *jobs;
    size_t count;
} batch_list;

/* Reads the list defaults->batch ("-": standard input). Options that a line does not set come from `defaults`. A wrong
 * line becomes a job with an error, and so does a line that writes a file of an earlier line. False, with one line in
 * `why`, if the list cannot be read. Call batch_list_free in either case. */
bool batch_list_read(batch_list *list, const options *defaults, failure *why);
void batch_list_free(batch_list *list);

/* batch_names.c: sets the error of each job that writes a file of an earlier job. False if memory is short. */
bool batch_find_clashes(batch_list *list);
