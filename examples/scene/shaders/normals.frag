#version 330
// SPDX-License-Identifier: MIT
//
// Pre-pass: the normal map, and with it the depth map.
// Macros, 0 or 1: MASKED, and where it is 1 TEXTURED and COLORED; DOUBLE_SIDED. LIT is 1, BLENDED 0.
// In:  unit normal in view space, interpolated; uv and vertex colour for the alpha test.
// Out: unit normal in view space (signed, rgb), alpha 0.

in vec3 v_normal_view;

#if MASKED
uniform vec4 u_base_color;
uniform float u_alpha_cutoff;
#if TEXTURED
in vec2 v_uv;
uniform sampler2D u_base_color_map;
#endif
#if COLORED
in vec4 v_color;
#endif
#endif

layout(location = 0) out vec4 o_normal_view;

void main()
{
#if MASKED
    float alpha = u_base_color.a;
#if TEXTURED
    alpha *= texture(u_base_color_map, v_uv).a;
#endif
#if COLORED
    alpha *= v_color.a;
#endif
    if (alpha < u_alpha_cutoff)
        discard;
#endif

    // A normal that vanishes (opposite ones interpolated, an instance scaled flat) becomes one that faces the viewer.
    float length_squared = dot(v_normal_view, v_normal_view);
    vec3 normal_view = length_squared > 0.0 ? v_normal_view * inversesqrt(length_squared) : vec3(0.0, 0.0, 1.0);
#if DOUBLE_SIDED
    if (!gl_FrontFacing)
        normal_view = -normal_view;
#endif
    o_normal_view = vec4(normal_view, 0.0);
}
