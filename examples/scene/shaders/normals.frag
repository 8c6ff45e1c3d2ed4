#version 330
// SPDX-License-Identifier: MIT
//
// Pre-pass: writes normals, and with them depth.
// Macros, 0 or 1: MASKED, and where it is 1 COLORED; TEXTURED (MASKED with a base colour map, or NORMAL_MAPPED);
// BASE_MAPPED; NORMAL_MAPPED; DOUBLE_SIDED; LIT, which the shadow pass and the layers set to 0: they want depth alone;
// BEHIND: a layer, of what lies behind the surfaces that the pre-pass left; MOVES: the motion pass.
// In:  unit normal in view space, interpolated; uv and vertex colour for the alpha test.
// Out: unit normal in view space (signed, rgb), alpha 0; or uv now minus uv in the last frame.

#if MASKED
uniform vec4 u_base_color;
uniform float u_alpha_cutoff;
#if BASE_MAPPED
uniform sampler2D u_base_color_map;
uniform vec4 u_base_color_uv[UV_ROWS];
#endif
#if COLORED
in vec4 v_color;
#endif
#endif

#if BEHIND
uniform sampler2D u_first_depth_map; // the pre-pass's window depth
uniform float u_depth_offset;        // fragments no farther than this behind it are discarded
#endif

#if LIT
layout(location = 0) out vec4 o_normal_view;
#endif

#if MOVES
in vec3 v_clip, v_last_clip;
layout(location = 0) out vec2 o_motion;
const vec2 NOWHERE = vec2(1e4); // behind the last frame's eye
#endif

void main()
{
#if LIT
    vec3 normal_view = shading_normal(); // before any discard, since it may take derivatives
#endif
#if BEHIND
    if (gl_FragCoord.z <= texelFetch(u_first_depth_map, ivec2(gl_FragCoord.xy), 0).r + u_depth_offset)
        discard;
#endif

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
    o_normal_view = vec4(normal_view, 0.0);
#endif
#if MOVES
    o_motion = v_last_clip.z > 0.0 ? 0.5 * (v_clip.xy / v_clip.z - v_last_clip.xy / v_last_clip.z) : NOWHERE;
#endif
}
