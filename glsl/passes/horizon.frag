// SPDX-License-Identifier: MIT
// The horizon estimate: cosine-weighted visibility, slice by slice (J. Jimenez et al., "Practical Realtime Strategies for
// Accurate Indirect Occlusion", 2016), gathered in a mask of sectors (O. Therrien et al., "Screen Space Indirect Lighting with
// Visibility Bitmask", 2023). The sectors have equal cosine-weighted measure. An occluder counts as being as thick as it is
// wide along the slice, times the setting, and the sphere of the radius cuts each sample, as in the traced truth.
// in  u_normal_map    view space; point sampled
// in  u_distance_map  view distance at the estimate's size, with LAYERS 1 thickness and second layer too; point sampled,
//                     clamped
// out result          by OUTPUT: accessibility, the paired value, or linear accessibility for the sum of its replicate; with
//                     BENT 1 the latter two with the hidden vector
// SLICES slices of STEPS samples on each side. LOOPS 1: the loops over slices and sides are not written out, and a side
// without an occluder is left early. VARIES 1: the noise is shifted by gNoise.
//
// Coordinates in a slice, in units of the radius: x is the distance from the point along the slice, outwards on either side;
// y is the height towards the eye. Angles are measured from y. tuned.glsl has the tuned constants. In each slice:
//   (1) n' = n without its part across the slice; it leans towards the plus side by g
//   (2) measure of the angles from 0 to acos(c), for a side towards which n' leans by g:
//       M(c, g) = (cos g (1 - c^2) + sin g (acos(c) - c sqrt(1 - c^2))) / 2
//   (3) total = M(sin g, -g) + M(-sin g, g): each side from the eye's direction to the rim of the hemisphere
//   (4) a sector: 1/31 of the total, counted from the rim of the minus side
//   (5) an occluder from y - thickness to y hides the cosines between those of its ends, c = y / sqrt(x^2 + y^2), as far as
//       the sphere, x^2 + y^2 <= 1, and the hemisphere reach
//   (6) occlusion = |n'| mix(total (sectors hidden) / 31, measure below the two horizons, VEIL)
// BENT 1: the directions that the hidden sectors stand for are summed too:
//   (7) the integral of (sin t, cos t) cos(t - g) sin t over the angles from 0 to acos(c), with s = sqrt(1 - c^2):
//       D(c, g) = (cos g s^3 + sin g (2 - 3 c + c^3), cos g (1 - c^3) + sin g s^3) / 3
//   (8) hidden vector = |n'| mix(D between the ends of each run of hidden sectors, D below the two horizons, VEIL)

uniform sampler2D u_distance_map;
#if OUTPUT == OUTPUT_SUM && BENT
#define RESULT vec4
#elif OUTPUT == OUTPUT_SUM
#define RESULT vec2
#else
#define RESULT AMBIENT
#endif

const float PI = 3.14159265;
const float SECTORS = 31.0; // so that a full mask needs no shift by 32
const float STEP = 1.0 / float(STEPS);

#if LAYERS
const float VEIL = VEIL_TWO_LAYERS;
#else
const float VEIL = VEIL_ONE_LAYER;
#endif
#if STEPS >= 12
const float CALIBRATION = CALIBRATION_12;
#elif STEPS == 8
const float CALIBRATION = CALIBRATION_8;
#else
const float CALIBRATION = CALIBRATION_6;
#endif

// Straight below the point, where a sample hides nothing.
const vec2 BELOW_THE_POINT = vec2(0.0, -1e6);
// A bound of layers, so that no square overflows.
const float MOST_RADII = 1e6;
// Seen edge-on, the tangent plane is all slope: the bound keeps the height of a snapped sample of the order of its x.
const float STEEPEST = 40.0;

int count_bits(uint mask)
{
    mask -= (mask >> 1) & 0x55555555u;
    mask = (mask & 0x33333333u) + ((mask >> 2) & 0x33333333u);
    return int((((mask + (mask >> 4)) & 0x0F0F0F0Fu) * 0x01010101u) >> 24);
}

