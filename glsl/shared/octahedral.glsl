// SPDX-License-Identifier: MIT
// Directions in two numbers of -1..1: the octahedral encoding of Q. Meyer et al., "On Floating-Point Normal Vectors" (2010).
// The half that looks away from the eye is folded over the square's edges; a coordinate of 0 belongs to the positive side.

vec2 side_of(vec2 square)
{
    return vec2(square.x >= 0.0 ? 1.0 : -1.0, square.y >= 0.0 ? 1.0 : -1.0);
}

vec2 octahedral(vec3 direction)
{
    vec2 square = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    return direction.z >= 0.0 ? square : (1.0 - abs(square.yx)) * side_of(square);
}

// Not of unit length.
vec3 octahedral_direction(vec2 square)
{
    float z = 1.0 - abs(square.x) - abs(square.y);
    return vec3(z >= 0.0 ? square : (1.0 - abs(square.yx)) * side_of(square), z);
}

// The two as one whole number, for a map that holds four of them a texel.
const float OCTAHEDRAL_STEPS = 2047.0;

float packed_direction(vec3 direction)
{
    float sum = abs(direction.x) + abs(direction.y) + abs(direction.z);
    vec2 folded = direction.xy + max(-direction.z, 0.0) * side_of(direction.xy); // where z is below 0, sum - |y| is |x| - z
    vec2 square = roundEven(folded * (OCTAHEDRAL_STEPS / sum));
    return 4096.0 * square.x + square.y;
}

vec3 unpacked_direction(float whole)
{
    float x = roundEven(whole * (1.0 / 4096.0));
    vec2 square = vec2(x, whole - 4096.0 * x);
    float z = OCTAHEDRAL_STEPS - abs(square.x) - abs(square.y);
    return normalize(vec3(square + min(z, 0.0) * side_of(square), z)); // the same in whole numbers
}
