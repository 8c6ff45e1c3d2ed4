// SPDX-License-Identifier: MIT
// The horizon estimate: cosine-weighted visibility, slice by slice (J. Jimenez et al., "Practical Realtime Strategies for
// Accurate Indirect Occlusion", 2016), gathered in a mask of sectors (O. Therrien et al., "Screen Space Indirect Lighting
// with Visibility Bitmask", 2023) that are of equal cosine-weighted measure here. An occluder is taken to be as thick as
// it is wide along the slice, and each sample is cut by the sphere of the radius, as the traced truth is.
// in  u_normal_map    view space; point sampled
// in  u_distance_map  view distance at the estimate's size, with LAYERS 1 thickness and second layer too; point sampled,
//                     clamped
// out result          accessibility, with PAIRED 1 what passes after this one read; with ACCUMULATE 1 the linear
//                     accessibility, to be added to the sum of its replicate
// STEPS_8, STEPS_12, STEPS_16 1: that many samples on each side of a slice, else 6. SLICES_2 1: two slices, else one.
// OPEN 1: nothing occludes. BRANCHES 1: a branch that all pixels of a warp take alike spares work. PRECISE, FMA, ROOT, ROUND: view.glsl.
//
// In a slice, x is the distance along it from the point, outwards on either side, and y the height towards the eye, both
// in units of the radius; angles are measured from y. Loops are written out by macros: Mesa's software rasteriser does
// not unroll them, and a loop of a single turn still costs it a third of this pass.

uniform sampler2D u_distance_map;
#if ACCUMULATE
#define RESULT vec2
#else
#define RESULT AMBIENT
#endif

#if STEPS_16
#define STEPS 16
#define EACH_STEP(f) f(0) f(1) f(2) f(3) f(4) f(5) f(6) f(7) f(8) f(9) f(10) f(11) f(12) f(13) f(14) f(15)
#define EACH_STEP_BACK(f) f(15) f(14) f(13) f(12) f(11) f(10) f(9) f(8) f(7) f(6) f(5) f(4) f(3) f(2) f(1) f(0)
#elif STEPS_12
#define STEPS 12
#define EACH_STEP(f) f(0) f(1) f(2) f(3) f(4) f(5) f(6) f(7) f(8) f(9) f(10) f(11)
#define EACH_STEP_BACK(f) f(11) f(10) f(9) f(8) f(7) f(6) f(5) f(4) f(3) f(2) f(1) f(0)
#elif STEPS_8
#define STEPS 8
#define EACH_STEP(f) f(0) f(1) f(2) f(3) f(4) f(5) f(6) f(7)
#define EACH_STEP_BACK(f) f(7) f(6) f(5) f(4) f(3) f(2) f(1) f(0)
#else
#define STEPS 6
#define EACH_STEP(f) f(0) f(1) f(2) f(3) f(4) f(5)
#define EACH_STEP_BACK(f) f(5) f(4) f(3) f(2) f(1) f(0)
#endif
#if SLICES_2
#define SLICES 2
#else
#define SLICES 1
#endif

// By loops a GPU's caches hold all of the program, which they don't written out; fragment shaders gain by it from two slices on.
#if COMPUTE || BRANCHES && SLICES_2
#define LOOPS 1
#else
#define LOOPS 0
#endif

const float PI = 3.14159265;
const float SECTORS = 31.0; // so that a full mask needs no shift by 32
const float STEP = 1.0 / float(STEPS);

// Found on glssao-bench's scenes; glssao-tune measures and searches them, docs/decisions.md says what came of it.
const float JUMP = 0.3;        // a step in height of more than this ends a run of samples ...
const float ALIKE = 0.4;       // ... unless the step before or after it differs by less than this: a steep surface
const float OPEN_END = 1.25;   // where a run ends that is not seen to end
const float WIDTH = 1.0;       // thickness of a run that a jump separates from the point, in units of its width
#if LAYERS
const float VEIL = 0.03;       // share of what lies hidden behind occluders that counts as occluded, however deep
const float SECOND = 0.3;      // thickness of the second layer's surfaces, in units of what is guessed for the first's
#else
const float VEIL = 0.15;
#endif
const float VEIL_WIDTH = 0.2;  // but not behind occluders thinner than this
#if STEPS_16 || STEPS_12
const float CALIBRATION = 1.0; // exponent that makes up for what few samples miss
#elif STEPS_8
const float CALIBRATION = 1.05;
#else
const float CALIBRATION = 1.1;
#endif

