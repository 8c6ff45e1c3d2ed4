// SPDX-License-Identifier: MIT
// A half-size result brought to full size, see upsample.glsl: for each half-size texel the four full-size pixels that it is
// the lower left of, which share the fetches of their neighbours and most of the decisions. spread.frag lays them out.
// in  u_ambient_map    paired map, half size; point sampled, clamped
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
    vec2 full_texel = 1.0 / vec2(textureSize(u_depth_map, 0));
    vec2 full_uv = (2.0 * pixel_center() - 0.5) * full_texel;
    vec2 full_next = full_uv + full_texel;
    // The lower left pixel is the texel's own.
    bool sky = is_sky(depth_component(textureLod(u_depth_map, full_uv, 0.0)));
    o_accessibility = vec4(sky ? 1.0 : accessibility_of(a),
                           upsampled(a, b, a, b, vec2(1.0, 0.0), vec2(full_next.x, full_uv.y)),
                           upsampled(a, a, c, c, vec2(0.0, 1.0), vec2(full_uv.x, full_next.y)),
                           upsampled(a, b, c, d, vec2(1.0), full_next));
}
