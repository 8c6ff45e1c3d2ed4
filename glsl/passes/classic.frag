// SPDX-License-Identifier: MIT
// The classic estimate (Luna, Introduction to 3D Game Programming with DirectX 12, chapter 21): 14 offset vectors,
// reflected about a random vector and flipped to the normal's side. The surface seen through each is a possible occluder.
// in  u_normal_map      view space, fetched
// in  u_depth_map       stored depth, fetched for the pixel; for occluders linearly sampled, border: sky
// in  u_random_vector_map  RGBA8, each channel uniform in 0..1, repeated 4 times across the target
// out o_ambient         by OUTPUT: accessibility or the paired value
// NO_ANGLE_WEIGHT 1: an occluder counts fully at any angle to the normal. This shows the self-occlusion of flat surfaces
// that the weight prevents.

uniform sampler2D u_random_vector_map;
out AMBIENT o_ambient;

// The weight of an occluder by how much nearer to the camera it is than the point (scene units); 0 up to `least`.
float weight_from_distance(float nearer, float least)
{
    if (nearer <= least || nearer >= gOcclusionFadeEnd)
        return 0.0;
    // Equal bounds make a step and are never divided by: nothing lies between them.
    if (nearer <= gOcclusionFadeStart)
        return 1.0;
    return (gOcclusionFadeEnd - nearer) / (gOcclusionFadeEnd - gOcclusionFadeStart);
}

void main()
{
    ivec2 texel = texel_from_uv(pixel_uv());
    vec3 normal_view = normal_view_from_map(texel);
    float depth = fetched_depth(texel);
    float distance = is_sky(depth) ? FAR_AWAY : distance_from_depth(depth);
    float linear = linear_from_distance(distance);
    uint code = normal_code(normal_view);
    o_ambient = ambient(1.0, linear, code);
    // Sky has no surface, a point without a normal has no hemisphere, and beyond the fade nothing counts.
    if (distance >= gFadeFar.x || normal_view == vec3(0.0))
        return;
    vec3 position_view = position_view_from_uv(uv_from_texel(texel), distance);
    normal_view = seen_normal_at(texel, position_view, normal_view);
    // Not normalised, as in the reference; a vector of length 0 leaves every offset as it is.
    vec2 random_uv = 4.0 * pixel_uv();
#if VARIES
    random_uv += gNoise;
#endif
    vec3 random_vector = 2.0 * texture(u_random_vector_map, random_uv).rgb - 1.0;

    // Nearer than this, the depth format and its filter can't tell an occluder from the point's own surface.
    float least = gSurfaceEpsilon + depth_step(distance) + filter_error(uv_from_texel(texel), distance, normal_view);
    float occlusion = 0.0;
    for (int i = 0; i < gSampleCount; ++i) {
        vec3 offset = gOffsetVectors[i].xyz;
        offset -= 2.0 * dot(random_vector, offset) * random_vector; // reflect(), written out: no unit length needed
        vec3 sample_view = position_view + sign(dot(offset, normal_view)) * wanted_radius(distance) * offset;
        vec4 sample_uvw = gProjTex * vec4(sample_view, 1.0);
        // At or behind the camera nothing can be seen through the sample, and the division would mirror it.
        if (sample_uvw.w <= 0.0)
            continue;
        // Near the camera's plane uv overflows; beyond the border every uv reads the same sky.
        vec2 uv = clamp(sample_uvw.xy / sample_uvw.w, -1.0, 2.0);
        vec3 occluder_view = position_view_from_uv(uv, distance_from_depth(stored_depth(uv)));
        vec3 to_occluder = occluder_view - position_view;
#if NO_ANGLE_WEIGHT
        float facing = 1.0;
#else
        // r = p, or so near that its square is 0 in a float: without the floor the direction is 0 / 0 or infinite.
        float facing = max(dot(normal_view, to_occluder) * inversesqrt(max(dot(to_occluder, to_occluder), 1e-30)), 0.0);
#endif
        occlusion += weight_from_distance(to_occluder.z, least) * facing;
    }
    float accessibility = 1.0 - far_fade(distance) * radius_fade(distance) * occlusion / float(gSampleCount);
    // pow() is undefined below 0, which rounding can leave, and at 0 for a power so small that it is flushed to 0.
    o_ambient = ambient(clamp(pow(max(accessibility, 1e-6), gPower), 0.0, 1.0), linear, code);
}
