#version 330
// SPDX-License-Identifier: MIT
//
// Main pass: the shaded picture. Accessibility scales ambient light alone, which comes from a gradient from below to
// above, or from a picture of the surroundings. Direct light is unchanged. Unlit materials (LIT 0) show their base colour
// unchanged: no light reaches them, so no occlusion does either. Blended ones are lit but not occluded: the
// accessibility map belongs to the opaque surface behind them.
// Macros, 0 or 1: TEXTURED (any map), BASE_MAPPED, COLORED, MASKED, BLENDED, LIT, and where LIT: DOUBLE_SIDED,
// NORMAL_MAPPED, REFLECTIVE, ROUGHNESS_MAPPED, BAKED, EMISSIVE, EMISSION_MAPPED, SHADOWED, LIGHTS,
// SPECULAR_OCCLUSION, MULTI_BOUNCE, ENVIRONMENT, BENT.
// In:  what scene.vert writes.
// Out: linear colour, alpha (1 unless BLENDED); the framebuffer encodes sRGB.

uniform vec4 u_base_color;

#if BASE_MAPPED
uniform sampler2D u_base_color_map; // sRGB texture: sampled as linear
uniform vec4 u_base_color_uv[UV_ROWS];
#endif
#if COLORED
in vec4 v_color;
#endif
#if MASKED
uniform float u_alpha_cutoff;
#endif

#if LIT
const float pi = 3.14159265;
#if ENVIRONMENT
uniform vec3 u_irradiance[9]; // irradiance / pi times: 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2 of the normal in the sky's axes
uniform mat3 u_sky_from_view;
#if REFLECTIVE
uniform sampler2D u_environment_map; // reflections; level i is for roughness i / 5
#endif
#else
uniform vec3 u_ambient;      // radiance from the side; irradiance / pi on a surface that faces sideways
uniform vec3 u_ambient_tilt; // added straight above, subtracted straight below
uniform vec3 u_up_view;      // the sky's up, unit
#endif
uniform vec3 u_directional;  // irradiance / pi
uniform vec3 u_to_light_view;
#if !BLENDED
uniform sampler2D u_ambient_map; // accessibility in red; BENT 1: bent normals, and accessibility in alpha
uniform float u_intensity;       // of occlusion, 0 none to 1 full
uniform vec2 u_pixel_uv;         // size of a pixel in the ambient map's uv
uniform vec2 u_origin;           // its lower left corner, in pixels
#endif

#if (REFLECTIVE || LIGHTS) && !FLAT // else surface.glsl has it
in vec3 v_position_view;
#endif
#if REFLECTIVE
uniform vec2 u_metallic_roughness;
uniform bool u_is_orthographic;
#endif
#if ROUGHNESS_MAPPED
uniform sampler2D u_metallic_roughness_map; // roughness in green, metallic in blue
uniform vec4 u_metallic_roughness_uv[UV_ROWS];
#endif
#if BAKED
uniform sampler2D u_occlusion_map; // accessibility in red
uniform vec4 u_occlusion_uv[UV_ROWS];
uniform float u_occlusion_strength;
#endif
#if EMISSIVE
uniform vec3 u_emission;
#if EMISSION_MAPPED
uniform sampler2D u_emission_map;
uniform vec4 u_emission_uv[UV_ROWS];
#endif
#endif

#if SHADOWED
in vec3 v_position_shadow; // uv and depth
uniform sampler2DShadow u_shadow_map;

// 3 x 3 taps, each filtered linearly over four texels; the border is lit.
float light_share()
{
    vec2 texel = 1.0 / vec2(textureSize(u_shadow_map, 0));
    float sum = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++)
            sum += texture(u_shadow_map, v_position_shadow + vec3(vec2(x, y) * texel, 0.0));
    return sum / 9.0;
}
#endif

// A surface that light falls on.
struct surface {
    vec3 normal_view, to_eye_view;
    vec3 diffuse, reflectance; // diffuse albedo; reflectance at normal incidence
    float roughness;
};

