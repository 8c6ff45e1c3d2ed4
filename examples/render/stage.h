/* SPDX-License-Identifier: MIT
 *
 * A scene ready to be drawn: in memory, in the context, and, once rays are traced, in Embree.
 */
#pragma once

#include "draw.h"
#include "fault.h"
#include "inputs.h"
#include "options.h"
#include "scene.h"
#include "trace.h"

typedef struct stage {
    const scene *scene;
    scene_renderer *renderer;
    scene_light *lights; /* of lighting */
    scene_lighting lighting;
    trace_scene *traced;       /* NULL: not yet */
    struct stage_build *build; /* of it, on another thread; NULL: none */
    const inputs *inputs;      /* files that the scene was read from; set by who loaded it */
} stage;

/* Loads the scene of the options and lists the files that it was read from. Warnings go to stderr. NULL, with one line
 * in `why`, on failure. Any thread. The caller frees the list in either case. */
scene *stage_load_scene(const options *o, inputs *out_inputs, failure *why);

/* Uploads the scene, which must outlive the stage. False, with one line in `why`, on failure. Call stage_close in
 * either case. */
bool stage_open(stage *st, const scene *s, failure *why);
/* The same, and frees what only the upload reads. Programs are shared with those of `like`, which may be NULL. Where
 * the options ask for rays, Embree's structure is built meanwhile. */
bool stage_open_spending(stage *st, scene *s, const stage *like, const options *o, failure *why);
void stage_close(stage *st);

/* The scene of the options' file at a time, without its warnings. NULL, with one line in `why`, on failure. */
scene *stage_load_pose(const options *o, double time_s, failure *why);
/* Follows the stage's renderer, whose scene is now `next`. False, with one line in `why`, if memory is short; the stage
 * is then only good to be closed. */
bool stage_pose(stage *st, const scene *next, failure *why);

/* Builds Embree's acceleration structure unless it exists, or waits until it is built. */
bool stage_trace(stage *st, failure *why);
