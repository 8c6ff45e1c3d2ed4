// SPDX-License-Identifier: MIT
// Bounds of one row of texels of a tile: the first of the passes that sort tiles.
// in  u_distance_map, or u_depth_map where FROM_DEPTH is 1; fetched
// in  u_normal_map  view space, fetched (PLANES 1)
// out o_bounds      x: distance of the nearest occluder, y: of the farthest surface (scene units; 0: no surface),
//                   z: how far the row is from lying in one plane: the greatest sine of the angle between the plane of the
//                   tile's middle and a step from texel to texel, or between the plane's normal and a texel's; 1: no plane

out vec4 o_bounds;

void main()
{
    ivec2 last = map_size() - 1;
    ivec2 cell = ivec2(gl_FragCoord.xy), tile = cell / rows_side();
    cell -= tile * rows_side();
    int y = min(tile.y * tile_side() + cell.y * rows_side() + cell.x, last.y); // rows beyond the tile or the map are not read
    int left = tile.x * tile_side();
    int right = min(left + tile_side(), last.x + 1);
    vec2 bounds = vec2(FAR_AWAY, 0.0);
    vec2 own = distances_at(ivec2(left, y));
#if PLANES
    // The height of a texel over the parallel plane through the eye is the share of its origin plus that of its ray times
    // the distance. Both are linear across the picture.
    vec3 plane = normal_at(middle_of_tile(tile));
    vec2 uv = uv_at(vec2(left, y));
    vec2 texel_uv = uv_at(vec2(left + 1, y + 1)) - uv;
    vec2 origin_step = plane.xy * gRayOrigin.xy * texel_uv;
    vec2 ray_step = plane.xy * gRayDirection.xy * texel_uv;
    float origin = dot(plane.xy, uv * gRayOrigin.xy + gRayOrigin.zw);
    float along = dot(plane, ray_at(uv));
    bool has_upper = y < last.y;
    float rise = 0.0;
    float turn = 0.0;
    float gaps = 0.0;
#endif
    for (int x = left; x < right; ++x) {
        vec2 after = distances_at(ivec2(min(x + 1, last.x), y));
        bounds = vec2(min(bounds.x, own.x), max(bounds.y, own.y));
#if PLANES
        float upper = distances_at(ivec2(x, min(y + 1, last.y))).y;
        vec3 deviation = normal_at(ivec2(x, y)) - plane;
        turn = max(turn, dot(deviation, deviation));
        float height = origin + along * own.y;
        float upper_height = origin + origin_step.y + (along + ray_step.y) * upper;
        float upper_rise = upper > 0.0 && has_upper ? abs(upper_height - height) : 0.0;
        origin += origin_step.x;
        along += ray_step.x;
        float right_height = origin + along * after.y;
        float right_rise = after.y > 0.0 && x < last.x ? abs(right_height - height) : 0.0;
        rise = max(rise, max(upper_rise, right_rise) / (orthographic() ? 1.0 : own.y));
        gaps = own.y > 0.0 ? gaps : 1.0;
#endif
        own = after;
    }
    float off = 0.0;
#if PLANES
    // The shortest way from the ray of a texel to that of the next, over the distance.
    vec2 texel = texel_view();
    vec3 widest = max(abs(ray_at(uv)), abs(ray_at(uv + vec2(float(tile_side()), 0.0) * texel_uv)));
    float shortest = min(texel.x, texel.y) / (orthographic() ? 1.0 : length(widest));
    off = min(max(max(rise / shortest, sqrt(turn)), gaps), 1.0);
#endif
    o_bounds = vec4(bounds, off, 0.0);
}
