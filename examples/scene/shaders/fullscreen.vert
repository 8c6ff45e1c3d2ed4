#version 330
// SPDX-License-Identifier: MIT
//
// One triangle over the whole target, from gl_VertexID 0..2 and no vertex buffer.
// Out: clip position.

void main()
{
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