// (2), the integral of cos(t - g) sin(t) over t, as a polynomial in c. That for acos(c) - c sqrt(1 - c^2),
// pi/2 - c (1.98868 - 0.25869 c^2 - 0.15521 c^4), is off by at most 0.004.
struct polynomial {
    vec4 low; // coefficients of 1, c, c^2, c^3
    float c5;
};

polynomial measure(float cos_g, float sin_g, float scale)
{
    return polynomial(0.5 * scale * vec4(cos_g + 0.5 * PI * sin_g, -1.98868 * sin_g, -cos_g, 0.25869 * sin_g),
                      0.5 * scale * 0.15521 * sin_g);
}

float value(polynomial p, float c)
{
    float c2 = c * c;
    return p.low.x + p.low.z * c2 + (p.low.y + (p.low.w + p.c5 * c2) * c2) * c;
}

// The pixel that is estimated.
struct point {
    vec2 uv;              // in the distance map
    vec2 low, high;       // pixels to the map's first and last texel
    float distance;       // scene units
    float scale;          // a pixel's width grows with it: the view distance in perspective, else 1
    float per_scale;      // STEP / scale: the width of a step
    float radius;         // scene units
    vec2 pixel;           // radii that a pixel is wide, in perspective per unit of view distance
    float y_per_distance; // radii per scene unit, along the ray
    float y_step;         // a step of the depth format, in radii
    vec3 normal_view;
    vec3 up_view;         // towards the eye, unit length
    float jitter;         // 0..1, of the samples along a slice
};

// One side of a slice.
struct slice_side {
    vec2 uv_per_px;            // offsets in pixels are positive outwards
    vec2 reach_px;             // to the map's last texel
    vec2 first_px, step_px;    // offset of the first sample, and from sample to sample
    vec2 x_per_px, y_per_px;   // per unit of scale
    float least_x;             // samples nearer than this lie on the point
    float tangent;             // height of the tangent plane per x
    float lowest;              // cosine of the angle at which the hemisphere ends
    float run_width;           // thickness of a run, in units of its width
    polynomial sectors;        // number of the sector, plus a half, from the far end of the minus side
};

// x, y and the width of a step (radii) at a sample. The sample is snapped to the centre of a texel, beyond the border to that
// of the border. Its height is corrected for its distance from the slice as if the surface there were parallel to the point's
// own. `layers`: thickness of the surface there, and how far behind it the second layer lies (radii); a thickness that is
// not known is minus the least that it can be.
vec3 sample_at(point p, slice_side side, float number, out vec2 layers)
{
    // The point is a texel's centre itself, so whole pixels lead to other centres.
    vec2 offset_px = min(roundEven(side.first_px + number * side.step_px), side.reach_px);
    vec2 uv = p.uv + offset_px * side.uv_per_px;
#if LAYERS
    vec3 texel = textureLod(u_distance_map, uv, 0.0).rgb;
    float distance = texel.r;
    layers = min(p.y_per_distance * texel.gb, vec2(MOST_RADII));
#else
    float distance = textureLod(u_distance_map, uv, 0.0).r;
    layers = vec2(0.0);
#endif
    float scale = orthographic() ? 1.0 : distance;
    return vec3(scale * dot(offset_px, side.x_per_px),
                scale * dot(offset_px, side.y_per_px) + p.y_per_distance * (p.distance - distance), scale * p.per_scale);
}

// Whether a sample can hide anything: within the sphere, off the point's own texel (where x is 0, or below it where the border
// holds a sample back), and above the tangent plane by more than depth formats and normals can tell.
bool occludes(point p, slice_side side, vec3 at)
{
    return at.x > side.least_x && at.x < 1.0 && at.y > side.tangent * at.x + p.y_step;
}

// The sectors (4) from a cosine on. The polynomial leaves 0..31 by an eighth at most, which the rounding takes back; a shift by
// more than 31 would be undefined.
uint sectors_from(slice_side side, float c)
{
    return ~0u << (uint(int(value(side.sectors, c))) & 31u);
}

