// SPDX-License-Identifier: MIT
// One direction of the separable blur. FILTER: 11 taps with the Gaussian weights of cbSsao, or the 4 taps that cover one
// period of a 4x4 tile. A bilateral tap counts only where its normal and view distance agree with the centre's, and the
// weights that are left are scaled to sum to 1.
// in  u_ambient_map  accessibility, or by OUTPUT the paired value; point sampled
// in  u_normal_map, u_depth_map  as for the estimate, fetched (bilateral)
// out result         the same

uniform sampler2D u_ambient_map;
#if !FLAT
uniform int gHorizontalBlur; // 0 or 1
#endif
#define RESULT AMBIENT

#if FILTER == FILTER_BILATERAL
// Set by result(). The values spare a warning of Mesa's.
ivec2 last = ivec2(0);
vec3 center_normal = vec3(0.0);
float center_distance = 0.0;
#endif

// Adds the tap `i` pixels from the centre.
void add_tap(int i, float weight, vec2 step_uv, inout CONTENTS sum, inout float weights)
{
    vec2 uv = pixel_uv() + float(i) * step_uv;
#if FILTER == FILTER_BILATERAL
    ivec2 tap = texel_from_uv(uv);
    ivec2 inside = clamp(tap, ivec2(0), last);
    float cosine = dot(normal_view_from_map(inside), center_normal);
    float distance = distance_from_depth(fetched_depth(inside));
    // The centre always counts, so the sum of weights is never 0, whatever the maps hold.
    bool keep = i == 0 || (inside == tap && cosine >= gBlurNormalThreshold &&
                           abs(distance - center_distance) <= gBlurDepthThreshold);
    weight = keep ? weight : 0.0;
#endif
#if OUTPUT == OUTPUT_PAIRED || BENT
    sum += weight * contents_of(PAIRED(texture(u_ambient_map, uv)));
#else
    sum += weight * texture(u_ambient_map, uv).r;
#endif
    weights += weight;
}

RESULT result()
{
    vec2 step_uv = gHorizontalBlur != 0 ? vec2(gInvRenderTargetSize.x, 0.0) : vec2(0.0, gInvRenderTargetSize.y);
#if FILTER == FILTER_BILATERAL
    last = textureSize(u_depth_map, 0) - 1;
    ivec2 center = texel_from_uv(pixel_uv());
    center_normal = normal_view_from_map(center);
    center_distance = distance_from_depth(fetched_depth(center));
#endif
    CONTENTS sum = CONTENTS(0.0);
    float weights = 0.0;
#if FILTER == FILTER_BOX
    UNROLL for (int i = -2; i <= 1; ++i) {
        add_tap(i, 0.25, step_uv, sum, weights);
    }
#else
    UNROLL for (int i = -5; i <= 5; ++i) {
        add_tap(i, gBlurWeights[(i + 5) / 4][(i + 5) % 4], step_uv, sum, weights);
    }
#endif
    PAIRED own = PAIRED(texture(u_ambient_map, pixel_uv()));
    return ambient(sum / weights, own.g, normal_code(own));
}
