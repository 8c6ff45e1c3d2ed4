#version 330
// SPDX-License-Identifier: MIT
//
// Layers behind the first: depth alone, of what lies behind the surfaces that the pre-pass left.
// Macros, 0 or 1: MASKED, and where it is 1 COLORED; BASE_MAPPED. LIT is 0.
// In:  uv and vertex colour for the alpha test.

uniform sampler2D u_first_depth_map; // the pre-pass's window depth
uniform float u_depth_offset;        // what lies no farther than this behind is dropped

#if MASKED
uniform vec4 u_base_color;
uniform float u_alpha_cutoff;
#if BASE_MAPPED
uniform sampler2D u_base_color_map;
uniform vec4 u_base_color_uv[3];
#endif
#if COLORED
in vec4 v_color;
#endif
#endif

void main()
{
    if (gl_FragCoord.z <= texelFetch(u_first_depth_map, ivec2(gl_FragCoord.xy), 0).r + u_depth_offset)
        discard;
#if MASKED
    float alpha = u_base_color.a;
#if BASE_MAPPED
    alpha *= texture(u_base_color_map, map_uv(u_base_color_uv)).a;
#endif
#if COLORED
    alpha *= v_color.a;
#endif
    if (alpha < u_alpha_cutoff)
        discard;
#endif
}
