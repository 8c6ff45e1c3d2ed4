// SPDX-License-Identifier: MIT
// What the passes after the estimate read of a pixel, in two floats: accessibility, whose ten lowest bits hold the normal,
// and the linear quantity of distance. PAIRED 1: the pass writes it; 0: it writes accessibility alone.
//
// The normal is kept in Lambert's azimuthal equal-area projection, in which the distance of two is about their chord. The
// one direction without a picture, straight away from the eye, no surface has that is seen.

const float NORMAL_STEP = 0.1; // of its two coordinates, -1.5 to 1.6

// A normal of any length, projected, in steps. The bounds keep one of length 0 from a division by 0.
vec2 projected_normal(vec3 normal)
{
    PRECISE float length_squared = dot(normal, normal);
    length_squared = max(length_squared, 1e-30);
    PRECISE float scale = inversesqrt(max(0.5 * (length_squared + normal.z * ROOT(length_squared)), 1e-30));
    PRECISE vec2 steps = normal.xy * (scale / NORMAL_STEP);
    return steps;
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

// The middle of the code's step.
vec2 projected_normal(uint code)
{
    return vec2(ivec2(code >> 5, code & 31u)) - 15.0;
}

float accessibility_of(vec2 paired)
{
    return uintBitsToFloat(floatBitsToUint(paired.x) & ~1023u);
}

// Rounded to the 13 bits left, 4 steps of R16 about 1. The floor, which R16 rounds to 0, keeps the bits from being those
// of a denormal number, which drivers may flush.
vec2 paired(float accessibility, float linear, uint code)
{
    uint bits = floatBitsToUint(max(accessibility, 2e-6)) + 512u;
    return vec2(uintBitsToFloat((bits & ~1023u) | code), linear);
}

#if PAIRED
#define AMBIENT vec2
vec2 ambient(float accessibility, float linear, uint code)
{
    return paired(accessibility, linear, code);
}
#else
#define AMBIENT float
float ambient(float accessibility, float linear, uint code)
{
    return accessibility;
}
#endif

// Chord of two unit normals that belong to different sides of a crease, 41 degrees; found by experiment.
const float CHORD = 0.69;

// Whether a surface turns away from the eye toward a neighbour in the picture: by how many steps its projected normal changes
// on the way, and where the neighbour lies. In a hollow both sides darken, and smoothing over it does no harm.
bool turns_away(vec2 change, vec2 way)
{
    const float STEPS_APART = CHORD / NORMAL_STEP;
    return dot(change, change) > STEPS_APART * STEPS_APART && dot(change, way) > 0.0;
}
