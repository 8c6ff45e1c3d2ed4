/* SPDX-License-Identifier: MIT
 *
 * GPU times of sections of a frame, by pairs of timestamps, which nest within whatever queries the host runs. Neither
 * recording nor reading ever waits: a frame for which no free queries are left goes untimed.
 */
#ifndef GLSSAO_GPU_TIMERS_H
#define GLSSAO_GPU_TIMERS_H

#include "gpu/functions.h"

enum { TIMER_FRAMES = 4, TIMER_SECTIONS = 16, SECTION_DEPTH_COPY = TIMER_SECTIONS - 1 }; /* the others: glssao_pass */

typedef struct glssao__timer_frame {
    gl_uint queries[TIMER_SECTIONS][2]; /* before and after */
    unsigned used;                      /* bit i: section i was timed */
    uint64_t frame;                     /* 0: free */
} glssao__timer_frame;

/* All zero: nothing is timed. */
typedef struct glssao__timers {
    bool enabled;
    glssao__timer_frame frames[TIMER_FRAMES];
    glssao__timer_frame *current;    /* NULL: the frame goes untimed */
    uint64_t known_frame;            /* the newest frame whose times are known; 0: none yet */
    double known_ms[TIMER_SECTIONS]; /* its times; negative: not timed */
} glssao__timers;

void glssao__timers_make(glssao__timers *timers, const glssao__gl *gl);
void glssao__timers_destroy(glssao__timers *timers, const glssao__gl *gl);
/* Starts the frame of that number, from 1; goes on with it where it was started already. */
void glssao__timers_frame(glssao__timers *timers, uint64_t frame);
/* Forgets that frame, which came to nothing, where it was started last. */
void glssao__timers_drop(glssao__timers *timers, uint64_t frame);
void glssao__timers_begin(glssao__timers *timers, const glssao__gl *gl, int section);
void glssao__timers_end(glssao__timers *timers, const glssao__gl *gl, int section);
/* Reads what the GPU has finished into known_frame and known_ms, and frees those queries. */
void glssao__timers_poll(glssao__timers *timers, const glssao__gl *gl);

#endif
