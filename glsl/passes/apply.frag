// SPDX-License-Identifier: MIT
// Multiplies accessibility into a picture. Drawn, it leaves the multiplication to the blender; with COMPUTE 1 it loads and
// stores the picture's texels.
// in  v_uv            0..1 across the destination
// in  u_ambient_map   accessibility, linearly sampled
// in  u_strength_map  STRENGTH 2: how much of the occlusion counts, in red; fetched. STRENGTH 1: gShade.a alone does
// in  u_albedo_map    ALBEDO 1: the surface's diffuse colour; fetched
// out o_color         rgb: the part of the picture that stays, TINTED 1: the part that goes; alpha stays

uniform sampler2D u_ambient_map, u_strength_map, u_albedo_map;
uniform vec4 gShade;   // rgb: the colour of full occlusion; a: intensity
uniform vec4 gPicture; // where the picture lies in the maps that are fetched: x, y, width, height in pixels

// Light that bounces off neighbours of the same colour before it arrives, as a cubic of accessibility: Jimenez et al. 2016,
// "Practical Realtime Strategies for Accurate Indirect Occlusion", section 5. The fit exceeds 1 by 1e-4 where all is open.
vec3 with_bounces(float accessibility, vec3 albedo)
{
    vec3 a = 2.0404 * albedo - 0.3324;
    vec3 b = -4.7951 * albedo + 0.6417;
    vec3 c = 2.7552 * albedo + 0.6903;
    vec3 cubic = ((a * accessibility + b) * accessibility + c) * accessibility;
    return clamp(cubic, vec3(accessibility), vec3(1.0));
}

// A value that is no number counts as 0.
float unit(float value)
{
    return value > 0.0 ? min(value, 1.0) : 0.0;
}

// The part of the picture's colour that stays.
vec3 stays(vec2 uv)
{
    vec3 open = textureLod(u_ambient_map, uv, 0.0).rrr;
#if ALBEDO || STRENGTH == STRENGTH_TEXTURE
    ivec2 texel = ivec2(gPicture.xy + floor(uv * gPicture.zw));
#endif
#if ALBEDO
    vec3 albedo = texelFetch(u_albedo_map, texel, 0).rgb;
    open = with_bounces(open.r, vec3(unit(albedo.r), unit(albedo.g), unit(albedo.b)));
#endif
#if STRENGTH == STRENGTH_FULL
    return open;
#else
    float strength = gShade.a;
#if STRENGTH == STRENGTH_TEXTURE
    strength *= unit(texelFetch(u_strength_map, texel, 0).r);
#endif
    return open * strength + (1.0 - strength);
#endif
}

#if COMPUTE
layout(local_size_x = GROUP_X, local_size_y = GROUP_Y) in;
#if IMAGE == IMAGE_RGBA8
layout(rgba8)
#elif IMAGE == IMAGE_RGBA16
layout(rgba16)
#elif IMAGE == IMAGE_RGBA16F
layout(rgba16f)
#elif IMAGE == IMAGE_RGBA32F
layout(rgba32f)
#elif IMAGE == IMAGE_RGB10_A2
layout(rgb10_a2)
#else
layout(r11f_g11f_b10f)
#endif
uniform image2D u_target;
uniform ivec4 gRegion; // the destination

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, gRegion.zw)))
        return;
    vec4 picture = imageLoad(u_target, gRegion.xy + pixel);
    vec3 part = stays((vec2(pixel) + 0.5) / vec2(gRegion.zw));
    imageStore(u_target, gRegion.xy + pixel, vec4(picture.rgb * part + gShade.rgb * (1.0 - part), picture.a));
}
#else
in vec2 v_uv;
out vec4 o_color;

void main()
{
    vec3 part = stays(v_uv);
    o_color = vec4(TINTED != 0 ? 1.0 - part : part, 1.0);
}
#endif
