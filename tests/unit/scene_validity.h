/* SPDX-License-Identifier: MIT
 *
 * The invariants of every scene.
 */
#pragma once

#include "scene.h"

/* NULL if all invariants hold, otherwise the one that fails: indices within the vertices, references within their
 * arrays, finite numbers, unit normals, instances sorted by mesh, bounds that contain everything drawn. */
const char *scene_find_flaw(const scene *s);
