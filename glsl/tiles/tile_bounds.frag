// SPDX-License-Identifier: MIT
// Bounds of a tile from those of its rows.
// in  u_ambient_map  output of tile_rows.frag; fetched
// out o_bounds       the same, of the whole tile

uniform sampler2D u_ambient_map;
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
    o_bounds = vec4(bounds, 0.0);
}
