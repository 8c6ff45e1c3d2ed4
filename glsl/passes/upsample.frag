// SPDX-License-Identifier: MIT
// Upsampling (shared/upsample.glsl) of the four full-size pixels that have a half-size texel as their lower left. They share
// most fetches and decisions. spread.frag lays them out.
// in  u_ambient_map    paired values, half size; point sampled, clamped
// out o_accessibility  of the lower left, lower right, upper left and upper right pixel

uniform sampler2D u_ambient_map;
out vec4 o_accessibility;

vec2 paired_at(vec2 uv)
{
    return textureLod(u_ambient_map, uv, 0.0).rg;
}

void main()
{
    vec2 uv = pixel_uv();
    vec2 next = uv + gInvRenderTargetSize;
    vec2 a = paired_at(uv);
    vec2 b = paired_at(vec2(next.x, uv.y));
    vec2 c = paired_at(vec2(uv.x, next.y));
    vec2 d = paired_at(next);
    vec2 full_uv = (2.0 * pixel_center() - 0.5) * gFullTexel;
    o_accessibility = upsampled_block(a, b, c, d, full_uv);
}
