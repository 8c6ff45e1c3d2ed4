// SPDX-License-Identifier: MIT
// Makes the distance map, so that the passes after it fetch view distances ready-made.
// in  u_depth_map  stored depth, fetched
// out o_distance   view distance (scene units), R32F; FAR_AWAY where nothing was drawn

out float o_distance;

void main()
{
    float depth = fetched_depth(ivec2(gl_FragCoord.xy) * gFactor);
    o_distance = is_sky(depth) ? FAR_AWAY : distance_from_depth(depth);
}