// (5): the sectors that are hidden at x between two heights, as far as these lie in the sphere, whose half chord is given.
uint hidden_between(slice_side side, float x2, float chord, float top, float bottom, out float cos_top)
{
    top = min(top, chord);
    bottom = max(bottom, -chord);
    cos_top = max(top * inversesqrt(top * top + x2), side.lowest);
    float cos_bottom = clamp(bottom * inversesqrt(bottom * bottom + x2), side.lowest, cos_top);
    return sectors_from(side, cos_top) ^ sectors_from(side, cos_bottom);
}

// The height at a sample's x from which the occluder's end is seen, which lies a part of a step farther on.
float top_of(vec3 at, float rise)
{
    return at.x > 0.0 ? max(at.y, at.x * (at.y + REACH_ON * rise) / (at.x + REACH_ON * at.z)) : at.y;
}

// The sectors that one sample hides, whose run is `width` steps wide and rises by `rise` a step. Raises `highest` to the
// sample's top where the sample is thick enough to veil what is behind it, and part of the way where it neither is near the
// point nor reaches down to it.
uint hidden_by(slice_side side, vec3 at, vec2 layers, float width, float rise, inout float highest)
{
    float x2 = at.x * at.x + 1e-12;
    float chord = sqrt(1.0 - x2); // x is below 1
    float thickness = side.run_width * width * at.z;
    float cos_top;
    uint mask = 0u;
#if LAYERS
    float second = min(at.y - layers.y, chord); // its thickness counts from where it is within the sphere
    mask = hidden_between(side, x2, chord, second, second - SECOND_WIDTH * thickness, cos_top);
    thickness = layers.x > 0.0 ? layers.x : max(thickness, -layers.x);
#endif
    mask |= hidden_between(side, x2, chord, top_of(at, rise), at.y - thickness, cos_top);
    float veil_top = at.y < max(VEIL_REACH, thickness) ? cos_top : mix(side.lowest, cos_top, VEIL_FAR);
    highest = thickness > VEIL_WIDTH ? max(highest, veil_top) : highest;
    return mask;
}

// The sectors that the samples of one side hide. `highest`: cosine of the horizon over occluders that veil what is behind
// them.
uint hidden_sectors(point p, slice_side side, out float highest)
{
    vec3 samples[STEPS];
    vec2 layers[STEPS];
    UNROLL for (int i = 0; i < STEPS; ++i) {
        samples[i] = sample_at(p, side, float(i), layers[i]);
    }
    float rise[STEPS]; // of height, from the sample before; from the point for the first
    UNROLL for (int i = 0; i < STEPS; ++i) {
        rise[i] = samples[i].y - (i > 0 ? samples[max(i - 1, 0)].y : 0.0);
    }
    bool any_occludes = false;
    UNROLL for (int i = 0; i < STEPS; ++i) {
        if (occludes(p, side, samples[i]))
            any_occludes = true;
        else
            samples[i].xy = BELOW_THE_POINT; // no step below asks again
    }
    highest = side.lowest;
#if LOOPS
    if (!any_occludes)
        return 0u;
#endif
    // Where the run of samples ends that each one belongs to, in steps, from the last one back. A rise leads to another surface
    // where it is large and the rises before and after it are not alike.
    float end[STEPS];
    float boundary = OPEN_END * float(STEPS) - 0.5 + p.jitter;
    bool bends_before = true;
    UNROLL for (int i = STEPS - 1; i >= 0; --i) {
        end[i] = boundary;
        bool bends_after = bends_before;
        bends_before = i == 0 || abs(rise[i] - rise[max(i - 1, 0)]) > ALIKE;
        boundary = abs(rise[i]) > JUMP && bends_before && bends_after ? float(i) : boundary;
    }
    float start = boundary == 0.0 ? 0.0 : gThickness.y;
    uint mask = 0u;
    UNROLL for (int i = 0; i < STEPS; ++i) {
        start = i > 0 && end[max(i - 1, 0)] == float(i) ? float(i) : start;
        mask |= hidden_by(side, samples[i], layers[i], end[i] - start, float(i) > start ? rise[i] : 0.0, highest);
    }
    return mask;
}

