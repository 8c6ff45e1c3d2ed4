#version 330
// SPDX-License-Identifier: MIT
//
// The sky: a gradient that is linear in the height of the direction of sight, or (ENVIRONMENT 1) a picture.
// In:  direction of sight in the sky's axes, where +y is up, any length.
// Out: linear colour, alpha 1.

in vec3 v_direction_sky;
#if ENVIRONMENT
uniform sampler2D u_environment_map; // mip levels are read by the size of a pixel
#else
uniform vec3 u_sky;      // at the horizon
uniform vec3 u_sky_tilt; // how much more straight above
#endif

layout(location = 0) out vec4 o_color;

void main()
{
    vec3 direction_sky = normalize(v_direction_sky);
#if ENVIRONMENT
    // By the angle, since uv jumps where the picture's ends meet.
    float pixel_rad = max(length(dFdx(direction_sky)), length(dFdy(direction_sky)));
    float texels = pixel_rad * float(textureSize(u_environment_map, 0).x) * 0.15915494;
    vec3 color = textureLod(u_environment_map, environment_uv(direction_sky), log2(max(texels, 1.0))).rgb;
#else
    vec3 color = u_sky + u_sky_tilt * direction_sky.y;
#endif
    o_color = vec4(max(color, 0.0), 1.0);
}
