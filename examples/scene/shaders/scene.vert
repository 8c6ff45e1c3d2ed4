#version 330
// SPDX-License-Identifier: MIT
//
// Draws the scene in every pass. gl_Position is invariant and computed by the same expression from the same inputs in
// each variant, so that the main pass can compare with the pre-pass's depth by EQUAL.
// Macros, 0 or 1: TEXTURED (any map is read), MORE_UVS, COLORED, LIT (normals are wanted), and where LIT: FLAT,
// NORMAL_MAPPED, REFLECTIVE, LIGHTS, SHADOWED. MOVES, without LIT: the motion pass.
// In:  mesh-space vertex; per instance, world_from_mesh and the inverse transpose of its upper 3x3.
// Out: clip position; unit normal and tangent in view space; both uv sets; vertex colour, linear; position in view
//      space and in the shadow map (uv and depth, 0..1).

layout(location = 0) in vec3 a_position_mesh;
layout(location = 4) in mat4x3 a_world_from_mesh;

uniform mat4 u_view_from_world;
uniform mat4 u_clip_from_view;

invariant gl_Position;

#if LIT
layout(location = 1) in vec3 a_normal_mesh;
layout(location = 8) in mat3 a_normal_world_from_mesh;
uniform mat3 u_normal_view_from_world;
#if !FLAT
out vec3 v_normal_view;
#endif

// Scaled by the largest component first: uneven scales give normals whose square would leave the range of a float.
vec3 unit_or_zero(vec3 v)
{
    vec3 size = abs(v);
    float largest = max(size.x, max(size.y, size.z));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

#if NORMAL_MAPPED
layout(location = 11) in vec4 a_tangent_mesh;
uniform float u_handedness; // -1 where the instance mirrors
out vec4 v_tangent_view;    // and the bitangent's sign
#endif
#if REFLECTIVE || LIGHTS || FLAT
out vec3 v_position_view;
#endif
#if SHADOWED
uniform mat4 u_shadow_from_world;
out vec3 v_position_shadow;
#endif
#endif

#if MOVES
// Where the lit variants have normals and tangents.
layout(location = 1) in vec3 a_last_position_mesh;
layout(location = 8) in mat4x3 a_last_world_from_mesh;
uniform mat4 u_last_view_from_world;
uniform mat4 u_last_clip_from_view;
out vec3 v_clip, v_last_clip; // x, y and w
#endif

#if TEXTURED
layout(location = 2) in vec4 a_uvs;
out vec4 v_uvs;
#if MORE_UVS
layout(location = 12) in vec4 a_more_uvs;
out vec4 v_more_uvs;
#endif
#endif

#if COLORED
layout(location = 3) in vec4 a_color;
out vec4 v_color;
#endif

void main()
{
    vec3 position_world = a_world_from_mesh * vec4(a_position_mesh, 1.0);
    vec4 position_view = u_view_from_world * vec4(position_world, 1.0);
    gl_Position = u_clip_from_view * position_view;

#if LIT
#if !FLAT
    // Unit at each vertex, so that an instance interpolates as the same triangle baked into world space would.
    v_normal_view = unit_or_zero(u_normal_view_from_world * (a_normal_world_from_mesh * a_normal_mesh));
#endif
#if NORMAL_MAPPED
    vec3 tangent_world = mat3(a_world_from_mesh) * a_tangent_mesh.xyz;
    v_tangent_view = vec4(unit_or_zero(mat3(u_view_from_world) * tangent_world), a_tangent_mesh.w * u_handedness);
#endif
#if REFLECTIVE || LIGHTS || FLAT
    v_position_view = position_view.xyz;
#endif
#if SHADOWED
    v_position_shadow = (u_shadow_from_world * vec4(position_world, 1.0)).xyz;
#endif
#endif
#if MOVES
    vec3 last_world = a_last_world_from_mesh * vec4(a_last_position_mesh, 1.0);
    v_clip = gl_Position.xyw;
    v_last_clip = (u_last_clip_from_view * (u_last_view_from_world * vec4(last_world, 1.0))).xyw;
#endif
#if TEXTURED
    v_uvs = a_uvs;
#if MORE_UVS
    v_more_uvs = a_more_uvs;
#endif
#endif
#if COLORED
    v_color = a_color;
#endif
}
