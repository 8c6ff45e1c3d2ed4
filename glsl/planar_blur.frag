// SPDX-License-Identifier: MIT
// One direction of the box over one period of a 4x4 tile, 1/2 1 1 1 1/2, along surfaces: a tap counts where it lies on a
// line with two neighbours in the same direction, or with the two about the pixel. A silhouette breaks both lines; a plane
// seen at any angle breaks neither.
// in  u_ambient_map  accessibility, and the linear quantity of distance; point sampled, clamped
// out o_ambient      the same

uniform sampler2D u_ambient_map;
uniform bool gHorizontalBlur;
out vec2 o_ambient;

// How far off a line may be, in units of the radius; found by experiment.
const float TOLERANCE = 0.02;

void main()
{
    vec2 step_uv = gHorizontalBlur ? vec2(gInvRenderTargetSize.x, 0.0) : vec2(0.0, gInvRenderTargetSize.y);
    vec2 uv = pixel_center() * gInvRenderTargetSize;
    vec2 center = textureLod(u_ambient_map, uv, 0.0).rg;
    vec2 before = textureLod(u_ambient_map, uv - step_uv, 0.0).rg;
    vec2 after = textureLod(u_ambient_map, uv + step_uv, 0.0).rg;
    vec2 before_2 = textureLod(u_ambient_map, uv - 2.0 * step_uv, 0.0).rg;
    vec2 after_2 = textureLod(u_ambient_map, uv + 2.0 * step_uv, 0.0).rg;
    float tolerance = linear_error(TOLERANCE * gOcclusionRadius, center.y);
    bool on_line = abs(before.y - 2.0 * center.y + after.y) < tolerance;
    bool on_before = abs(before_2.y - 2.0 * before.y + center.y) < tolerance;
    bool on_after = abs(after_2.y - 2.0 * after.y + center.y) < tolerance;
    vec4 weights = vec4(on_before ? 0.5 : 0.0, on_before || on_line ? 1.0 : 0.0, on_after || on_line ? 1.0 : 0.0,
                        on_after ? 0.5 : 0.0);
    vec4 taps = vec4(before_2.x, before.x, after.x, after_2.x);
    o_ambient = vec2((center.x + dot(weights, taps)) / (1.0 + dot(weights, vec4(1.0))), center.y);
}