// An ordered tile of noise: Bayer's matrix for the angle, and the same bits reversed for the jitter along the slice. A single
// slice of few samples takes the 8x8 matrix, any 4x4 of which are spread alike; the few places that the smaller one looks at
// show as streaks on a wall behind a large occluder.
vec2 tile_noise()
{
    uvec2 p = uvec2(pixel_center());
    uint x = p.x ^ p.y;
#if SLICES == 2
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
#if OUTPUT == OUTPUT_SUM
    // The second replicate has the tile turned over, so that the two differ by another offset in each pixel of the tile.
    noise = fract((gAccumulation.x > 0.0 ? noise : noise.yx) + gNoise);
#elif VARIES
    noise = fract(noise + gNoise);
#endif
    return noise;
}

#if BENT
// (7)
vec2 directions(float cos_g, float sin_g, float c)
{
    float s2 = max(1.0 - c * c, 0.0);
    float s3 = s2 * sqrt(s2);
    float c3 = c * c * c;
    return vec2(cos_g * s3 + sin_g * (2.0 - 3.0 * c + c3), cos_g * (1.0 - c3) + sin_g * s3) / 3.0;
}

// The cosine up to which a side has a given measure. With acos(c) - c sqrt(1 - c^2) about pi/2 - 2 c + (2 - pi/2) c |c|, (2) is
// a quadratic; one step of Newton's method on the polynomial leaves 0.001 of (7) on average, 0.02 at most.
float cosine_at(float cos_g, float sin_g, float lowest, float amount)
{
    float rest = cos_g + 0.5 * PI * sin_g - 2.0 * amount;
    bool below = rest < 0.0 && sin_g >= 0.0; // the eye's horizon
    float square = cos_g + (below ? 2.0 - 0.5 * PI : 0.5 * PI - 2.0) * sin_g;
    float root = sqrt(max(sin_g * sin_g + square * rest, 0.0));
    float c = sin_g < 0.0 ? (root - sin_g) / square : rest / max(sin_g + root, 1e-6);
    c = clamp(c, lowest, 1.0);
    float slope = max(cos_g * c + sin_g * sqrt(1.0 - c * c), 0.2); // 0 at the rim
    return clamp(c + (value(measure(cos_g, sin_g, 1.0), c) - amount) / slope, lowest, 1.0);
}

// D up to where a sector begins, signed by its side. x is the way along the slice towards the plus side.
vec2 directions_up_to(int sector, float cos_g, float sin_g, float total, float total_minus)
{
    float amount = total / SECTORS * float(sector) - total_minus;
    float sign = amount < 0.0 ? -1.0 : 1.0;
    float c = cosine_at(cos_g, sign * sin_g, -sign * sin_g, abs(amount));
    return vec2(1.0, sign) * directions(cos_g, sign * sin_g, c);
}

// D of the hidden sectors: each run of them adds its end and takes off its beginning.
vec2 directions_hidden(uint mask, float cos_g, float sin_g, float total, float total_minus)
{
    vec2 sum = vec2(0.0);
    for (uint ends = mask ^ (mask << 1); ends != 0u; ends &= ends - 1u) {
        uint lowest = ends & (~ends + 1u);
        int sector = int(floatBitsToUint(float(lowest)) >> 23) - 127; // the exponent of a power of 2
        vec2 up_to = directions_up_to(sector, cos_g, sin_g, total, total_minus);
        sum += (mask & lowest) != 0u ? -up_to : up_to;
    }
    return sum;
}

vec3 hidden_vector = vec3(0.0); // view space, sum over the slices
#endif

