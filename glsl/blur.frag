// SPDX-License-Identifier: MIT
// One direction of the separable blur: 11 taps of cbSsao's weights, or with BOX 1 the 4 taps that cover one period of
// a 4x4 tile. With EDGE_AWARE 1, a tap counts only where its normal and view distance agree with the centre's, and the
// weights that are left are scaled to sum to 1.
// in  u_ambient_map  accessibility, with PAIRED 1 the paired map; point sampled
// in  u_normal_map, u_depth_map  as for the estimate, fetched (EDGE_AWARE 1)
// out result         the same

uniform sampler2D u_ambient_map;
uniform bool gHorizontalBlur;
#define RESULT AMBIENT

#if EDGE_AWARE
ivec2 last;
vec3 center_normal;
float center_distance;
#endif

// Adds the tap `i` pixels from the centre.
void add_tap(int i, float weight, vec2 step_uv, inout float sum, inout float weights)
{
    vec2 uv = pixel_uv() + float(i) * step_uv;
#if EDGE_AWARE
    ivec2 tap = texel_from_uv(uv);
    ivec2 inside = clamp(tap, ivec2(0), last);
    float cosine = dot(normal_view_from_map(inside), center_normal);
    float distance = distance_from_depth(fetched_depth(inside));
    // The centre always counts, so the sum of weights is never 0, whatever the maps hold.
    bool keep = i == 0 || (inside == tap && cosine >= gBlurNormalThreshold &&
                           abs(distance - center_distance) <= gBlurDepthThreshold);
    weight = keep ? weight : 0.0;
#endif
#if PAIRED
    sum += weight * accessibility_of(texture(u_ambient_map, uv).rg);
#else
    sum += weight * texture(u_ambient_map, uv).r;
#endif
    weights += weight;
}

RESULT result()
{
    vec2 step_uv = gHorizontalBlur ? vec2(gInvRenderTargetSize.x, 0.0) : vec2(0.0, gInvRenderTargetSize.y);
#if EDGE_AWARE
    last = textureSize(u_depth_map, 0) - 1;
    ivec2 center = texel_from_uv(pixel_uv());
    center_normal = normal_view_from_map(center);
    center_distance = distance_from_depth(fetched_depth(center));
#endif
    float sum = 0.0;
    float weights = 0.0;
    // Written out: Mesa's software rasteriser does not unroll a loop of this size, and runs it at half the speed.
#if BOX
    add_tap(-2, 0.25, step_uv, sum, weights);
    add_tap(-1, 0.25, step_uv, sum, weights);
    add_tap(0, 0.25, step_uv, sum, weights);
    add_tap(1, 0.25, step_uv, sum, weights);
#else
    add_tap(-5, gBlurWeights[0].x, step_uv, sum, weights);
    add_tap(-4, gBlurWeights[0].y, step_uv, sum, weights);
    add_tap(-3, gBlurWeights[0].z, step_uv, sum, weights);
    add_tap(-2, gBlurWeights[0].w, step_uv, sum, weights);
    add_tap(-1, gBlurWeights[1].x, step_uv, sum, weights);
    add_tap(0, gBlurWeights[1].y, step_uv, sum, weights);
    add_tap(1, gBlurWeights[1].z, step_uv, sum, weights);
    add_tap(2, gBlurWeights[1].w, step_uv, sum, weights);
    add_tap(3, gBlurWeights[2].x, step_uv, sum, weights);
    add_tap(4, gBlurWeights[2].y, step_uv, sum, weights);
    add_tap(5, gBlurWeights[2].z, step_uv, sum, weights);
#endif
    vec2 own = texture(u_ambient_map, pixel_uv()).rg;
    return ambient(sum / weights, own.g, normal_code(own));
}
