#version 330
// SPDX-License-Identifier: MIT
//
// The sky, a gradient that is linear in the height of the direction of sight.
// In:  direction of sight in world space, any length.
// Out: linear colour, alpha 1.

in vec3 v_direction_world;
uniform vec3 u_sky;      // at the horizon
uniform vec3 u_sky_tilt; // how much more straight above

layout(location = 0) out vec4 o_color;

void main()
{
    o_color = vec4(max(u_sky + u_sky_tilt * normalize(v_direction_world).y, 0.0), 1.0);
}
