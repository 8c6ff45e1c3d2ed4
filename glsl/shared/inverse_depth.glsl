// SPDX-License-Identifier: MIT
// The linear quantity of distance: a function of view distance that changes linearly across the picture of a plane. In
// perspective it is 1 / distance, in an orthographic projection distance itself.
// PERSPECTIVE 1: the projection is known to be perspective, which spares a choice and registers.

bool orthographic()
{
#if PERSPECTIVE
    return false;
#else
    return gRayDirection.x == 0.0;
#endif
}

float linear_from_distance(float distance)
{
    return orthographic() ? distance : 1.0 / distance;
}

// Whether it is that of sky, however the driver divides: the division may miss by a few parts in 10^7.
bool is_far(float linear)
{
    return orthographic() ? linear == FAR_AWAY : abs(linear) < 1.000001 / FAR_AWAY;
}

// The same for a stored depth that is not sky.
float linear_from_depth(float depth)
{
#if DEPTH == DEPTH_WINDOW
    vec4 k = gDistanceFromDepth;
    vec2 fraction = vec2((1.0 - depth) * k.x + depth * k.y, (1.0 - depth) * k.z + depth * k.w);
    fraction = orthographic() ? fraction : fraction.yx;
    return fraction.x / fraction.y;
#else
    return linear_from_distance(depth);
#endif
}

// The longer side of the picture (scene units, in perspective per unit of view distance).
float longer_side()
{
    vec2 sides = abs(orthographic() ? gRayOrigin.xy : gRayDirection.xy);
    return max(sides.x, sides.y);
}

// The radius at a view distance (scene units). The picture shows nothing farther away than its own sides, so a radius beyond
// them counts as one as long as the longer: samples spread over more would miss what is near.
float radius_at(float distance)
{
    return min(wanted_radius(distance), longer_side() * (orthographic() ? 1.0 : distance));
}

// The change of the linear quantity for a change of view distance by the radius.
float radius_in_linear(float linear)
{
#if RADIUS_GROWS
    return min(gOcclusionRadius, longer_side()) * linear;
#else
    return orthographic() ? radius_at(0.0) : min(gOcclusionRadius * linear, longer_side()) * linear;
#endif
}

// The change of the linear quantity for a step of the depth format.
float linear_step(float linear)
{
    vec2 shares = orthographic() ? vec2(1.0, linear * linear) : vec2(linear * linear, 1.0);
    return shares.x * gDepthStep.x + linear * gDepthStep.y + shares.y * gDepthStep.z;
}
