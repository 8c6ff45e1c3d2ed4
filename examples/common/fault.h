/* SPDX-License-Identifier: MIT
 *
 * One line of error text that names the file and the fault. Text from a file may hold anything, so line breaks and
 * control characters are removed here, once, for every message.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct failure {
    const char *file; /* begins the message; NULL: the message stands alone */
    char *text;       /* may be NULL when size is 0 */
    size_t size;
    bool set; /* the first fault stays; later ones are its consequences */
} failure;

/* A fault that goes into an array of characters, for a call: work(FAULT(error)). */
#define FAULT(array) (&(struct failure){.text = (array), .size = sizeof(array)})

/* Writes "file: message" and returns false: `return fault_set(f, "...");`. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
bool fault_set(failure *f, const char *format, ...);

/* The same, for memory that could not be allocated. */
bool fault_set_memory(failure *f);

#ifdef __cplusplus
}
#endif
