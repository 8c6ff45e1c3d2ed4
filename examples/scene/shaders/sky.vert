#version 330
// SPDX-License-Identifier: MIT
//
// The sky: one triangle over the whole target at the far plane, from gl_VertexID 0..2 and no vertex buffer.
// Out: clip position; direction of sight in world space, any length, which is linear over the picture.

uniform mat4 u_world_from_clip;
out vec3 v_direction_world;

void main()
{
    vec2 position_ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec4 near_world = u_world_from_clip * vec4(position_ndc, -1.0, 1.0);
    vec4 far_world = u_world_from_clip * vec4(position_ndc, 1.0, 1.0);
    // From the near point to the far one, times both w: an infinite far plane has w = 0.
    v_direction_world = far_world.xyz * near_world.w - near_world.xyz * far_world.w;
    gl_Position = vec4(position_ndc, 1.0, 1.0);
}
