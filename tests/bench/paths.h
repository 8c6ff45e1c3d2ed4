/* SPDX-License-Identifier: MIT
 *
 * Recorded motions: how the camera, or a thing in the scene, moves from frame to frame.
 */
#pragma once

#include "camera.h"

typedef enum bench_path {
    PATH_STILL = 0, /* nothing moves */
    PATH_ORBIT,     /* a slow turn about the target */
    PATH_WALK,      /* forward, with the head bobbing */
    PATH_PAN,       /* a fast turn about the eye */
    PATH_DOLLY,     /* sideways */
    PATH_CUT,       /* still, then from another side at once, then still */
    PATH_BOX,       /* the camera stands still; a box slides along the floor, and then is gone */
    PATH_BEND,      /* the camera stands still; columns bend to and fro, as skins do */
    PATH_COUNT
} bench_path;

/* What happens at once does so at this frame. */
enum { PATH_EVENT = 12 };

const char *path_name(bench_path path);

/* The camera of a frame, from that of frame 0. */
camera path_camera(bench_path path, const camera *start, int frame);

/* Whether things move in the built-in scene "columns", and the camera does not. */
bool path_moves_things(bench_path path);
/* Puts them to where they are in that frame; frames come in order. False where there are none. */
bool path_move_things(bench_path path, scene *s, int frame);
