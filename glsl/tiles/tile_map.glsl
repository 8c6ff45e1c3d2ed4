// SPDX-License-Identifier: MIT
// Functions shared by the passes that sort tiles. A tile is gTiles.x pixels of the estimate wide and high. FROM_DEPTH 1: the
// estimate looks occluders up in the full-size depth map, so all of its texels count; 0: in the distance map. PLANES 1: tiles
// that lie in a plane are open too.

uniform sampler2D u_distance_map;

// The size of the map that occluders are looked up in.
ivec2 map_size()
{
#if FROM_DEPTH
    return textureSize(u_depth_map, 0);
#else
    return textureSize(u_distance_map, 0);
#endif
}

// The side of a tile in texels of that map.
int tile_side()
{
#if FROM_DEPTH
    return int(gTiles.x) * gFactor;
#else
    return int(gTiles.x);
#endif
}

// Rows of a tile are laid out in a square, so that a point covers those of one tile: so many along a side.
int rows_side()
{
    return tile_side() > 16 ? 6 : 4;
}

// The uv of a texel; halves mean the places between.
vec2 uv_at(vec2 texel)
{
#if FROM_DEPTH
    return (texel + 0.5) / vec2(map_size());
#else
    return (full_texel(texel) + 0.5) / vec2(textureSize(u_depth_map, 0));
#endif
}

// View xy that a texel gains, per unit of distance in perspective.
vec2 texel_view()
{
    vec2 texel_uv = uv_at(vec2(1.0)) - uv_at(vec2(0.0));
    return texel_uv * (orthographic() ? abs(gRayOrigin.xy) : abs(gRayDirection.xy));
}

vec3 ray_at(vec2 uv)
{
    return vec3(uv * gRayDirection.xy + gRayDirection.zw, -1.0);
}

// x: view distance of an occluder at the texel; y: of a surface, 0 where there is none.
vec2 distances_at(ivec2 texel)
{
#if FROM_DEPTH
    float depth = fetched_depth(texel);
    float distance = distance_from_depth(depth);
    return vec2(distance, is_sky(depth) ? 0.0 : distance);
#else
    float distance = texelFetch(u_distance_map, texel, 0).r;
    return vec2(distance, distance < FAR_AWAY ? distance : 0.0);
#endif
}

#if PLANES
vec3 normal_at(ivec2 texel)
{
#if FROM_DEPTH
    return normal_view_from_map(texel);
#else
    return normal_view_from_map(ivec2(full_texel(vec2(texel))));
#endif
}

// The texel whose normal stands for its tile.
ivec2 middle_of_tile(ivec2 tile)
{
    return min(tile * tile_side() + tile_side() / 2, map_size() - 1);
}
#endif
