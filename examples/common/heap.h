/* SPDX-License-Identifier: MIT
 *
 * How the C library keeps memory that was freed.
 */
#pragma once

/* Keeps freed memory for the next allocation. By default glibc gives it back: a software rasteriser, which allocates
 * the vertices of each batch anew, then spends a tenth of its time on page faults. */
void heap_keep_freed(void);
