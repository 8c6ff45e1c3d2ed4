// SPDX-License-Identifier: MIT
// The distance map: view distance at the estimate's size, FAR_AWAY where nothing was drawn. Its texel t was taken from the
// full-size texel gFactor * t.

uniform sampler2D u_distance_map;

float mapped_distance(ivec2 texel)
{
    return texelFetch(u_distance_map, texel, 0).r;
}

vec3 position_view_from_map(ivec2 texel, float distance)
{
    return position_view_from_uv(uv_from_texel(texel * gFactor), distance);
}
