/* SPDX-License-Identifier: MIT
 *
 * Files that appear whole or not at all: they are written under another name in the same folder and renamed at the end.
 * Devices and pipes are written directly, and so is a file if its folder is read-only. The path "-" is standard output.
 */
#pragma once

#include "fault.h"

#include <stdbool.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct whole_file {
    FILE *file;       /* write here */
    const char *name; /* the given path, for messages */
    char *path;       /* the final path, with links resolved */
    char *temporary;  /* the name until then; NULL: `path` itself */
} whole_file;

/* False, with one line in `error`, on failure. Any thread. `path` must live until the file is closed. */
bool whole_file_open(whole_file *f, const char *path, failure *fault);

/* Removes the temporary files of all open files, before the program ends. Async-signal-safe. */
void whole_file_abandon_all(void);
/* Removes temporary files of `path` that a process with this number left. */
void whole_file_remove_left(const char *path, long process);

/* Closes the file. If that fails, or `written` is false (then `error` already says why), the new file is removed and
 * the old one stays, unless it was written directly. Returns whether everything was written. */
bool whole_file_close(whole_file *f, bool written, failure *fault);

#ifdef __cplusplus
}
#endif
