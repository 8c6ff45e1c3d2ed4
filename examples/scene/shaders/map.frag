#version 330
// SPDX-License-Identifier: MIT
//
// Shows a map in a rectangle of the target: out = scale * texel + bias.
// In:  u_map, any size and format.
// Out: rgb, and alpha 1; with u_red_only the red channel in all three.

uniform sampler2D u_map;
uniform vec2 u_origin;   // lower left of the rectangle, pixels of the target
uniform vec2 u_pixel_uv; // one pixel of the rectangle
uniform float u_scale;
uniform float u_bias;
uniform bool u_red_only;

layout(location = 0) out vec4 o_color;

void main()
{
    vec3 texel = texture(u_map, (gl_FragCoord.xy - u_origin) * u_pixel_uv).rgb;
    if (u_red_only)
        texel = texel.rrr;
    o_color = vec4(u_scale * texel + u_bias, 1.0);
}
