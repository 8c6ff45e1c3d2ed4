// SPDX-License-Identifier: MIT
// Brings a half-size result to full size: linearly where the pixel lies on the plane of its neighbours, else from those
// of them that lie near it on the same surface, else from the one that is nearest in distance.
// in  u_depth_map      stored depth, full size; point sampled
// in  u_normal_map     view space, full size; point sampled

// How far off the plane a pixel may be, and how far off a neighbour on the same surface, in units of the radius; found by
// experiment.
const float UPSAMPLE_TOLERANCE = 0.02;
const float UPSAMPLE_NEAR = 0.1;
// By how much farther those around a crease count, where the nearest is looked for.
const float AROUND_CREASE = 1000.0;

// Accessibility at a full-size uv, whose coordinates are `odd` (1) where they lie midway between a and d of the paired
// map: b differs from a in x alone, c in y.
float upsampled(vec2 a, vec2 b, vec2 c, vec2 d, vec2 odd, vec2 full_uv)
{
    float depth = depth_component(textureLod(u_depth_map, full_uv, 0.0));
    float own = linear_from_depth(depth);
    vec4 values = vec4(accessibility_of(a), accessibility_of(b), accessibility_of(c), accessibility_of(d));
    vec4 apart = vec4(a.y, b.y, c.y, d.y) - own;
    bool on_plane = abs(dot(apart, vec4(0.25))) < linear_error(UPSAMPLE_TOLERANCE * gOcclusionRadius, own);
    uvec4 codes = uvec4(normal_code(a), normal_code(b), normal_code(c), normal_code(d));
    bvec4 turned = bvec4(false);
    // Most pixels lie amid neighbours that all face one way: there a GPU is spared the rest.
    if (any(notEqual(codes.xxx, codes.yzw))) {
        uint code = normal_code(normal_view_at_uv(full_uv));
        turned = bvec4(turns_away(normal_change(code, codes.x), -odd),
                       turns_away(normal_change(code, codes.y), vec2(odd.x, -odd.y)),
                       turns_away(normal_change(code, codes.z), vec2(-odd.x, odd.y)),
                       turns_away(normal_change(code, codes.w), odd));
    }
    float accessibility = dot(values, vec4(0.25));
    if (!on_plane || any(turned)) {
        bvec4 near = lessThan(abs(apart), vec4(linear_error(UPSAMPLE_NEAR * gOcclusionRadius, own)));
        vec4 weights = vec4(!turned.x && near.x, !turned.y && near.y, !turned.z && near.z, !turned.w && near.w);
        float total = dot(weights, vec4(1.0));
        vec4 off = abs(apart) * mix(vec4(1.0), vec4(AROUND_CREASE), turned);
        vec2 ab = off.x <= off.y ? vec2(values.x, off.x) : vec2(values.y, off.y);
        vec2 cd = off.w <= off.z ? vec2(values.w, off.w) : vec2(values.z, off.z);
        float nearest = ab.y <= cd.y ? ab.x : cd.x;
        accessibility = total > 0.0 ? dot(weights, values) / total : nearest;
    }
    return is_sky(depth) ? 1.0 : accessibility;
}
