// SPDX-License-Identifier: MIT
// The horizon estimate: cosine-weighted visibility, slice by slice (J. Jimenez et al., "Practical Realtime Strategies for
// Accurate Indirect Occlusion", 2016), gathered in a mask of sectors (O. Therrien et al., "Screen Space Indirect Lighting
// with Visibility Bitmask", 2023) that are of equal cosine-weighted measure here. An occluder is taken to be as thick as
// it is wide along the slice, and each sample is cut by the sphere of the radius, as the traced truth is.
// in  u_normal_map     view space, fetched
// in  u_distance_map   view distance at the estimate's size, fetched
// in  u_depth_map      bound for its size alone
// out o_accessibility  0..1, R16
// STEPS_8 1: 8 samples on each side of a slice, else 6. SLICES_2, SLICES_4 1: that many slices, else 1.
//
// In a slice, x is the distance along it from the point, y the height towards the eye, both in units of the radius; angles
// are measured from y.

out float o_accessibility;

#if STEPS_8
const int STEPS = 8;
#else
const int STEPS = 6;
#endif
#if SLICES_4
const int SLICES = 4;
#elif SLICES_2
const int SLICES = 2;
#else
const int SLICES = 1;
#endif

const float PI = 3.14159265;
const float SECTORS = 31.0; // so that a full mask needs no shift by 32

// The shape of occluders, found by experiment (docs/decisions.md): error is flat about these values.
const float JUMP = 0.7;      // a step in height of more than this ends a run of samples
const float OWN = 1.25;      // thickness of the run that the point itself belongs to
const float OPEN_END = 1.25; // where a run ends that is not seen to end
const float CAP_BASE = 0.2;  // a run apart from the point is at most this thick ...
const float CAP_SLOPE = 1.5; // ... plus this times the sample's distance
// Few samples miss what lies between them and layers behind the first are not seen: the exponent that fits truth best.
const float CALIBRATION = 1.15;

uint count_bits(uint mask)
{
    mask -= (mask >> 1) & 0x55555555u;
    mask = (mask & 0x33333333u) + ((mask >> 2) & 0x33333333u);
    return (((mask + (mask >> 4)) & 0x0F0F0F0Fu) * 0x01010101u) >> 24;
}

// acos(c) - c sqrt(1 - c^2), within 0.004, by an odd polynomial about pi/2.
float segment_area(float c)
{
    float c2 = c * c;
    return 0.5 * PI - c * (1.98868 - c2 * (0.25869 + 0.15521 * c2));
}

// Cosine-weighted measure of the angles from 0 to acos(c) on one side, for a normal that leans towards that side by g:
// the integral of cos(t - g) sin(t).
float measure(float c, float cos_g, float sin_g)
{
    return 0.5 * (cos_g * (1.0 - c * c) + sin_g * segment_area(c));
}

struct slice_frame {
    vec3 position_view;
    vec3 along;   // x of the slice
    vec3 up;      // y: towards the eye
    vec3 across;  // out of the slice
    float slope;  // height that the tangent plane gains per unit of distance out of the slice, against `across`
    vec2 step_px; // one radius along the slice, pixels of the distance map
};

// Sample at `along` (0..1 of the radius, negative on the other side): x outwards, and y. Snapped to a texel's centre, and
// beyond the border to the border's; x is 0 where that is the point's own texel.
vec2 sample_at(slice_frame f, float along, vec2 center_px)
{
    ivec2 size = textureSize(u_distance_map, 0);
    ivec2 texel = clamp(ivec2(floor(clamp(center_px + along * f.step_px, -1e6, 1e6))), ivec2(0), size - 1);
    vec3 at = position_view_from_map(texel, mapped_distance(texel)) - f.position_view;
    float x = max(dot(at, f.along) * sign(along), 0.0);
    float y = dot(at, f.up) + f.slope * dot(at, f.across);
    return vec2(x, y) / gOcclusionRadius;
}

