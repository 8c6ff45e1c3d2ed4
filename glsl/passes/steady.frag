// SPDX-License-Identifier: MIT
// The result of a frame with a history: what the blur left of the frames, and the detail that it took out. Detail is the mean
// difference of estimate and blurred estimate over the pixel and its neighbours, as far as it stands out of its own spread
// (shrinkage, after W. James and C. Stein, "Estimation with Quadratic Loss", 1961).
// in  u_history_map  texels of the history; fetched
// out result         accessibility
// RAYS 1: the history is linear

uniform usampler2D u_history_map;
#define RESULT float

// What a texel of the history says.
struct neighbour {
    float linear, detail;
    uint code; // of the normal
};

neighbour decoded(uvec2 words)
{
    vec2 means = floats(uvec4(words.y >> 21, (words.y >> 10) & 2047u, 0u, 0u)).xy;
    return neighbour(linear_of(words.xxxx, 1.0).x, means.x - means.y, words.y & 1023u);
}

vec4 turns_from(vec2 projected, uvec4 codes)
{
    vec4 x = floats(codes >> 5) - projected.x, y = floats(codes & 31u) - projected.y;
    return x * x + y * y;
}

// Adds two pairs of opposite neighbours: those that lie on a line with the pixel and face the same way. `a` and `b` are
// opposite, and `c` and `d`.
void add_pairs(neighbour own, float tolerance, neighbour a, neighbour b, neighbour c, neighbour d, inout vec3 sums)
{
    vec2 bend = abs(vec2(a.linear + b.linear, c.linear + d.linear) - 2.0 * own.linear);
    vec4 counts = vec4(lessThan(bend.xxyy, vec4(tolerance)));
    uvec4 codes = uvec4(a.code, b.code, c.code, d.code);
#if BRANCHES
    // Most pixels face the same way as their neighbours, which spares a GPU this.
    if (any(notEqual(codes, uvec4(own.code))))
#endif
    {
        const float MOST = CHORD * CHORD / (NORMAL_STEP * NORMAL_STEP);
        vec2 projected = vec2(ivec2(own.code >> 5, own.code & 31u));
        counts *= vec4(lessThan(turns_from(projected, codes), vec4(MOST)));
    }
    vec4 detail = vec4(a.detail, b.detail, c.detail, d.detail);
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
shared vec2 tile[TEXELS]; // linear quantity and detail
shared uint tile_codes[TEXELS];

#define PREPARE fetch_tile()
void fetch_tile()
{
    ivec2 corner = ivec2(gl_WorkGroupID.xy) * ivec2(GROUP_X, GROUP_Y) + gRegion.xy + ivec2(gOrigin) - 1;
    for (int i = int(gl_LocalInvocationIndex); i < TEXELS; i += GROUP_X * GROUP_Y) {
        neighbour n = decoded(fetched(corner + ivec2(i % WIDTH, i / WIDTH)));
        tile[i] = vec2(n.linear, n.detail);
        tile_codes[i] = n.code;
    }
    barrier();
}

neighbour texel_at(int x, int y)
{
    int at = (int(gl_LocalInvocationID.y) + 1 + y) * WIDTH + int(gl_LocalInvocationID.x) + 1 + x;
    return neighbour(tile[at].x, tile[at].y, tile_codes[at]);
}
#else
neighbour texel_at(int x, int y)
{
    return decoded(fetched(ivec2(pixel_center()) + ivec2(x, y)));
}
#endif

RESULT result()
{
    uvec2 texel = fetched(ivec2(pixel_center()));
    neighbour own = decoded(texel);
    // What the history rounds bends lines too.
    float tolerance = max(BLUR_TOLERANCE * radius_in_linear(own.linear), linear_step(own.linear)) +
                      own.linear * (4.0 / 32768.0);
    vec3 sums = vec3(1.0, own.detail, own.detail * own.detail);
    add_pairs(own, tolerance, texel_at(-1, 0), texel_at(1, 0), texel_at(0, -1), texel_at(0, 1), sums);
    add_pairs(own, tolerance, texel_at(-1, -1), texel_at(1, 1), texel_at(-1, 1), texel_at(1, -1), sums);
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
