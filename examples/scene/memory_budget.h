/* SPDX-License-Identifier: MIT
 *
 * How much memory a file may take. Everything that a file makes the loader allocate is charged here before it is
 * allocated, so that a small hostile file costs no more than the budget, and a large honest one fails only when the
 * budget ends.
 */
#ifndef GLSSAO_EXAMPLES_MEMORY_BUDGET_H
#define GLSSAO_EXAMPLES_MEMORY_BUDGET_H

#include <stdbool.h>
#include <stdint.h>

#include "scene_fault.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct memory_budget {
    uint64_t total, left; /* bytes */
} memory_budget;

/* `bytes` 0: half of the machine's memory. */
memory_budget memory_budget_begin(uint64_t bytes);

/* False, with a fault that names `what` and both sizes, where less is left. */
bool memory_budget_charge(memory_budget *b, uint64_t bytes, const char *what, scene_fault *fault);

#ifdef __cplusplus
}
#endif
#endif
