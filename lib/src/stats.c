/* SPDX-License-Identifier: MIT
 *
 * Counts and times of the passes. Times are pairs of timestamps, which nest within whatever queries the host runs,
 * in a ring of frames, so that reading them never waits for the GPU.
 */
#include "effect.h"

#include <string.h>

const char *const glssao__stats_pass_names[GLSSAO_PASS_COUNT] = {
    [GLSSAO_PASS_INPUTS] = "inputs",     [GLSSAO_PASS_NORMALS] = "normals", [GLSSAO_PASS_DISTANCE] = "distance",
    [GLSSAO_PASS_ESTIMATE] = "estimate", [GLSSAO_PASS_RESOLVE] = "resolve", [GLSSAO_PASS_BLUR] = "blur",
    [GLSSAO_PASS_UPSAMPLE] = "upsample", [GLSSAO_PASS_APPLY] = "apply",
};

static glssao__timer_frame *timers_of(glssao_effect *effect, uint64_t frame)
{
    return &effect->timers[frame % TIMER_FRAMES];
}

void glssao__stats_make_timers(glssao_effect *effect)
{
    if (effect->has_timers)
        for (int i = 0; i < TIMER_FRAMES; ++i)
            effect->gl.GenQueries(GLSSAO_PASS_COUNT * 2, effect->timers[i].queries[0]);
}

void glssao__stats_begin_frame(glssao_effect *effect)
{
    effect->frame += 1;
    memset(effect->draw_calls, 0, sizeof effect->draw_calls);
    memset(timers_of(effect, effect->frame)->used, 0, sizeof effect->timers->used);
}

void glssao__stats_begin_pass(glssao_effect *effect, glssao_pass pass)
{
    if (effect->has_timers)
        effect->gl.QueryCounter(timers_of(effect, effect->frame)->queries[pass][0], GL_TIMESTAMP);
}

void glssao__stats_end_pass(glssao_effect *effect, glssao_pass pass, int draw_calls)
{
    effect->draw_calls[pass] = draw_calls;
    if (!effect->has_timers)
        return;
    effect->gl.QueryCounter(timers_of(effect, effect->frame)->queries[pass][1], GL_TIMESTAMP);
    timers_of(effect, effect->frame)->used[pass] = true;
}

static bool is_known(const glssao__gl *gl, const glssao__timer_frame *timers)
{
    bool any = false;
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass)
        for (int end = 0; timers->used[pass] && end < 2; ++end) {
            gl_int available = 0;
            gl->GetQueryObjectiv(timers->queries[pass][end], GL_QUERY_RESULT_AVAILABLE, &available);
            if (!available)
                return false;
            any = true;
        }
    return any;
}

static double milliseconds(const glssao__gl *gl, const gl_uint queries[2])
{
    uint64_t before = 0, after = 0;
    gl->GetQueryObjectui64v(queries[0], GL_QUERY_RESULT, &before);
    gl->GetQueryObjectui64v(queries[1], GL_QUERY_RESULT, &after);
    return after > before ? (double)(after - before) * 1e-6 : 0.0;
}

glssao_stats glssao_get_stats(glssao_effect *effect)
{
    glssao_stats stats = {.gpu_ms = -1.0, .sampling_error = -1.0};
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass) {
        stats.passes[pass].name = glssao__stats_pass_names[pass];
        stats.passes[pass].gpu_ms = -1.0;
    }
    if (!effect)
        return stats;
    stats.frame = effect->frame;
    stats.estimates = effect->accumulation.count[0] + effect->accumulation.count[1];
    stats.sampling_error = glssao__accumulate_error(effect);
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass) {
        stats.passes[pass].draw_calls = effect->draw_calls[pass];
        stats.draw_calls += effect->draw_calls[pass];
    }
    if (!effect->has_timers || effect->frame == 0)
        return stats;
    const glssao__timer_frame *timers = timers_of(effect, effect->frame);
    if (!is_known(&effect->gl, timers))
        return stats;
    stats.gpu_ms = 0.0;
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass)
        if (timers->used[pass]) {
            stats.passes[pass].gpu_ms = milliseconds(&effect->gl, timers->queries[pass]);
            stats.gpu_ms += stats.passes[pass].gpu_ms;
        }
    return stats;
}
