// SPDX-License-Identifier: MIT
// Brings a half-size result to full size. A pixel on the plane of its neighbours is interpolated linearly. Any other takes
// those neighbours that lie near it on the same surface, or else the one that is nearest in distance.
// in  u_depth_map      stored depth, full size; point sampled
// in  u_normal_map     view space, full size; point sampled. Without (NORMALS_REBUILT), lines through depths tell creases
// BRANCHES 1: a branch that all pixels of a warp take alike spares work.

// The difference that a neighbour around a crease counts as having: larger than any other.
const float AROUND_CREASE = 1e16;

#if NORMALS == NORMALS_REBUILT
// How far above the pixel the line through the corner that is `way` pixels from it and what lies as far beyond passes: above 0
// where the surface turns away from the eye in between.
float fall(float own, vec2 corner, vec2 full_uv, vec2 way)
{
    float beyond = depth_component(textureLod(u_depth_map, full_uv + 2.0 * way * gFullTexel, 0.0));
    float off = 2.0 * corner.y - linear_from_depth(beyond) - own;
    return orthographic() ? -off : off;
}
#endif

// Accessibility at a full-size uv, whose coordinates are `odd` (1) where they lie midway between a and d of the paired
// map: b differs from a in x alone, c in y; where a coordinate is even, the two are the same.
float upsampled(vec2 a, vec2 b, vec2 c, vec2 d, vec2 odd, vec2 full_uv)
{
    float depth = depth_component(textureLod(u_depth_map, full_uv, 0.0));
    float own = linear_from_depth(depth);
    vec4 values = vec4(accessibility_of(a), accessibility_of(b), accessibility_of(c), accessibility_of(d));
    vec4 apart = vec4(a.y, b.y, c.y, d.y) - own;
    vec4 off = abs(apart);
    float tolerance = max(UPSAMPLE_TOLERANCE * radius_in_linear(own), 0.5 * linear_step(own));
    uvec4 codes = uvec4(normal_code(a), normal_code(b), normal_code(c), normal_code(d));
    // Most pixels have neighbours that all face the same way, which spares a GPU this.
    if (any(notEqual(codes.xxx, codes.yzw))) {
#if NORMALS == NORMALS_REBUILT
        vec4 falls = vec4(fall(own, a, full_uv, -odd), fall(own, b, full_uv, vec2(odd.x, -odd.y)),
                          fall(own, c, full_uv, vec2(-odd.x, odd.y)), fall(own, d, full_uv, odd));
        vec4 size = abs(falls);
        float least = min(min(size.x, size.y), min(size.z, size.w));
        bvec4 turned = greaterThan(falls, vec4(UPSAMPLE_FALL * least + tolerance));
#else
        vec2 projected = projected_normal(decoded_normal(textureLod(u_normal_map, full_uv, 0.0).xyz));
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
    vec4 weights = vec4(lessThanEqual(off, vec4(near)));
    return is_sky(depth) ? 1.0 : dot(weights, values) / dot(weights, vec4(1.0));
}

// Accessibility of the four full-size pixels that texel a is the lower left of: lower left, at full_uv, which is its own,
// lower right, upper left and upper right.
vec4 upsampled_block(vec2 a, vec2 b, vec2 c, vec2 d, vec2 full_uv)
{
#if BRANCHES
    // Where nothing occludes any of them, neither depth nor normals matter. The bits of the normal only add to 1.
    if (min(min(a.x, b.x), min(c.x, d.x)) >= 1.0)
        return vec4(1.0);
#endif
    vec2 full_next = full_uv + gFullTexel;
    bool sky = is_sky(depth_component(textureLod(u_depth_map, full_uv, 0.0)));
    return vec4(sky ? 1.0 : accessibility_of(a),
                upsampled(a, b, a, b, vec2(1.0, 0.0), vec2(full_next.x, full_uv.y)),
                upsampled(a, a, c, c, vec2(0.0, 1.0), vec2(full_uv.x, full_next.y)),
                upsampled(a, b, c, d, vec2(1.0), full_next));
}
