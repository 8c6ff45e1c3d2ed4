// SPDX-License-Identifier: MIT
// The result of a frame with a history: what the blur left of the frames, and the detail that it took out. Detail is the mean
// difference of estimate and blurred estimate over the pixel and its neighbours, as far as it stands out of its own spread
// (shrinkage, after W. James and C. Stein, "Estimation with Quadratic Loss", 1961).
// in  u_history_map  texels of the history; fetched
// out result         accessibility

uniform sampler2D u_history_map;
#define RESULT float

// Adds a pair of opposite neighbours where they lie on a line with the pixel.
void add_pair(vec4 own, vec4 before, vec4 after, float tolerance, inout vec3 sums)
{
    vec2 detail = vec2(before.x - before.y, after.x - after.y);
    float counts = abs(before.z - 2.0 * own.z + after.z) < tolerance ? 1.0 : 0.0;
    sums += counts * vec3(2.0, detail.x + detail.y, dot(detail, detail));
}

RESULT result()
{
    ivec2 pixel = ivec2(pixel_center());
    ivec2 low = max(pixel - 1, ivec2(0)), high = min(pixel + 1, textureSize(u_history_map, 0) - 1);
    vec4 own = texelFetch(u_history_map, pixel, 0);
    float tolerance = max(linear_error(BLUR_TOLERANCE * gOcclusionRadius, own.z), linear_step(own.z));
    float detail = own.x - own.y;
    vec3 sums = vec3(1.0, detail, detail * detail);
    add_pair(own, texelFetch(u_history_map, ivec2(low.x, pixel.y), 0), texelFetch(u_history_map, ivec2(high.x, pixel.y), 0),
             tolerance, sums);
    add_pair(own, texelFetch(u_history_map, ivec2(pixel.x, low.y), 0), texelFetch(u_history_map, ivec2(pixel.x, high.y), 0),
             tolerance, sums);
    add_pair(own, texelFetch(u_history_map, low, 0), texelFetch(u_history_map, high, 0), tolerance, sums);
    add_pair(own, texelFetch(u_history_map, ivec2(low.x, high.y), 0), texelFetch(u_history_map, ivec2(high.x, low.y), 0),
             tolerance, sums);
    vec2 moments = sums.yz / sums.x;
    float spread = max(moments.y - moments.x * moments.x, 0.0);
    float known = clamp((frames_of(own) - 1.0) / NARROW, 0.0, 1.0);
    float keep = known * max(1.0 - SHRINK * spread / max(moments.x * moments.x, 1e-8), 0.0);
    return clamp(own.y + keep * moments.x, 0.0, 1.0);
}
