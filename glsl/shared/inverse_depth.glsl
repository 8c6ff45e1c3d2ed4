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

// The change of the linear quantity for an error of `length` (scene units) about a surface.
float linear_error(float length, float linear)
{
    return orthographic() ? length : length * linear * linear;
}

// The change of the linear quantity for a step of the depth format.
float linear_step(float linear)
{
    vec2 shares = orthographic() ? vec2(1.0, linear * linear) : vec2(linear * linear, 1.0);
    return shares.x * gDepthStep.x + linear * gDepthStep.y + shares.y * gDepthStep.z;
}
