/* SPDX-License-Identifier: MIT
 *
 * Limits the memory that loading a file may take. The loader charges each allocation before making it. A small hostile
 * file therefore costs no more than the budget, and a large file fails only at the end of the budget.
 */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "fault.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct memory_budget {
    uint64_t total, left; /* bytes */
} memory_budget;

/* `bytes` 0: half of the machine's memory. */
memory_budget memory_budget_begin(uint64_t bytes);

/* False, with a fault that names `what` and both sizes, where less is left. */
bool memory_budget_charge(memory_budget *b, uint64_t bytes, const char *what, failure *fault);

#ifdef __cplusplus
}
#endif
