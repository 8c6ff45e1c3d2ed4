/* SPDX-License-Identifier: MIT
 *
 * The files that a program read, so that it overwrites none of them. Files are told by device and number, not by name:
 * links and other spellings of a path are the same file.
 */
#pragma once

#include "fault.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct inputs {
    struct input *files;
    size_t count;
    bool full; /* memory was short: some are missing, so that nothing may be overwritten */
} inputs;

/* From now on, what this thread reads through read_file.h is added to `to`; NULL ends that. */
void inputs_record(inputs *to);
/* read_file.c: adds a file that was opened. */
void inputs_note(int descriptor, const char *path);

void inputs_free(inputs *in);
/* Takes a file out of the list: it may be overwritten. */
void inputs_forget(inputs *in, const char *path);

/* False, with one line in `why`, where writing to `path` would overwrite one of the files, or the file `also` (may be
 * NULL). */
bool inputs_spare(const inputs *in, const char *also, const char *path, failure *why);

#ifdef __cplusplus
}
#endif
