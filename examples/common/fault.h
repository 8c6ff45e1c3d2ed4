/* SPDX-License-Identifier: MIT
 *
 * One line of error text that names the file and the fault. Text from a file may hold anything, so line breaks and
 * control characters are removed here, once, for every message.
 */
#ifndef GLSSAO_EXAMPLES_FAULT_H
#define GLSSAO_EXAMPLES_FAULT_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fault {
    const char *file; /* begins the message; NULL: the message stands alone */
    char *text;       /* may be NULL when size is 0 */
    size_t size;
    bool set; /* the first fault stays; later ones are its consequences */
} fault;

/* A fault that goes into an array of characters, for a call: work(FAULT(error)). */
#define FAULT(array) (&(struct fault){.text = (array), .size = sizeof(array)})

/* Writes "file: message" and returns false: `return fault_set(f, "...");`. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
bool fault_set(fault *f, const char *format, ...);

/* The same, for memory that could not be allocated. */
bool fault_set_memory(fault *f);

#ifdef __cplusplus
}
#endif
#endif
