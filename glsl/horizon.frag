// SPDX-License-Identifier: MIT
// The horizon estimate: cosine-weighted visibility, slice by slice (J. Jimenez et al., "Practical Realtime Strategies for
// Accurate Indirect Occlusion", 2016), gathered in a mask of sectors (O. Therrien et al., "Screen Space Indirect Lighting
// with Visibility Bitmask", 2023) that are of equal cosine-weighted measure here. An occluder is taken to be as thick as
// it is wide along the slice, and each sample is cut by the sphere of the radius, as the traced truth is.
// in  u_normal_map     view space, fetched
// in  u_distance_map   view distance at the estimate's size, fetched
// in  u_depth_map      bound for its size alone
// out o_ambient       accessibility, and the linear quantity of distance

out vec2 o_ambient;

#if STEPS_8
const int STEPS = 8;
#define EACH_STEP(f) f(0) f(1) f(2) f(3) f(4) f(5) f(6) f(7)
#define EACH_STEP_BACK(f) f(7) f(6) f(5) f(4) f(3) f(2) f(1) f(0)
#else
const int STEPS = 6;
#define EACH_STEP(f) f(0) f(1) f(2) f(3) f(4) f(5)
#define EACH_STEP_BACK(f) f(5) f(4) f(3) f(2) f(1) f(0)
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

const float JUMP = 0.4;
const float OPEN_END = 1.25;
const float CAP_BASE = 0.2;
const float CAP_SLOPE = 1.5;
const float VEIL = 0.15;
const float CALIBRATION = 1.1;

uint count_bits(uint mask)
{
    mask -= (mask >> 1) & 0x55555555u;
    mask = (mask & 0x33333333u) + ((mask >> 2) & 0x33333333u);
    return (((mask + (mask >> 4)) & 0x0F0F0F0Fu) * 0x01010101u) >> 24;
}

struct slice_frame {
    vec2 center; // pixels
    vec2 a, e;
    float level, center_distance;
    float jitter;
};

vec2 map_size;
vec2 inverse_size;
float center_scale;

vec2 sample_at(slice_frame f, vec2 step_px, float along, out float scale)
{
    vec2 texel = clamp(floor(f.center + along * step_px), vec2(0.0), map_size - 1.0);
    float distance = textureLod(u_distance_map, (texel + 0.5) * inverse_size, 0.0).r;
    vec2 offset = texel + 0.5 - f.center;
    float s = gRayDirection.x == 0.0 ? 1.0 : distance;
    scale = s * center_scale;
    return vec2(s * dot(offset, f.a), f.level * (f.center_distance - distance) + s * dot(offset, f.e));
}

// 0..31
float sector(vec4 m, float m5, float c)
{
    float c2 = c * c;
    return (m.y + c2 * (m.w + c2 * m5)) * c + (m.x + c2 * m.z);
}

uint hidden_sectors(vec2 p[STEPS], float scales[STEPS], float jitter, float lowest, vec4 m, float m5, bool minus, out float highest)
{
    float start[STEPS];
    float end[STEPS];
    float at = -100.0;
    float before = 0.0;
#define FORWARD(i) at = abs(p[i].y - before) > JUMP ? float(i) : at; start[i] = at; before = p[i].y;
    EACH_STEP(FORWARD)
    at = OPEN_END * float(STEPS) - 0.5 + jitter;
#define BACK(i) end[i] = at; at = abs(p[i].y - (i > 0 ? p[max(i - 1, 0)].y : 0.0)) > JUMP ? float(i) : at;
    EACH_STEP_BACK(BACK)
    uint mask = 0u;
    highest = lowest;
#define GATHER(i) { \
        float x = p[i].x, y = p[i].y; \
        float thickness = (end[i] - start[i]) * scales[i]; \
        float x2 = x * x + 1e-12; \
        float chord = sqrt(max(1.0 - x2, 0.0)); \
        float top = min(y, chord); \
        float bottom = max(y - thickness, -chord); \
        float cos_top = x > 0.0 && x < 1.0 ? max(top * inversesqrt(x2 + top * top), lowest) : lowest; \
        float cos_bottom = clamp(bottom * inversesqrt(x2 + bottom * bottom), lowest, cos_top); \
        highest = max(highest, cos_top); \
        uint near = uint(sector(m, m5, cos_top)); \
        uint far = uint(sector(m, m5, cos_bottom)); \
        mask |= minus ? (1u << near) - (1u << far) : (1u << far) - (1u << near); \
    }
    EACH_STEP(GATHER)
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

vec4 side_measure(float cos_g, float sin_g)
{
    return vec4(0.5 * (cos_g + sin_g * 1.5707963), -0.5 * sin_g * 1.98868, -0.5 * cos_g, 0.5 * sin_g * 0.25869);
}

float measured(vec4 m, float m5, float c)
{
    float c2 = c * c;
    return (m.y + c2 * (m.w + c2 * m5)) * c + (m.x + c2 * m.z);
}

