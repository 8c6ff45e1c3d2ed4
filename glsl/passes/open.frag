// SPDX-License-Identifier: MIT
// The paired value of pixels that nothing occludes, for tiles that get no estimate but whose values others read.
// FROM_DEPTH 1: from the depth map, as the classic and hemisphere estimates do; 0: from the distance map.
// in  u_distance_map  view distance at the estimate's size; point sampled (FROM_DEPTH 0)
// in  u_depth_map     stored depth, fetched (FROM_DEPTH 1)
// in  u_normal_map    view space; point sampled
// out o_paired        paired value

uniform sampler2D u_distance_map;
out PAIRED o_paired;

void main()
{
#if FROM_DEPTH
    ivec2 texel = texel_from_uv(pixel_uv());
    vec3 normal_view = normal_view_from_map(texel);
    float depth = fetched_depth(texel);
    float distance = is_sky(depth) ? FAR_AWAY : distance_from_depth(depth);
#else
    vec2 uv = (full_texel(floor(pixel_center())) + 0.5) * gFullTexel;
    vec3 normal_view = normal_view_at_uv(uv);
    float distance = textureLod(u_distance_map, pixel_uv(), 0.0).r;
#endif
    o_paired = paired(OPEN, linear_from_distance(distance), normal_code(normal_view));
}
