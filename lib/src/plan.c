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

glssao__region glssao__plan_inner(int width, int height, int margin)
{
    return (glssao__region){margin, margin, width - 2 * margin, height - 2 * margin};
}

/* Grown on all sides, within width x height. */
static glssao__region grown(glssao__region r, int by, int width, int height)
{
    int right = r.x + r.width + by, top = r.y + r.height + by;
    r.x = r.x > by ? r.x - by : 0;
    r.y = r.y > by ? r.y - by : 0;
    r.width = (right < width ? right : width) - r.x;
    r.height = (top < height ? top : height) - r.y;
    return r;
}

int glssao__plan_reach(const glssao_settings *settings, const glssao_plan *plan)
{
    const bool planar = settings->blur == GLSSAO_BLUR_PLANAR;
    const int first = planar || settings->blur == GLSSAO_BLUR_BOX ? 2 : 5, later = planar ? 3 : first;
    const bool blurs = plan->passes[GLSSAO_PASS_BLUR].run || glssao__compute_rounds_within(settings, plan) > 0;
    return (blurs ? first + later * (settings->blur_rounds - 1) : 0) + (plan->passes[GLSSAO_PASS_UPSAMPLE].run ? 1 : 0);
}

bool glssao__plan_is_paired(const glssao_settings *settings, const glssao_plan *plan)
{
    return plan->passes[GLSSAO_PASS_UPSAMPLE].run ||
           (plan->passes[GLSSAO_PASS_BLUR].run && settings->blur == GLSSAO_BLUR_PLANAR);
}

glssao__region glssao__plan_result(const glssao_effect *effect, const glssao_frame *frame,
                                   const glssao_settings *settings, const glssao_plan *plan)
{
    int width, height;
    glssao__plan_ambient_size(effect, settings, &width, &height);
    if (settings->half_resolution && !plan->passes[GLSSAO_PASS_UPSAMPLE].run)
        return glssao__plan_inner(width, height, frame->margin / 2);
    return glssao__plan_inner(effect->width, effect->height, frame->margin);
}

glssao__region glssao__plan_region(const glssao_effect *effect, const glssao_frame *frame,
                                   const glssao_settings *settings, const glssao_plan *plan, glssao_pass pass)
{
    int width, height, factor = settings->half_resolution ? 2 : 1, by = glssao__plan_reach(settings, plan);
    glssao__plan_ambient_size(effect, settings, &width, &height);
    if (pass == GLSSAO_PASS_INPUTS)
        return glssao__plan_inner(effect->width, effect->height, 0);
    if (pass == GLSSAO_PASS_UPSAMPLE)
        return glssao__plan_inner(effect->width, effect->height, frame->margin);
    if (pass == GLSSAO_PASS_NORMALS)
        return grown(glssao__plan_inner(effect->width, effect->height, frame->margin), factor * by, effect->width,
                     effect->height);
    if (pass == GLSSAO_PASS_DISTANCE || pass == GLSSAO_PASS_TILES) /* occluders are looked for in the margin */
        return glssao__plan_inner(width, height, 0);
    return grown(glssao__plan_inner(width, height, frame->margin / factor), by, width, height);
}

/* Why every pixel would come out as 1; NULL where one may not. */
static const char *nothing_to_occlude(const glssao_frame *frame, const glssao_settings *s)
{
    if (frame->only_sky)
        return "the host sees nothing but sky: no surface is occluded";
    if (frame->no_ambient_light)
        return "the host has no ambient light: nothing to scale";
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
    plan.path = GLSSAO_PATH_FRAGMENT;
    plan.path_reason = "nothing runs";
    return plan;
}

static int blur_calls(const glssao_settings *settings, const glssao_plan *plan)
{
    if (settings->blur != GLSSAO_BLUR_PLANAR || settings->blur_rounds == 0)
        return 2 * settings->blur_rounds;
    if (!plan->passes[GLSSAO_PASS_BLUR].compute)
        return settings->blur_rounds + 1; /* the first round takes two */
    const int rounds = settings->blur_rounds - glssao__compute_rounds_within(settings, plan);
    return (rounds + COMPUTE_ROUNDS - 1) / COMPUTE_ROUNDS;
}

