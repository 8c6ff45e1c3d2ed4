/* SPDX-License-Identifier: MIT
 *
 * Cameras for the examples: one that fits the scene, one given by hand, and their matrices.
 */
#pragma once

#include "draw.h"
#include "scene.h"

typedef struct camera {
    float eye[3], target[3], up[3]; /* world space */
    float fov_y_rad;                /* vertical field of view, perspective */
    float half_height;              /* half the height that an orthographic camera sees, scene units; 0: perspective */
    float near_plane, far_plane;    /* view distance, scene units */
} camera;

/* A direction to see a scene from, and the part of the picture that it may fill. */
typedef struct camera_framing {
    float azimuth_rad;   /* about `up`: 0 is the front (+z where +y is up), positive goes to the right side */
    float elevation_rad; /* -pi/2 (from below) to pi/2 (from above) */
    float up[3];         /* world space, any length but 0 */
    float fov_y_rad;
    float aspect;                /* width / height of the picture */
    float free_left, free_right; /* the scene stays between these shares of the width */
    bool orthographic;
    bool turns; /* the scene stays in the picture while the camera goes round it about `up` */
} camera_framing;

/* From a little above and to the right of the front, 45 degrees, +y up, the whole picture. */
camera_framing camera_default_framing(float aspect);

/* The shortest turn that takes +y to `up` (any length but 0): what +x, +y and +z become. +x is then the right side of
 * the scene and +z its front. */
void camera_find_turn(const float up[3], double out[3][3]);

/* A camera that sees all vertices with equal margins left and right, and equal margins top and bottom. The narrower
 * pair is 2.5 % of the picture's width or height. The target is as far away as the middle of the scene's bounds; the
 * planes fit the bounds. An empty scene is seen from distance 1. */
camera camera_frame(const scene *s, const camera_framing *how);

/* The same with the default framing. */
camera camera_frame_scene(const scene *s, float aspect);

/* Sets near and far so that the part of the bounds in front of the camera lies between them. Near is at least far /
 * 20000. If everything is behind the camera, the planes are valid but arbitrary. */
void camera_fit_planes(camera *c, const scene *s);

/* Turns the camera by `angle_rad` about a line, counter-clockwise if `axis` points to the viewer. */
camera camera_turned(const camera *c, const float pivot[3], const float axis[3], float angle_rad);

/* False, with one line in `error`, if the camera is degenerate: eye on target, up along the line of sight, planes or
 * angle out of range, or values that are not finite. */
bool camera_check(const camera *c, failure *fault);

scene_view camera_view(const camera *c, int width, int height);

/* The suggested occlusion radius of a scene: 1/20 of the diagonal of its bounds, 0.5 for an empty scene. */
float camera_suggest_radius(const scene *s);

/* The same view with `margin` more pixels on each side. */
scene_view camera_widened_view(const scene_view *view, int margin);
