/* SPDX-License-Identifier: MIT
 *
 * Decides which passes a frame needs. glssao_compute runs exactly what this says.
 */
#include "effect.h"

void glssao__plan_ambient_size(const glssao_effect *effect, const glssao_settings *settings, int *out_width,
                               int *out_height)
{
    *out_width = settings->half_resolution ? (effect->width + 1) / 2 : effect->width;
    *out_height = settings->half_resolution ? (effect->height + 1) / 2 : effect->height;
}

/* Why every pixel would come out as 1; NULL where one may not. */
static const char *nothing_to_occlude(const glssao_settings *s)
{
    if (s->radius <= 0.0f)
        return "radius is 0: no occluder is in reach";
    if (s->power <= 0.0f)
        return "power is 0: every accessibility becomes 1";
    if (s->technique == GLSSAO_CLASSIC && s->fade_end <= s->surface_epsilon)
        return "fade_end is not above surface_epsilon: no occluder counts";
    return NULL;
}

static struct glssao_planned_pass planned(glssao_pass pass, bool run, const char *reason)
{
    return (struct glssao_planned_pass){.name = glssao__stats_pass_names[pass], .run = run, .reason = reason};
}

static glssao_plan plan_of_skips(const char *reason)
{
    glssao_plan plan;
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i)
        plan.passes[i] = planned((glssao_pass)i, false, reason);
    plan.passes[GLSSAO_PASS_APPLY].reason = "runs when glssao_apply is called";
    return plan;
}

glssao_plan glssao_plan_frame(const glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    static const glssao__log_sink silent = {0};
    glssao__projection projection;
    if (!effect || !glssao__settings_check_frame(effect, frame, settings, &silent, &projection))
        return plan_of_skips("glssao_compute would refuse these arguments");
    const char *nothing = nothing_to_occlude(settings);
    if (nothing)
        return plan_of_skips(nothing);

    glssao_plan plan = plan_of_skips("");
    struct glssao_planned_pass *normals = &plan.passes[GLSSAO_PASS_NORMALS];
    *normals = frame->normal_texture ? planned(GLSSAO_PASS_NORMALS, false, "the host brings normals")
                                     : planned(GLSSAO_PASS_NORMALS, true, "no normal map: rebuilt from depth");
    normals->draw_calls = normals->run ? 1 : 0;
    normals->width = effect->width;
    normals->height = effect->height;

    struct glssao_planned_pass *estimate = &plan.passes[GLSSAO_PASS_ESTIMATE];
    *estimate = planned(GLSSAO_PASS_ESTIMATE, true, settings->half_resolution ? "at half size" : "at full size");
    estimate->draw_calls = 1;
    glssao__plan_ambient_size(effect, settings, &estimate->width, &estimate->height);

    struct glssao_planned_pass *blur = &plan.passes[GLSSAO_PASS_BLUR];
    if (settings->blur == GLSSAO_BLUR_NONE || settings->blur_rounds == 0)
        *blur = planned(GLSSAO_PASS_BLUR, false, "no blur asked for");
    else
        *blur = planned(GLSSAO_PASS_BLUR, true, "smooths the estimate's noise");
    blur->draw_calls = blur->run ? 2 * settings->blur_rounds : 0;
    blur->width = estimate->width;
    blur->height = estimate->height;
    return plan;
}