uint count_bits(uint mask)
{
    mask -= (mask >> 1) & 0x55555555u;
    mask = (mask & 0x33333333u) + ((mask >> 2) & 0x33333333u);
    return (((mask + (mask >> 4)) & 0x0F0F0F0Fu) * 0x01010101u) >> 24;
}

// The cosine-weighted measure of the angles from 0 to acos(c) on one side, as a polynomial in c. For a normal that leans
// towards that side by g it is the integral of cos(t - g) sin(t), which is (cos g (1 - c^2) + sin g h(c)) / 2 with
// h(c) = acos(c) - c sqrt(1 - c^2), and h is within 0.004 of pi/2 - c (1.98868 - 0.25869 c^2 - 0.15521 c^4).
struct polynomial {
    vec4 low; // coefficients of 1, c, c^2, c^3
    float c5;
};

polynomial measure(float cos_g, float sin_g, float scale)
{
    PRECISE polynomial p =
        polynomial(0.5 * scale * vec4(cos_g + 0.5 * PI * sin_g, -1.98868 * sin_g, -cos_g, 0.25869 * sin_g),
                   0.5 * scale * 0.15521 * sin_g);
    return p;
}

float value(polynomial p, float c)
{
    PRECISE float c2 = c * c;
    PRECISE float sum = FMA(FMA(c2, FMA(c2, p.c5, p.low.w), p.low.y), c, FMA(c2, p.low.z, p.low.x));
    return sum;
}

// Bits of the sectors from the value on, rounded: the polynomial has half a sector added. It leaves 0..31 by an eighth at
// most, which rounding takes back; a shift by more than 31 would be undefined.
uint sectors_from(polynomial p, float c)
{
    return ~0u << (uint(int(value(p, c))) & 31u);
}

// What turns a sample's offset in pixels and its view distance into x and y.
struct slice_frame {
    vec2 center_uv;        // the point
    vec2 texel_uv;         // of the distance map
    vec2 low, high;        // how far off the map's first and last texel are, pixels
    float center_distance; // scene units
    float scale;           // what a pixel's size grows with: in perspective the view distance, else 1
    float per_scale;       // of a step, at the point: STEP over it
    vec2 x_per_px;
    vec2 y_per_px;
    float y_per_distance;
    float y_step; // of the depth format
};

// What one side of a slice has to itself.
struct slice_side {
    polynomial sectors; // numbered from the far end of the minus side
    float lowest;       // cosine of the angle at which the hemisphere ends
};

// What a sample must exceed to be an occluder.
struct least {
    float x;
    float tangent; // height of the tangent plane per x ...
    float above;   // ... and how much higher than that
};

// Snapped to a texel's centre, and beyond the border to the border's; the height is corrected for the distance off the
// slice as if the surface there were parallel to the point's own. z: the width of one step at the sample's distance.
// `layers`: the thickness of what is seen, negative where it is not known, and how far behind it the second layer lies.
vec3 sample_at(slice_frame f, vec2 reach, vec2 first_px, vec2 step_px, float number, out vec2 layers)
{
    // The point is a texel's centre itself, so that whole pixels lead to others.
    PRECISE vec2 offset = min(ROUND(FMA(vec2(number), step_px, first_px)), reach);
    PRECISE vec2 uv = FMA(offset, f.texel_uv, f.center_uv);
#if LAYERS
    vec3 texels = textureLod(u_distance_map, uv, 0.0).rgb;
    float distance = texels.r;
    layers = min(f.y_per_distance * texels.gb, vec2(1e6)); // bounded, so that no square overflows
#else
    layers = vec2(0.0);
    float distance = textureLod(u_distance_map, uv, 0.0).r;
#endif
    float scale = orthographic() ? 1.0 : distance;
    PRECISE vec2 per_scale = vec2(FMA(offset.x, f.x_per_px.x, offset.y * f.x_per_px.y),
                                  FMA(offset.x, f.y_per_px.x, offset.y * f.y_per_px.y));
    PRECISE vec3 at =
        vec3(scale * per_scale.x, FMA(f.y_per_distance, f.center_distance - distance, scale * per_scale.y), scale * f.per_scale);
    return at;
}

