#version 330
// SPDX-License-Identifier: MIT
//
// The sky: one triangle over the whole target at the far plane, from gl_VertexID 0..2 and no vertex buffer.
// Out: clip position; direction of sight in the sky's axes, where +y is up, any length, which is linear over the picture.

uniform mat4 u_sky_from_clip;
out vec3 v_direction_sky;

void main()
{
    vec2 position_ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec4 near_sky = u_sky_from_clip * vec4(position_ndc, -1.0, 1.0);
    vec4 far_sky = u_sky_from_clip * vec4(position_ndc, 1.0, 1.0);
    // From the near point to the far one, times both w: an infinite far plane has w = 0.
    v_direction_sky = far_sky.xyz * near_sky.w - near_sky.xyz * far_sky.w;
    gl_Position = vec4(position_ndc, 1.0, 1.0);
}
