// SPDX-License-Identifier: MIT
// Makes the distance map, so that the passes after it fetch view distances ready-made.
// in  u_depth_map  stored depth, point sampled
// out o_distance   view distance (scene units), R32F; FAR_AWAY where nothing was drawn

out float o_distance;

void main()
{
    vec2 texel = floor(gl_FragCoord.xy) * float(gFactor);
    float depth = depth_component(textureLod(u_depth_map, (texel + 0.5) / vec2(textureSize(u_depth_map, 0)), 0.0));
    o_distance = is_sky(depth) ? FAR_AWAY : distance_from_depth(depth);
}
