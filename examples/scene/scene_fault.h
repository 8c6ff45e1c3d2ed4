/* SPDX-License-Identifier: MIT
 *
 * One line of error text that names the file and the fault. Text that comes from a file may hold anything, so line
 * breaks and control characters are taken out here, once, for every message.
 */
#ifndef GLSSAO_EXAMPLES_SCENE_FAULT_H
#define GLSSAO_EXAMPLES_SCENE_FAULT_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene_fault {
    const char *file; /* what the message begins with */
    char *text;       /* may be NULL when size is 0 */
    size_t size;
    bool set; /* the first fault stays; later ones are its consequences */
} scene_fault;

/* Writes "file: message" and returns false, so that a check can `return scene_fail(...)`. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
bool scene_fail(scene_fault *fault, const char *format, ...);

/* The same, for memory that could not be had. */
bool scene_fail_memory(scene_fault *fault);

#ifdef __cplusplus
}
#endif
#endif
