/* SPDX-License-Identifier: MIT
 *
 * Shows one of a frame's maps in a rectangle of a framebuffer: the debug quad, and the viewer's maps.
 */
#ifndef GLSSAO_EXAMPLES_MAP_VIEW_H
#define GLSSAO_EXAMPLES_MAP_VIEW_H

#include "options.h"
#include "pipeline.h"

/* The lower right quarter of the picture's width and height, where the D3D12 demo shows its map; a square for the
 * shadow map. */
scene_rectangle map_view_inset(const pipeline *p, options_map map);

/* Draws the map of the frame last drawn, and nothing where there is none. Accessibility and the shadow map in grey,
 * normals as n * 0.5 + 0.5, view distance in grey from 0 to the far plane, random vectors as stored. Leaves
 * `framebuffer` bound. */
void map_view_draw(pipeline *p, const scene_view *view, options_map map, scene_rectangle place, GLuint framebuffer);

/* Frees what it made in the pipeline. */
void map_view_free(pipeline *p);

#endif
