/* SPDX-License-Identifier: MIT
 *
 * Counts bytes against a limit.
 */
#define _POSIX_C_SOURCE 200809L /* sysconf */
#include "memory_budget.h"

#include <unistd.h>

memory_budget memory_budget_begin(uint64_t bytes)
{
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    if (!bytes)
        bytes = pages > 0 && page > 0 ? (uint64_t)pages * (uint64_t)page / 2 : UINT64_C(4) << 30;
    return (memory_budget){.total = bytes, .left = bytes};
}

bool memory_budget_charge(memory_budget *b, uint64_t bytes, const char *what, failure *fault)
{
    const uint64_t mib = 1 << 20;
    if (bytes > b->left)
        return fault_set(fault, "%s: %llu MiB needed, and %llu of the %llu MiB allowed are left (option --memory)",
                         what, (unsigned long long)(bytes / mib + (bytes % mib != 0)),
                         (unsigned long long)(b->left / mib), (unsigned long long)(b->total / mib));
    b->left -= bytes;
    return true;
}
