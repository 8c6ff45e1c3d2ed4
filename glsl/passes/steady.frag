// SPDX-License-Identifier: MIT
// The result of a frame with a history: what the blur left of the frames, and the detail that it took out. Detail is the mean
// difference of estimate and blurred estimate over the pixel and its neighbours, as far as it stands out of its own spread
// (shrinkage, after W. James and C. Stein, "Estimation with Quadratic Loss", 1961).
// in  u_history_map  texels of the history; fetched
// out result         accessibility
// RAYS 1: the history is linear

uniform sampler2D u_history_map;
#define RESULT float

// Adds two pairs of opposite neighbours: those that lie on a line with the pixel and face the same way. `a` and `b` are
// opposite, and `c` and `d`.
void add_pairs(vec4 own, vec2 projected, vec4 a, vec4 b, vec4 c, vec4 d, float tolerance, inout vec3 sums)
{
    const float MOST = CHORD * CHORD / (NORMAL_STEP * NORMAL_STEP);
    vec4 detail = vec4(a.x - a.y, b.x - b.y, c.x - c.y, d.x - d.y);
    vec2 bend = abs(vec2(a.z + b.z, c.z + d.z) - 2.0 * own.z);
    vec4 stored = vec4(a.w, b.w, c.w, d.w);
    vec4 codes = stored - 1024.0 * floor(stored * (1.0 / 1024.0));
    vec4 high = floor(codes * (1.0 / 32.0));
    vec4 turn_x = high - 15.0 - projected.x, turn_y = codes - 32.0 * high - 15.0 - projected.y;
    vec4 counts = vec4(lessThan(bend.xxyy, vec4(tolerance))) *
                  vec4(lessThan(turn_x * turn_x + turn_y * turn_y, vec4(MOST)));
    sums += vec3(dot(counts, vec4(1.0)), dot(counts, detail), dot(counts, detail * detail));
}

RESULT result()
{
    ivec2 pixel = ivec2(pixel_center());
    ivec2 low = max(pixel - 1, ivec2(0)), high = min(pixel + 1, textureSize(u_history_map, 0) - 1);
    vec4 own = texelFetch(u_history_map, pixel, 0);
    vec2 projected = projected_normal(normal_code(own));
    float tolerance = max(BLUR_TOLERANCE * radius_in_linear(own.z), linear_step(own.z));
    float detail = own.x - own.y;
    vec3 sums = vec3(1.0, detail, detail * detail);
    add_pairs(own, projected, texelFetch(u_history_map, ivec2(low.x, pixel.y), 0),
              texelFetch(u_history_map, ivec2(high.x, pixel.y), 0), texelFetch(u_history_map, ivec2(pixel.x, low.y), 0),
              texelFetch(u_history_map, ivec2(pixel.x, high.y), 0), tolerance, sums);
    add_pairs(own, projected, texelFetch(u_history_map, low, 0), texelFetch(u_history_map, high, 0),
              texelFetch(u_history_map, ivec2(low.x, high.y), 0), texelFetch(u_history_map, ivec2(high.x, low.y), 0),
              tolerance, sums);
    vec2 moments = sums.yz / sums.x;
    float spread = max(moments.y - moments.x * moments.x, 0.0);
    float known = clamp((frames_of(own) - 1.0) / NARROW, 0.0, 1.0);
    float keep = known * max(1.0 - SHRINK * spread / max(moments.x * moments.x, 1e-8), 0.0);
#if RAYS
    return pow(clamp(own.y + keep * moments.x, 0.0, 1.0), gPower);
#else
    return clamp(own.y + keep * moments.x, 0.0, 1.0);
#endif
}
