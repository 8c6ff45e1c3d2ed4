// SPDX-License-Identifier: MIT
// A half-size result brought to full size, see upsample.glsl.
// in  u_ambient_map    paired map, half size; point sampled, clamped
// out result           accessibility, R16, full size

uniform sampler2D u_ambient_map;
#define RESULT float

RESULT result()
{
    vec2 pixel = pixel_center() - 0.5;
    // A half-size texel stands for the full-size texel of twice its index: odd pixels lie midway between two, and where
    // a coordinate is even, both are the same, so that the mean of the four is the linear interpolation.
    vec2 half_pixel = floor(0.5 * pixel);
    vec2 odd = pixel - 2.0 * half_pixel;
    vec2 uv_a = (half_pixel + 0.5) * gInvRenderTargetSize;
    vec2 uv_d = uv_a + odd * gInvRenderTargetSize;
    vec2 a = textureLod(u_ambient_map, uv_a, 0.0).rg;
    vec2 b = textureLod(u_ambient_map, vec2(uv_d.x, uv_a.y), 0.0).rg;
    vec2 c = textureLod(u_ambient_map, vec2(uv_a.x, uv_d.y), 0.0).rg;
    vec2 d = textureLod(u_ambient_map, uv_d, 0.0).rg;
    return upsampled(a, b, c, d, odd, pixel_center() / vec2(textureSize(u_depth_map, 0)));
}
