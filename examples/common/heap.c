/* SPDX-License-Identifier: MIT */
#include "heap.h"

#include <stdlib.h>

#ifdef __GLIBC__
#include <malloc.h>

enum { MEBIBYTE = 1 << 20, MOST_KEPT = 64 * MEBIBYTE, LARGEST_REUSED = 8 * MEBIBYTE };
#endif

void heap_keep_freed(void)
{
#ifdef __GLIBC__
    mallopt(M_TRIM_THRESHOLD, MOST_KEPT);
    mallopt(M_MMAP_THRESHOLD, LARGEST_REUSED);
#endif
}
