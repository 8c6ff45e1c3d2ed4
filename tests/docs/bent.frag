#version 330
// SPDX-License-Identifier: MIT
// The shader of docs/integration.md that lights with bent normals; glslangValidator compiles it.
uniform vec3 u_albedo, u_specular;
uniform float u_roughness;
uniform samplerCube u_irradiance, u_environment;
uniform mat3 u_world_from_view;
uniform vec2 u_inv_size;
in vec3 v_reflection_view;
out vec4 o_color;
// snippet: bent shader
uniform sampler2D u_bent_map; // GLSSAO_MAP_BENT_NORMAL: direction in view space, accessibility in alpha

// The share of the reflection's cone that lies in the open one: the area in which two spherical caps overlap (C. Oat and P.
// Sander, "Ambient Aperture Lighting", 2007), with cones as in J. Jimenez et al. (2016).
float specular_accessibility(vec4 bent, vec3 reflection_view, float roughness)
{
    float open = acos(sqrt(max(1.0 - bent.a, 0.0)));
    float lobe = acos(exp2(-3.32193 * max(roughness * roughness, 1e-3)));
    float between = acos(clamp(dot(bent.xyz, reflection_view), -1.0, 1.0));
    float inside = abs(open - lobe); // up to here the wider cone holds the narrower one
    float overlap = 1.0 - smoothstep(0.0, 1.0, (between - inside) / max(open + lobe - inside, 1e-4));
    return overlap * (1.0 - cos(min(open, lobe))) / (1.0 - cos(lobe));
}
// end

void main()
{
    vec4 bent = texture(u_bent_map, gl_FragCoord.xy * u_inv_size);
    vec3 diffuse = u_albedo * bent.a * texture(u_irradiance, u_world_from_view * bent.xyz).rgb;
    vec3 reflected = textureLod(u_environment, u_world_from_view * v_reflection_view, 6.0 * u_roughness).rgb;
    o_color = vec4(diffuse + u_specular * reflected * specular_accessibility(bent, v_reflection_view, u_roughness), 1.0);
}
