// SPDX-License-Identifier: MIT
// Reads the normal map. NORMALS: how the host stores them; octahedral is the encoding of Q. Meyer et al., "On
// Floating-Point Normal Vectors" (2010), in two channels of -1..1.

uniform sampler2D u_normal_map; // view space, any length

// View-space normal of any length, unchecked.
vec3 decoded_normal(vec3 normal)
{
#if NORMALS == NORMALS_OCTAHEDRAL || NORMALS == NORMALS_REBUILT
    normal.z = 1.0 - abs(normal.x) - abs(normal.y);
    // The lower half is folded over the square's edges; a coordinate of 0 belongs to the positive side.
    vec2 side = vec2(normal.x >= 0.0 ? 1.0 : -1.0, normal.y >= 0.0 ? 1.0 : -1.0);
    normal.xy = normal.z >= 0.0 ? normal.xy : (1.0 - abs(normal.yx)) * side;
#elif NORMALS == NORMALS_UNSIGNED
    normal = normal * 2.0 - 1.0;
#endif
    return normal;
}

// View-space unit normal, or 0 where the map holds none (length 0, infinite, NaN). A comparison with NaN is false, so all
// three take the same way out, and normalize() never divides by 0.
vec3 normal_view_from_stored(vec3 stored)
{
    vec3 normal = decoded_normal(stored);
    float length_squared = dot(normal, normal);
    if (!(length_squared > 1e-20 && length_squared < 1e20))
        return vec3(0.0);
    return normal * inversesqrt(length_squared);
}

// At a full-size texel, which rebuilt normals stand for by twos.
vec3 normal_view_from_map(ivec2 texel)
{
#if NORMALS == NORMALS_REBUILT
    texel >>= gFactor - 1;
#endif
    return normal_view_from_stored(texelFetch(u_normal_map, texel, 0).xyz);
}

// At a texel's centre, for maps bound to a sampler that does not filter.
vec3 normal_view_at_uv(vec2 uv)
{
#if NORMALS == NORMALS_REBUILT
    return normal_view_from_map(ivec2(uv / gFullTexel));
#endif
    return normal_view_from_stored(textureLod(u_normal_map, uv, 0.0).xyz);
}
