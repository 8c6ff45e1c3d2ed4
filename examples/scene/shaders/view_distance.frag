#version 330
// SPDX-License-Identifier: MIT
//
// View distance from window depth. Both are tied by a quotient of two expressions that are linear in depth d:
// for a perspective projection the numerator is constant, for an orthographic one the denominator. Each comes as
// its values at d = 0 and d = 1, because a far plane makes the usual (a - b d) cancel.
// In:  u_depth_map, window depth, size of the target.
// Out: view distance times u_scale in rgb; 0 at the far value of depth, where nothing was drawn.

uniform sampler2D u_depth_map;
uniform vec2 u_numerator;   // at d = 0, d = 1
uniform vec2 u_denominator; // at d = 0, d = 1
uniform float u_far_depth;  // 1, or 0 where depth is reversed
uniform float u_scale;      // 1: scene units

layout(location = 0) out vec4 o_view_distance;

void main()
{
    float depth = texelFetch(u_depth_map, ivec2(gl_FragCoord.xy), 0).r;
    float distance_view = 0.0;
    if (depth != u_far_depth) {
        vec2 weight = vec2(1.0 - depth, depth);
        distance_view = dot(u_numerator, weight) / dot(u_denominator, weight);
    }
    o_view_distance = vec4(vec3(distance_view * u_scale), 1.0);
}
