/* SPDX-License-Identifier: MIT
 *
 * Calls glssao_accumulate in a loop. It waits for each estimate: its error and its time decide whether another follows.
 */
#include "progressive.h"

#include "clock.h"
#include "gl.h"
#include "stop.h"

#include <stdio.h>

enum { MOST_ESTIMATES = 4096 }; /* the sums of the pixels then reach the precision of a float */

static bool is_done(const progressive_report *r, const progressive_goal *goal)
{
    return goal->error > 0 && r->sampling_error >= 0 && r->sampling_error <= goal->error;
}

glssao_result progressive_step(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                               const progressive_goal *goal, progressive_report *out)
{
    if (out->estimates == 0) /* the camera may have moved with the same projection */
        glssao_restart_accumulation(effect);
    const glssao_result result = glssao_accumulate(effect, frame, settings);
    gl.Finish();
    const glssao_stats stats = glssao_get_stats(effect);
    out->estimates = stats.estimates;
    out->sampling_error = stats.sampling_error;
    out->reached = goal->error <= 0 || is_done(out, goal);
    out->ended = result != GLSSAO_OK || is_done(out, goal) || out->estimates >= MOST_ESTIMATES;
    return result;
}

glssao_result progressive_run(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings,
                              const progressive_goal *goal, progressive_report *out)
{
    *out = (progressive_report){.sampling_error = -1};
    gl.Finish(); /* do not count what was drawn before */
    const double start = clock_wall_ms();
    double dearest_ms = 0;
    bool time_is_left = true;
    glssao_result result = GLSSAO_OK;
    for (int i = 0; !out->ended && time_is_left && !stop_signal(); i++) {
        const double before = clock_wall_ms();
        result = progressive_step(effect, frame, settings, goal, out);
        const double now = clock_wall_ms();
        out->ms = now - start;
        if (i > 0 && now - before > dearest_ms) /* the first estimate compiles shaders */
            dearest_ms = now - before;
        time_is_left = goal->budget_ms <= 0 || out->ms + dearest_ms <= goal->budget_ms;
    }
    return result;
}

void progressive_print(FILE *out, const progressive_report *r, const progressive_goal *goal)
{
    fprintf(out, "%d estimates in %.1f ms, sampling error ", r->estimates, r->ms);
    if (r->sampling_error >= 0)
        fprintf(out, "%.5f", r->sampling_error);
    else
        fprintf(out, "not known of a single one");
    if (goal->error > 0)
        fprintf(out, " (%s %g)", r->reached ? "at most" : "did not reach", goal->error);
    if (goal->budget_ms > 0)
        fprintf(out, " (budget %g ms)", goal->budget_ms);
    fputc('\n', out);
}
