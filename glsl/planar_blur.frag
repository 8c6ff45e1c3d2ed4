// SPDX-License-Identifier: MIT
// One direction of the planar blur, see planar_blur.glsl.
// WIDE 1: of a later round.
// in  u_ambient_map  paired map; point sampled, clamped
// out result         the same with PAIRED 1, else accessibility alone

uniform sampler2D u_ambient_map;
uniform bool gHorizontalBlur;
#define RESULT AMBIENT

RESULT result()
{
    vec2 way = gHorizontalBlur ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    vec2 step_uv = (WIDE == 1 ? 3.0 : 1.0) * way * gInvRenderTargetSize;
    vec2 uv = pixel_center() * gInvRenderTargetSize;
    vec2 center = textureLod(u_ambient_map, uv, 0.0).rg;
    vec2 before = textureLod(u_ambient_map, uv - step_uv, 0.0).rg;
    vec2 after = textureLod(u_ambient_map, uv + step_uv, 0.0).rg;
#if WIDE
    float accessibility = blurred_wide(before, center, after, way);
#else
    vec2 before_2 = textureLod(u_ambient_map, uv - 2.0 * step_uv, 0.0).rg;
    vec2 after_2 = textureLod(u_ambient_map, uv + 2.0 * step_uv, 0.0).rg;
    float accessibility = blurred(before_2, before, center, after, after_2, way);
#endif
    return ambient(accessibility, center.y, normal_code(center));
}
