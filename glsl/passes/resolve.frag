// SPDX-License-Identifier: MIT
// The mean of the accumulated estimates.
// in  u_ambient_map   sums of the linear accessibility of two replicates; point sampled
// in  u_distance_map  view distance, full size; point sampled
// in  u_normal_map    view space, full size; point sampled
// out o_ambient       by OUTPUT: accessibility or the paired value

uniform sampler2D u_ambient_map;
uniform sampler2D u_distance_map;
out AMBIENT o_ambient;

void main()
{
    vec2 uv = pixel_center() * gInvRenderTargetSize;
    vec2 sums = textureLod(u_ambient_map, uv, 0.0).rg;
    float mean = (sums.x + sums.y) / (gAccumulation.z + gAccumulation.w);
    // The base of pow() is above 0, since each estimate is.
    o_ambient = ambient(pow(mean, gPower), linear_from_distance(textureLod(u_distance_map, uv, 0.0).r),
                        normal_code(normal_view_at_uv(uv)));
}
