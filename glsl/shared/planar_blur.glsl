// SPDX-License-Identifier: MIT
// The planar blur. Its first round is a separable box over one period of a 4x4 tile, 1/2 1 1 1 1/2, along surfaces. A tap
// counts where it lies on a line with two neighbours in the same direction, or with the two about the pixel, and where the
// surface does not turn away from the eye in between. A silhouette breaks both lines; a plane seen at any angle breaks
// neither. A pixel left without a tap takes neighbours that are merely near. One without those is brightened where it is
// much darker than its neighbours.
//
// After the first round the only noise left is that of twice the tile's period. Later rounds remove it in one pass each: a
// quarter of the pixel and 3/16 of each of the four at three pixels from it, where they lie on a line or in a hollow. In a
// hollow both sides darken, and the rest of the noise would show along it. What is left of the noise falls with the root of
// the number of samples. So two opposite neighbours count less the more their mean differs, or one alone the more it
// differs, and not at all from BLUR_ALIKE on: such a difference is shade.
// BRANCHES 1: a branch that all pixels of a warp take alike spares work.

float line_tolerance(float linear)
{
    return max(BLUR_TOLERANCE * radius_in_linear(linear), linear_step(linear));
}

// Of the pixel's own value and four others. RAYS 1: of those that are not missing; missing where all are. Later rounds for
// rays alone (STRIDE above 0, CORRECTS 0) count values less the more they differ: the first has left little noise, so a
// difference is a shadow's edge. The first round for a correction (CORRECTS) trusts a difference less the fewer taps it has,
// since more of it is noise: a few that say that the estimate is right already count with them.
float weighted_mean(float own, float weight, vec4 others, vec4 weights)
{
#if RAYS
#if CORRECTS && STRIDE == 0
    float taps = weight + dot(weights, vec4(1.0));
    float trust = (1.0 + 0.25 * CORRECTION_PRIOR) * taps / (taps + CORRECTION_PRIOR); // 1 for all 4
#endif
    weight = own < 0.0 ? 0.0 : weight;
    weights = mix(weights, vec4(0.0), lessThan(others, vec4(0.0)));
#if STRIDE > 0 && !CORRECTS
    vec4 apart = (others - own) * (1.0 / RAYS_ALIKE);
    weights *= own < 0.0 ? vec4(1.0) : max(vec4(0.0), 1.0 - apart * apart);
#endif
    float sum = weight * own + dot(weights, others);
    float total = weight + dot(weights, vec4(1.0));
#if CORRECTS && STRIDE == 0
    return total > 0.0 ? 0.5 + trust * (sum / total - 0.5) : MISSING;
#else
    return total > 0.0 ? sum / total : MISSING;
#endif
#else
    return (weight * own + dot(weights, others)) / (weight + dot(weights, vec4(1.0)));
#endif
}

