// SPDX-License-Identifier: MIT
// The host's rays, of full or half size; depth.glsl comes before.
// in  u_rays_map  accessibility, linear; negative or no number: no rays; fetched

uniform sampler2D u_rays_map;

// Linear accessibility at a texel, MISSING where there are no rays. A comparison with NaN is false.
float rays_at(ivec2 texel)
{
    float share = texelFetch(u_rays_map, texel, 0).r;
    return share >= 0.0 ? min(share, 1.0) : MISSING;
}

// The rays of the full-size texel that a pixel of the estimate stands for.
float rays_of(ivec2 texel)
{
    bool full = textureSize(u_rays_map, 0).x == textureSize(u_depth_map, 0).x;
    float share = rays_at(full ? texel : texel >> 1);
#if VARIES
    return full || (texel & 1) == ivec2(gRaysPick) ? share : MISSING;
#else
    return full || (texel & 1) == ivec2(0) ? share : MISSING;
#endif
}
