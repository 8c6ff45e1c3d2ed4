// SPDX-License-Identifier: MIT
// Brings a half-size result to full size: linearly where the pixel lies on the plane of its neighbours, else mostly from
// those that are nearest to it in distance.
// in  u_ambient_map    accessibility, and the linear quantity of distance, half size; point sampled, clamped
// in  u_depth_map      stored depth, full size; point sampled
// out o_accessibility  0..1, R16, full size

uniform sampler2D u_ambient_map;
out float o_accessibility;

// How far off the plane a pixel may be, in units of the radius; found by experiment.
const float TOLERANCE = 0.02;

void main()
{
    vec2 pixel = pixel_center() - 0.5;
    // A half-size texel stands for the full-size texel of twice its index: odd pixels lie midway between two, and where
    // a coordinate is even, both are the same, so that the mean of the four is the linear interpolation.
    vec2 half_pixel = floor(0.5 * pixel);
    vec2 uv_a = (half_pixel + 0.5) * gInvRenderTargetSize;
    vec2 uv_d = uv_a + (pixel - 2.0 * half_pixel) * gInvRenderTargetSize;
    vec2 a = textureLod(u_ambient_map, uv_a, 0.0).rg;
    vec2 b = textureLod(u_ambient_map, vec2(uv_d.x, uv_a.y), 0.0).rg;
    vec2 c = textureLod(u_ambient_map, vec2(uv_a.x, uv_d.y), 0.0).rg;
    vec2 d = textureLod(u_ambient_map, uv_d, 0.0).rg;
    float depth = depth_component(textureLod(u_depth_map, pixel_center() / vec2(textureSize(u_depth_map, 0)), 0.0));
    float own = linear_from_depth(depth);
    float tolerance = linear_error(TOLERANCE * gOcclusionRadius, own);
    vec4 neighbours = vec4(a.y, b.y, c.y, d.y);
    bool on_plane = abs(dot(neighbours, vec4(0.25)) - own) < tolerance;
    vec4 apart = abs(neighbours - own);
    vec2 ab = apart.x <= apart.y ? vec2(a.x, apart.x) : vec2(b.x, apart.y);
    vec2 cd = apart.w <= apart.z ? vec2(d.x, apart.w) : vec2(c.x, apart.z);
    float nearest = ab.y <= cd.y ? ab.x : cd.x;
    float accessibility = on_plane ? 0.25 * (a.x + b.x + c.x + d.x) : nearest;
    o_accessibility = is_sky(depth) ? 1.0 : accessibility;
}