// Sectors that are hidden at x between two heights, where they lie within the sphere, by its half chord there.
uint hidden_between(float x2, float chord, float top, float bottom, slice_side side, out float cos_top)
{
    top = min(top, chord);
    bottom = max(bottom, -chord);
    cos_top = max(top * inversesqrt(FMA(top, top, x2)), side.lowest);
    PRECISE float cos_bottom = clamp(bottom * inversesqrt(FMA(bottom, bottom, x2)), side.lowest, cos_top);
    return sectors_from(side.sectors, cos_top) ^ sectors_from(side.sectors, cos_bottom);
}

// Where a sample that hides nothing is put, so that no step after asks again: straight below the point.
const vec2 NOWHERE = vec2(0.0, -1e6);

// Whether a sample can hide anything: within the sphere, above the tangent plane. x is 0 on the point's own texel, and below
// it where the border holds a sample on the other side; held right across the slice, its angle is all error. And what the
// depth format can't tell from the tangent plane is no occluder.
bool occludes(vec3 at, least from)
{
    return at.x > from.x && at.x < 1.0 && at.y > FMA(from.tangent, at.x, from.above);
}

// Sectors that one sample hides, whose run is `width` steps wide. Raises `highest` to the sample's top where it veils what is
// behind it.
uint hidden_by(vec3 at, vec2 layers, float width, slice_side side, inout float highest)
{
    PRECISE float x2 = FMA(at.x, at.x, 1e-12);
    PRECISE float chord = 1.0 - x2; // x is below 1
    chord = ROOT(chord);
    PRECISE float thickness = WIDTH * width * at.z;
    float cos_top;
    uint mask = 0u;
#if LAYERS
    PRECISE float second = min(at.y - layers.y, chord); // its thickness counts from where it is within the sphere
    mask = hidden_between(x2, chord, second, FMA(-SECOND, thickness, second), side, cos_top);
    thickness = layers.x >= 0.0 ? layers.x : thickness;
#endif
    mask |= hidden_between(x2, chord, at.y, at.y - thickness, side, cos_top);
    highest = thickness > VEIL_WIDTH ? max(highest, cos_top) : highest;
    return mask;
}

// Sectors that one side's samples hide. `highest` is the cosine of the horizon over occluders that veil what is behind them.
uint hidden_sectors(vec3 samples[STEPS], vec2 layers[STEPS], float jitter, slice_side side, least from, out float highest)
{
    PRECISE float change[STEPS];
#define CHANGE(i) change[i] = samples[i].y - (i > 0 ? samples[max(i - 1, 0)].y : 0.0);
    EACH_STEP(CHANGE)
    bool any_occludes = false;
#define SINK(i) if (occludes(samples[i], from)) any_occludes = true; else samples[i].xy = NOWHERE;
    EACH_STEP(SINK)
    highest = side.lowest;
#if LOOPS
    // Where no sample of the side does for any pixel of a warp, a GPU is spared the rest.
    if (!any_occludes)
        return 0u;
#endif
    // In steps. A change of height leads to another surface where it is large, and goes on neither before nor after at the same
    // slope.
    float end[STEPS];
    float boundary = OPEN_END * float(STEPS) - 0.5 + jitter;
    bool bends_before = true;
    bool bends_after;
#define FIND_END(i) end[i] = boundary; bends_after = bends_before; bends_before = i == 0 || abs(change[i] - change[max(i - 1, 0)]) > ALIKE; boundary = abs(change[i]) > JUMP && bends_before && bends_after ? float(i) : boundary;
    EACH_STEP_BACK(FIND_END)
    // The run that the point itself belongs to starts so far off that it is thicker than the sphere.
    float start = boundary == 0.0 ? 0.0 : -100.0;
    uint mask = 0u;
#define HIDE(i) start = i > 0 && end[max(i - 1, 0)] == float(i) ? float(i) : start; mask |= hidden_by(samples[i], layers[i], end[i] - start, side, highest);
    EACH_STEP(HIDE)
    return mask;
}

