// SPDX-License-Identifier: MIT
// View-space normals rebuilt from depth, at the estimate's size, for hosts that have none. Along each axis the pass takes the
// side whose two nearest depths predict the pixel's own best: the linear quantity of distance predicts a plane exactly, and the
// other side of a silhouette does not.
// in  u_depth_map  stored depth, full size; point sampled, clamped
// out result       octahedral (shared/octahedral.glsl); that of (0, 0, 1) on sky

#define RESULT vec2

// What the prediction from a side counts as being off by: where a depth is missing, and where the side itself is.
const float UNPREDICTED = 1e30;
const float UNSEEN = 2e30;

float stored_at(vec2 uv)
{
    return depth_component(textureLod(u_depth_map, uv, 0.0));
}

// Stored depth where it is linear across the picture of a plane, else the linear quantity of distance.
float flat_depth(float depth)
{
#if DEPTH == DEPTH_WINDOW
    return depth;
#else
    return linear_from_distance(distance_from_depth(depth));
#endif
}

// The linear quantity of distance that a unit of flat_depth() is.
float linear_per_flat_depth()
{
#if DEPTH == DEPTH_WINDOW
    vec4 k = gDistanceFromDepth;
    return orthographic() ? (k.y - k.x) / k.z : (k.w - k.z) / k.x;
#else
    return 1.0;
#endif
}

// How far off the prediction of `own` is from the nearest depth on a side and the one beyond. Sky has no surface, and
// what lies outside the map was clamped.
float error_of(float own, float near, float beyond, vec2 near_uv, vec2 beyond_uv)
{
    float error = abs(2.0 * flat_depth(near) - flat_depth(beyond) - own);
    // A comparison with a depth that is no number is false.
    error = error < UNPREDICTED && beyond_uv == clamp(beyond_uv, 0.0, 1.0) ? error : UNPREDICTED;
    return is_sky(near) || near_uv != clamp(near_uv, 0.0, 1.0) ? UNSEEN : error;
}

// The change of flat_depth() over `by`, from the better side. 0 where neither is seen.
float change_over(vec2 by, vec2 uv, float own)
{
    float before = stored_at(uv - by);
    float after = stored_at(uv + by);
    float error_before = error_of(own, before, stored_at(uv - 2.0 * by), uv - by, uv - 2.0 * by);
    float error_after = error_of(own, after, stored_at(uv + 2.0 * by), uv + by, uv + 2.0 * by);
    // A coarse depth format often leaves both sides equally far off, where rounding must not decide.
    float change = error_before < error_after - 1e-6 * abs(own) ? own - flat_depth(before) : flat_depth(after) - own;
    return min(error_before, error_after) < UNSEEN ? change : 0.0;
}

// How many pixels to step. Where the depth format is coarser than a pixel is wide, neighbours form terraces; over this many
// pixels the slope is right to a quarter.
vec2 stride(float linear)
{
    vec2 width = gFullTexel * (orthographic() ? abs(gRayOrigin.xy) : linear * abs(gRayDirection.xy));
    vec2 most = clamp(0.25 / gFullTexel, 1.0, 32.0);
    return clamp(ceil(4.0 * linear_step(linear) / max(width, 1e-30)), vec2(1.0), floor(most));
}

RESULT result()
{
#if DENSE
    vec2 uv = target_center() * gFullTexel;
#else
    vec2 uv = (full_texel(floor(target_center())) + 0.5) * gFullTexel;
#endif
    float stored = stored_at(uv);
    float own = flat_depth(stored);
    float linear = linear_from_depth(stored);
    vec2 by = stride(linear);
    vec2 change = vec2(change_over(vec2(by.x * gFullTexel.x, 0.0), uv, own), change_over(vec2(0.0, by.y * gFullTexel.y), uv, own));
    vec2 slope = change * linear_per_flat_depth() / (by * gFullTexel); // of the linear quantity, per uv
    // The plane n . p = 1 has the linear quantity n . ray in perspective. Its normal faces away from the eye.
    vec2 lean = orthographic() ? slope / gRayOrigin.xy : -slope / (linear * gRayDirection.xy);
    vec3 normal = vec3(lean, orthographic() ? 1.0 : 1.0 + dot(lean, uv * gRayDirection.xy + gRayDirection.zw));
#if TURNED
    // Back to the host's view space, in which normals are stored.
    normal.xy = vec2(gRoll.x * normal.x - gRoll.y * normal.y, gRoll.y * normal.x + gRoll.x * normal.y);
#endif
    return octahedral(dot(normal, normal) < 1e30 && !is_sky(stored) ? normal : vec3(0.0, 0.0, 1.0));
}
