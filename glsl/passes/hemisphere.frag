// SPDX-License-Identifier: MIT
// The hemisphere estimate (J. Chapman, "SSAO Tutorial", 2013; J. de Vries, "Learn OpenGL", 2020, SSAO): samples in the
// half ball about the normal. A sample is occluded where it lies behind the surface seen at its pixel.
// in  u_normal_map     view space, fetched
// in  u_depth_map      stored depth, fetched for the pixel; for occluders linearly sampled, border: sky
// out o_ambient        by OUTPUT: accessibility or the paired value

out AMBIENT o_ambient;

// Two unit vectors that span the plane across the normal, turned by the pixel's place in the 4x4 tile.
mat3 view_from_tangent(vec3 normal_view)
{
    ivec2 tile = ivec2(pixel_center()) & 3;
    vec3 turned = vec3(gRotations[tile.y * 4 + tile.x].xy, 0.0);
    // A rotation vector along the normal leaves nothing after Gram-Schmidt; the z axis is then across.
    vec3 tangent = turned - normal_view * dot(turned, normal_view);
    if (dot(tangent, tangent) < 1e-6)
        tangent = vec3(0.0, 0.0, 1.0) - normal_view * normal_view.z;
    tangent = normalize(tangent);
    return mat3(tangent, cross(normal_view, tangent), normal_view);
}

void main()
{
    ivec2 texel = texel_from_uv(pixel_uv());
    vec3 normal_view = normal_view_from_map(texel);
    float depth = fetched_depth(texel);
    float center_distance = is_sky(depth) ? FAR_AWAY : distance_from_depth(depth);
    float linear = linear_from_distance(center_distance);
    uint code = normal_code(normal_view);
    o_ambient = ambient(1.0, linear, code);
    // Sky has no surface, a point without a normal has no hemisphere, and beyond the fade nothing counts.
    if (center_distance >= gFadeFar.x || normal_view == vec3(0.0))
        return;
    vec3 position_view = position_view_from_uv(uv_from_texel(texel), center_distance);
    normal_view = seen_normal_at(texel, position_view, normal_view);
    mat3 basis = view_from_tangent(normal_view);

    float radius = wanted_radius(center_distance);
    // Within this, the depth format and its filter can't tell a surface in reach from the point's own.
    float least = gSurfaceEpsilon + depth_step(center_distance + radius) +
                  filter_error(uv_from_texel(texel), center_distance, normal_view);
    float occlusion = 0.0;
    float counted = 0.0;
    for (int i = 0; i < gSampleCount; ++i) {
        vec3 sample_view = position_view + radius * (basis * gKernel[i].xyz);
        vec4 sample_uvw = gProjTex * vec4(sample_view, 1.0);
        // At or behind the camera nothing can be seen through the sample.
        if (sample_uvw.w <= 0.0)
            continue;
        vec2 uv = sample_uvw.xy / sample_uvw.w;
        // Nothing is known off the screen: the other samples stand for it. The comparison is false for NaN too.
        if (!(uv.x >= 0.0 && uv.y >= 0.0 && uv.x <= 1.0 && uv.y <= 1.0))
            continue;
        float surface_distance = distance_from_depth(stored_depth(uv));
        bool hidden = surface_distance < -sample_view.z - least;
        bool in_reach = abs(surface_distance - center_distance) <= radius;
        occlusion += hidden && in_reach ? 1.0 : 0.0;
        counted += 1.0;
    }
    // The floor prevents 0 / 0 where no sample counts.
    float accessibility = 1.0 - far_fade(center_distance) * radius_fade(center_distance) * occlusion / max(counted, 1.0);
    // pow() is undefined below 0, which rounding can leave, and at 0 for a power so small that it is flushed to 0.
    o_ambient = ambient(clamp(pow(max(accessibility, 1e-6), gPower), 0.0, 1.0), linear, code);
}
