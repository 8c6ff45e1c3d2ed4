// SPDX-License-Identifier: MIT
// Which tiles count for one that may be open: drawn along rows, then along columns.
// in  u_ambient_map  tile_class.frag's output with MIDDLES 1, or this pass's; fetched
// out o_reach        the greatest of those that reach as far as this tile; 0: none does

uniform sampler2D u_ambient_map;
#if !FLAT
uniform int gHorizontalBlur; // 0 or 1
#endif
out float o_reach;

const int MOST = 17; // tile_class.frag's MOST_TILES and one

void main()
{
    ivec2 tile = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_ambient_map, 0) - 1;
    ivec2 way = gHorizontalBlur != 0 ? ivec2(1, 0) : ivec2(0, 1);
    float greatest = 0.0;
    for (int i = -MOST; i <= MOST; ++i) {
        ivec2 other = tile + i * way;
        float reach = other == clamp(other, ivec2(0), last) ? texelFetch(u_ambient_map, other, 0).r : 0.0;
        greatest = reach > float(abs(i)) ? max(greatest, reach) : greatest;
    }
    o_reach = greatest;
}