// Sectors that one side's samples hide. `total` is the measure of the whole slice, `offset` that of its minus side, where
// both sides begin; `direction` is the way they run from there.
uint hidden_sectors(vec2 samples[STEPS], float cos_g, float sin_g, float offset, float direction, float total)
{
    float start[STEPS];
    float end[STEPS];
    float run_start = -1.0; // -1: the point's own run
    float before_x = 0.0;
    float before_y = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        bool jump = abs(samples[i].y - before_y) > JUMP;
        run_start = jump ? 0.5 * (before_x + samples[i].x) : run_start;
        start[i] = run_start;
        before_x = samples[i].x;
        before_y = samples[i].y;
    }
    float run_end = OPEN_END;
    for (int i = STEPS - 1; i >= 0; --i) {
        end[i] = run_end;
        float to_x = i > 0 ? samples[i - 1].x : 0.0;
        float to_y = i > 0 ? samples[i - 1].y : 0.0;
        run_end = abs(samples[i].y - to_y) > JUMP ? 0.5 * (to_x + samples[i].x) : run_end;
    }
    uint mask = 0u;
    float lowest = -sin_g; // cosine of the angle at which the hemisphere ends on this side
    float scale = SECTORS / total;
    for (int i = 0; i < STEPS; ++i) {
        float x = samples[i].x;
        float thickness = start[i] < 0.0 ? OWN : min(end[i] - start[i], CAP_BASE + CAP_SLOPE * x);
        // The part of the occluder within the sphere.
        float half_chord = sqrt(max(1.0 - x * x, 0.0));
        float top = min(samples[i].y, half_chord);
        float bottom = max(samples[i].y - thickness, -half_chord);
        float cos_top = max(top * inversesqrt(max(x * x + top * top, 1e-12)), lowest);
        float cos_bottom = max(bottom * inversesqrt(max(x * x + bottom * bottom, 1e-12)), lowest);
        float near_edge = (offset + direction * measure(cos_top, cos_g, sin_g)) * scale;
        float far_edge = (offset + direction * measure(cos_bottom, cos_g, sin_g)) * scale;
        float low = clamp(floor(min(near_edge, far_edge) + 0.5), 0.0, SECTORS);
        float high = clamp(floor(max(near_edge, far_edge) + 0.5), 0.0, SECTORS);
        uint bits = ((1u << uint(high - low)) - 1u) << uint(low);
        mask |= top > bottom && x < 1.0 && x > 0.0 ? bits : 0u;
    }
    return mask;
}

// Ordered tile of directions: 4x4 Bayer for the angle, the same bits reversed for the jitter along the slice.
vec2 tile_noise()
{
    uvec2 p = uvec2(gl_FragCoord.xy) & 3u;
    uint x = p.x ^ p.y;
    uint bayer = ((x & 1u) << 3) | ((p.y & 1u) << 2) | (x & 2u) | (p.y >> 1);
    uint reversed = ((bayer & 1u) << 3) | ((bayer & 2u) << 1) | ((bayer & 4u) >> 1) | (bayer >> 3);
    return (vec2(bayer, reversed) + 0.5) / 16.0;
}

void main()
{
    o_accessibility = 1.0;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec3 normal_view = normal_view_from_map(texel * gFactor);
    float distance = mapped_distance(texel);
    // Sky has no surface, and a point without a normal has no hemisphere: nothing there to occlude.
    if (distance >= FAR_AWAY || normal_view == vec3(0.0))
        return;
    slice_frame f;
    f.position_view = position_view_from_map(texel, distance);
    vec2 uv = uv_from_texel(texel * gFactor);
    f.up = normalize(vec3(-(uv * gRayDirection.xy + gRayDirection.zw), 1.0));
    vec2 view_per_px = (gRayOrigin.xy + distance * gRayDirection.xy) / vec2(textureSize(u_distance_map, 0));
    vec2 noise = tile_noise();
    float occlusion = 0.0;
    for (int slice = 0; slice < SLICES; ++slice) {
        float angle_rad = PI * (noise.x + float(slice)) / float(SLICES);
        vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
        f.step_px = gOcclusionRadius * direction / view_per_px;
        vec3 along = vec3(direction, 0.0);
        f.along = normalize(along - f.up * dot(along, f.up));
        f.across = cross(f.up, f.along);
        float normal_up = dot(normal_view, f.up);
        float normal_along = dot(normal_view, f.along);
        // Seen edge-on the tangent plane is all slope; the bounds keep a snapped sample's height of the same order as its x.
        f.slope = clamp(dot(normal_view, f.across) / max(normal_up, 1e-3), -40.0, 40.0);
        // The normal, projected into the slice, leans by g; a normal straight across the slice projects to nothing.
        float projected = sqrt(max(normal_along * normal_along + normal_up * normal_up, 1e-12));
        float cos_g = normal_up / projected;
        float sin_g = normal_along / projected;
        float g = atan(sin_g, cos_g);
        float total_plus = 0.5 * (cos_g + sin_g * (0.5 * PI + g));
        float total_minus = 0.5 * (cos_g - sin_g * (0.5 * PI - g));
        // 0 where the whole lens of directions lies behind the viewing plane: a normal that looks away.
        float total = max(total_plus + total_minus, 1e-6);
        vec2 plus[STEPS];
        vec2 minus[STEPS];
        for (int i = 0; i < STEPS; ++i) {
            float at = (float(i) + 1.0 - noise.y) / float(STEPS);
            plus[i] = sample_at(f, at, vec2(texel) + 0.5);
            minus[i] = sample_at(f, -at, vec2(texel) + 0.5);
        }
        uint mask = hidden_sectors(plus, cos_g, sin_g, total_minus, 1.0, total) |
                    hidden_sectors(minus, cos_g, -sin_g, total_minus, -1.0, total);
        occlusion += projected * total * float(count_bits(mask)) / SECTORS;
    }
    // pow() is undefined for a base of 0 with power 0, and for the negative that rounding can leave.
    o_accessibility = clamp(pow(max(1.0 - occlusion / float(SLICES), 1e-6), CALIBRATION * gPower), 0.0, 1.0);
}