// The occlusion that one slice sees; `angle`: of the slice in the picture, in half turns.
float slice_occlusion(point p, float angle)
{
    vec2 direction = vec2(cos(PI * angle), sin(PI * angle));
    vec2 step_px = p.radius * p.per_scale * direction * gPixel.zw;
    vec2 way = mix(vec2(-1.0), vec2(1.0), greaterThan(step_px, vec2(0.0)));
    vec3 along = vec3(direction, 0.0);
    along = normalize(along - p.up_view * dot(along, p.up_view)); // never of length 0: up is a ray that leaves the picture
    vec3 across = cross(p.up_view, along);
    // A smooth normal may look away a little beside a silhouette; the hemisphere is then seen from its rim.
    float normal_up = max(dot(p.normal_view, p.up_view), 0.0);
    float normal_along = dot(p.normal_view, along);
    float slope = clamp(dot(p.normal_view, across) / max(normal_up, 1e-3), -STEEPEST, STEEPEST);
    // (1). A normal straight across the slice projects to nothing.
    float projected = sqrt(max(normal_along * normal_along + normal_up * normal_up, 1e-12));
    float cos_g = normal_up / projected;
    float sin_g = normal_along / projected;
    // (3). The floor is for a normal straight across the slice, which leaves no measure to share out among sectors.
    float total_minus = value(measure(cos_g, -sin_g, 1.0), sin_g);
    float total = max(value(measure(cos_g, sin_g, 1.0), -sin_g) + total_minus, 1e-6);
    float scale = SECTORS / total;

    slice_side side;
    side.step_px = abs(step_px);
    side.first_px = (1.0 - p.jitter) * side.step_px;
    side.x_per_px = way * p.pixel * along.xy;
    vec2 y_per_px = p.pixel * (p.up_view.xy + slope * across.xy);
    // A fifth of a pixel.
    vec2 pixel_x = p.scale * side.x_per_px;
    side.least_x = 0.2 * sqrt(dot(pixel_x, pixel_x));

    side.run_width = RUN_WIDTH;
#if !PERSPECTIVE
    // Straight down on a surface, as on a plan, nothing but a top is seen of what stands on it.
    if (orthographic())
        side.run_width = mix(RUN_WIDTH, PLAN_WIDTH, clamp((normal_up - PLAN_FROM) / (PLAN_TO - PLAN_FROM), 0.0, 1.0));
#endif
    side.run_width *= gThickness.x;

    uint mask = 0u;
    float veiled = total;
#if BENT
    vec2 veiled_directions = vec2(0.0);
#endif
    UNROLL_IF_SHORT for (int i = 0; i < 2; ++i) {
        float sign = i == 0 ? 1.0 : -1.0; // the plus side, then the minus side
        side.uv_per_px = sign * way * gMapTexel;
        side.y_per_px = sign * way * y_per_px;
        side.reach_px = mix(p.low, p.high, greaterThan(sign * way, vec2(0.0)));
        side.tangent = sign * -sin_g / max(cos_g, 1e-3) + LEAST_RISE;
        side.lowest = -sign * sin_g;
        side.sectors = measure(sign * cos_g, sin_g, scale);
        side.sectors.low.x += total_minus * scale + 0.5;
        float highest;
        mask |= hidden_sectors(p, side, highest);
        veiled -= value(measure(cos_g, sign * sin_g, 1.0), highest);
#if BENT
        veiled_directions += vec2(sign, 1.0) * (directions(cos_g, sign * sin_g, side.lowest) -
                                                directions(cos_g, sign * sin_g, highest));
#endif
    }
#if BENT
    // (8)
    vec2 in_slice =
        projected * mix(directions_hidden(mask, cos_g, sin_g, total, total_minus), veiled_directions, VEIL);
    hidden_vector += in_slice.x * along + in_slice.y * p.up_view;
#endif
    // (6)
    float hidden = total * float(count_bits(mask)) * (1.0 / SECTORS);
    return projected * mix(hidden, veiled, VEIL);
}

// From the point, whose ray has a length of 1 along the view axis, to the pixel `offset` beside it. Beyond the map's border
// nothing is known.
vec3 step_to(vec2 offset, vec2 map_uv, vec3 ray, float distance)
{
    vec2 uv = map_uv + offset * gMapTexel;
    float there = uv == clamp(uv, 0.0, 1.0) ? textureLod(u_distance_map, uv, 0.0).r : FAR_AWAY;
    vec2 across = offset * gPixel.xy * (orthographic() ? 1.0 : there);
    return vec3(across, 0.0) + ray * (there - distance);
}

