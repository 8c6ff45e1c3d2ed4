// SPDX-License-Identifier: MIT
// One direction of the box over one period of a 4x4 tile, 1/2 1 1 1 1/2, along surfaces: a tap counts where it lies on a
// line with two neighbours in the same direction, or with the two about the pixel, and where the surface does not turn
// away from the eye in between. A silhouette breaks both lines; a plane seen at any angle breaks neither. A pixel left
// without a tap takes neighbours that are merely near.
// in  u_ambient_map  accessibility, the linear quantity of distance, projected normal; point sampled, clamped
// out o_ambient      the same

uniform sampler2D u_ambient_map;
uniform bool gHorizontalBlur;
out vec4 o_ambient;

// All found by experiment. How far off a line may be, in units of the radius.
const float TOLERANCE = 0.02;
// How far off a neighbour of a pixel without others may be, in units of the radius.
const float NEAR = 0.1;

void main()
{
    vec2 way = gHorizontalBlur ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    vec2 step_uv = way * gInvRenderTargetSize;
    vec2 uv = pixel_center() * gInvRenderTargetSize;
    vec4 center = textureLod(u_ambient_map, uv, 0.0);
    vec4 before = textureLod(u_ambient_map, uv - step_uv, 0.0);
    vec4 after = textureLod(u_ambient_map, uv + step_uv, 0.0);
    vec4 before_2 = textureLod(u_ambient_map, uv - 2.0 * step_uv, 0.0);
    vec4 after_2 = textureLod(u_ambient_map, uv + 2.0 * step_uv, 0.0);
    float tolerance = linear_error(TOLERANCE * gOcclusionRadius, center.y);
    float near = linear_error(NEAR * gOcclusionRadius, center.y);
    bool on_line = abs(before.y - 2.0 * center.y + after.y) < tolerance;
    bool on_before = abs(before_2.y - 2.0 * before.y + center.y) < tolerance;
    bool on_after = abs(after_2.y - 2.0 * after.y + center.y) < tolerance;
    bool joins_before = !turns_away(before.zw - center.zw, -way);
    bool joins_after = !turns_away(after.zw - center.zw, way);
    vec4 weights = vec4(on_before && !turns_away(before_2.zw - center.zw, -way) ? 0.5 : 0.0,
                        joins_before && (on_before || on_line) ? 1.0 : 0.0,
                        joins_after && (on_after || on_line) ? 1.0 : 0.0,
                        on_after && !turns_away(after_2.zw - center.zw, way) ? 0.5 : 0.0);
    if (weights.y + weights.z == 0.0)
        weights.yz = vec2(joins_before && abs(before.y - center.y) < near ? 1.0 : 0.0,
                          joins_after && abs(after.y - center.y) < near ? 1.0 : 0.0);
    vec4 taps = vec4(before_2.x, before.x, after.x, after_2.x);
    o_ambient = vec4((center.x + dot(weights, taps)) / (1.0 + dot(weights, vec4(1.0))), center.yzw);
}
