// SPDX-License-Identifier: MIT
// Marks the tiles that count for one that may be open: drawn as a square about each of those.
// out o_counts  1 as least and greatest ring, in tile_blocks.frag's code

out float o_counts;

void main()
{
    o_counts = 33.0;
}
