#version 330
// SPDX-License-Identifier: MIT
// The shader of docs/integration.md that scales ambient light alone; glslangValidator compiles it.
uniform vec3 u_ambient_light, u_albedo, u_direct_light;
out vec4 o_color;
// snippet: shader
uniform sampler2D u_ambient_map; // GLSSAO_MAP_AMBIENT: full size after upsampling, else half size
uniform vec2 u_inv_size;         // one over the full size in pixels

float accessibility()
{
    return texture(u_ambient_map, gl_FragCoord.xy * u_inv_size).r;
}
// end

void main()
{
    o_color = vec4(u_albedo * (u_ambient_light * accessibility() + u_direct_light), 1.0);
}
