// SPDX-License-Identifier: MIT
// Adds the blurred difference between the host's rays and the estimate (rays.frag) to the estimate: a control variate. Compare
// E. Heitz, S. Hill, M. McGuire, "Combining analytic direct illumination and stochastic shadows" (2018), who blur a ratio.
// in  u_ambient_map  paired values of the estimate; point sampled
// in  u_rays_map     paired values of the difference, which may be missing; point sampled
// out result         by OUTPUT: accessibility or the paired value; with RAYS 2 the power is applied

uniform sampler2D u_ambient_map;
uniform sampler2D u_rays_map;
#define RESULT AMBIENT

RESULT result()
{
    vec2 estimate = textureLod(u_ambient_map, pixel_uv(), 0.0).rg;
    float half_difference = accessibility_of(textureLod(u_rays_map, pixel_uv(), 0.0).rg);
    float difference = half_difference < 0.0 ? 0.0 : 2.0 * half_difference - 1.0;
    float share = clamp(pow(accessibility_of(estimate), 1.0 / gPower) + difference, 0.0, 1.0);
    return ambient(share, estimate.y, normal_code(estimate));
}
