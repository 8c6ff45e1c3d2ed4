/* SPDX-License-Identifier: MIT */
#include "animation.h"

/* A renderer of its own, where the scene has other triangles than in the step before. */
static bool open_again(animation *a, scene *next, const options *o, const stage *like, failure *why)
{
    stage made;
    if (!stage_open_spending(&made, next, a->scene ? &a->stage : like, o, why)) {
        stage_close(&made);
        return false;
    }
    stage_close(&a->stage);
    a->stage = made;
    return true;
}

bool animation_step(animation *a, const options *o, int frame, const stage *like, bool *out_is_known, failure *why)
{
    scene *next = stage_load_pose(o, (double)o->time_s.value + frame / (double)o->fps.value, why);
    if (!next)
        return false;
    *out_is_known = a->scene && scene_renderer_pose(a->stage.renderer, next);
    const bool done = *out_is_known ? stage_pose(&a->stage, next, why) : open_again(a, next, o, like, why);
    if (!done && !*out_is_known) {
        scene_destroy(next);
        return false;
    }
    scene_destroy(a->scene);
    a->scene = next;
    a->stage.inputs = like->inputs;
    return done;
}

void animation_close(animation *a)
{
    stage_close(&a->stage);
    scene_destroy(a->scene);
    *a = (animation){.scene = NULL};
}
