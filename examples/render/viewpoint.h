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
    float pivot[3], axis[3];             /* of a turntable, world space */
    bool fitted;                         /* to the picture's shape: neither the file's camera nor one given by hand */
    float clip_near, clip_far;           /* the file's camera shows nothing outside; 0: no bound */
    option_number near_plane, far_plane; /* from the command line */
} viewpoint;

/* Names for --view. */
#define VIEW_WORDS "front|right|back|left|top|bottom|iso"
/* Azimuth and elevation in degrees from "AZIMUTH,ELEVATION" or a name. False where it is neither. */
bool viewpoint_parse_view(const char *text, float out_deg[2]);

/* Where the view is fitted to the scene, the scene stays in the part of the picture from `free_left`, a share of its
 * width, to the right. False, with one line in `why`, where the scene has no camera of that number. */
bool viewpoint_choose(const options *o, const scene *s, float free_left, viewpoint *out, fault *why);

/* The field of view; of an orthographic view, the one with which --ortho gives the same view. */
float viewpoint_fov_deg(const viewpoint *v);

/* The view turned by `angle_rad` about the axis. False, with one line, if it is degenerate. */
bool viewpoint_view(const viewpoint *v, const scene *s, float angle_rad, int width, int height, scene_view *out,
                    fault *why);

#endif
