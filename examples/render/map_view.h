/* SPDX-License-Identifier: MIT
 *
 * Shows a map of a frame in a rectangle of a framebuffer: for --debug-map, and for the maps of the viewer.
 */
#pragma once

#include "options.h"
#include "pipeline.h"

/* The rectangle for --debug-map: a quarter of the width and height, in the lower right. For the shadow map, a square.
 */
scene_rectangle map_view_inset(const pipeline *p, options_map map);

/* Draws a map of the last frame, or nothing if the frame has no such map. Accessibility and the shadow map are grey,
 * normals n * 0.5 + 0.5, view distance grey from 0 to the far plane, random vectors as stored. Leaves `framebuffer`
 * bound. */
void map_view_draw(pipeline *p, const scene_view *view, options_map map, scene_rectangle place, GLuint framebuffer);

/* Frees the pipeline members that map_view.c owns. */
void map_view_free(pipeline *p);
