// SPDX-License-Identifier: MIT
// Lays out the blocks of four pixels that upsample.frag made.
// in  u_ambient_map    half size: lower left, lower right, upper left, upper right; point sampled
// in  u_bent_map       BENT 1: their bent normals, packed (shared/octahedral.glsl); point sampled
// out o_accessibility  R16, full size
// out o_bent_normal    BENT 1: bent normal and accessibility, full size

uniform sampler2D u_ambient_map;
layout(location = 0) out float o_accessibility;
#if BENT
uniform sampler2D u_bent_map;
layout(location = 1) out vec4 o_bent_normal;
#endif

float spread(vec4 four, bvec2 odd)
{
    vec2 row = odd.y ? four.zw : four.xy;
    return odd.x ? row.y : row.x;
}

void main()
{
    vec2 place = 0.5 * pixel_center(); // a quarter or three off a block's corner
    vec2 uv = place * gInvRenderTargetSize;
    bvec2 odd = greaterThan(fract(place), vec2(0.5));
    o_accessibility = spread(textureLod(u_ambient_map, uv, 0.0), odd);
#if BENT
    o_bent_normal = vec4(unpacked_direction(spread(textureLod(u_bent_map, uv, 0.0), odd)), o_accessibility);
#endif
}
