// SPDX-License-Identifier: MIT
// The paired value of a pixel, which the passes after the estimate read: accessibility, whose ten lowest bits hold the
// normal, and the linear quantity of distance. BENT 1: two more channels hold the hidden vector (shared/bent.glsl): x, and y
// and z rounded, as one whole number. OUTPUT: whether a pass writes the paired value, accessibility alone, or that and the
// bent normal.
//
// The normal is kept in Lambert's azimuthal equal-area projection, where the distance of two normals is about their chord.
// The projection has no image for the direction straight away from the eye, which no visible surface has.

#if BENT
#define PAIRED vec4
#define CONTENTS vec4 // what is averaged: accessibility, and the hidden vector
const CONTENTS OPEN = vec4(1.0, 0.0, 0.0, 0.0);
#else
#define PAIRED vec2
#define CONTENTS float
const CONTENTS OPEN = 1.0;
#endif

// A normal of any length, projected, in units of NORMAL_STEP. The bounds prevent a division by 0 for one of length 0.
vec2 projected_normal(vec3 normal)
{
    float length_squared = max(dot(normal, normal), 1e-30);
    float scale = inversesqrt(max(0.5 * (length_squared + normal.z * sqrt(length_squared)), 1e-30));
    return normal.xy * (scale / NORMAL_STEP);
}

uint normal_code(vec3 normal_view)
{
    uvec2 code = uvec2(clamp(projected_normal(normal_view) + 15.5, 0.0, 31.0));
    return code.x << 5 | code.y;
}

uint normal_code(vec2 paired)
{
    return floatBitsToUint(paired.x) & 1023u;
}

// The middle of the step that the code stands for.
vec2 projected_normal(uint code)
{
    return vec2(ivec2(code >> 5, code & 31u)) - 15.0;
}

float accessibility_of(vec2 paired)
{
    return uintBitsToFloat(floatBitsToUint(paired.x) & ~1023u);
}

// Accessibility is rounded to the 13 bits that are left, about 4 steps of R16 near 1. An estimate may be below 0
// (passes/horizon.frag); what is blurred is not. 2e-6, which R16 rounds to 0, avoids denormal numbers, which drivers may flush.
// RAYS: the value comes from the host's rays. It may be missing, and is linear.

vec2 paired_accessibility(float accessibility, float linear, uint code)
{
#if RAYS
    if (accessibility < 0.0)
        return vec2(uintBitsToFloat(floatBitsToUint(MISSING) | code), linear);
#endif
    uint bits = floatBitsToUint(abs(accessibility) < 2e-6 ? 2e-6 : accessibility) + 512u;
    return vec2(uintBitsToFloat((bits & ~1023u) | code), linear);
}

#if BENT
uint normal_code(PAIRED paired)
{
    return normal_code(paired.xy);
}

float accessibility_of(PAIRED paired)
{
    return accessibility_of(paired.xy);
}

PAIRED paired(CONTENTS contents, float linear, uint code)
{
    vec2 yz = roundEven(contents.zw);
    return vec4(paired_accessibility(contents.x, linear, code), contents.y, 4096.0 * yz.x + yz.y);
}

CONTENTS contents_of(PAIRED paired)
{
    float y = roundEven(paired.w * (1.0 / 4096.0));
    return vec4(accessibility_of(paired), paired.z, y, paired.w - 4096.0 * y);
}

float accessibility_in(CONTENTS contents)
{
    return contents.x;
}

// Whether both have the same contents, so that averaging them changes nothing.
bool is_same(PAIRED a, PAIRED b)
{
    return a.xzw == b.xzw;
}

// Whether something may occlude the pixel.
bool is_shaded(PAIRED paired)
{
    return paired.x < 1.0 || paired.zw != vec2(0.0);
}

// The weighted sum of the contents of four pixels.
CONTENTS weighted(vec4 weights, PAIRED a, PAIRED b, PAIRED c, PAIRED d)
{
    return weights.x * contents_of(a) + weights.y * contents_of(b) + weights.z * contents_of(c) +
           weights.w * contents_of(d);
}
#else
PAIRED paired(CONTENTS contents, float linear, uint code)
{
    return paired_accessibility(contents, linear, code);
}

CONTENTS contents_of(PAIRED paired)
{
    return accessibility_of(paired);
}

float accessibility_in(CONTENTS contents)
{
    return contents;
}

bool is_same(PAIRED a, PAIRED b)
{
    return a.x == b.x;
}

bool is_shaded(PAIRED paired)
{
    return paired.x < 1.0; // the bits of the normal only add to 1
}

CONTENTS weighted(vec4 weights, PAIRED a, PAIRED b, PAIRED c, PAIRED d)
{
    return dot(weights, vec4(accessibility_of(a), accessibility_of(b), accessibility_of(c), accessibility_of(d)));
}
#endif

// RAYS 2: the last pass that may find no value. Pixels that no ray tells anything about count as open. The power waits until
// here, because it would change what a blur averages.
float finished(float accessibility)
{
#if RAYS == 2
    return accessibility < 0.0 ? 1.0 : pow(accessibility, gPower);
#else
    return accessibility;
#endif
}

#if BENT
CONTENTS finished(CONTENTS contents)
{
    return vec4(finished(contents.x), contents.yzw);
}
#endif

#if OUTPUT == OUTPUT_PAIRED
#define AMBIENT PAIRED
AMBIENT ambient(CONTENTS contents, float linear, uint code)
{
    return paired(finished(contents), linear, code);
}
#elif OUTPUT == OUTPUT_BENT
#define AMBIENT vec4
AMBIENT ambient(CONTENTS contents, float linear, uint code)
{
    vec2 full_uv = (floor(pixel_center()) * float(gFactor) + 0.5) * gFullTexel;
    return delivered(finished(contents), is_far(linear), normal_view_at_uv(full_uv));
}
#else
#define AMBIENT float
AMBIENT ambient(float accessibility, float linear, uint code)
{
    return finished(accessibility);
}
#endif

#if RAW
// Estimate and blurred estimate as one number of 24 bits over 2^24, which a float holds exactly: 1 to 4095 each, 0 where the
// value is missing. Two open ones are 1.
float packed_pair(vec2 pair)
{
    vec2 codes = floor(clamp(pair, 0.0, 1.0) * 4094.0 + 1.5);
#if RAYS
    codes = mix(codes, vec2(0.0), lessThan(pair, vec2(0.0)));
#endif
    return (4096.0 * codes.x + codes.y + 1.0) * (1.0 / 16777216.0);
}

vec2 unpacked_pair(float packed_values)
{
    float whole = packed_values * 16777216.0 - 1.0;
    float high = floor(whole * (1.0 / 4096.0));
    vec2 codes = vec2(high, whole - 4096.0 * high);
#if RAYS
    return mix((codes - 1.0) * (1.0 / 4094.0), vec2(MISSING), equal(codes, vec2(0.0)));
#else
    return (codes - 1.0) * (1.0 / 4094.0);
#endif
}
#endif

// Whether the surface turns away from the eye between a pixel and a neighbour. `change`: of the projected normal on the way,
// in units of NORMAL_STEP; `way`: where the neighbour lies. In a hollow both sides darken, and smoothing over it does no
// harm.
bool turns_away(vec2 change, vec2 way)
{
    const float STEPS_APART = CHORD / NORMAL_STEP;
    return dot(change, change) > STEPS_APART * STEPS_APART && dot(change, way) > 0.0;
}
