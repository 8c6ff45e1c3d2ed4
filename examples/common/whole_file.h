/* SPDX-License-Identifier: MIT
 *
 * Files that appear whole or not at all: written under another name in the same folder, and renamed at the end. What is
 * no regular file (a device, a pipe) is written as it is, and so is a file whose folder takes no new one. The path "-"
 * is standard output.
 */
#ifndef GLSSAO_EXAMPLES_WHOLE_FILE_H
#define GLSSAO_EXAMPLES_WHOLE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct whole_file {
    FILE *file;       /* to write to */
    const char *name; /* as it was handed over, for messages */
    char *path;       /* what it will be; links followed */
    char *temporary;  /* what it is until then; NULL: `path` itself */
} whole_file;

/* False, with one line in `error`; any thread. `path` must live until the file is closed. */
bool whole_file_open(whole_file *f, const char *path, char *error, size_t error_size);

/* Removes the temporary files of all that are open: for a program that ends. Async-signal-safe. */
void whole_file_abandon_all(void);
/* Removes the temporary files that a process of that number left beside `path`. */
void whole_file_remove_left(const char *path, long process);

/* Closes it. Where that fails, or `written` is false already (and `error` says why), nothing of it is left and what was
 * there before stays, unless it had to be written as it is. Returns whether all is written. */
bool whole_file_close(whole_file *f, bool written, char *error, size_t error_size);

#ifdef __cplusplus
}
#endif
#endif
