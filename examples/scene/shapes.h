/* SPDX-License-Identifier: MIT
 *
 * Simple solids for the built-in scenes: each adds vertices and indices to the scene under construction, front faces
 * counter-clockwise, normals outwards. The caller makes primitives of them.
 */
#pragma once

#include "scene_builder.h"

/* A parallelogram from `corner` along `u` and `v`, cut into u_cells by v_cells quads; it faces the way of u x v. */
bool shape_grid(scene_builder *b, const float corner[3], const float u[3], const float v[3], uint32_t u_cells,
                uint32_t v_cells);

/* A cube of side 1 about the origin. */
bool shape_box(scene_builder *b);

/* Standing on y = 0, with caps. */
bool shape_cylinder(scene_builder *b, float bottom_radius, float top_radius, float height, uint32_t slices,
                    uint32_t stacks);

/* About the origin. */
bool shape_sphere(scene_builder *b, float radius, uint32_t slices, uint32_t stacks);
