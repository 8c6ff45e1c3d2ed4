// SPDX-License-Identifier: MIT
// View-space normals rebuilt from depth, for hosts that have none. Along each axis the pass takes the side whose two
// nearest depths predict the pixel's own best. Window depth is linear across a plane, as is 1 / distance in perspective, so
// a plane predicts exactly, and the other side of a silhouette does not.
// in  u_depth_map  stored depth, full size, fetched
// out o_normal     view space, unit length, RGBA16F; (0, 0, 1) on sky

out vec4 o_normal;

float depth_at(ivec2 pixel, ivec2 size)
{
    return depth_component(texelFetch(u_depth_map, clamp(pixel, ivec2(0), size - 1), 0));
}

// A function of depth that is linear across the picture of a plane.
float linear_depth_at(ivec2 pixel, ivec2 size)
{
    float depth = depth_at(pixel, size);
#if DEPTH == DEPTH_WINDOW
    return depth;
#else
    return linear_from_distance(distance_from_depth(depth));
#endif
}

vec3 position_view_at(ivec2 pixel, ivec2 size)
{
    pixel = clamp(pixel, ivec2(0), size - 1);
    return position_view_from_uv((vec2(pixel) + 0.5) / vec2(size), distance_from_depth(depth_at(pixel, size)));
}

bool is_seen(ivec2 pixel, ivec2 size)
{
    return pixel == clamp(pixel, ivec2(0), size - 1) && !is_sky(depth_at(pixel, size));
}

// Change of position from the pixel to its neighbour along `axis`, from the better side.
vec3 step_view(ivec2 pixel, ivec2 axis, ivec2 size, vec3 position_view)
{
    float depth = linear_depth_at(pixel, size);
    float before = abs(2.0 * linear_depth_at(pixel - axis, size) - linear_depth_at(pixel - 2 * axis, size) - depth);
    float after = abs(2.0 * linear_depth_at(pixel + axis, size) - linear_depth_at(pixel + 2 * axis, size) - depth);
    ivec2 low = pixel - 2 * axis;
    ivec2 high = pixel + 2 * axis;
    // A side that lies outside the map was clamped and predicts by chance; one that begins with sky has no surface.
    bool before_seen = is_seen(pixel - axis, size);
    bool after_seen = is_seen(pixel + axis, size);
    if (!before_seen && !after_seen) // the slope is unknown: straight across
        return vec3(vec2(axis) * (gRayOrigin.xy + gRayDirection.xy), 0.0);
    bool has_before = before_seen && low.x >= 0 && low.y >= 0;
    bool has_after = after_seen && high.x < size.x && high.y < size.y;
    bool use_before = has_before && (!has_after || before < after);
    // Beside a hole at the border, and in maps of few pixels, neither side has two depths: take one that exists.
    if (!has_before && !has_after)
        use_before = before_seen;
    return use_before ? position_view - position_view_at(pixel - axis, size)
                      : position_view_at(pixel + axis, size) - position_view;
}

// How many pixels to step. Where the depth format is coarser than a pixel is wide, neighbours form terraces; over this many
// pixels the slope is right to a quarter.
ivec2 stride(float distance, ivec2 size)
{
    vec2 width = abs(gRayOrigin.xy + distance * gRayDirection.xy) / vec2(size);
    vec2 most = clamp(vec2(size) / 4.0, 1.0, 32.0);
    // At the eye a pixel has no width.
    return ivec2(clamp(ceil(4.0 * depth_step(distance) / max(width, vec2(1e-30))), vec2(1.0), most));
}

// Only the direction matters: at length 1 or so the cross product neither overflows nor underflows at any scene scale.
vec3 scaled_to_one(vec3 v)
{
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return largest > 0.0 ? v / largest : v;
}

void main()
{
    ivec2 size = textureSize(u_depth_map, 0);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depth_at(pixel, size);
    vec3 position_view = position_view_at(pixel, size);
    ivec2 by = stride(-position_view.z, size);
    vec3 across = step_view(pixel, ivec2(by.x, 0), size, position_view);
    vec3 up = step_view(pixel, ivec2(0, by.y), size, position_view);
    vec3 normal = cross(scaled_to_one(across), scaled_to_one(up));
    float length_squared = dot(normal, normal);
    // A map that is one pixel wide has no second direction: the view axis is the neutral answer.
    bool known = !is_sky(depth) && length_squared > 0.0;
    // A projection that mirrors the picture reverses the order of the steps.
    vec4 gain = orthographic() ? gRayOrigin : gRayDirection;
    normal = gain.x * gain.y < 0.0 ? -normal : normal;
    normal = known ? normal * inversesqrt(length_squared) : vec3(0.0, 0.0, 1.0);
#if TURNED
    // Back to the host's view space, in which the map is stored.
    normal.xy = vec2(gRoll.x * normal.x - gRoll.y * normal.y, gRoll.y * normal.x + gRoll.x * normal.y);
#endif
    o_normal = vec4(normal, 0.0);
}
