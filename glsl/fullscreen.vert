// SPDX-License-Identifier: MIT
// Covers the viewport with two triangles from gl_VertexID alone: 6 vertices, no buffer; or, where gTileRange.z is above
// 0, covers tiles whose ring lies within a range, with a square point each: two triangles would shade the pixels along
// their diagonal twice. The viewport is then as large as all tiles together. Others leave the clip volume.
// in  u_tile_map  tile_rings.frag's output; fetched
// out v_uv        0..1 across the viewport, origin bottom left

uniform sampler2D u_tile_map;
uniform vec3 gTileRange; // least and greatest ring over 16; a tile's side in pixels of the target
out vec2 v_uv;

void main()
{
    const vec2 corners[6] = vec2[6](vec2(0.0, 1.0), vec2(0.0, 0.0), vec2(1.0, 0.0),
                                    vec2(0.0, 1.0), vec2(1.0, 0.0), vec2(1.0, 1.0));
    v_uv = corners[gl_VertexID % 6];
    gl_PointSize = gTileRange.z;
    if (gTileRange.z > 0.0) {
        ivec2 tiles = textureSize(u_tile_map, 0);
        ivec2 tile = ivec2(gl_VertexID % tiles.x, gl_VertexID / tiles.x);
        float ring = texelFetch(u_tile_map, tile, 0).r;
        bool drawn = ring > gTileRange.x - 0.01 && ring < gTileRange.y + 0.01;
        v_uv = drawn ? (vec2(tile) + 0.5) / vec2(tiles) : vec2(2.0);
    }
    gl_Position = vec4(2.0 * v_uv - 1.0, 0.0, 1.0);
}
