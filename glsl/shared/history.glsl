// SPDX-License-Identifier: MIT
// A texel of the history, which passes from frame to frame at full size: two words of fields, from the highest bits down.
//   x  20 bits  the linear quantity of distance: bits 9 to 28 of the float, 6 of them of the exponent
//       6 bits  the frames that count; 0: nothing is known
//       6 bits  by how much frames lately differed from the second mean: 32 + 31 for LATELY_MOST
//   y  11 bits  accessibility: the mean of the frames that count
//      11 bits  accessibility: the mean of what the blur left of them
//      10 bits  the normal's code

const float LATELY_MOST = 0.25;
const float MEAN_STEPS = 2047.0;

// Numbers of up to 31 bits. A software rasteriser converts signed ones faster.
vec4 floats(uvec4 numbers)
{
    return vec4(ivec4(numbers));
}

// The linear quantity of four texels: that within a factor of 2^32 of `near`.
vec4 linear_of(uvec4 words, float near)
{
    int base = int(floatBitsToUint(near) >> 9);
    return intBitsToFloat((base + ((ivec4(words >> 12) - base) << 12 >> 12)) << 9);
}

vec4 frames_of(uvec4 words)
{
    return floats((words >> 6) & 63u);
}

// The quantity changes by less than 2^-15 of itself. Means and changes are rounded up or down from frame to frame by turns, so
// that what is less than a step adds up.
uvec2 history_texel(vec2 means, float change, float linear, float frames, uint code)
{
    uint distance_bits = (floatBitsToUint(linear) + 256u) >> 9;
    uint lately = uint(int(32.0 + 31.0 * clamp(change * (1.0 / LATELY_MOST), -1.0, 1.0) + gNoise.x));
    uvec2 steps = uvec2(ivec2(clamp(means, 0.0, 1.0) * MEAN_STEPS + gNoise));
    return uvec2(distance_bits << 12 | uint(int(frames)) << 6 | min(lately, 63u), steps.x << 21 | steps.y << 10 | code);
}
