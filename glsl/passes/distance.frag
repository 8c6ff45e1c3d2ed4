// SPDX-License-Identifier: MIT
// The distance map: view distances at the estimate's size, so that later passes need not convert depth.
// in  u_depth_map  stored depth, point sampled
// in  u_back_map, u_second_map  LAYERS 1: the nearest back face at or behind the surface, and the nearest front face behind it
// out result       x: view distance (scene units); FAR_AWAY where nothing was drawn. With LAYERS 1 also
//                  y: thickness of the surface (scene units); negative: not known
//                  z: distance from it to the next front face (scene units); FAR_AWAY: none

#if LAYERS
#define RESULT vec4
uniform sampler2D u_back_map;
uniform sampler2D u_second_map;

// In units of the radius, found by experiment: docs/decisions/0034.
const float GAP = 0.15;  // with the next front face less than this behind the back face, both may be one solid
const float THIN = 0.03; // anything thinner is a sheet or a seam, whose thickness says nothing about what is behind it
#else
#define RESULT float
#endif

float distance_at(sampler2D map, vec2 uv)
{
    float depth = textureLod(map, uv, 0.0).r;
    return is_sky(depth) ? FAR_AWAY : distance_from_depth(depth);
}

RESULT result()
{
#if DENSE
    vec2 uv = target_center() * gFullTexel;
#else
    vec2 uv = (full_texel(floor(target_center())) + 0.5) * gFullTexel;
#endif
    float depth = depth_component(textureLod(u_depth_map, uv, 0.0));
    float distance = is_sky(depth) ? FAR_AWAY : distance_from_depth(depth);
#if LAYERS
    float back = distance_at(u_back_map, uv);
    float second = distance_at(u_second_map, uv);
    float radius = wanted_radius(distance);
    bool solid = back < FAR_AWAY && back - distance >= THIN * radius;
    bool known = solid && second - back >= GAP * radius;
    float behind = second < FAR_AWAY ? max(second - distance, 0.0) : FAR_AWAY;
    return vec4(distance, known ? back - distance : solid ? distance - back : 0.0, behind, 0.0);
#else
    return distance;
#endif
}
