/* SPDX-License-Identifier: MIT
 *
 * Warnings: one line for each thing in a file that is drawn differently from what the file asks for, or not at all.
 * With `strict`, the first warning is a fault instead.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "fault.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene_warnings {
    bool strict;
    char **lines; /* each once, in the order of their first mention, without the file's name */
    size_t count;
} scene_warnings;

/* Adds a line. False, with the fault set, when `strict` is set or there is no memory. After 32 lines the rest is left
 * out. */
#ifdef __GNUC__
__attribute__((format(printf, 3, 4)))
#endif
bool scene_warn(scene_warnings *w, failure *fault, const char *format, ...);

void scene_warnings_free(scene_warnings *w);

#ifdef __cplusplus
}
#endif