// Contents of a pixel from the paired values of itself and of the two on each side along `way`.
CONTENTS blurred(PAIRED before_2, PAIRED before, PAIRED center, PAIRED after, PAIRED after_2, vec2 way)
{
#if BRANCHES && !CORRECTS
    // Most pixels are surrounded by equal ones, which nothing occludes.
    if (is_same(before_2, center) && is_same(before, center) && is_same(after, center) && is_same(after_2, center))
        return contents_of(center);
#endif
    float tolerance = line_tolerance(center.y);
    bool on_line = abs(before.y - 2.0 * center.y + after.y) < tolerance;
    bool on_before = abs(before_2.y - 2.0 * before.y + center.y) < tolerance;
    bool on_after = abs(after_2.y - 2.0 * after.y + center.y) < tolerance;
    uint code = normal_code(center);
    uvec4 codes = uvec4(normal_code(before_2), normal_code(before), normal_code(after), normal_code(after_2));
    bvec4 joins = bvec4(true);
    // Most pixels face the same way as their neighbours, which spares a GPU this.
    if (any(notEqual(codes, uvec4(code)))) {
        vec2 own = projected_normal(code);
        joins = not(bvec4(turns_away(projected_normal(codes.x) - own, -way), turns_away(projected_normal(codes.y) - own, -way),
                          turns_away(projected_normal(codes.z) - own, way), turns_away(projected_normal(codes.w) - own, way)));
    }
    vec4 weights = vec4(on_before && joins.x ? 0.5 : 0.0, (on_before || on_line) && joins.y ? 1.0 : 0.0,
                        (on_after || on_line) && joins.z ? 1.0 : 0.0, on_after && joins.w ? 0.5 : 0.0);
    if (weights.y + weights.z == 0.0) {
        float near = BLUR_NEAR * radius_in_linear(center.y);
        weights.yz = vec2(joins.y && abs(before.y - center.y) < near ? 1.0 : 0.0,
                          joins.z && abs(after.y - center.y) < near ? 1.0 : 0.0);
    }
    vec4 taps = vec4(accessibility_of(before_2), accessibility_of(before), accessibility_of(after),
                     accessibility_of(after_2));
    float own = accessibility_of(center);
#if !RAYS
    // What is below 0 is part of a mean over slices. Where not all taps count, it would make a speck.
    bool counts_all = dot(weights, vec4(1.0)) == 3.0;
    own = counts_all ? own : max(own, 0.0);
    taps = counts_all ? taps : max(taps, 0.0);
#endif
    float mean = weighted_mean(own, 1.0, taps, weights);
    // What is left without any tap keeps its noise, which shows where it is dark among bright neighbours.
    float least = weights.y + weights.z == 0.0 ? min(taps.y, taps.z) - BLUR_ALONE : 0.0;
#if RAYS
    least = own < 0.0 ? MISSING : least;
#endif
    mean = max(mean, least);
#if BENT
    return vec4(mean, (contents_of(center) + weighted(weights, before_2, before, after, after_2)).yzw /
                          (1.0 + dot(weights, vec4(1.0))));
#else
    return mean;
#endif
}

// Accessibility after a later round, from itself and the four at three pixels from it. The first round leaves little noise in
// directions, and in a crease they differ more than by noise, so later ones leave hidden vectors alone.
float blurred_wide(vec2 left, vec2 below, vec2 center, vec2 above, vec2 right)
{
#if BRANCHES
    if (all(equal(vec4(left.x, below.x, above.x, right.x), center.xxxx)))
        return accessibility_of(center);
#endif
    float tolerance = line_tolerance(center.y);
    float hollow = BLUR_HOLLOW * radius_in_linear(center.y);
    vec2 bend = vec2(left.y, below.y) - 2.0 * center.y + vec2(right.y, above.y);
    bend = orthographic() ? -bend : bend; // above 0 in a hollow
    bvec2 counts = bvec2(bend.x > -tolerance && bend.x < hollow, bend.y > -tolerance && bend.y < hollow);
    bvec4 joins = counts.xyyx;
    uint code = normal_code(center);
    uvec4 codes = uvec4(normal_code(left), normal_code(below), normal_code(above), normal_code(right));
    if (any(notEqual(codes, uvec4(code)))) {
        vec2 own = projected_normal(code);
        joins.x = joins.x && !turns_away(projected_normal(codes.x) - own, vec2(-1.0, 0.0));
        joins.y = joins.y && !turns_away(projected_normal(codes.y) - own, vec2(0.0, -1.0));
        joins.z = joins.z && !turns_away(projected_normal(codes.z) - own, vec2(0.0, 1.0));
        joins.w = joins.w && !turns_away(projected_normal(codes.w) - own, vec2(1.0, 0.0));
    }
    vec4 weights = mix(vec4(0.0), vec4(0.1875), joins);
    float own = accessibility_of(center);
    vec4 taps = vec4(accessibility_of(left), accessibility_of(below), accessibility_of(above), accessibility_of(right));
#if !RAYS
    vec4 apart = (taps - own) * (sqrt(float(gSampleCount)) / BLUR_ALIKE);
    // Of two opposite taps the mean counts: on a slope of shade they differ, one up and one down.
    vec2 pair = 0.5 * (apart.xy + apart.wz);
    apart.xw = joins.x && joins.w ? pair.xx : apart.xw;
    apart.yz = joins.y && joins.z ? pair.yy : apart.yz;
    weights *= max(vec4(0.0), 1.0 - apart * apart);
#endif
    return weighted_mean(own, 0.25, taps, weights);
}

// The contents of a paired value with other accessibility.
CONTENTS with_accessibility(PAIRED paired, float accessibility)
{
#if BENT
    return vec4(accessibility, contents_of(paired).yzw);
#else
    return accessibility;
#endif
}
