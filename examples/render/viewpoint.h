/* SPDX-License-Identifier: MIT
 *
 * The camera of a picture: one of the file, or one that fits the scene, changed by options.
 */
#pragma once

#include "camera.h"
#include "fault.h"
#include "options.h"

typedef struct viewpoint {
    camera base;
    float pivot[3], axis[3];   /* line about which a turntable turns, world space */
    bool fitted;               /* depends on the picture's shape: neither the file's camera nor one from options */
    float clip_near, clip_far; /* the file's camera hides what is outside; 0: no limit */
    option_number near_plane, far_plane; /* from the command line */
} viewpoint;

/* Names for --view. */
#define VIEW_WORDS "front|right|back|left|top|bottom|iso"
/* Azimuth and elevation in degrees from "AZIMUTH,ELEVATION" or a name. False if it is neither. */
bool viewpoint_parse_view(const char *text, float out_deg[2]);

/* Chooses the camera. A view that is fitted to the scene uses the part of the picture to the right of `free_left`, a
 * share of its width. False, with one line in `why`, if the file has no camera of that number. */
bool viewpoint_choose(const options *o, const scene *s, float free_left, viewpoint *out, failure *why);

/* The field of view; for an orthographic view, the one that gives the same view with --ortho. */
float viewpoint_fov_deg(const viewpoint *v);

/* The view, turned by `angle_rad` about the axis. False, with one line in `why`, if it is degenerate. */
bool viewpoint_view(const viewpoint *v, const scene *s, float angle_rad, int width, int height, scene_view *out,
                    failure *why);
