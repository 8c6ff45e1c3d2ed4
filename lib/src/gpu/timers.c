/* SPDX-License-Identifier: MIT
 *
 * A pool of timestamp queries, one set for each frame in flight. A set is used again only after glssao__timers_poll has
 * seen that the GPU is through with it: reusing one earlier makes some drivers wait.
 */
#include "gpu/timers.h"

void glssao__timers_make(glssao__timers *timers, const glssao__gl *gl)
{
    for (int i = 0; i < TIMER_FRAMES; ++i)
        gl->GenQueries(TIMER_SECTIONS * 2, timers->frames[i].queries[0]);
    timers->enabled = true;
}

void glssao__timers_destroy(glssao__timers *timers, const glssao__gl *gl)
{
    for (int i = 0; timers->enabled && i < TIMER_FRAMES; ++i)
        gl->DeleteQueries(TIMER_SECTIONS * 2, timers->frames[i].queries[0]);
    *timers = (glssao__timers){0};
}

void glssao__timers_frame(glssao__timers *timers, uint64_t frame)
{
    if (timers->current && timers->current->frame == frame)
        return;
    timers->current = NULL;
    for (int i = 0; timers->enabled && i < TIMER_FRAMES && !timers->current; ++i)
        if (timers->frames[i].frame == 0)
            timers->current = &timers->frames[i];
    if (!timers->current)
        return;
    timers->current->frame = frame;
    timers->current->used = 0;
}

void glssao__timers_drop(glssao__timers *timers, uint64_t frame)
{
    if (!timers->current || timers->current->frame != frame)
        return;
    timers->current->frame = 0;
    timers->current = NULL;
}

void glssao__timers_begin(glssao__timers *timers, const glssao__gl *gl, int section)
{
    if (timers->current && !(timers->current->used & 1u << section))
        gl->QueryCounter(timers->current->queries[section][0], GL_TIMESTAMP);
}

void glssao__timers_end(glssao__timers *timers, const glssao__gl *gl, int section)
{
    if (!timers->current || (timers->current->used & 1u << section)) /* a second time in one frame goes untimed */
        return;
    gl->QueryCounter(timers->current->queries[section][1], GL_TIMESTAMP);
    timers->current->used |= 1u << section;
}

static bool is_finished(const glssao__gl *gl, const glssao__timer_frame *frame)
{
    for (int section = 0; section < TIMER_SECTIONS; ++section)
        for (int end = 0; (frame->used & 1u << section) && end < 2; ++end) {
            gl_int available = 0;
            gl->GetQueryObjectiv(frame->queries[section][end], GL_QUERY_RESULT_AVAILABLE, &available);
            if (!available)
                return false;
        }
    return true;
}

static double milliseconds(const glssao__gl *gl, const gl_uint queries[2])
{
    uint64_t before = 0, after = 0;
    gl->GetQueryObjectui64v(queries[0], GL_QUERY_RESULT, &before);
    gl->GetQueryObjectui64v(queries[1], GL_QUERY_RESULT, &after);
    return after > before ? (double)(after - before) * 1e-6 : 0.0;
}

void glssao__timers_poll(glssao__timers *timers, const glssao__gl *gl)
{
    for (int i = 0; i < TIMER_FRAMES; ++i) {
        glssao__timer_frame *frame = &timers->frames[i];
        if (frame->frame == 0 || !is_finished(gl, frame))
            continue;
        for (int section = 0; section < TIMER_SECTIONS && frame->frame >= timers->known_frame; ++section)
            timers->known_ms[section] = frame->used & 1u << section ? milliseconds(gl, frame->queries[section]) : -1.0;
        if (frame->frame > timers->known_frame)
            timers->known_frame = frame->frame;
        /* The newest frame may still be applied, which is one more section of it. */
        if (frame != timers->current)
            frame->frame = 0;
    }
}
