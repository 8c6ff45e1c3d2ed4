// SPDX-License-Identifier: MIT
//
// Light from a bent normal: what is open is taken to be a cone about it (C. Oat and P. Sander, "Ambient Aperture Lighting",
// 2007), whose cosine-weighted share of the hemisphere is the accessibility (J. Jimenez et al., "Practical Real-Time
// Strategies for Accurate Indirect Occlusion", 2016).
// In a cone about the normal with the cosine c at its edge, the mean of that light's first spherical harmonic, by the cosine,
// is 2/3 (1 - c^3) / (1 - c^2) of it, that of the second (1 + 3 c^2) / 4. Over the hemisphere, c = 0, they are 2/3 and 1/4.
vec2 bands_of_cone(float accessibility)
{
    float c = sqrt(max(1.0 - accessibility, 0.0));
    return vec2((1.0 + c + c * c) / (1.0 + c), 1.0 + 3.0 * c * c);
}

// snippet: bent shader
// The share of the reflection's cone that lies in the open one: the area in which two spherical caps overlap (C. Oat and P.
// Sander, "Ambient Aperture Lighting", 2007), with cones as in J. Jimenez et al. (2016).
// bent: a texel of GLSSAO_MAP_BENT_NORMAL, direction in view space and accessibility.
float specular_accessibility(vec4 bent, vec3 reflection_view, float roughness)
{
    float open = acos(sqrt(clamp(1.0 - bent.a, 0.0, 1.0)));
    float lobe = acos(exp2(-3.32193 * max(roughness * roughness, 1e-3)));
    float between = acos(clamp(dot(bent.xyz, reflection_view), -1.0, 1.0));
    float inside = abs(open - lobe); // up to here the wider cone holds the narrower one
    float overlap = 1.0 - smoothstep(0.0, 1.0, (between - inside) / max(open + lobe - inside, 1e-4));
    return overlap * (1.0 - cos(min(open, lobe))) / (1.0 - cos(lobe));
}
// end
