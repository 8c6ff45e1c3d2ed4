// SPDX-License-Identifier: MIT
// Brings a half-size result to full size: linearly where the pixel lies on the plane of its neighbours, else mostly from
// those that are nearest to it in distance.
// in  u_ambient_map    accessibility, half size, fetched
// in  u_distance_map   view distance, half size, fetched
// in  u_depth_map      stored depth, full size, fetched
// out o_accessibility  0..1, R16, full size

uniform sampler2D u_ambient_map;
out float o_accessibility;

// How far off the plane a pixel may be, in units of the radius; found by experiment.
const float TOLERANCE = 0.02;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_distance_map, 0) - 1;
    // A half-size texel stands for the full-size texel of twice its index: odd pixels lie between two.
    ivec2 odd = pixel & 1;
    ivec2 a = pixel >> 1;
    ivec2 d = min(a + odd, last);
    ivec2 b = ivec2(d.x, a.y);
    ivec2 c = ivec2(a.x, d.y);
    vec2 fraction = 0.5 * vec2(odd);
    vec4 linear_weights = vec4((1.0 - fraction.x) * (1.0 - fraction.y), fraction.x * (1.0 - fraction.y),
                               (1.0 - fraction.x) * fraction.y, fraction.x * fraction.y);
    vec4 values = vec4(texelFetch(u_ambient_map, a, 0).r, texelFetch(u_ambient_map, b, 0).r,
                       texelFetch(u_ambient_map, c, 0).r, texelFetch(u_ambient_map, d, 0).r);
    vec4 neighbours = vec4(linear_from_distance(mapped_distance(a)), linear_from_distance(mapped_distance(b)),
                           linear_from_distance(mapped_distance(c)), linear_from_distance(mapped_distance(d)));
    float depth = fetched_depth(pixel);
    float distance = distance_from_depth(depth);
    float own = linear_from_distance(distance);
    float tolerance = linear_error(TOLERANCE * gOcclusionRadius, distance);
    bool on_plane = abs(dot(linear_weights, neighbours) - own) < tolerance;
    // In units of the tolerance; the bound keeps the square finite beside sky.
    vec4 apart = min(abs(neighbours - own) / tolerance, 1e9);
    vec4 weights = on_plane ? linear_weights : (linear_weights + 0.05) / (1e-3 + apart * apart);
    float accessibility = dot(weights, values) / dot(weights, vec4(1.0));
    o_accessibility = is_sky(depth) ? 1.0 : clamp(accessibility, 0.0, 1.0);
}
