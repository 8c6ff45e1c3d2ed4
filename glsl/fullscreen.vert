// SPDX-License-Identifier: MIT
// Covers the viewport with two triangles from gl_VertexID alone: 6 vertices, no buffer.
// out v_uv: 0..1 across the target, origin bottom left

out vec2 v_uv;

void main()
{
    const vec2 corners[6] = vec2[6](vec2(0.0, 1.0), vec2(0.0, 0.0), vec2(1.0, 0.0),
                                    vec2(0.0, 1.0), vec2(1.0, 0.0), vec2(1.0, 1.0));
    v_uv = corners[gl_VertexID];
    gl_Position = vec4(2.0 * v_uv - 1.0, 0.0, 1.0);
}
