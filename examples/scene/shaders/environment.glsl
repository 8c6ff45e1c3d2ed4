// SPDX-License-Identifier: MIT
//
// Where a direction lies in an environment's pictures, which wrap round and whose upper edge is straight up.

vec2 environment_uv(vec3 direction_sky)
{
    // At the poles both arguments vanish, for which the function is not defined.
    float ahead = -direction_sky.z + (direction_sky.x == 0.0 && direction_sky.z == 0.0 ? 1.0 : 0.0);
    return vec2(0.5 + atan(direction_sky.x, ahead) * 0.15915494, acos(clamp(direction_sky.y, -1.0, 1.0)) * 0.31830989);
}
