// SPDX-License-Identifier: MIT
// One direction of the box over one period of a 4x4 tile, 1/2 1 1 1 1/2, along surfaces: a tap counts where it lies on a
// line with two neighbours in the same direction, or with the two about the pixel. A silhouette breaks both lines; a plane
// seen at any angle breaks neither.
// in  u_ambient_map    accessibility, fetched
// in  u_distance_map   view distance at the same size, fetched
// out o_accessibility  0..1, R16

uniform sampler2D u_ambient_map;
uniform bool gHorizontalBlur;
out float o_accessibility;

// How far off a line may be, in units of the radius; found by experiment.
const float TOLERANCE = 0.02;

ivec2 last;

float linear_distance(ivec2 texel)
{
    return linear_from_distance(mapped_distance(clamp(texel, ivec2(0), last)));
}

float accessibility(ivec2 texel)
{
    return texelFetch(u_ambient_map, clamp(texel, ivec2(0), last), 0).r;
}

void main()
{
    last = textureSize(u_distance_map, 0) - 1;
    ivec2 axis = gHorizontalBlur ? ivec2(1, 0) : ivec2(0, 1);
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float distance = mapped_distance(texel);
    float center = linear_from_distance(distance);
    float before = linear_distance(texel - axis);
    float after = linear_distance(texel + axis);
    float tolerance = linear_error(TOLERANCE * gOcclusionRadius, distance);
    bool on_line = abs(before - 2.0 * center + after) < tolerance;
    bool on_before = abs(linear_distance(texel - 2 * axis) - 2.0 * before + center) < tolerance;
    bool on_after = abs(linear_distance(texel + 2 * axis) - 2.0 * after + center) < tolerance;
    vec4 weights = vec4(on_before ? 0.5 : 0.0, on_before || on_line ? 1.0 : 0.0, on_after || on_line ? 1.0 : 0.0,
                        on_after ? 0.5 : 0.0);
    vec4 taps = vec4(accessibility(texel - 2 * axis), accessibility(texel - axis), accessibility(texel + axis),
                     accessibility(texel + 2 * axis));
    o_accessibility = (accessibility(texel) + dot(weights, taps)) / (1.0 + dot(weights, vec4(1.0)));
}
