/* SPDX-License-Identifier: MIT
 *
 * Moves a camera by hand.
 */
#pragma once

#include "camera.h"

/* `axis` is the direction that is up in the scene, a unit vector in world space. */

/* Moves the eye round the target: to the right about the axis, and upwards, but never quite straight above or below. */
void navigate_orbit(camera *c, const float axis[3], float right_rad, float up_rad);

/* Turns the camera where it stands; the target moves. */
void navigate_look(camera *c, const float axis[3], float right_rad, float up_rad);

/* Moves eye and target across the picture, by shares of its height at the target's distance. */
void navigate_pan(camera *c, float right, float up);

/* Multiplies the distance to the target by `factor`. */
void navigate_zoom(camera *c, float factor);

/* Moves eye and target by scene units: along the line of sight, to the right, and along the axis. */
void navigate_walk(camera *c, const float axis[3], float ahead, float right, float up);
