/* SPDX-License-Identifier: MIT
 *
 * Cameras for the examples: one that frames the scene, one given by hand, and the matrices they stand for.
 */
#ifndef GLSSAO_EXAMPLES_CAMERA_H
#define GLSSAO_EXAMPLES_CAMERA_H

#include "draw.h"
#include "scene.h"

typedef struct camera {
    float eye[3], target[3], up[3]; /* world space */
    float fov_y_rad;                /* vertical field of view */
    float near_plane, far_plane;    /* view distance, scene units */
} camera;

/* A camera that sees the whole scene from a little above and to the right of its front, with a margin of 5%:
 * 45 degrees, planes that hug the bounds, target on the vertical through the bounds' centre. `aspect` is width /
 * height. An empty scene gets a camera at (0, 0, 1). */
camera camera_frame_scene(const scene *s, float aspect);

/* Sets near and far so that the scene's bounds lie between them, as far as they are in front of the camera, and near
 * is at least far / 20000. Where everything is behind it, any valid planes. */
void camera_fit_planes(camera *c, const scene *s);

/* Turned by `angle_rad` about the vertical (y) through the target, counter-clockwise seen from above. */
camera camera_turned(const camera *c, float angle_rad);

/* False, with one line in `error`, where it is degenerate: eye on target, up along the view, planes or angle out
 * of range, not finite. */
bool camera_check(const camera *c, char *error, size_t error_size);

scene_view camera_view(const camera *c, int width, int height);

/* The occlusion radius suggested for a scene: 1/20 of its bounds' diagonal, 0.5 for an empty one. */
float camera_suggest_radius(const scene *s);

/* The same view with more of the scene on each side. */
scene_view camera_widened_view(const scene_view *view, int margin);

#endif
