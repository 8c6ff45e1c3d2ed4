#version 330
// SPDX-License-Identifier: MIT
//
// Surfaces in one texture, for a tracer that starts rays from them: normal and view distance (view_distance.frag) of
// every pixel, or of one of each 2 x 2.
// In:  u_depth_map, window depth; u_normal_map, view space; both fetched.
// Out: xyz: normal as stored, w: view distance, 0 where nothing was drawn.

uniform sampler2D u_depth_map;
uniform sampler2D u_normal_map;
uniform vec2 u_numerator;   // at d = 0, d = 1
uniform vec2 u_denominator; // at d = 0, d = 1
uniform float u_far_depth;  // 1, or 0 where depth is reversed
uniform float u_scale;      // pixels of the maps to one of the target: 1 or 2
uniform vec2 u_offset;      // which of them: 0 or 1

layout(location = 0) out vec4 o_surface;

void main()
{
    ivec2 texel = min(ivec2(gl_FragCoord.xy) * int(u_scale) + ivec2(u_offset), textureSize(u_depth_map, 0) - 1);
    float depth = texelFetch(u_depth_map, texel, 0).r;
    float distance_view = 0.0;
    if (depth != u_far_depth) {
        vec2 weight = vec2(1.0 - depth, depth);
        distance_view = dot(u_numerator, weight) / dot(u_denominator, weight);
    }
    o_surface = vec4(texelFetch(u_normal_map, texel, 0).xyz, distance_view);
}
