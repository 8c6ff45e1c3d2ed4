// SPDX-License-Identifier: MIT
// Lays out the blocks of four pixels that upsample.frag made.
// in  u_ambient_map    half size: lower left, lower right, upper left, upper right; point sampled
// out o_accessibility  R16, full size

uniform sampler2D u_ambient_map;
out float o_accessibility;

void main()
{
    vec2 place = 0.5 * pixel_center(); // a quarter or three off a block's corner
    vec4 four = textureLod(u_ambient_map, place * gInvRenderTargetSize, 0.0);
    bvec2 odd = greaterThan(fract(place), vec2(0.5));
    vec2 row = odd.y ? four.zw : four.xy;
    o_accessibility = odd.x ? row.y : row.x;
}
