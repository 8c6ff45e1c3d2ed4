// SPDX-License-Identifier: MIT
// From stored depth to view space, for any perspective or orthographic projection.
// DEPTH: how the host stores it.

uniform sampler2D u_depth_map; // as the host stores it

float depth_component(vec4 texel)
{
#if DEPTH == DEPTH_ALPHA
    return texel.a;
#else
    return texel.r;
#endif
}

// View distance (scene units) of a stored depth. Both ends of the depth range are exact constants, blended as
// (1 - d) a + d b, because a + d (b - a) cancels where far is much larger than near.
float distance_from_depth(float depth)
{
#if DEPTH == DEPTH_WINDOW
    vec4 k = gDistanceFromDepth;
    float distance = ((1.0 - depth) * k.x + depth * k.y) / ((1.0 - depth) * k.z + depth * k.w);
#else
    float distance = depth;
#endif
    // An infinite far plane divides by 0 at the sky, 0 / 0 is possible beyond it, and hosts may store infinity or NaN (any
    // comparison with NaN is false). None of them may reach a sum.
    return abs(distance) < FAR_AWAY ? distance : FAR_AWAY;
}

// A step of the depth format as view distance (scene units), plus what single precision loses.
float depth_step(float distance)
{
    return gDepthStep.x + distance * (gDepthStep.y + distance * gDepthStep.z);
}

// The radius that is asked for at a view distance (scene units). RADIUS_GROWS 1: it counts pixels, in perspective.
float wanted_radius(float distance)
{
#if RADIUS_GROWS
    return gOcclusionRadius * distance;
#else
    return gOcclusionRadius;
#endif
}

// The share of the occlusion that counts at a view distance.
float far_fade(float distance)
{
    return clamp((gFadeFar.x - distance) * gFadeFar.y, 0.0, 1.0);
}

// Whether a stored depth means that nothing was drawn.
bool is_sky(float depth)
{
#if DEPTH == DEPTH_WINDOW
    return depth == gSkyDepth;
#else
    // By its bits: a driver may take !(NaN < x) for NaN >= x, which is false. Subnormal numbers count as 0.
    uint bits = floatBitsToUint(depth) & 0x7fffffffu;
    return bits >= floatBitsToUint(gSkyDepth) || bits < 0x00800000u;
#endif
}

// The full-size texel that stands for a pixel of the ambient map. At half size and even sizes uv falls on the corner of
// four texels: rounding would pick one at random, and filtering would mix the two sides of a silhouette (and let an
// infinite neighbour in, since 0 times infinity is NaN). A quarter texel back always means the lower left of the four. At
// full size uv is a centre already. The texel may lie outside the map where uv does.
ivec2 texel_from_uv(vec2 uv)
{
    ivec2 texel = ivec2(floor(uv * vec2(textureSize(u_depth_map, 0)) - 0.25));
#if VARIES
    texel = min(texel + ivec2(gPick), textureSize(u_depth_map, 0) - 1);
#endif
    return texel;
}

// The same for a texel of the ambient map.
vec2 full_texel(vec2 texel)
{
#if VARIES
    return min(texel * float(gFactor) + gPick, round(1.0 / gFullTexel) - 1.0);
#else
    return texel * float(gFactor);
#endif
}

vec2 uv_from_texel(ivec2 texel)
{
    return (vec2(texel) + 0.5) / vec2(textureSize(u_depth_map, 0));
}

// What the host stores at a texel of the map.
float fetched_depth(ivec2 texel)
{
    return depth_component(texelFetch(u_depth_map, texel, 0));
}

// The point at uv and a view distance (scene units).
vec3 position_view_from_uv(vec2 uv, float distance)
{
    vec2 origin = uv * gRayOrigin.xy + gRayOrigin.zw;
    vec2 direction = uv * gRayDirection.xy + gRayDirection.zw;
    return vec3(origin + distance * direction, -distance);
}
