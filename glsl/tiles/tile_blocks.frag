// SPDX-License-Identifier: MIT
// Rings of a tile, of its block of 2 x 2 and of its block of 4 x 4 tiles, so that the vertex shader, which runs for each tile
// of each later pass, fetches one texel.
// in  u_ambient_map  output of tile_rings.frag; fetched
// out o_blocks       x: of the tile, y: of 2 x 2, z: of 4 x 4: 32 times the least ring plus the greatest; -32 where the map ends
//                    within the block

uniform sampler2D u_ambient_map;
out vec4 o_blocks;

const int MOST = 16;

float rings_of(ivec2 tile, int side)
{
    ivec2 first = tile / side * side, tiles = textureSize(u_ambient_map, 0);
    float least = float(MOST), greatest = 0.0;
    for (int i = 0; i < side * side; ++i) {
        float ring = float(MOST) * texelFetch(u_ambient_map, min(first + ivec2(i % side, i / side), tiles - 1), 0).r;
        least = min(least, ring);
        greatest = max(greatest, ring);
    }
    return all(lessThanEqual(first + side, tiles)) ? 32.0 * least + greatest : -32.0;
}

void main()
{
    ivec2 tile = ivec2(gl_FragCoord.xy);
    o_blocks = vec4(rings_of(tile, 1), rings_of(tile, 2), rings_of(tile, 4), 0.0);
}
