// SPDX-License-Identifier: MIT
// The host's rays as paired values, which may be missing (shared/paired.glsl). CORRECTS 1: how far the rays are from the
// technique's own estimate, as half the difference plus a half.
// in  u_rays_map     accessibility, linear; full or half size; negative or no number: no rays; fetched
// in  u_ambient_map  CORRECTS 1: paired values of the estimate; point sampled
// in  u_depth_map    stored depth, fetched
// in  u_normal_map   view space, fetched
// out result         by OUTPUT: accessibility or the paired value

#if CORRECTS
uniform sampler2D u_ambient_map;
#endif
#define RESULT AMBIENT

RESULT result()
{
    ivec2 texel = ivec2(full_texel(floor(pixel_center())));
    float depth = fetched_depth(texel);
    vec3 normal_view = normal_view_from_map(texel);
    bool is_open = is_sky(depth) || normal_view == vec3(0.0);
    float linear = is_sky(depth) ? linear_from_distance(FAR_AWAY) : linear_from_depth(depth);
    uint code = normal_code(normal_view);
    float share = rays_of(texel);
#if CORRECTS
    float estimate = accessibility_of(textureLod(u_ambient_map, pixel_uv(), 0.0).rg);
    float difference = share - pow(max(estimate, 1e-6), 1.0 / gPower);
    share = share < 0.0 || is_open ? MISSING : clamp(0.5 + 0.5 * difference, 0.0, 1.0);
#else
    share = is_open ? 1.0 : share;
#endif
    return ambient(share, linear, code);
}
