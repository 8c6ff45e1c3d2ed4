// SPDX-License-Identifier: MIT
// The entry points of a pass that can be drawn or dispatched. The value of result() goes into the framebuffer or, with
// COMPUTE 1, into an image, for each pixel of gRegion. OUTPUT_BENT: accessibility goes there, and the bent normal with
// accessibility into a second one. A pass that defines PREPARE has all invocations of a work group run that first.

#if COMPUTE
layout(local_size_x = GROUP_X, local_size_y = GROUP_Y) in;
#ifndef TARGET
#define TARGET image2D
#endif
#ifndef PREPARE
#define PREPARE
#endif
writeonly uniform TARGET u_target;

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

uvec4 texel(uvec2 result)
{
    return uvec4(result, 0u, 1u);
}

#if OUTPUT == OUTPUT_BENT
writeonly uniform image2D u_bent_target;
#endif

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    PREPARE;
    if (any(greaterThanEqual(pixel, gRegion.zw)))
        return;
    RESULT value = result();
#if OUTPUT == OUTPUT_BENT
    imageStore(u_target, pixel + gRegion.xy, value.xxxx);
    imageStore(u_bent_target, pixel + gRegion.xy, vec4(normalize(value.yzw), value.x));
#else
    imageStore(u_target, pixel + gRegion.xy, texel(value));
#endif
}
#elif OUTPUT == OUTPUT_BENT
layout(location = 0) out float o_accessibility;
layout(location = 1) out vec4 o_bent_normal;

void main()
{
    RESULT value = result();
    o_accessibility = value.x;
    o_bent_normal = vec4(normalize(value.yzw), value.x);
}
#else
out RESULT o_result;

void main()
{
    o_result = result();
}
#endif
