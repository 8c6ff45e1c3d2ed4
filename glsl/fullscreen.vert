// SPDX-License-Identifier: MIT
// Covers the viewport with two triangles from gl_VertexID alone: 6 vertices, no buffer; or, where gTileRange.z is above
// 0, with as many a tile, of those tiles whose ring lies within the range. The others collapse to a point, so that nothing
// of them is drawn.
// in  u_tile_map  tile_rings.frag's output; fetched
// out v_uv        0..1 across the target, origin bottom left

uniform sampler2D u_tile_map;
uniform vec4 gTileRange; // x, y: least and greatest ring over 16; z, w: a tile's width and height in uv
out vec2 v_uv;

void main()
{
    const vec2 corners[6] = vec2[6](vec2(0.0, 1.0), vec2(0.0, 0.0), vec2(1.0, 0.0),
                                    vec2(0.0, 1.0), vec2(1.0, 0.0), vec2(1.0, 1.0));
    v_uv = corners[gl_VertexID % 6];
    if (gTileRange.z > 0.0) {
        int columns = textureSize(u_tile_map, 0).x;
        ivec2 tile = ivec2(gl_VertexID / 6 % columns, gl_VertexID / 6 / columns);
        float ring = texelFetch(u_tile_map, tile, 0).r;
        bool drawn = ring > gTileRange.x - 0.01 && ring < gTileRange.y + 0.01;
        v_uv = drawn ? min((vec2(tile) + v_uv) * gTileRange.zw, vec2(1.0)) : vec2(0.0);
    }
    gl_Position = vec4(2.0 * v_uv - 1.0, 0.0, 1.0);
}
