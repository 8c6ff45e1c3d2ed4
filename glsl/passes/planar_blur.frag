// SPDX-License-Identifier: MIT
// One pass of the planar blur (shared/planar_blur.glsl): a direction of the first round, or with WIDE 1 a later round.
// STRIDE: the neighbours of the first round lie 2 to that power of pixels apart.
// CORRECTS 2: the last pass of the blur of a difference (rays.frag) adds it to the estimate, a control variate. Compare E. Heitz,
// S. Hill, M. McGuire, "Combining analytic direct illumination and stochastic shadows" (2018), who blur a ratio.
// in  u_ambient_map  paired values; point sampled, clamped
// in  u_rays_map     CORRECTS 2: paired values of the estimate; point sampled
// out result         by OUTPUT: accessibility or the paired value

uniform sampler2D u_ambient_map;
#if CORRECTS == 2
uniform sampler2D u_rays_map;
const float MOST_GROWTH = 1.5; // of the hidden vector: where little was hidden, its direction is noise
#endif
#if !WIDE
#if !FLAT
uniform int gHorizontalBlur; // 0 or 1
#endif
#endif
#define RESULT AMBIENT

#if CORRECTS == 2
// The estimate's contents with other accessibility. Rays say how much is hidden and not where: that grows as occlusion does, as
// far as its direction is known.
CONTENTS corrected(CONTENTS estimate, float before, float after)
{
#if BENT
    return vec4(after, min((1.0 - after) / max(1.0 - before, 1e-3), MOST_GROWTH) * estimate.yzw);
#else
    return after;
#endif
}
#endif

PAIRED paired_at(vec2 uv)
{
    return PAIRED(textureLod(u_ambient_map, uv, 0.0));
}

RESULT result()
{
    vec2 uv = pixel_uv();
    PAIRED center = paired_at(uv);
#if WIDE
    vec2 x = vec2(3.0 * gInvRenderTargetSize.x, 0.0);
    vec2 y = vec2(0.0, 3.0 * gInvRenderTargetSize.y);
    float mean = blurred_wide(paired_at(uv - x).xy, paired_at(uv - y).xy, center.xy, paired_at(uv + y).xy,
                              paired_at(uv + x).xy);
    CONTENTS contents = with_accessibility(center, mean);
#else
    vec2 way = gHorizontalBlur != 0 ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    vec2 by = float(1 << STRIDE) * way * gInvRenderTargetSize;
    CONTENTS contents = blurred(paired_at(uv - 2.0 * by), paired_at(uv - by), center, paired_at(uv + by),
                                paired_at(uv + 2.0 * by), way);
#endif
#if CORRECTS == 2
    float blurred = accessibility_in(contents);
    float difference = blurred < 0.0 ? 0.0 : 2.0 * blurred - 1.0;
    CONTENTS estimate = contents_of(PAIRED(textureLod(u_rays_map, uv, 0.0)));
    float before = pow(max(accessibility_in(estimate), 1e-6), 1.0 / gPower);
    contents = corrected(estimate, before, clamp(before + difference, 0.0, 1.0));
#endif
    return ambient(contents, center.y, normal_code(center));
}
