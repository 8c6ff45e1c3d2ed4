// SPDX-License-Identifier: MIT
// The result of a frame with a history: what the blur left of the frames, and the detail that it took out. Detail is the mean
// difference of estimate and blurred estimate over the pixel and its neighbours, as far as it stands out of its own spread
// (shrinkage, after W. James and C. Stein, "Estimation with Quadratic Loss", 1961).
// in  u_history_map  texels of the history; fetched
// out result         accessibility
// RAYS 1: the history is linear

uniform usampler2D u_history_map;
#define RESULT float

struct surface {
    float linear, tolerance;
    vec2 projected;
};

vec4 details_of(uvec4 words)
{
    return floats(words >> 21) - floats((words >> 10) & 2047u);
}

// Adds two pairs of opposite neighbours: those that lie on a line with the pixel and face the same way. `a` and `b` are
// opposite, and `c` and `d`.
void add_pairs(surface own, uvec2 a, uvec2 b, uvec2 c, uvec2 d, inout vec3 sums)
{
    const float MOST = CHORD * CHORD / (NORMAL_STEP * NORMAL_STEP);
    uvec4 first = uvec4(a.x, b.x, c.x, d.x), second = uvec4(a.y, b.y, c.y, d.y);
    vec4 linear = linear_of(first, 1.0), detail = details_of(second);
    vec2 bend = abs(linear.xz + linear.yw - 2.0 * own.linear);
    vec4 turn_x = floats((second >> 5) & 31u) - own.projected.x, turn_y = floats(second & 31u) - own.projected.y;
    vec4 counts = vec4(lessThan(bend.xxyy, vec4(own.tolerance))) *
                  vec4(lessThan(turn_x * turn_x + turn_y * turn_y, vec4(MOST)));
    sums += vec3(dot(counts, vec4(1.0)), dot(counts, detail), dot(counts, detail * detail));
}

uvec2 texel_at(int x, int y)
{
    return texelFetch(u_history_map, ivec2(x, y), 0).xy;
}

RESULT result()
{
    ivec2 at = ivec2(pixel_center());
    ivec2 low = max(at - 1, ivec2(0)), high = min(at + 1, textureSize(u_history_map, 0) - 1);
    uvec2 texel = texel_at(at.x, at.y);
    surface own;
    own.linear = linear_of(texel.xxxx, 1.0).x;
    // What the history rounds bends lines too.
    own.tolerance = max(BLUR_TOLERANCE * radius_in_linear(own.linear), linear_step(own.linear)) +
                    own.linear * (4.0 / 32768.0);
    own.projected = vec2(ivec2((texel.y >> 5) & 31u, texel.y & 31u));
    float detail = details_of(texel.yyyy).x;
    vec3 sums = vec3(1.0, detail, detail * detail);
    add_pairs(own, texel_at(low.x, at.y), texel_at(high.x, at.y), texel_at(at.x, low.y), texel_at(at.x, high.y), sums);
    add_pairs(own, texel_at(low.x, low.y), texel_at(high.x, high.y), texel_at(low.x, high.y), texel_at(high.x, low.y),
              sums);
    vec2 moments = sums.yz / sums.x;
    float spread = max(moments.y - moments.x * moments.x, 0.0);
    float known = clamp((frames_of(texel.xxxx).x - 1.0) / NARROW, 0.0, 1.0);
    float keep = known * max(1.0 - SHRINK * spread / max(moments.x * moments.x, 1e-8), 0.0);
    float blurred = float(int((texel.y >> 10) & 2047u));
    float accessibility = clamp((blurred + keep * moments.x) / MEAN_STEPS, 0.0, 1.0);
#if RAYS
    return pow(accessibility, gPower);
#else
    return accessibility;
#endif
}
