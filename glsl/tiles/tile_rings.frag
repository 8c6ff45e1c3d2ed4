// SPDX-License-Identifier: MIT
// The distance in tiles from each tile to the nearest one that needs an estimate, a diagonal counting as one.
// in  u_ambient_map  output of tile_class.frag; fetched
// out o_ring         that number over 16: 0 for such a tile itself, at most 1

uniform sampler2D u_ambient_map;
out float o_ring;

const int MOST = 16;

void main()
{
    ivec2 tile = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_ambient_map, 0) - 1;
    int farthest = min(int(gTileRings), MOST);
    int ring = texelFetch(u_ambient_map, tile, 0).r > 0.5 ? 0 : farthest;
    farthest = ring; // a tile that needs an estimate looks no farther
    for (int y = max(tile.y - farthest, 0); y <= min(tile.y + farthest, last.y); ++y)
        for (int x = max(tile.x - farthest, 0); x <= min(tile.x + farthest, last.x); ++x)
            if (texelFetch(u_ambient_map, ivec2(x, y), 0).r > 0.5)
                ring = min(ring, max(abs(x - tile.x), abs(y - tile.y)));
    o_ring = float(ring) / float(MOST);
}
