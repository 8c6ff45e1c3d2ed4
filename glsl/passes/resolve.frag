// SPDX-License-Identifier: MIT
// The mean of the accumulated estimates.
// in  u_ambient_map   sums of the linear accessibility of two replicates; point sampled. BENT 1: of the first replicate, and
//                     of its hidden vectors
// in  u_other_map     BENT 1: the same of the second
// in  u_distance_map  view distance, full size; point sampled
// in  u_normal_map    view space, full size; point sampled
// out result          by OUTPUT: accessibility or the paired value

uniform sampler2D u_ambient_map;
uniform sampler2D u_distance_map;
#define RESULT AMBIENT
#if BENT
uniform sampler2D u_other_map;
#endif

RESULT result()
{
    vec2 uv = pixel_center() * gInvRenderTargetSize;
#if BENT
    vec4 sum = textureLod(u_ambient_map, uv, 0.0) + textureLod(u_other_map, uv, 0.0);
#else
    vec2 sums = textureLod(u_ambient_map, uv, 0.0).rg;
    float sum = sums.x + sums.y;
#endif
    CONTENTS mean = sum / (gAccumulation.z + gAccumulation.w);
#if BENT
    mean.x = pow(max(mean.x, 1e-6), gPower);
#else
    mean = pow(max(mean, 1e-6), gPower);
#endif
    return ambient(mean, linear_from_distance(textureLod(u_distance_map, uv, 0.0).r),
                   normal_code(normal_view_at_uv(uv)));
}
