// SPDX-License-Identifier: MIT
// Depth between texels, for the classic and hemisphere techniques, which sample the depth map linearly.

// The error (scene units) that filtering may add to the distance of a surface with this unit normal. Filters weigh in steps
// of 1/256 of a texel, and a surface seen at a grazing angle changes much from texel to texel.
float filter_error(vec2 uv, float distance, vec3 normal_view)
{
    vec2 texel = (gRayOrigin.xy + distance * gRayDirection.xy) / vec2(textureSize(u_depth_map, 0));
    vec3 ray = vec3(uv * gRayDirection.xy + gRayDirection.zw, -1.0);
    // Edge-on, the surface lies along the ray, and there is no bound.
    return dot(abs(normal_view.xy), abs(texel)) / max(256.0 * abs(dot(normal_view, ray)), 1e-3);
}

// What the host stores at uv, filtered by the depth sampler.
float stored_depth(vec2 uv)
{
#if DEPTH != DEPTH_WINDOW
    // Distances that mean sky (0, infinite, NaN) can't be mixed with others: beside one of them the nearest texel counts
    // alone.
    ivec2 last = textureSize(u_depth_map, 0) - 1;
    vec2 texels = uv * vec2(last + 1);
    ivec2 low = clamp(ivec2(floor(texels - 0.5)), ivec2(0), last);
    ivec2 high = clamp(ivec2(floor(texels + 0.5)), ivec2(0), last);
    bool beside_sky = is_sky(fetched_depth(low)) || is_sky(fetched_depth(high)) ||
                      is_sky(fetched_depth(ivec2(low.x, high.y))) || is_sky(fetched_depth(ivec2(high.x, low.y)));
    if (beside_sky && uv == clamp(uv, 0.0, 1.0)) {
        float depth = fetched_depth(min(ivec2(texels), last));
        return is_sky(depth) ? FAR_AWAY : depth;
    }
#endif
    return depth_component(texture(u_depth_map, uv));
}

// The share of the occlusion that counts. With a radius below a pixel, an estimate would see what the depth filter shows
// between two texels, where there is no surface: the share falls in proportion from a pixel of the target down.
float radius_fade(float distance)
{
    vec2 pixel = abs(gRayOrigin.xy + distance * gRayDirection.xy) * gInvRenderTargetSize;
    float width = min(pixel.x, pixel.y);
    float radius = wanted_radius(distance);
    return width > radius ? radius / width : 1.0; // never divides by 0, which the width is at the eye
}
