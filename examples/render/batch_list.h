/* SPDX-License-Identifier: MIT
 *
 * A list of jobs as text: one a line, its words quoted as for a shell, which expands nothing.
 */
#ifndef GLSSAO_EXAMPLES_BATCH_LIST_H
#define GLSSAO_EXAMPLES_BATCH_LIST_H

#include "fault.h"
#include "options.h"

#include <stddef.h>

typedef struct batch_job {
    int line; /* counted from 1 */
    options options;
    char *error; /* one line, without the list's name: why it can't be a job; NULL: it can */
} batch_job;

typedef struct batch_list {
    char *text; /* the options' strings point into it */
    batch_job *jobs;
    size_t count;
} batch_list;

/* Reads the list of defaults->batch ("-": standard input) and parses its lines over `defaults`; lines that are wrong
 * become jobs with an error, and so does every line that writes a file which an earlier one writes. False, with one
 * line in `error`, where the list can't be read; batch_list_free is due in either case. */
bool batch_list_read(batch_list *list, const options *defaults, fault *why);
void batch_list_free(batch_list *list);

/* batch_names.c: gives an error to every job that writes a file which an earlier one writes. False where memory is
 * short. */
bool batch_find_clashes(batch_list *list);

#endif
