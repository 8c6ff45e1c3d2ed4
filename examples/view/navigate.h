/* SPDX-License-Identifier: MIT
 *
 * Moving a camera by hand: around its target, across, towards it, and walking.
 */
#ifndef GLSSAO_EXAMPLES_NAVIGATE_H
#define GLSSAO_EXAMPLES_NAVIGATE_H

#include "camera.h"

/* `axis`: the direction that is up in the scene, unit, world space. */

/* Round the target by these angles: to the right about the axis, and upwards, short of straight above and below. */
void navigate_orbit(camera *c, const float axis[3], float right_rad, float up_rad);

/* Looks about from where it stands; the target moves. */
void navigate_look(camera *c, const float axis[3], float right_rad, float up_rad);

/* Eye and target together, in the picture's plane, by shares of its height at the target's distance. */
void navigate_pan(camera *c, float right, float up);

/* Towards the target: the distance is multiplied by `factor`. */
void navigate_zoom(camera *c, float factor);

/* Eye and target together by scene units: along the line of sight, to the right, and straight up. */
void navigate_walk(camera *c, const float axis[3], float ahead, float right, float up);

#endif
