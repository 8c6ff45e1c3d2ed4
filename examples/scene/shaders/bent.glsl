// SPDX-License-Identifier: MIT
//
// Light from a bent normal: the open directions are taken to be a cone about it (C. Oat and P. Sander, "Ambient Aperture
// Lighting", 2007), whose cosine-weighted share of the hemisphere is the accessibility (J. Jimenez et al., "Practical Real-Time
// Strategies for Accurate Indirect Occlusion", 2016).
// In a cone about the normal with the cosine c at its edge, the mean by the cosine of light that is linear in direction is
// 2/3 (1 - c^3) / (1 - c^2) of that along the axis; over the hemisphere, c = 0, it is 2/3. This is how much more that is. (The
// second spherical harmonics would grow fourfold, and ring in creases.)
float linear_light_of_cone(float accessibility)
{
    float c = sqrt(max(1.0 - accessibility, 0.0));
    return (1.0 + c + c * c) / (1.0 + c);
}

// snippet: bent shader
// The share of the cone about `lobe_view`, `lobe` wide, that lies in the one about `axis_view`: the area in which two spherical
// caps overlap (C. Oat and P. Sander, "Ambient Aperture Lighting", 2007).
float overlap(vec3 axis_view, float open, vec3 lobe_view, float lobe)
{
    float between = acos(clamp(dot(axis_view, lobe_view), -1.0, 1.0));
    float inside = abs(open - lobe); // up to here the wider cone holds the narrower one
    float share = 1.0 - smoothstep(0.0, 1.0, (between - inside) / max(open + lobe - inside, 1e-4));
    return share * (1.0 - cos(min(open, lobe))) / (1.0 - cos(lobe));
}

// The share that is open of what the surface reflects. bent: a texel of GLSSAO_MAP_BENT_NORMAL, direction in view space and
// accessibility. Cones as in J. Jimenez et al. (2016). What the surface itself hides of the reflection does not count.
float specular_accessibility(vec4 bent, vec3 normal_view, vec3 reflection_view, float roughness)
{
    float lobe = acos(exp2(-3.32193 * max(roughness * roughness, 1e-3)));
    float open = overlap(bent.xyz, acos(sqrt(clamp(1.0 - bent.a, 0.0, 1.0))), reflection_view, lobe);
    return min(open / max(overlap(normal_view, 0.5 * 3.14159265, reflection_view, lobe), 1e-3), 1.0);
}
// end
