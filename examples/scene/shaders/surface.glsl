// SPDX-License-Identifier: MIT
//
// What the pre-pass and the main pass read of a surface in the same way: where a map is sampled, and the shading normal.
// Macros as in scene.vert, and DOUBLE_SIDED. In: its outputs.

#if TEXTURED
in vec4 v_uvs;

// The rows' first four numbers weigh both uv sets; the third vector's first two are added.
vec2 map_uv(vec4 rows[3])
{
    return vec2(dot(rows[0], v_uvs), dot(rows[1], v_uvs)) + rows[2].xy;
}
#endif

#if LIT
in vec3 v_normal_view;
#if NORMAL_MAPPED
in vec4 v_tangent_view;
uniform sampler2D u_normal_map; // tangent space, 0..1
uniform vec4 u_normal_uv[3];
uniform float u_normal_scale;
#endif

// Unit, in view space; a back face's is turned round after the map, as glTF says.
vec3 shading_normal()
{
    // A normal that vanishes (opposite ones interpolated, an instance scaled flat) becomes one that faces the viewer.
    float length_squared = dot(v_normal_view, v_normal_view);
    vec3 normal_view = length_squared > 0.0 ? v_normal_view * inversesqrt(length_squared) : vec3(0.0, 0.0, 1.0);
#if NORMAL_MAPPED
    vec3 tangent_view = v_tangent_view.xyz - normal_view * dot(normal_view, v_tangent_view.xyz); // Gram-Schmidt
    float tangent_squared = dot(tangent_view, tangent_view);
    if (tangent_squared > 1e-12) {
        tangent_view *= inversesqrt(tangent_squared);
        vec3 bitangent_view = cross(normal_view, tangent_view) * v_tangent_view.w;
        vec3 mapped = texture(u_normal_map, map_uv(u_normal_uv)).xyz * 2.0 - 1.0;
        mapped.xy *= u_normal_scale;
        vec3 bent = tangent_view * mapped.x + bitangent_view * mapped.y + normal_view * mapped.z;
        float bent_squared = dot(bent, bent);
        normal_view = bent_squared > 1e-12 ? bent * inversesqrt(bent_squared) : normal_view;
    }
#endif
#if DOUBLE_SIDED
    if (!gl_FrontFacing)
        normal_view = -normal_view;
#endif
    return normal_view;
}
#endif
