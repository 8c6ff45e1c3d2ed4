// SPDX-License-Identifier: MIT
// The difference between the two replicates of the accumulated mean, at one pixel of each cell of the picture.
// in  u_ambient_map   sums of the linear accessibility of two replicates; point sampled. BENT 1: of the first in red
// in  u_other_map     BENT 1: of the second in red
// in  u_distance_map  view distance, full size; point sampled
// out o_difference    squared difference of the two means, and 1 where there is a surface

uniform sampler2D u_ambient_map;
uniform sampler2D u_distance_map;
#if BENT
uniform sampler2D u_other_map;
#endif
out vec2 o_difference;

// A place in the cell, 0 to 1, that differs from cell to cell (PCG2D of M. Jarzynski and M. Olano, 2020).
vec2 place(uvec2 cell)
{
    uvec2 v = cell * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16;
    return vec2(v >> 8) / 16777216.0;
}

void main()
{
    vec2 size = vec2(textureSize(u_ambient_map, 0));
    vec2 cell = floor(gl_FragCoord.xy);
    vec2 texel = min(floor(gProbe.xy + (cell + place(uvec2(cell))) * gProbe.zw), size - 1.0);
    vec2 uv = (texel + 0.5) / size;
#if BENT
    vec2 sums = vec2(textureLod(u_ambient_map, uv, 0.0).r, textureLod(u_other_map, uv, 0.0).r);
#else
    vec2 sums = textureLod(u_ambient_map, uv, 0.0).rg;
#endif
    vec2 means = max(sums / gAccumulation.zw, 1e-6);
    float difference = pow(means.x, gPower) - pow(means.y, gPower);
    bool surface = textureLod(u_distance_map, uv, 0.0).r < FAR_AWAY;
    o_difference = surface ? vec2(difference * difference, 1.0) : vec2(0.0);
}
