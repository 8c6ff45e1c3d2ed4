// SPDX-License-Identifier: MIT
// Copies a texture of the host that the other passes can't read as it is.
// in  u_input_map  depth or normals as the host stores them, fetched; gOrigin: lower left corner of the picture in it
//                  MULTISAMPLE 1: the first of several samples is taken, since a mean of depths lies on no surface
// out o_texel      the same at the full size; LOGARITHMIC 1 or OBLIQUE 1: red becomes view distance (scene units),
//                  FAR_AWAY on sky

#if MULTISAMPLE
uniform sampler2DMS u_input_map;
#else
uniform sampler2D u_input_map;
#endif
out vec4 o_texel;

void main()
{
    o_texel = texelFetch(u_input_map, ivec2(pixel_center()), 0);
#if LOGARITHMIC
    // Depth d = log(c t + 1) / log(c far + 1) at view distance t, with sky at 1.
    float distance = (exp2(o_texel.r * gLogDepth.x) - 1.0) * gLogDepth.y;
    o_texel.r = o_texel.r < 1.0 ? max(distance, 0.0) : FAR_AWAY;
#elif OBLIQUE
    // As distance_from_depth(), with the ends of the depth range at this pixel.
    vec2 uv = target_center() * gFullTexel;
    float depth = o_texel.r;
    vec2 fraction = (1.0 - depth) * gDistanceFromDepth.xz + depth * gDistanceFromDepth.yw +
                    vec2(dot(gOblique.xy, uv), dot(gOblique.zw, uv));
    float distance = fraction.x / fraction.y;
    o_texel.r = depth != gWindowSky && abs(distance) < FAR_AWAY ? distance : FAR_AWAY;
#endif
}
