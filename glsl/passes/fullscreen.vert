// SPDX-License-Identifier: MIT
// Covers the viewport with two triangles from gl_VertexID alone: 6 vertices, no buffer; or, where gTileRange.z is above
// 0, covers the tiles whose ring lies within a range, with square points: two triangles would shade the pixels along their
// diagonal twice. The viewport is then as large as all tiles together. A block of tiles that are all drawn is one point,
// that of its lower left tile; whatever is not drawn leaves the clip volume.
// in  u_tile_map  tile_rings.frag's output; fetched
// out v_uv        0..1 across the viewport, origin bottom left

uniform sampler2D u_tile_map;
uniform vec3 gTileRange; // least and greatest ring over 16; a tile's side in pixels of the target
out vec2 v_uv;

// Whether each tile of the block is there, and drawn.
bool is_drawn(ivec2 first, int side)
{
    ivec2 tiles = textureSize(u_tile_map, 0);
    bool drawn = all(lessThanEqual(first + side, tiles));
    for (int i = 0; i < side * side; ++i) {
        float ring = texelFetch(u_tile_map, min(first + ivec2(i % side, i / side), tiles - 1), 0).r;
        drawn = drawn && ring > gTileRange.x - 0.01 && ring < gTileRange.y + 0.01;
    }
    return drawn;
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
        int side = is_drawn(tile / 4 * 4, 4) ? 4 : is_drawn(tile / 2 * 2, 2) ? 2 : 1;
        bool drawn = is_drawn(tile, 1) && tile == tile / side * side;
        v_uv = drawn ? (vec2(tile) + 0.5 * float(side)) / vec2(textureSize(u_tile_map, 0)) : vec2(2.0);
        gl_PointSize *= float(side);
    }
    gl_Position = vec4(2.0 * v_uv - 1.0, 0.0, 1.0);
}
