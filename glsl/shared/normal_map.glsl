// SPDX-License-Identifier: MIT
// Reads the normal map. NORMALS: how the host stores them.
// TURNED: they lie in another space than the passes compute in.

uniform sampler2D u_normal_map; // any length

// View-space normal of any length, unchecked.
vec3 decoded_normal(vec3 normal)
{
#if NORMALS == NORMALS_OCTAHEDRAL || NORMALS == NORMALS_REBUILT
    normal = octahedral_direction(normal.xy);
#elif NORMALS == NORMALS_UNSIGNED
    normal = normal * 2.0 - 1.0;
#endif
#if TURNED
    normal = vec3(dot(gTurn[0].xyz, normal), dot(gTurn[1].xyz, normal), dot(gTurn[2].xyz, normal));
#endif
    return normal;
}

// View-space unit normal, or 0 where the map holds none (length 0, infinite, NaN). A comparison with NaN is false, so all
// three take the same way out, and normalize() never divides by 0.
vec3 normal_view_from_stored(vec3 stored)
{
    vec3 normal = decoded_normal(stored);
    float length_squared = dot(normal, normal);
    bool is_usable = length_squared > 1e-20 && length_squared < 1e20;
    return is_usable ? normal * inversesqrt(length_squared) : vec3(0.0);
}

// At a full-size texel, which rebuilt normals stand for by twos unless they are DENSE.
vec3 normal_view_from_map(ivec2 texel)
{
#if NORMALS == NORMALS_REBUILT && !DENSE
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

// Normals that look away from the eye. Beside a silhouette, a smooth normal may lean over a little while its triangle still
// faces the eye. Otherwise the normal is that of the surface's other side, as in files that have normals the wrong way round,
// and on surfaces drawn from both sides. The surface tells which: where the normal leans to, it falls off by more than across
// the normal, or it does not.

// The pixel that the normal leans towards: -1, 0 or 1 beside the point's. `up`: towards the eye.
vec2 lean_of(vec3 normal_view, vec3 up)
{
    vec4 gain = gRayDirection.x == 0.0 ? gRayOrigin : gRayDirection;
    vec2 lean = (normal_view - dot(normal_view, up) * up).xy / gain.xy;
    return roundEven(lean * inversesqrt(max(dot(lean, lean), 1e-30)));
}

// The normal of the side that is seen. `to`: from the point to that pixel; `from`: from the opposite one to the point. The
// shorter of the two is less likely to lead to another surface.
vec3 seen_normal(vec3 normal_view, vec3 up, vec3 to, vec3 from)
{
    vec3 step_view = dot(to, to) <= dot(from, from) ? to : from;
    float facing = dot(normal_view, up);
    bool other_side = facing < -0.5 || dot(step_view, up - facing * normal_view) > 0.0;
    return facing < 0.0 && other_side ? -normal_view : normal_view;
}

// Beyond the map's border nothing is known.
vec3 position_view_of(ivec2 texel)
{
    ivec2 inside = clamp(texel, ivec2(0), textureSize(u_depth_map, 0) - 1);
    float distance = inside == texel ? distance_from_depth(fetched_depth(texel)) : FAR_AWAY;
    return position_view_from_uv(uv_from_texel(texel), distance);
}

// The same for a texel of the depth map.
vec3 seen_normal_at(ivec2 texel, vec3 position_view, vec3 normal_view)
{
    vec3 up = normalize(gRayDirection.x == 0.0 ? vec3(-gRayDirection.zw, 1.0) : -position_view);
    if (dot(normal_view, up) >= 0.0)
        return normal_view;
    ivec2 lean = ivec2(lean_of(normal_view, up));
    return seen_normal(normal_view, up, position_view_of(texel + lean) - position_view,
                       position_view - position_view_of(texel - lean));
}
