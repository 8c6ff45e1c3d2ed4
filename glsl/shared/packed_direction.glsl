// SPDX-License-Identifier: MIT
// A unit vector as one whole number of two: its octahedral coordinates, for a map that holds four of them a texel.
const float OCTAHEDRAL_STEPS = 2047.0;

float packed_direction(vec3 direction)
{
    vec2 square = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    vec2 side = vec2(square.x >= 0.0 ? 1.0 : -1.0, square.y >= 0.0 ? 1.0 : -1.0);
    square = roundEven(OCTAHEDRAL_STEPS * (direction.z >= 0.0 ? square : (1.0 - abs(square.yx)) * side));
    return 4096.0 * square.x + square.y;
}

vec3 unpacked_direction(float whole)
{
    float x = roundEven(whole * (1.0 / 4096.0));
    vec2 square = vec2(x, whole - 4096.0 * x) / OCTAHEDRAL_STEPS;
    float z = 1.0 - abs(square.x) - abs(square.y);
    vec2 side = vec2(square.x >= 0.0 ? 1.0 : -1.0, square.y >= 0.0 ? 1.0 : -1.0);
    return normalize(vec3(z >= 0.0 ? square : (1.0 - abs(square.yx)) * side, z));
}
