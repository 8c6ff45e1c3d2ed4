// SPDX-License-Identifier: MIT
// Brings a half-size result to full size. A pixel on the plane of its neighbours is interpolated linearly. Any other takes
// those neighbours that lie near it on the same surface, or else the one that is nearest in distance.
// in  u_depth_map      stored depth, full size; point sampled
// in  u_normal_map     view space, full size; point sampled. Without (NORMALS_REBUILT), lines through depths tell creases
// in  u_raw_map        RAW 1: paired values of the estimate, which the history takes besides what the blur left; fetched
// BRANCHES 1: a branch that all pixels of a warp take alike spares work.

// The difference that a neighbour around a crease counts as having: larger than any other.
const float AROUND_CREASE = 1e16;

#if NORMALS == NORMALS_REBUILT
// How far above the pixel the line through the corner that is `way` pixels from it and what lies as far beyond passes: above 0
// where the surface turns away from the eye in between.
float fall(float own, PAIRED corner, vec2 full_uv, vec2 way)
{
    float beyond = depth_component(textureLod(u_depth_map, full_uv + 2.0 * way * gFullTexel, 0.0));
    float off = 2.0 * corner.y - linear_from_depth(beyond) - own;
    return orthographic() ? -off : off;
}
#endif

#if BENT && NORMALS == NORMALS_REBUILT
// Of the block's four texels: its own, the one to the right, the one above, and the one beyond both.
vec3 corner_normals[4];

void fetch_corner_normals(vec2 full_uv)
{
    vec2 uv = (floor(0.5 * full_uv / gFullTexel) + 0.5) * gInvRenderTargetSize;
    UNROLL for (int i = 0; i < 4; ++i) {
        vec2 corner = uv + vec2(float(i & 1), float(i >> 1)) * gInvRenderTargetSize;
        corner_normals[i] = normal_view_from_stored(textureLod(u_normal_map, corner, 0.0).xyz);
    }
}

// Of a full-size pixel that is `odd`, from neighbours with these weights.
vec3 mean_normal(vec4 weights, vec2 odd)
{
    vec3 below = weights.x * corner_normals[0] + weights.y * corner_normals[odd.x > 0.0 ? 1 : 0];
    vec3 above = weights.z * corner_normals[odd.y > 0.0 ? 2 : 0] +
                 weights.w * corner_normals[(odd.x > 0.0 ? 1 : 0) + (odd.y > 0.0 ? 2 : 0)];
    vec3 sum = below + above;
    return sum * inversesqrt(max(dot(sum, sum), 1e-10));
}
#endif

// How much each of four neighbours counts at a full-size uv, whose coordinates are `odd` (1) where they lie midway between a
// and d of the paired map: b differs from a in x alone, c in y; where a coordinate is even, the two are the same.
vec4 upsample_weights(PAIRED a, PAIRED b, PAIRED c, PAIRED d, vec2 odd, vec2 full_uv, float depth)
{
    float own = linear_from_depth(depth);
    vec4 apart = vec4(a.y, b.y, c.y, d.y) - own;
    vec4 off = abs(apart);
    float tolerance = max(UPSAMPLE_TOLERANCE * radius_in_linear(own), 0.5 * linear_step(own));
    uvec4 codes = uvec4(normal_code(a), normal_code(b), normal_code(c), normal_code(d));
    // Most pixels have neighbours that all face the same way, which spares a GPU what follows, and a software rasteriser the
    // memory of its normals: all of them read one, which is in the cache.
    bool differs = any(notEqual(codes.xxx, codes.yzw));
#if NORMALS != NORMALS_REBUILT && (BENT || !BRANCHES)
    vec3 stored = textureLod(u_normal_map, BENT != 0 || differs ? full_uv : vec2(0.0), 0.0).xyz;
#endif
    if (differs) {
#if NORMALS == NORMALS_REBUILT
        vec4 falls = vec4(fall(own, a, full_uv, -odd), fall(own, b, full_uv, vec2(odd.x, -odd.y)),
                          fall(own, c, full_uv, vec2(-odd.x, odd.y)), fall(own, d, full_uv, odd));
        vec4 size = abs(falls);
        float least = min(min(size.x, size.y), min(size.z, size.w));
        bvec4 turned = greaterThan(falls, vec4(UPSAMPLE_FALL * least + tolerance));
#else
#if BRANCHES && !BENT
        vec3 stored = textureLod(u_normal_map, full_uv, 0.0).xyz;
#endif
        vec2 projected = projected_normal(decoded_normal(stored));
        bvec4 turned = bvec4(turns_away(projected_normal(codes.x) - projected, -odd),
                             turns_away(projected_normal(codes.y) - projected, vec2(odd.x, -odd.y)),
                             turns_away(projected_normal(codes.z) - projected, vec2(-odd.x, odd.y)),
                             turns_away(projected_normal(codes.w) - projected, odd));
#endif
        off = mix(off, vec4(AROUND_CREASE), turned);
    }
    bool on_plane = abs(dot(apart, vec4(0.25))) < tolerance;
    float near = on_plane ? 0.5 * AROUND_CREASE : UPSAMPLE_NEAR * radius_in_linear(own);
    // The nearest neighbour always counts.
    near = max(near, min(min(off.x, off.y), min(off.z, off.w)));
    return vec4(lessThanEqual(off, vec4(near)));
}

