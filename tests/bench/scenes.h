/* SPDX-License-Identifier: MIT
 *
 * Which scenes are measured, from where, and with which radius.
 */
#pragma once

#include "camera.h"
#include "options.h"
#include "scene.h"

enum { BENCH_SCENES_MAX = 64 };

typedef struct bench_scene {
    char name[64];   /* of the view: the scene's, with -2 and so on from its second view */
    char path[1024]; /* "": built in, called `name` */
    bool given;      /* `camera` is set; otherwise the scene's first camera, or one that frames it */
    camera camera;   /* planes not set */
    float radius;    /* scene units; 0: suggested from the scene's size */
    bool judging;    /* never tuned on: glssao-tune refuses it */
} bench_scene;

/* Fills `out` and returns how many there are. A scene whose file is missing is left out and named on stderr. */
int bench_scenes_list(const options *o, bench_scene out[BENCH_SCENES_MAX]);

/* The camera that looks at it, with fitted planes; `aspect` is width / height. */
camera bench_scene_camera(const bench_scene *b, const scene *s, float aspect);

/* Loads it and gives the view at that size. NULL, with one line in `error`, on failure. */
scene *bench_scene_open(const bench_scene *b, int width, int height, scene_view *out_view, float *out_radius,
                        failure *fault);
