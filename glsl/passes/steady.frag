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

uvec2 fetched(ivec2 at)
{
    return texelFetch(u_history_map, clamp(at, ivec2(0), textureSize(u_history_map, 0) - 1), 0).xy;
}

#if COMPUTE
// The texels of the work group and those around them, which spares fetches.
const int WIDTH = GROUP_X + 2;
const int TEXELS = WIDTH * (GROUP_Y + 2);
shared uvec2 tile[TEXELS];

#define PREPARE fetch_tile()
void fetch_tile()
{
    ivec2 corner = ivec2(gl_WorkGroupID.xy) * ivec2(GROUP_X, GROUP_Y) + gRegion.xy + ivec2(gOrigin) - 1;
    for (int i = int(gl_LocalInvocationIndex); i < TEXELS; i += GROUP_X * GROUP_Y)
        tile[i] = fetched(corner + ivec2(i % WIDTH, i / WIDTH));
    barrier();
}

uvec2 texel_at(int x, int y)
{
    return tile[(int(gl_LocalInvocationID.y) + 1 + y) * WIDTH + int(gl_LocalInvocationID.x) + 1 + x];
}
#else
uvec2 texel_at(int x, int y)
{
    return fetched(ivec2(pixel_center()) + ivec2(x, y));
}
#endif

RESULT result()
{
    uvec2 texel = texel_at(0, 0);
    surface own;
    own.linear = linear_of(texel.xxxx, 1.0).x;
    // What the history rounds bends lines too.
    own.tolerance = max(BLUR_TOLERANCE * radius_in_linear(own.linear), linear_step(own.linear)) +
                    own.linear * (4.0 / 32768.0);
    own.projected = vec2(ivec2((texel.y >> 5) & 31u, texel.y & 31u));
    float detail = details_of(texel.yyyy).x;
    vec3 sums = vec3(1.0, detail, detail * detail);
    add_pairs(own, texel_at(-1, 0), texel_at(1, 0), texel_at(0, -1), texel_at(0, 1), sums);
    add_pairs(own, texel_at(-1, -1), texel_at(1, 1), texel_at(-1, 1), texel_at(1, -1), sums);
    vec2 moments = sums.yz / sums.x;
    float spread = max(moments.y - moments.x * moments.x, 0.0);
    float known = clamp((frames_of(texel.xxxx).x - 1.0) / NARROW, 0.0, 1.0);
    const float NOISY = RAYS != 0 ? SHRINK_RAYS : SHRINK;
    float keep = known * max(1.0 - NOISY * spread / max(moments.x * moments.x, 1e-8), 0.0);
    float blurred = float(int((texel.y >> 10) & 2047u));
    float accessibility = clamp((blurred + keep * moments.x) / MEAN_STEPS, 0.0, 1.0);
#if RAYS
    return pow(accessibility, gPower);
#else
    return accessibility;
#endif
}
