/* SPDX-License-Identifier: MIT
 *
 * How the C library keeps memory that was freed.
 */
#ifndef GLSSAO_EXAMPLES_HEAP_H
#define GLSSAO_EXAMPLES_HEAP_H

/* Keeps freed memory for the next allocation. By default glibc gives it back: a software rasteriser, which allocates
 * the vertices of each batch anew, then spends a tenth of its time on page faults. */
void heap_keep_freed(void);

#endif