#if REFLECTIVE
// glTF 2.0, appendix B: GGX distribution, height-correlated Smith masking, Schlick's Fresnel term; the light's cosine
// and 1/pi are left to the caller, as with the matte part.
vec3 reflected(surface s, vec3 to_light_view, float cos_light)
{
    vec3 half_view = normalize(to_light_view + s.to_eye_view);
    float cos_eye = max(dot(s.normal_view, s.to_eye_view), 1e-4);
    float cos_half = max(dot(s.normal_view, half_view), 0.0);
    float alpha = max(s.roughness * s.roughness, 2e-3); // a perfect mirror would not show a light without size
    float alpha2 = alpha * alpha;
    float spread = cos_half * cos_half * (alpha2 - 1.0) + 1.0;
    float distribution = alpha2 / (spread * spread); // times pi
    float masking = 0.5 / (cos_light * sqrt(cos_eye * cos_eye * (1.0 - alpha2) + alpha2) +
                           cos_eye * sqrt(cos_light * cos_light * (1.0 - alpha2) + alpha2));
    float grazing = pow(1.0 - max(dot(s.to_eye_view, half_view), 0.0), 5.0);
    return (s.reflectance + (1.0 - s.reflectance) * grazing) * distribution * masking;
}
#endif

// Radiance towards the eye of light from that direction. `light` is its irradiance / pi on a surface that faces it.
vec3 lit(surface s, vec3 to_light_view, vec3 light)
{
    float cos_light = max(dot(s.normal_view, to_light_view), 0.0);
#if REFLECTIVE
    return cos_light > 0.0 ? light * cos_light * (s.diffuse + reflected(s, to_light_view, cos_light)) : vec3(0.0);
#else
    return light * cos_light * s.diffuse;
#endif
}

#if LIGHTS
#define MOST_LIGHTS 16
uniform int u_light_count;
// Four vectors each: position and 1, or the direction to a directional light and 0; intensity / pi, and 1 / range^4
// or 0; a spot's axis, and the cosine outside of which it is dark; in the fourth's x, 1 / (inner - outer cosine).
uniform vec4 u_lights[4 * MOST_LIGHTS];

// KHR_lights_punctual: inverse square, faded out at the range; a spot's edge as a square between its two cones.
vec3 lit_by_lights(surface s)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < u_light_count; i++) {
        vec4 place = u_lights[4 * i], color = u_lights[4 * i + 1], axis = u_lights[4 * i + 2];
        vec3 to_light = place.xyz;
        float share = 1.0;
        if (place.w > 0.0) {
            to_light -= v_position_view;
            float distance2 = max(dot(to_light, to_light), 1e-12);
            to_light *= inversesqrt(distance2);
            share = clamp(1.0 - distance2 * distance2 * color.w, 0.0, 1.0) / distance2;
            float edge = clamp((dot(axis.xyz, -to_light) - axis.w) * u_lights[4 * i + 3].x, 0.0, 1.0);
            share *= edge * edge;
        }
        sum += lit(s, to_light, color.rgb * share);
    }
    return sum;
}
#endif

// Irradiance / pi on a surface with that normal, and the radiance that a mirror reflects. `linear`: how much more of the light
// that is linear in direction arrives than from a whole hemisphere.
#if ENVIRONMENT
vec3 matte_light(vec3 normal_view, float linear)
{
    vec3 n = u_sky_from_view * normal_view, m = linear * n;
    vec3 flat_part = u_irradiance[0] + u_irradiance[1] * m.y + u_irradiance[2] * m.z + u_irradiance[3] * m.x;
    return max(flat_part + u_irradiance[4] * (n.x * n.y) + u_irradiance[5] * (n.y * n.z) +
                   u_irradiance[6] * (3.0 * n.z * n.z - 1.0) + u_irradiance[7] * (n.x * n.z) +
                   u_irradiance[8] * (n.x * n.x - n.y * n.y), 0.0);
}
#if REFLECTIVE
vec3 glossy_light(vec3 mirror_view, float roughness)
{
    return textureLod(u_environment_map, environment_uv(normalize(u_sky_from_view * mirror_view)), roughness * 5.0).rgb;
}
#endif
#else
// The gradient is linear in the height of the direction, whose mean over a cosine lobe is 2/3 of the lobe's; a rough
// mirror's lobe is taken to be in between.
vec3 matte_light(vec3 normal_view, float linear)
{
    return u_ambient + u_ambient_tilt * (dot(normal_view, u_up_view) * (2.0 / 3.0 * linear));
}
#if REFLECTIVE
vec3 glossy_light(vec3 mirror_view, float roughness)
{
    return u_ambient + u_ambient_tilt * (dot(mirror_view, u_up_view) * mix(1.0, 2.0 / 3.0, roughness));
}
#endif
#endif

