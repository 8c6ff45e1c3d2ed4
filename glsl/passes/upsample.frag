// SPDX-License-Identifier: MIT
// Upsampling (shared/upsample.glsl) of the four full-size pixels that have a half-size texel as their lower left. They share
// most fetches and decisions. spread.frag lays them out. RAW 1: for the history, which finds its value in a block itself; the
// lower left pixel is the one that was estimated.
// in  u_ambient_map    paired values, half size; point sampled, clamped
// out o_accessibility  of the lower left, lower right, upper left and upper right pixel
// out o_bent_normals   BENT 1: theirs, packed (shared/octahedral.glsl)

uniform sampler2D u_ambient_map;
layout(location = 0) out vec4 o_accessibility;
#if BENT
layout(location = 1) out vec4 o_bent_normals;
#endif

PAIRED paired_at(vec2 uv)
{
    return PAIRED(textureLod(u_ambient_map, uv, 0.0));
}

void main()
{
    vec2 uv = pixel_uv();
    vec2 next = uv + gInvRenderTargetSize;
    PAIRED a = paired_at(uv);
    PAIRED b = paired_at(vec2(next.x, uv.y));
    PAIRED c = paired_at(vec2(uv.x, next.y));
    PAIRED d = paired_at(next);
#if RAW
    fetch_corner_raws(ivec2(pixel_center()));
    vec2 full_uv = (2.0 * pixel_center() - 0.5 + gPick) * gFullTexel;
#else
    vec2 full_uv = (2.0 * pixel_center() - 0.5) * gFullTexel;
#endif
    block four = upsampled_block(a, b, c, d, full_uv);
#if BENT
    o_accessibility = vec4(four.lower_left.x, four.lower_right.x, four.upper_left.x, four.upper_right.x);
    o_bent_normals = vec4(packed_direction(four.lower_left.yzw), packed_direction(four.lower_right.yzw),
                          packed_direction(four.upper_left.yzw), packed_direction(four.upper_right.yzw));
#else
    o_accessibility = vec4(four.lower_left, four.lower_right, four.upper_left, four.upper_right);
#endif
}