// Ordered tile: Bayer's matrix for the angle, the same bits reversed for the jitter along the slice. A single slice of few
// samples takes the 8x8 matrix, any 4x4 of which are spread alike: with the smaller one, the few places that are looked
// at show as streaks on a wall behind a large occluder.
vec2 tile_noise()
{
    uvec2 p = uvec2(pixel_center());
    uint x = p.x ^ p.y;
#if SLICES_2
    uint bayer = ((x & 1u) << 3) | ((p.y & 1u) << 2) | (x & 2u) | ((p.y & 2u) >> 1);
    uint reversed = ((bayer & 1u) << 3) | ((bayer & 2u) << 1) | ((bayer & 4u) >> 1) | (bayer >> 3);
    vec2 noise = (vec2(bayer, reversed) + 0.5) / 16.0;
#else
    uint bayer = ((x & 1u) << 5) | ((p.y & 1u) << 4) | ((x & 2u) << 2) | ((p.y & 2u) << 1) | ((x & 4u) >> 1) |
                 ((p.y & 4u) >> 2);
    uint reversed = ((bayer & 1u) << 5) | ((bayer & 2u) << 3) | ((bayer & 4u) << 1) | ((bayer & 8u) >> 1) |
                    ((bayer & 16u) >> 3) | (bayer >> 5);
    vec2 noise = (vec2(bayer, reversed) + 0.5) / 64.0;
#endif
#if ACCUMULATE
    // The second replicate has the tile turned over, so that the two differ by another offset in each pixel of the tile.
    noise = fract((gAccumulation.x > 0.0 ? noise : noise.yx) + gNoise);
#endif
    return noise;
}

// Adds the sectors that the samples of the plus side (`sign` 1) or the minus side (-1) hide, and takes from `veiled` what
// their horizon leaves open. `g`: cosine and sine of the normal's lean; the sectors' measure is multiplied by `scale`, and
// `origin` is that of the eye's direction.
void add_side(slice_frame f, vec2 way, vec2 first_px, vec2 step_px, vec2 g, float scale, float origin, least from,
              float jitter, float sign, inout uint mask, inout float veiled)
{
    way *= sign;
    f.texel_uv *= way;
    f.y_per_px *= way;
    vec2 reach = mix(f.low, f.high, greaterThan(way, vec2(0.0)));
    PRECISE slice_side side;
    side.sectors = measure(sign * g.x, g.y, scale);
    side.sectors.low.x += origin + 0.5;
    side.lowest = -sign * g.y;
    from.tangent *= sign;
    vec3 samples[STEPS];
    vec2 layers[STEPS];
#define TAKE(i) samples[i] = sample_at(f, reach, first_px, step_px, float(i), layers[i]);
    EACH_STEP(TAKE)
    float highest;
    mask |= hidden_sectors(samples, layers, jitter, side, from, highest);
    veiled -= value(measure(g.x, sign * g.y, 1.0), highest);
}

// What the slice adds to occlusion.
float slice_occlusion(slice_frame f, vec3 normal_view, vec3 up, float angle, float jitter)
{
    PRECISE vec2 direction = vec2(cos(PI * angle), sin(PI * angle));
    // The bound keeps pixel coordinates exact, however near the point is.
    PRECISE vec2 step_px = STEP * clamp(float(STEPS) * f.per_scale * direction * gPixel.zw, -1e5, 1e5);
    vec2 way = mix(vec2(-1.0), vec2(1.0), greaterThan(step_px, vec2(0.0)));
    step_px = abs(step_px);
    PRECISE vec2 first_px = (1.0 - jitter) * step_px;
    PRECISE vec3 along = vec3(direction, 0.0);
    along = normalize(along - up * dot(along, up)); // never of length 0: up is a ray that leaves the picture's plane
    PRECISE vec3 across = cross(up, along);
    // Shading normals may look away from the eye; the hemisphere is then seen from its rim.
    PRECISE float normal_up = max(dot(normal_view, up), 0.0);
    PRECISE float normal_along = dot(normal_view, along);
    // Seen edge-on the tangent plane is all slope; the bounds keep a snapped sample's height of the same order as its x.
    PRECISE float slope = clamp(dot(normal_view, across) / max(normal_up, 1e-3), -40.0, 40.0);
    f.x_per_px = way * gPixel.xy * along.xy;
    f.y_per_px = gPixel.xy * (up.xy + slope * across.xy);
    // The normal, projected into the slice, leans by g; a normal straight across the slice projects to nothing.
    PRECISE float projected = max(normal_along * normal_along + normal_up * normal_up, 1e-12);
    PRECISE float per_projected = inversesqrt(projected);
    projected *= per_projected;
    PRECISE float cos_g = normal_up * per_projected;
    PRECISE float sin_g = normal_along * per_projected;
    // Sectors are numbered from the far end of the minus side.
    PRECISE float total_minus = value(measure(cos_g, -sin_g, 1.0), sin_g);
    // The floor: a normal straight across the slice leaves no measure to share out among sectors.
    PRECISE float total = max(value(measure(cos_g, sin_g, 1.0), -sin_g) + total_minus, 1e-6);
    PRECISE float scale = SECTORS / total;
    // A fifth of a pixel.
    PRECISE vec2 pixel_x = f.scale * f.x_per_px;
    PRECISE float least_x = max(dot(pixel_x, pixel_x), 1e-30);
    least_x = 0.2 * ROOT(least_x);
    least from = least(least_x, -sin_g / max(cos_g, 1e-3), f.y_step);
    uint mask = 0u;
    PRECISE float veiled = total;
#if LOOPS
    for (int i = 0; i < 2; ++i)
        add_side(f, way, first_px, step_px, vec2(cos_g, sin_g), scale, total_minus * scale, from, jitter,
                 i == 0 ? 1.0 : -1.0, mask, veiled);
#else
    add_side(f, way, first_px, step_px, vec2(cos_g, sin_g), scale, total_minus * scale, from, jitter, 1.0, mask, veiled);
    add_side(f, way, first_px, step_px, vec2(cos_g, sin_g), scale, total_minus * scale, from, jitter, -1.0, mask, veiled);
#endif
    PRECISE float hidden = total * float(count_bits(mask)) * (1.0 / SECTORS);
    PRECISE float occlusion = projected * mix(hidden, veiled, VEIL);
    return occlusion;
}

