/* SPDX-License-Identifier: MIT
 *
 * Where a picture is taken from: the scene's own camera or one that frames it, with what the command line overrides.
 */
#ifndef GLSSAO_EXAMPLES_VIEWPOINT_H
#define GLSSAO_EXAMPLES_VIEWPOINT_H

#include "camera.h"
#include "fault.h"
#include "options.h"

typedef struct viewpoint {
    camera base;
    float half_height;                   /* of an orthographic view, scene units; 0: perspective */
    float clip_near, clip_far;           /* the file's camera shows nothing outside; 0: no bound */
    option_number near_plane, far_plane; /* from the command line */
} viewpoint;

/* False, with one line in `why`, where the scene has no such camera. */
bool viewpoint_choose(const options *o, const scene *s, viewpoint *out, fault *why);

/* The view turned by `angle_rad` about the vertical through the target. False, with one line, if it is degenerate. */
bool viewpoint_view(const viewpoint *v, const scene *s, float angle_rad, int width, int height, scene_view *out,
                    fault *why);

#endif
