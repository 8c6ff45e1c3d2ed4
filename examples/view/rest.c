/* SPDX-License-Identifier: MIT
 *
 * What happens while nothing changes: the history fills up, and then estimates are accumulated until the picture is
 * that of glssao-render --error.
 */
#include "viewer.h"

#include <math.h>

enum { FILLED = 16, SMOOTH = 16 }; /* frames of a history that is full; estimates whose mean is smoother than that */

/* Several samples a pixel, and a budget of time, are drawn as one frame. Bent normals are not reused. */
static bool applies(const viewer *v)
{
    const pipeline *p = &v->pipeline;
    return v->settings.history > 0 && p->wants.ao && !viewer_averages(v) && !v->options.budget_ms.given &&
           v->shown != SHOWN_RAW && !v->settings.bent_normals && !rays_view_applies(v);
}

double rest_error(const viewer *v)
{
    const double usual = 0.002;
    return v->settings.technique != GLSSAO_HORIZON || !(applies(v) || v->options.error.given) ? 0
           : v->options.error.given ? (double)v->options.error.value
                                    : usual;
}

bool rest_reuses(const viewer *v)
{
    return applies(v);
}

bool rest_is_due(const viewer *v)
{
    const bool seen = v->shown == SHOWN_AO || (v->shown == SHOWN_PICTURE && v->mode != MODE_OFF);
    return applies(v) && seen && !v->frame_due && !v->rested;
}

bool rest_hides(const viewer *v)
{
    const progressive_report *r = &v->pipeline.reached;
    return r->estimates > 0 && r->estimates < SMOOTH && !r->ended;
}

/* The mean is shown after 16, 32, 64 ... estimates and at the end: shading costs as much as an estimate. */
static bool is_shown(const progressive_report *r)
{
    return r->ended || (r->estimates >= SMOOTH && (r->estimates & (r->estimates - 1)) == 0);
}

bool rest_step(viewer *v)
{
    pipeline *p = &v->pipeline;
    const int most = v->settings.history < FILLED ? v->settings.history : FILLED;
    const bool fills = v->still_frames + 1 < most;
    const progressive_goal goal = {.error = rest_error(v)};
    bool done = true;
    if (fills || goal.error > 0)
        done = fills ? pipeline_occlude(p, &v->view, FAULT(v->error))
                     : pipeline_accumulate(p, &v->view, &goal, FAULT(v->error));
    v->still_frames += fills;
    v->rests++;
    v->rested = !done || (!fills && (goal.error <= 0 || p->reached.ended));
    if (!done)
        viewer_say(v, true, "%s", v->error);
    else if (fills || is_shown(&p->reached))
        pipeline_shade(p, &v->view, pipeline_ambient_map(p), p->color_framebuffer);
    return done;
}
