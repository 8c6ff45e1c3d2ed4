// SPDX-License-Identifier: MIT
// A texel of the history, which passes from frame to frame at full size:
//   x  accessibility: the mean of the frames that count
//   y  accessibility: the mean of what the blur left of them
//   z  the linear quantity of distance
//   w  a whole number below 2^24: the normal's code (10 bits), the frames that count (6 bits; 0: nothing is known), and by how
//      much frames lately differed from y (8 bits: 128 + 127 times it)

float frames_of(vec4 texel)
{
    return floor(mod(texel.w, 65536.0) * (1.0 / 1024.0));
}

uint normal_code(vec4 texel)
{
    return uint(texel.w) & 1023u;
}

vec4 history_texel(vec2 means, float change, float linear, float frames, uint code)
{
    float lately = floor(128.5 + 127.0 * clamp(change, -1.0, 1.0));
    return vec4(means, linear, 65536.0 * lately + 1024.0 * frames + float(code));
}
