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
    int first = int(gl_FragCoord.y) * side;
    int last = min(first + side, textureSize(u_ambient_map, 0).y);
    vec3 bounds = vec3(FAR_AWAY, 0.0, 0.0);
    for (int y = first; y < last; ++y) {
        vec3 row = texelFetch(u_ambient_map, ivec2(int(gl_FragCoord.x), y), 0).xyz;
        bounds = vec3(min(bounds.x, row.x), max(bounds.yz, row.yz));
    }
#if PLANES
    bool counts = texelFetch(u_near_map, ivec2(gl_FragCoord.xy), 0).r > 0.0;
    bounds = counts ? bounds : vec3(0.0, FAR_AWAY, 1.0);
#endif
    o_bounds = vec4(bounds, 0.0);
}
