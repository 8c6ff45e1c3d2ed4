// SPDX-License-Identifier: MIT
// Bounds of one row of texels of a tile; the first of the passes that sort tiles.
// in  u_distance_map, or u_depth_map where FROM_DEPTH is 1; fetched
// in  u_normal_map  view space, fetched (PLANES 1)
// out o_bounds      x: distance of the nearest occluder, y: of the farthest surface (scene units; 0: no surface),
//                   z: how far off one plane the row is: 1 where it is none, else the greatest sine of the angle between
//                   the plane of the tile's middle and a step from texel to texel, or of that to a texel's normal

out vec4 o_bounds;

void main()
{
    ivec2 size = map_size();
    ivec2 tile = ivec2(int(gl_FragCoord.x), int(gl_FragCoord.y) / tile_side());
    int left = tile.x * tile_side();
    int right = min(left + tile_side(), size.x);
    int y = int(gl_FragCoord.y);
    vec2 bounds = vec2(FAR_AWAY, 0.0);
    float off = 0.0;
#if PLANES
    vec3 plane = normal_at(middle_of_tile(tile));
    vec2 texel = texel_view();
    float step_view = min(texel.x, texel.y);
#endif
    for (int x = left; x < right; ++x) {
        vec2 distances = distances_at(ivec2(x, y));
        bounds = vec2(min(bounds.x, distances.x), max(bounds.y, distances.y));
#if PLANES
        vec2 uv = uv_at(vec2(x, y));
        vec3 ray = ray_at(uv);
        float own = dot(plane, position_view_from_uv(uv, distances.y));
        // The shortest way from one texel's ray to the next's.
        float shortest = step_view * (orthographic() ? 1.0 : distances.y) * inversesqrt(dot(ray, ray));
        vec3 deviation = normal_at(ivec2(x, y)) - plane;
        vec2 after = distances_at(min(ivec2(x + 1, y), size - 1));
        vec2 above = distances_at(min(ivec2(x, y + 1), size - 1));
        float right_height = x + 1 < size.x && after.y > 0.0 ? dot(plane, position_view_from_uv(uv_at(vec2(x + 1, y)), after.y)) : own;
        float upper_height = y + 1 < size.y && above.y > 0.0 ? dot(plane, position_view_from_uv(uv_at(vec2(x, y + 1)), above.y)) : own;
        float rise = max(abs(right_height - own), abs(upper_height - own));
        off = max(off, distances.y > 0.0 ? max(rise / shortest, length(deviation)) : 1.0);
#endif
    }
    o_bounds = vec4(bounds, min(off, 1.0), 0.0);
}