// `open_view`: the mean direction of the light that arrives; the bent normal with BENT 1.
vec3 ambient_light(surface s, vec3 open_view, float accessibility)
{
#if BENT && !BLENDED
    vec3 matte = matte_light(open_view, linear_light_of_cone(accessibility));
#else
    vec3 matte = matte_light(open_view, 1.0);
#endif
#if MULTI_BOUNCE && !BLENDED
    // Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion", equation 10: light that
    // bounces between near surfaces takes on their colour.
    vec3 a = 2.0404 * s.diffuse - 0.3324, b = -4.7951 * s.diffuse + 0.6417, c = 2.7552 * s.diffuse + 0.6903;
    float x = accessibility;
    vec3 sum = matte * s.diffuse * max(vec3(x), ((x * a + b) * x + c) * x);
#else
    vec3 sum = matte * s.diffuse * accessibility;
#endif
#if REFLECTIVE
    float cos_eye = clamp(dot(s.normal_view, s.to_eye_view), 0.0, 1.0);
    vec3 mirror_view = reflect(-s.to_eye_view, s.normal_view);
    vec3 glossy = glossy_light(mirror_view, s.roughness);
    // Karis 2014, "Physically Based Shading on Mobile": a fit to the integral of Fresnel and masking.
    vec4 r = s.roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a004 = min(r.x * r.x, exp2(-9.28 * cos_eye)) * r.x + r.y;
    vec2 scale_bias = vec2(-1.04, 1.04) * a004 + r.zw;
#if BENT && !BLENDED
    accessibility = specular_accessibility(vec4(open_view, accessibility), s.normal_view, mirror_view, s.roughness);
#elif SPECULAR_OCCLUSION && !BLENDED
    // Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 26.
    float open = pow(cos_eye + accessibility, exp2(-16.0 * s.roughness - 1.0)) - 1.0 + accessibility;
    accessibility = clamp(open, 0.0, 1.0);
#endif
    sum += glossy * (s.reflectance * scale_bias.x + scale_bias.y) * accessibility;
#endif
    return sum;
}
#endif

layout(location = 0) out vec4 o_color;

void main()
{
#if LIT
    vec3 normal_view = shading_normal(); // before any discard, since it may take derivatives
#endif
    vec4 color = u_base_color;
#if BASE_MAPPED
    color *= texture(u_base_color_map, map_uv(u_base_color_uv));
#endif
#if COLORED
    color *= v_color;
#endif
#if MASKED
    // Depth EQUAL keeps most holes open by itself, but not those over a coplanar surface.
    if (color.a < u_alpha_cutoff)
        discard;
#endif

#if LIT
    surface s = surface(normal_view, vec3(0.0, 0.0, 1.0), color.rgb, vec3(0.0), 1.0);
#if REFLECTIVE
    vec2 metallic_roughness = u_metallic_roughness;
#if ROUGHNESS_MAPPED
    metallic_roughness *= texture(u_metallic_roughness_map, map_uv(u_metallic_roughness_uv)).bg;
#endif
    s.roughness = metallic_roughness.y;
    s.diffuse = color.rgb * (1.0 - metallic_roughness.x);
    s.reflectance = mix(vec3(0.04), color.rgb, metallic_roughness.x);
    if (!u_is_orthographic)
        s.to_eye_view = normalize(-v_position_view);
#endif

    float accessibility = 1.0;
    vec3 open_view = s.normal_view;
#if !BLENDED
    vec4 open = texture(u_ambient_map, (gl_FragCoord.xy - u_origin) * u_pixel_uv);
#if BENT
    accessibility = mix(1.0, open.a, u_intensity);
    open_view = normalize(mix(s.normal_view, open.rgb, u_intensity) + 1e-6 * s.normal_view);
#else
    accessibility = mix(1.0, open.r, u_intensity);
#endif
#endif
#if BAKED
    accessibility *= 1.0 + u_occlusion_strength * (texture(u_occlusion_map, map_uv(u_occlusion_uv)).r - 1.0);
#endif
    color.rgb = ambient_light(s, open_view, accessibility);

    vec3 direct = lit(s, u_to_light_view, u_directional);
#if SHADOWED
    direct *= light_share();
#endif
    color.rgb += direct;
#if LIGHTS
    color.rgb += lit_by_lights(s);
#endif
#if EMISSIVE
    vec3 emission = u_emission;
#if EMISSION_MAPPED
    emission *= texture(u_emission_map, map_uv(u_emission_uv)).rgb;
#endif
    color.rgb += emission;
#endif
#endif

#if !BLENDED
    color.a = 1.0;
#endif
    o_color = color;
}