// Accessibility from what is left open. It is below 0 where a single slice of a surface that leans along it hides more than all;
// slices across the lean hide less, and the blur needs both. Two slices lie across each other. pow() is undefined below 0, and
// at 0 for a power so small that it is flushed to 0.
float accessibility_from(float open, float exponent)
{
    float below = SLICES == 1 ? min(open, 0.0) * min(exponent, 1.0) : 0.0;
    return min(pow(max(open, 1e-6), exponent), 1.0) + below;
}

RESULT result()
{
    vec2 uv = (full_texel(floor(pixel_center())) + 0.5) * gFullTexel;
#if DENSE
    vec2 map_uv = uv;
    vec2 center = full_texel(floor(pixel_center())) + 0.5;
#else
    vec2 map_uv = pixel_uv();
    vec2 center = pixel_center();
#endif
    float distance = textureLod(u_distance_map, map_uv, 0.0).r;
    vec3 normal_view = normal_view_at_uv(uv);
#if OUTPUT == OUTPUT_SUM && BENT
    RESULT open = OPEN;
#elif OUTPUT == OUTPUT_SUM
    RESULT open = gAccumulation.xy;
#else
    float linear = linear_from_distance(distance);
    uint code = normal_code(normal_view);
    RESULT open = ambient(OPEN, linear, code);
#endif
    // Sky has no surface, a point without a normal has no hemisphere, and beyond the fade nothing counts.
    if (distance >= gFadeFar.x || normal_view == vec3(0.0))
        return open;
    vec3 ray = vec3(uv * gRayDirection.xy + gRayDirection.zw, -1.0);
    float ray_length = length(ray);
    vec3 up = -ray / ray_length;
#if BENT
    vec3 stored_view = normal_view;
#endif
    if (dot(normal_view, up) < 0.0) {
        vec2 lean = lean_of(normal_view, up);
        normal_view = seen_normal(normal_view, up, step_to(lean, map_uv, ray, distance),
                                  -step_to(-lean, map_uv, ray, distance));
    }
    vec2 noise = tile_noise();
    point p;
    p.uv = map_uv;
    p.low = center - 0.5;
    p.high = gMapSize - 0.5 - center;
    p.distance = distance;
    p.scale = orthographic() ? 1.0 : distance;
    p.per_scale = STEP / p.scale;
    p.radius = radius_at(distance);
    p.pixel = gPixel.xy / p.radius;
    p.y_per_distance = ray_length / p.radius;
    p.y_step = p.y_per_distance * depth_step(distance + p.radius);
    p.normal_view = normal_view;
    p.up_view = up;
    p.jitter = noise.y;
    float occlusion = 0.0;
    UNROLL_IF_SHORT for (int i = 0; i < SLICES; ++i) {
        occlusion += slice_occlusion(p, (noise.x + float(i)) / float(SLICES));
    }
    occlusion /= float(SLICES);
    float share = 1.0 - far_fade(distance) * occlusion;
#if BENT
    vec3 hidden = far_fade(distance) * hidden_vector / float(SLICES);
#if STEPS < 12
    hidden *= (1.0 - accessibility_from(share, CALIBRATION)) / max(1.0 - share, 1e-4); // it grows as the occlusion does
#endif
    // It is taken off the stored normal later, which may be that of the other side.
    hidden += (2.0 / 3.0) * (stored_view - normal_view);
    hidden = clamp(hidden * HIDDEN_STEPS, -2047.0, 2047.0);
#endif
#if OUTPUT == OUTPUT_SUM && BENT
    return vec4(accessibility_from(share, CALIBRATION), hidden);
#elif OUTPUT == OUTPUT_SUM
    return gAccumulation.xy * accessibility_from(share, CALIBRATION);
#else
    float accessibility = accessibility_from(share, CALIBRATION * gPower);
#if BENT
    return ambient(vec4(accessibility, hidden), linear, code);
#else
    return ambient(accessibility, linear, code);
#endif
#endif
}