float exit_at(vec2 center, vec2 step_px, vec2 size)
{
    vec2 room = mix(center - 0.5, size - 0.5 - center, greaterThan(step_px, vec2(0.0)));
    vec2 t = room / max(abs(step_px), 1e-6);
    return min(t.x, t.y);
}

float slice_occlusion(int slice, slice_frame f, vec3 normal_view, vec3 up, vec2 px, vec2 noise)
{
    float angle_rad = PI * (noise.x + float(slice)) / float(SLICES);
    vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
    vec2 step_px = gOcclusionRadius * direction / px * (center_scale * float(STEPS));
    step_px = clamp(step_px, -1e5, 1e5);
    vec3 along = vec3(direction, 0.0);
    along = normalize(along - up * dot(along, up));
    vec3 across = cross(up, along);
    float normal_up = max(dot(normal_view, up), 0.0);
    float normal_along = dot(normal_view, along);
    float slope = clamp(dot(normal_view, across) / max(normal_up, 1e-3), -40.0, 40.0);
    f.a = px * along.xy / gOcclusionRadius;
    f.e = px * (up.xy + slope * across.xy) / gOcclusionRadius;
    float projected = sqrt(max(normal_along * normal_along + normal_up * normal_up, 1e-12));
    float cos_g = normal_up / projected;
    float sin_g = normal_along / projected;
    vec4 plus_m = side_measure(cos_g, sin_g);
    float plus_m5 = 0.5 * sin_g * 0.15521;
    vec4 minus_m = side_measure(cos_g, -sin_g);
    float total_plus = measured(plus_m, plus_m5, -sin_g);
    float total_minus = measured(minus_m, -plus_m5, sin_g);
    float total = max(total_plus + total_minus, 1e-6);
    float scale = SECTORS / total;
    vec2 plus[STEPS];
    vec2 minus[STEPS];
    float plus_scale[STEPS];
    float minus_scale[STEPS];
    float plus_exit = exit_at(f.center, step_px, map_size);
    float minus_exit = -exit_at(f.center, -step_px, map_size);
#define SAMPLE(i) { \
    float at = (float(i) + 1.0 - noise.y) / float(STEPS); \
    plus[i] = sample_at(f, step_px, at, plus_scale[i]); \
    minus[i] = sample_at(f, step_px, -at, minus_scale[i]); \
    minus[i].x = -minus[i].x; }
    EACH_STEP(SAMPLE)
    float offset = total_minus * scale + 0.5;
    float high_plus, high_minus;
    uint mask = hidden_sectors(plus, plus_scale, noise.y, -sin_g, plus_m * scale + vec4(offset, 0.0, 0.0, 0.0), plus_m5 * scale, false, high_plus) |
                hidden_sectors(minus, minus_scale, noise.y, sin_g, -minus_m * scale + vec4(offset, 0.0, 0.0, 0.0), plus_m5 * scale, true, high_minus);
    float veiled = total - measured(plus_m, plus_m5, high_plus) - measured(minus_m, -plus_m5, high_minus);
    return projected * mix(total * float(count_bits(mask)) / SECTORS, veiled, VEIL);
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec2 uv = uv_from_texel(texel * gFactor);
    vec3 normal_view = normal_view_at_uv(uv);
    float distance = textureLod(u_distance_map, gl_FragCoord.xy / vec2(textureSize(u_distance_map, 0)), 0.0).r;
    // Sky has no surface, and a point without a normal has no hemisphere: nothing there to occlude.
    o_ambient = vec2(1.0, linear_from_distance(distance));
    if (distance >= FAR_AWAY || normal_view == vec3(0.0))
        return;
    map_size = vec2(textureSize(u_distance_map, 0));
    inverse_size = 1.0 / map_size;
    vec3 ray = vec3(uv * gRayDirection.xy + gRayDirection.zw, -1.0);
    float ray_length = length(ray);
    vec3 up = -ray / ray_length;
    bool is_orthographic = orthographic();
    vec2 uv_per_px = float(gFactor) / vec2(textureSize(u_depth_map, 0));
    vec2 px = uv_per_px * (is_orthographic ? gRayOrigin.xy : gRayDirection.xy);
    center_scale = (is_orthographic ? 1.0 : 1.0 / distance) / float(STEPS);
    slice_frame f;
    f.center = vec2(texel) + 0.5;
    f.center_distance = distance;
    f.level = ray_length / gOcclusionRadius;
    vec2 noise = tile_noise();
    f.jitter = noise.y;
    float occlusion = slice_occlusion(0, f, normal_view, up, px, noise);
#if SLICES_2 || SLICES_4
    occlusion += slice_occlusion(1, f, normal_view, up, px, noise);
#endif
#if SLICES_4
    occlusion += slice_occlusion(2, f, normal_view, up, px, noise);
    occlusion += slice_occlusion(3, f, normal_view, up, px, noise);
#endif
    // pow() is undefined for a base of 0 with power 0, and for the negative that rounding can leave.
    o_ambient.x = clamp(pow(max(1.0 - occlusion / float(SLICES), 1e-6), CALIBRATION * gPower), 0.0, 1.0);
}
