#version 330
// SPDX-License-Identifier: MIT
//
// Main pass: the shaded picture. Accessibility scales ambient light alone; the directional light it leaves alone.
// Unlit materials (LIT 0) show their base colour as it is: no light reaches them, so no occlusion does either.
// Blended ones are lit but not occluded: the accessibility map belongs to the opaque surface behind them.
// Macros, 0 or 1: TEXTURED, COLORED, MASKED, LIT, DOUBLE_SIDED (where LIT), BLENDED.
// In:  unit normal in view space, interpolated; uv; vertex colour, linear.
// Out: linear colour, alpha (1 unless BLENDED); the framebuffer encodes sRGB.

uniform vec4 u_base_color;

#if TEXTURED
in vec2 v_uv;
uniform sampler2D u_base_color_map; // sRGB texture: sampled as linear
#endif
#if COLORED
in vec4 v_color;
#endif
#if MASKED
uniform float u_alpha_cutoff;
#endif

#if LIT
in vec3 v_normal_view;
uniform vec3 u_ambient;
uniform vec3 u_directional; // irradiance / pi
uniform vec3 u_to_light_view;
#if !BLENDED
uniform sampler2D u_ambient_map; // accessibility in red
uniform vec2 u_pixel_uv;         // one pixel of the target
#endif
#endif

layout(location = 0) out vec4 o_color;

void main()
{
    vec4 color = u_base_color;
#if TEXTURED
    color *= texture(u_base_color_map, v_uv);
#endif
#if COLORED
    color *= v_color;
#endif
#if MASKED
    // Depth EQUAL keeps most holes open by itself, but not those over a coplanar surface.
    if (color.a < u_alpha_cutoff)
        discard;
#endif

#if LIT
    float length_squared = dot(v_normal_view, v_normal_view);
    vec3 normal_view = length_squared > 0.0 ? v_normal_view * inversesqrt(length_squared) : vec3(0.0, 0.0, 1.0);
#if DOUBLE_SIDED
    if (!gl_FrontFacing)
        normal_view = -normal_view;
#endif
    vec3 ambient = u_ambient;
#if !BLENDED
    ambient *= texture(u_ambient_map, gl_FragCoord.xy * u_pixel_uv).r;
#endif
    color.rgb *= ambient + u_directional * max(dot(normal_view, u_to_light_view), 0.0);
#endif

#if !BLENDED
    color.a = 1.0;
#endif
    o_color = color;
}
