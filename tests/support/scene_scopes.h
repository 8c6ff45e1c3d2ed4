/* SPDX-License-Identifier: MIT
 *
 * SCOPED(scene) and SCOPED(renderer).
 */
#pragma once

#include "draw.h"
#include "testing.h"

SCOPED_BY(scene, scene, scene_destroy)
SCOPED_BY(renderer, scene_renderer, scene_renderer_destroy)
