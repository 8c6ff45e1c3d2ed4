/* SPDX-License-Identifier: MIT
 *
 * A file's animation, picture by picture. Each picture reads the file again, at its time; buffers, textures and
 * programs in the context stay where only places changed.
 */
#pragma once

#include "stage.h"

typedef struct animation { /* all 0: before the first step */
    stage stage;
    scene *scene;
} animation;

/* Makes a->stage show the options' scene at --time and `frame` pictures later. Programs are shared with `like`.
 * `out_is_known`: the renderer can tell where each point was in the step before. False, with one line in `why`, on
 * failure. Call animation_close in either case. */
bool animation_step(animation *a, const options *o, int frame, const stage *like, bool *out_is_known, failure *why);
void animation_close(animation *a);
