// SPDX-License-Identifier: MIT
// Covers the viewport with two triangles from gl_VertexID alone: 6 vertices, no buffer; or, where gTileRange.z is above
// 0, covers the tiles whose ring lies within a range, with square points: two triangles would shade the pixels along their
// diagonal twice. The viewport is then as large as all tiles together. A block of tiles that are all drawn is one point,
// that of its lower left tile; whatever is not drawn leaves the clip volume.
// in  u_tile_map  tile_blocks.frag's output, or whether each tile counts, in the same code; fetched
// out v_uv        0..1 across the viewport, origin bottom left

uniform sampler2D u_tile_map;
// Least and greatest ring; a tile's side in pixels of the target; 1: the ring itself says how many tiles farther a point reaches.
uniform vec4 gTileRange;
out vec2 v_uv;

bool is_drawn(float rings)
{
    float least = floor(rings * (1.0 / 32.0));
    return least > gTileRange.x - 0.5 && rings - 32.0 * least < gTileRange.y + 0.5;
}

void main()
{
#if FLAT
    hand_on();
#endif
    const vec2 corners[6] = vec2[6](vec2(0.0, 1.0), vec2(0.0, 0.0), vec2(1.0, 0.0),
                                    vec2(0.0, 1.0), vec2(1.0, 0.0), vec2(1.0, 1.0));
    v_uv = corners[gl_VertexID % 6];
    gl_PointSize = gTileRange.z;
    if (gTileRange.z > 0.0) {
        int columns = textureSize(u_tile_map, 0).x;
        ivec2 tile = ivec2(gl_VertexID % columns, gl_VertexID / columns);
        vec3 rings = texelFetch(u_tile_map, tile, 0).xyz;
        int side = is_drawn(rings.z) ? 4 : is_drawn(rings.y) ? 2 : 1;
        bool drawn = is_drawn(rings.x) && tile == tile / side * side;
        v_uv = drawn ? (vec2(tile) + 0.5 * float(side)) / vec2(textureSize(u_tile_map, 0)) : vec2(2.0);
        gl_PointSize *= gTileRange.w > 0.0 ? 2.0 * mod(rings.x, 32.0) - 1.0 : float(side);
    }
    gl_Position = vec4(2.0 * v_uv - 1.0, 0.0, 1.0);
}