glssao_plan glssao_plan_frame(const glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    static const glssao__log_sink silent = {0};
    glssao__projection projection;
    if (!effect || !glssao__settings_check_frame(effect, frame, settings, &silent, &projection))
        return plan_of_skips("glssao_compute would refuse these arguments");
    const char *nothing = nothing_to_occlude(frame, settings);
    if (nothing)
        return plan_of_skips(nothing);

    glssao_plan plan = plan_of_skips("");
    plan.passes[GLSSAO_PASS_RESOLVE].reason = "runs when glssao_accumulate is called";
    const int copies = glssao__inputs_count(frame);
    plan.passes[GLSSAO_PASS_INPUTS] =
        copies > 0 ? planned(GLSSAO_PASS_INPUTS, true, "one sample, the viewport or the logarithm is taken out first")
                   : planned(GLSSAO_PASS_INPUTS, false, "the host's textures are read as they are");
    struct glssao_planned_pass *normals = &plan.passes[GLSSAO_PASS_NORMALS];
    *normals = frame->normal_texture ? planned(GLSSAO_PASS_NORMALS, false, "the host brings normals")
                                     : planned(GLSSAO_PASS_NORMALS, true, "no normal map: rebuilt from depth");
    struct glssao_planned_pass *estimate = &plan.passes[GLSSAO_PASS_ESTIMATE];
    *estimate = planned(GLSSAO_PASS_ESTIMATE, true, settings->half_resolution ? "at half size" : "at full size");

    struct glssao_planned_pass *blur = &plan.passes[GLSSAO_PASS_BLUR];
    if (settings->blur == GLSSAO_BLUR_NONE || settings->blur_rounds == 0)
        *blur = planned(GLSSAO_PASS_BLUR, false, "no blur asked for");
    else
        *blur = planned(GLSSAO_PASS_BLUR, true, "smooths the estimate's noise");

    struct glssao_planned_pass *upsample = &plan.passes[GLSSAO_PASS_UPSAMPLE];
    if (!settings->half_resolution)
        *upsample = planned(GLSSAO_PASS_UPSAMPLE, false, "the estimate is at full size");
    else if (!settings->upsample)
        *upsample = planned(GLSSAO_PASS_UPSAMPLE, false, "the host takes the half-size map");
    else
        *upsample = planned(GLSSAO_PASS_UPSAMPLE, true, "half size to full along surfaces");

    struct glssao_planned_pass *distance = &plan.passes[GLSSAO_PASS_DISTANCE];
    if (settings->technique == GLSSAO_HORIZON)
        *distance = planned(GLSSAO_PASS_DISTANCE, true, "the estimate reads it");
    else
        *distance = planned(GLSSAO_PASS_DISTANCE, false, "no pass reads it");

    int width, height;
    glssao__plan_ambient_size(effect, settings, &width, &height);
    const bool compute = glssao__compute_decide(effect, settings, &plan.path_reason);
    plan.path = compute ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
    const char *refusal = glssao__tiles_refusal(effect, settings, width, height);
    struct glssao_planned_pass *tiles = &plan.passes[GLSSAO_PASS_TILES];
    *tiles = refusal ? planned(GLSSAO_PASS_TILES, false, refusal)
                     : planned(GLSSAO_PASS_TILES, true, "what no occluder can reach is left out below");

    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i)
        plan.passes[i].compute = plan.passes[i].run && compute && glssao__compute_can_run(settings, (glssao_pass)i);
    if (blur->run && blur_calls(settings, &plan) == 0)
        *blur = planned(GLSSAO_PASS_BLUR, false, "within the dispatch that brings the result to full size");
    for (int i = 0; i < GLSSAO_PASS_COUNT; ++i) {
        struct glssao_planned_pass *pass = &plan.passes[i];
        if (i == GLSSAO_PASS_APPLY || i == GLSSAO_PASS_RESOLVE)
            continue;
        const glssao__region region = glssao__plan_region(effect, frame, settings, &plan, (glssao_pass)i);
        const bool fills = tiles->run && glssao__plan_is_paired(settings, &plan); /* what neighbours read */
        pass->draw_calls = !pass->run                  ? 0
                           : pass == blur              ? blur_calls(settings, &plan)
                           : pass == tiles             ? TILE_PASSES
                           : i == GLSSAO_PASS_INPUTS   ? copies
                           : pass == upsample          ? (pass->compute ? 1 : 2)
                           : pass == estimate && fills ? 2
                                                       : 1;
        pass->width = region.width;
        pass->height = region.height;
    }
    return plan;
}

glssao_plan glssao__plan_accumulate(const glssao_effect *effect, const glssao_frame *frame,
                                    const glssao_settings *settings, int estimates)
{
    glssao_plan plan = glssao_plan_frame(effect, frame, settings);
    struct glssao_planned_pass *resolve = &plan.passes[GLSSAO_PASS_RESOLVE];
    struct glssao_planned_pass *blur = &plan.passes[GLSSAO_PASS_BLUR];
    if (!plan.passes[GLSSAO_PASS_ESTIMATE].run)
        return plan;
    *resolve = planned(GLSSAO_PASS_RESOLVE, true, "the mean of the estimates");
    plan.passes[GLSSAO_PASS_ESTIMATE].compute = false; /* it is added by blending */
    resolve->draw_calls = estimates > 1 ? 2 : 1;       /* a single one has no error to probe */
    const glssao__region region = glssao__plan_region(effect, frame, settings, &plan, GLSSAO_PASS_RESOLVE);
    resolve->width = region.width;
    resolve->height = region.height;
    if (blur->run && estimates >= TILE_ESTIMATES)
        *blur = planned(GLSSAO_PASS_BLUR, false, "as many estimates as the tile of noise has are smooth");
    return plan;
}
