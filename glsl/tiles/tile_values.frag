// SPDX-License-Identifier: MIT
// Whether a tile holds any occlusion: a blocked ray, or with CORRECTS 1 an estimate below 1. An average of ones is 1, so later
// passes leave other tiles out (proof.md).
// in  u_rays_map     the host's rays; fetched
// in  u_depth_map    of full size
// in  u_ambient_map  CORRECTS 1: paired values of the estimate; fetched
// out o_needed       1: some, 0: none

#if CORRECTS
uniform sampler2D u_ambient_map;
#endif
out float o_needed;

void main()
{
    ivec2 size = (textureSize(u_depth_map, 0) + gFactor - 1) / gFactor;
    ivec2 first = ivec2(gl_FragCoord.xy) * int(gTiles.x);
    ivec2 last = min(first + int(gTiles.x), size);
    float least = 1.0;
    for (int y = first.y; y < last.y && least == 1.0; ++y)
        for (int x = first.x; x < last.x; ++x) {
            float share = rays_of(ivec2(x, y) * gFactor);
            least = share < 0.0 ? least : min(least, share);
#if CORRECTS
            least = min(least, texelFetch(u_ambient_map, ivec2(x, y), 0).r); // the bits of the normal only add to 1
#endif
        }
    o_needed = least < 1.0 ? 1.0 : 0.0;
}
