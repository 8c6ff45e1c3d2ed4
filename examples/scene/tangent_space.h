/* SPDX-License-Identifier: MIT
 *
 * Tangents for normal maps by the rules of MikkTSpace (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited"),
 * which glTF prescribes where a file has none, so that maps baked elsewhere shade as they were meant to.
 */
#pragma once

#include "scene.h"

/* For each corner of the triangles, indices[0 .. index_count), the unit tangent in mesh space and the sign that makes
 * cross(normal, tangent) * sign the bitangent, by uv set `uv` of the vertices. Where the uvs say nothing, some unit
 * vector at right angles to the normal. False where memory is short. */
bool tangent_space_make(const scene_vertex *vertices, int uv, const uint32_t *indices, uint32_t index_count,
                        float (*out)[4]);
