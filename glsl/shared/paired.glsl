// SPDX-License-Identifier: MIT
// The paired value of a pixel, which the passes after the estimate read: accessibility, whose ten lowest bits hold the
// normal, and the linear quantity of distance. OUTPUT: whether a pass writes it or accessibility alone.
//
// The normal is kept in Lambert's azimuthal equal-area projection, where the distance of two normals is about their chord.
// The projection has no image for the direction straight away from the eye, which no visible surface has.

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

// Accessibility is rounded to the 13 bits that are left, about 4 steps of R16 near 1. The floor, which R16 rounds to 0,
// avoids denormal numbers, which drivers may flush.
// RAYS: the value comes from the host's rays. It may be missing, which any negative number means.
#define MISSING (-1.0)

vec2 paired(float accessibility, float linear, uint code)
{
#if RAYS
    if (accessibility < 0.0)
        return vec2(uintBitsToFloat(floatBitsToUint(MISSING) | code), linear);
#endif
    uint bits = floatBitsToUint(max(accessibility, 2e-6)) + 512u;
    return vec2(uintBitsToFloat((bits & ~1023u) | code), linear);
}

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

#if OUTPUT == OUTPUT_PAIRED
#define AMBIENT vec2
vec2 ambient(float accessibility, float linear, uint code)
{
    return paired(finished(accessibility), linear, code);
}
#else
#define AMBIENT float
float ambient(float accessibility, float linear, uint code)
{
    return finished(accessibility);
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