RESULT result()
{
    vec2 map_uv = pixel_uv();
    float distance = textureLod(u_distance_map, map_uv, 0.0).r;
    PRECISE vec2 uv = (floor(pixel_center()) * float(gFactor) + 0.5) * gFullTexel;
    vec3 normal_view = normal_view_at_uv(uv);
#if ACCUMULATE
    RESULT open = gAccumulation.xy;
#else
    float linear = linear_from_distance(distance);
    uint code = normal_code(normal_view);
    RESULT open = ambient(1.0, linear, code);
#endif
#if OPEN
    return open;
#else
    // Sky has no surface, and a point without a normal has no hemisphere: nothing there to occlude.
    if (distance >= FAR_AWAY || normal_view == vec3(0.0))
        return open;
    PRECISE vec3 ray = vec3(uv * gRayDirection.xy + gRayDirection.zw, -1.0);
    PRECISE float ray_length = dot(ray, ray);
    PRECISE float per_length = inversesqrt(ray_length);
    ray_length *= per_length;
    PRECISE vec3 up = -per_length * ray;
    PRECISE slice_frame f;
    f.texel_uv = gInvRenderTargetSize;
    f.center_uv = map_uv;
    f.low = pixel_center() - 0.5;
    f.high = gEstimateSize - 0.5 - pixel_center();
    f.center_distance = distance;
    f.scale = orthographic() ? 1.0 : distance;
    f.per_scale = STEP / f.scale;
    f.y_per_distance = ray_length * gPerRadius;
    f.y_step = f.y_per_distance * depth_step(distance + gOcclusionRadius);
    vec2 noise = tile_noise();
#if LOOPS
    PRECISE float occlusion = 0.0;
    for (int i = 0; i < SLICES; ++i)
        occlusion += slice_occlusion(f, normal_view, up, (noise.x + float(i)) / float(SLICES), noise.y);
    occlusion /= float(SLICES);
#else
    PRECISE float occlusion = slice_occlusion(f, normal_view, up, noise.x / float(SLICES), noise.y);
#if SLICES_2
    occlusion = 0.5 * (occlusion + slice_occlusion(f, normal_view, up, 0.5 * (noise.x + 1.0), noise.y));
#endif
#endif
    // pow() is undefined below 0, which rounding can leave (as it can leave more than 1), and at 0 for a power so small that it
    // is flushed to 0.
    PRECISE float share = max(1.0 - occlusion, 1e-6);
#if ACCUMULATE
    return gAccumulation.xy * min(pow(share, CALIBRATION), 1.0);
#else
    return ambient(clamp(pow(share, CALIBRATION * gPower), 0.0, 1.0), linear, code);
#endif
#endif
}
