// SPDX-License-Identifier: MIT
// Bounds of a tile from those of its rows.
// in  u_ambient_map  output of tile_rows.frag; fetched
// in  u_near_map     tile_near.frag's output; fetched (PLANES 1)
// out o_bounds       the same, of the whole tile; bounds that leave nothing open for a tile that counts for no open one

uniform sampler2D u_ambient_map;
#if PLANES
uniform sampler2D u_near_map;
#endif
out vec4 o_bounds;

void main()
{
    int side = tile_side();
    ivec2 tile = ivec2(gl_FragCoord.xy);
    int rows = min(side, map_size().y - tile.y * side);
    vec3 bounds = vec3(FAR_AWAY, 0.0, 0.0);
#if PLANES
    bool counts = texelFetch(u_near_map, tile, 0).r > 0.0;
    bounds = counts ? bounds : vec3(0.0, FAR_AWAY, 1.0);
    rows = counts ? rows : 0;
#endif
    for (int i = 0; i < rows; ++i) {
        ivec2 cell = tile * rows_side() + ivec2(i % rows_side(), i / rows_side());
        vec3 row = texelFetch(u_ambient_map, cell, 0).xyz;
        bounds = vec3(min(bounds.x, row.x), max(bounds.yz, row.yz));
    }
    o_bounds = vec4(bounds, 0.0);
}
