/* SPDX-License-Identifier: MIT
 *
 * Writes loops of a GLSL source out. Mesa's software rasteriser runs them faster so, and does not do it by itself.
 */
#ifndef GLSSAO_FRAME_UNROLL_H
#define GLSSAO_FRAME_UNROLL_H

#include <stdbool.h>

/* A copy of the source in which each loop of the form
 *     UNROLL for (int i = A; i < B; ++i) { ... }      or      UNROLL for (int i = A; i >= B; --i) { ... }
 * is its body once for each turn, in a block of its own with `const int i = ...`. With `is_short`, so are loops that
 * begin with UNROLL_IF_SHORT. A and B are whole numbers, macros that the source defines as numbers, or a macro plus or
 * minus a number. NULL where there is no memory; the caller frees. */
char *glssao__unroll(const char *source, bool is_short);

#endif
