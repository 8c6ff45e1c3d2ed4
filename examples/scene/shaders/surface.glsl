// SPDX-License-Identifier: MIT
//
// Shared by the pre-pass and the main pass: texture coordinates of a map, and the shading normal.
// Macros as in scene.vert, and DOUBLE_SIDED. In: its outputs.

#if TEXTURED
in vec4 v_uvs;
#if MORE_UVS
in vec4 v_more_uvs;
#define UV_ROWS 5
#else
#define UV_ROWS 3
#endif

// Rows 0 and 1 weigh the first two uv sets, rows 3 and 4 the third and the fourth; the first two numbers of row 2 are
// added.
vec2 map_uv(vec4 rows[UV_ROWS])
{
    vec2 uv = vec2(dot(rows[0], v_uvs), dot(rows[1], v_uvs)) + rows[2].xy;
#if MORE_UVS
    uv += vec2(dot(rows[3], v_more_uvs), dot(rows[4], v_more_uvs));
#endif
    return uv;
}
#endif

#if LIT
#if FLAT
in vec3 v_position_view;
#else
in vec3 v_normal_view;
#endif
#if NORMAL_MAPPED
in vec4 v_tangent_view;
uniform sampler2D u_normal_map; // tangent space, 0..1
uniform vec4 u_normal_uv[UV_ROWS];
uniform float u_normal_scale;
#endif

// Unit length, in view space. As glTF says, a back face's normal is reversed after the normal map is applied.
vec3 shading_normal()
{
#if FLAT
    // The triangle's own normal. View space is right-handed with y up, like the screen, so the result faces the viewer.
    vec3 normal_view = cross(dFdx(v_position_view), dFdy(v_position_view));
    float largest = max(max(abs(normal_view.x), abs(normal_view.y)), abs(normal_view.z));
    normal_view = largest > 0.0 ? normalize(normal_view / largest) : vec3(0.0, 0.0, 1.0); // squares may underflow
#else
    // A normal that vanishes (opposite ones interpolated, an instance scaled flat) becomes one that faces the viewer.
    float length_squared = dot(v_normal_view, v_normal_view);
    vec3 normal_view = length_squared > 0.0 ? v_normal_view * inversesqrt(length_squared) : vec3(0.0, 0.0, 1.0);
#endif
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
#if DOUBLE_SIDED && !FLAT
    if (!gl_FrontFacing)
        normal_view = -normal_view;
#endif
    return normal_view;
}
#endif
