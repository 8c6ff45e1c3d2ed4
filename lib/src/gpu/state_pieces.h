/* SPDX-License-Identifier: MIT
 *
 * One piece of the host's state: how it is saved, set to what the passes want, and restored.
 */
#ifndef GLSSAO_GPU_STATE_PIECES_H
#define GLSSAO_GPU_STATE_PIECES_H

#include "gpu/state.h"

typedef struct glssao__state_piece {
    unsigned part; /* STATE_ bit; 0: wherever texture units are named */
    void (*save)(const glssao__gl *gl, glssao__state *s);
    void (*set)(const glssao__gl *gl, const glssao__state *s); /* NULL: each pass sets its own */
    void (*restore)(const glssao__gl *gl, const glssao__state *s);
} glssao__state_piece;

/* Objects that are bound, and switches and numbers. Both tables end with a row without functions. */
extern const glssao__state_piece glssao__state_bindings[];
extern const glssao__state_piece glssao__state_switches[];

#endif
