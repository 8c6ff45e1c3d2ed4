// SPDX-License-Identifier: MIT
// The entry points of a pass that can be drawn or dispatched. The value of result() goes into the framebuffer or, with
// COMPUTE 1, into an image, for each pixel of gRegion.

#if COMPUTE
layout(local_size_x = GROUP_X, local_size_y = GROUP_Y) in;
writeonly uniform image2D u_target;

vec4 texel(float result)
{
    return vec4(result, 0.0, 0.0, 1.0);
}

vec4 texel(vec2 result)
{
    return vec4(result, 0.0, 1.0);
}

vec4 texel(vec4 result)
{
    return result;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, gRegion.zw)))
        imageStore(u_target, pixel + gRegion.xy, texel(result()));
}
#else
out RESULT o_result;

void main()
{
    o_result = result();
}
#endif
