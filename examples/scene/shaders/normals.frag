#version 330
// SPDX-License-Identifier: MIT
//
// Pre-pass: the normal map, and with it the depth map.
// Macros, 0 or 1: MASKED, and where it is 1 COLORED; TEXTURED (MASKED with a base colour map, or NORMAL_MAPPED);
// BASE_MAPPED; NORMAL_MAPPED; DOUBLE_SIDED; LIT, which the shadow pass sets to 0: it wants depth alone.
// In:  unit normal in view space, interpolated; uv and vertex colour for the alpha test.
// Out: unit normal in view space (signed, rgb), alpha 0.

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

#if LIT
layout(location = 0) out vec4 o_normal_view;
#endif

void main()
{
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

#if LIT
    o_normal_view = vec4(shading_normal(), 0.0);
#endif
}