#if RAW
uniform sampler2D u_raw_map;
vec4 corner_raws; // of the block's four texels, in the order of corner_normals

void fetch_corner_raws(ivec2 texel)
{
    ivec2 next = min(texel + 1, ivec2(gEstimateSize) - 1);
    // The bits of the normal in a value add too little to matter.
    corner_raws = vec4(texelFetch(u_raw_map, texel, 0).r, texelFetch(u_raw_map, ivec2(next.x, texel.y), 0).r,
                       texelFetch(u_raw_map, ivec2(texel.x, next.y), 0).r, texelFetch(u_raw_map, next, 0).r);
}

// The mean; RAYS 1: of what is not missing.
float known_mean(vec4 weights, vec4 values)
{
#if RAYS
    weights = mix(weights, vec4(0.0), lessThan(values, vec4(0.0)));
    float sum = dot(weights, vec4(1.0));
    return sum > 0.0 ? dot(weights, values) / sum : MISSING;
#else
    return dot(weights, values) / dot(weights, vec4(1.0));
#endif
}
#endif

// Accessibility there, with BENT 1 what shared/bent.glsl delivers, with RAW 1 packed with the estimate.
CONTENTS upsampled(PAIRED a, PAIRED b, PAIRED c, PAIRED d, vec2 odd, vec2 full_uv)
{
    float depth = depth_component(textureLod(u_depth_map, full_uv, 0.0));
    vec4 weights = upsample_weights(a, b, c, d, odd, full_uv, depth);
#if RAW
    vec4 raws = odd.y > 0.0 ? corner_raws : corner_raws.xyxy;
    raws = odd.x > 0.0 ? raws : raws.xxzz;
    vec4 values = vec4(accessibility_of(a), accessibility_of(b), accessibility_of(c), accessibility_of(d));
    return packed_pair(vec2(known_mean(weights, raws), known_mean(weights, values)));
#else
    CONTENTS mean = weighted(weights, a, b, c, d) / dot(weights, vec4(1.0));
#if BENT && NORMALS == NORMALS_REBUILT
    return delivered(mean, is_sky(depth), mean_normal(weights, odd));
#elif BENT
    return delivered(mean, is_sky(depth), normal_view_from_stored(textureLod(u_normal_map, full_uv, 0.0).xyz));
#else
    return is_sky(depth) ? 1.0 : mean;
#endif
#endif
}

// The four full-size pixels that texel a is the lower left of.
struct block {
    CONTENTS lower_left, lower_right, upper_left, upper_right;
};

// `full_uv`: of the lower left one, which is the texel's own.
block upsampled_block(PAIRED a, PAIRED b, PAIRED c, PAIRED d, vec2 full_uv)
{
#if BRANCHES && !BENT
    // Where nothing occludes any of them, neither depth nor normals matter. The bits of the normal only add to 1.
    if (min(min(a.x, b.x), min(c.x, d.x)) >= 1.0)
        return block(1.0, 1.0, 1.0, 1.0);
#endif
    vec2 full_next = full_uv + gFullTexel;
#if !RAW
    bool sky = is_sky(depth_component(textureLod(u_depth_map, full_uv, 0.0)));
#endif
#if BENT && NORMALS == NORMALS_REBUILT
    fetch_corner_normals(full_uv);
    CONTENTS own = delivered(contents_of(a), sky, corner_normals[0]);
#elif BENT
    CONTENTS own = delivered(contents_of(a), sky, normal_view_at_uv(full_uv));
#elif RAW
    CONTENTS own = packed_pair(vec2(corner_raws.x, accessibility_of(a))); // the history knows sky itself
#else
    CONTENTS own = sky ? 1.0 : contents_of(a);
#endif
    return block(own,
                 upsampled(a, b, a, b, vec2(1.0, 0.0), vec2(full_next.x, full_uv.y)),
                 upsampled(a, a, c, c, vec2(0.0, 1.0), vec2(full_uv.x, full_next.y)),
                 upsampled(a, b, c, d, vec2(1.0), full_next));
}
