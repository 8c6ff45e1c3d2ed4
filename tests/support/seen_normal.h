/* SPDX-License-Identifier: MIT
 *
 * Which side of a surface a normal belongs to, in double precision, for the models of the estimates. A normal that
 * looks away from the eye stays where the surface falls off by more than across the normal, in the direction it leans
 * in. It is that of the other side elsewhere, and wherever it looks away by more than 30 degrees.
 */
#pragma once

typedef enum seen_side { OWN_SIDE, OTHER_SIDE, EITHER_SIDE } seen_side; /* EITHER_SIDE: rounding decides */

/* From the point to the pixel that lies x, y beside it. */
typedef void (*step_beside)(const void *user, int x, int y, double out_step[3]);

/* normal, up: unit length; up is towards the eye. gain: view xy gained per uv, up to a factor. */
seen_side seen_side_of(const double normal[3], const double up[3], const double gain[2], step_beside step,
                       const void *user);
