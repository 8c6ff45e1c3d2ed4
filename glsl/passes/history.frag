// SPDX-License-Identifier: MIT
// The mean of this frame's estimate and earlier ones', found again where the surface was in the last frame.
// in  u_ambient_map  paired values after the blur; RAW 1: blocks of such values and the estimate's (upsample.frag); fetched
// in  u_raw_map      paired values of the estimate; fetched (RAW 0)
// in  u_history_map  the last frame's output, fetched
// in  u_motion_map   MOTION 1: uv now minus uv in the last frame; point sampled
// in  u_depth_map, u_normal_map  as for the estimate, full size; point sampled
// out result         a texel of the history (shared/history.glsl)
// RAW 1: the estimate has half the size
// RAYS 1: both maps are linear and may lack values; what is not blurred is what rays say

uniform sampler2D u_ambient_map;
#if !RAW
uniform sampler2D u_raw_map;
#endif
uniform usampler2D u_history_map;
#if MOTION
uniform sampler2D u_motion_map;
#endif
#define RESULT uvec2
#define TARGET uimage2D

// What this frame says of the pixel. x: the estimate, y: what the blur left of it.
vec2 estimate_at(ivec2 pixel)
{
#if RAW
    ivec2 from = max(pixel - ivec2(gPick), ivec2(0));
    vec4 block = texelFetch(u_ambient_map, from >> 1, 0);
    vec2 row = (from.y & 1) == 1 ? block.zw : block.xy;
    return unpacked_pair((from.x & 1) == 1 ? row.y : row.x);
#else
    return vec2(texelFetch(u_raw_map, pixel, 0).r, accessibility_of(texelFetch(u_ambient_map, pixel, 0).rg));
#endif
}

// The uv at which the last frame saw a point of its view space.
vec2 last_uv(vec3 position_view)
{
    float distance = -position_view.z;
    return (position_view.xy - gLastRayOrigin.zw - distance * gLastRayDirection.zw) /
           (gLastRayOrigin.xy + distance * gLastRayDirection.xy);
}

#if MOTION
// The point that the last frame saw at a uv, where it is less than the radius off a view distance; else one at that distance.
vec3 last_position(vec2 uv, float distance)
{
    ivec2 texel = ivec2(clamp(floor(uv / gFullTexel), gLastRegion.xy, gLastRegion.zw));
    float linear = linear_of(texelFetch(u_history_map, texel, 0).xxxx, linear_from_distance(distance)).x;
    float seen = orthographic() ? linear : 1.0 / linear;
    distance = abs(seen - distance) < radius_at(distance) ? seen : distance;
    return vec3(uv * gLastRayOrigin.xy + gLastRayOrigin.zw + distance * (uv * gLastRayDirection.xy + gLastRayDirection.zw),
                -distance);
}
#endif

// The history of a point of the last frame's view space: mean, mean of what was blurred, frames; 0 frames where there is none.
// Each of the four texels around its uv counts where it lies in the point's plane, n . p = h, within the tolerance, and faces
// the same way. Along the ray of a texel the plane has the linear quantity n . ray / h in perspective.
vec4 history_at(vec3 position_view, vec3 normal_view, vec2 uv, float tolerance)
{
    vec2 place = uv / gFullTexel - 0.5;
    // False for NaN too.
    if (!(all(greaterThanEqual(place, gLastRegion.xy - 0.5)) && all(lessThanEqual(place, gLastRegion.zw + 0.5)) &&
          (orthographic() || position_view.z < 0.0)))
        return vec4(0.0);
    vec2 low = floor(place);
    vec2 part = place - low;
    ivec2 a = ivec2(max(low, gLastRegion.xy)), d = ivec2(min(low + 1.0, gLastRegion.zw));
    ivec2 b = ivec2(d.x, a.y), c = ivec2(a.x, d.y);
    uvec4 below = uvec4(texelFetch(u_history_map, a, 0).xy, texelFetch(u_history_map, b, 0).xy);
    uvec4 above = uvec4(texelFetch(u_history_map, c, 0).xy, texelFetch(u_history_map, d, 0).xy);
    uvec4 first = uvec4(below.xz, above.xz), second = uvec4(below.yw, above.yw);
    float own = linear_from_distance(-position_view.z);
    vec4 linear = linear_of(first, own);
    vec4 frames = frames_of(first);
    float height = dot(position_view, normal_view);
    // The plane's linear quantity at the corners' rays, from that at the point's own uv.
    vec2 slope = normal_view.xy * (orthographic() ? gLastRayOrigin.xy / normal_view.z : gLastRayDirection.xy / height);
    vec4 x = vec4(-part.x, 1.0 - part.x, -part.x, 1.0 - part.x) * (slope.x * gFullTexel.x);
    vec4 y = vec4(-part.yy, 1.0 - part.yy) * (slope.y * gFullTexel.y);
    vec4 off = abs((own + x + y - linear) * (orthographic() ? normal_view.z : height));
    vec4 most = orthographic() ? vec4(tolerance) : tolerance * linear;
    // Squared changes of the projected normal.
    vec2 projected = projected_normal(normal_view) + 15.0;
    vec4 turn_x = floats((second >> 5) & 31u) - projected.x, turn_y = floats(second & 31u) - projected.y;
    vec4 turn = turn_x * turn_x + turn_y * turn_y;
    vec4 weights = vec4(1.0 - part.x, part.x, 1.0 - part.x, part.x) * vec4(1.0 - part.yy, part.yy);
    const float MOST = TURN * TURN / (NORMAL_STEP * NORMAL_STEP);
    weights *= vec4(lessThan(off, most)) * vec4(lessThan(turn, vec4(MOST))) * vec4(greaterThan(frames, vec4(0.0)));
    float sum = dot(weights, vec4(1.0));
    vec2 means = vec2(dot(weights, floats(second >> 21)), dot(weights, floats((second >> 10) & 2047u))) / MEAN_STEPS;
    float change = (dot(weights, floats(first & 63u)) - 32.0 * sum) * (LATELY_MOST / 31.0);
    return sum > 0.01 ? vec4(means, dot(weights, frames), change) / sum : vec4(0.0);
}

#if !RAYS
// How much of the disc that samples reach lies in the picture, along each side: about a point at a uv and view distance. An
// estimate lacks occluders from beyond the picture's edge, so it is too bright there.
float seen_share(vec2 uv, float distance, vec4 origin, vec4 direction)
{
    vec2 reach = radius_at(distance) / abs(origin.xy + distance * direction.xy);
    vec2 seen = clamp(0.5 + 0.5 * min(uv, 1.0 - uv) / reach, 0.25, 1.0);
    return seen.x * seen.y;
}
#endif

RESULT result()
{
    ivec2 pixel = ivec2(pixel_center());
    vec2 uv = pixel_center() * gFullTexel;
    float depth = depth_component(textureLod(u_depth_map, uv, 0.0));
    if (is_sky(depth))
        return history_texel(vec2(1.0), 0.0, 0.0, 0.0, 0u);
    float distance = distance_from_depth(depth);
    vec3 normal_view = normal_view_at_uv(uv);
    vec2 now = estimate_at(pixel);
    vec4 last = vec4(0.0);
#if !RAYS
    float seen = 1.0, weight = 1.0; // what the last frame's estimate counts against this one's
#endif
    if (gHistory.y > 0.0) {
        vec3 position = (gLastView * vec4(position_view_from_uv(uv, distance), 1.0)).xyz;
        vec3 normal = mat3(gLastView) * normal_view;
        vec2 pixel_width = abs(gLastRayOrigin.xy - position.z * gLastRayDirection.xy) * gFullTexel;
        float tolerance = PLANE * radius_at(distance) + max(pixel_width.x, pixel_width.y) + depth_step(-position.z);
        vec2 place = last_uv(position);
#if MOTION
        vec2 moved = uv - textureLod(u_motion_map, uv, 0.0).rg;
        vec2 apart = (moved - place) / gFullTexel;
        // A thing that moves by itself. Its distance was that of the surface which was seen there, if that is near.
        if (all(lessThan(abs(moved - uv), vec2(2.0))) && dot(apart, apart) > 0.25) {
            place = moved;
            position = last_position(place, -position.z);
        }
#endif
        last = history_at(position, normal, place, tolerance);
#if !RAYS
        seen = seen_share(uv, distance, gRayOrigin, gRayDirection);
        float ratio = seen_share(place, -position.z, gLastRayOrigin, gLastRayDirection) / seen;
        weight = last.z > 0.5 ? pow(ratio, SEEN) : 1.0;
#endif
    }
#if RAYS
    // Where no ray tells anything, what is known stays.
    bool is_known = last.z > 0.5;
    if (now.y < 0.0)
        return history_texel(is_known ? last.xy : vec2(1.0), last.w, linear_from_distance(distance), floor(last.z + 0.5),
                             normal_code(normal_view));
    now.x = now.x >= 0.0 ? now.x : is_known ? last.x : now.y;
#endif
    float frames = floor(last.z + 0.5);
#if RAYS
    frames = min(frames + 1.0, gHistory.x);
#else
    // As many of this frame's weight. Those that saw more count as several.
    frames = frames > gHistory.x ? frames - 1.0 : min(frames + 1.0, gHistory.x);
    frames = clamp(floor(weight * frames + gNoise.x), 1.0, min(SEEN_MOST * gHistory.x, 63.0));
#endif
    // What changes for longer than noise does is taken over at once, and what was known before is soon forgotten.
    float change = frames > 1.0 ? mix(last.w, now.y - last.y, LATELY) : 0.0;
    float noise = NOISE + min(DETAIL * abs(last.x - last.y), NOISE);
    // Where nothing occludes the pixel or its neighbours, there is little noise.
    noise *= min(now.x, now.y) < 1.0 ? 1.0 : 0.5;
#if !RAW && !RAYS
    // At full size the blur leaves less. A frame that is darker has found an occluder; a lighter one may have lost it from sight.
    noise *= change < 0.0 ? QUIET * QUIET : QUIET;
#endif
#if !RAYS
    // In motion, and after it, a frame may be lighter because it lost an occluder from sight.
    if (change > 0.0 && (frames > gHistory.x || abs(weight - 1.0) > 0.01))
        noise += LOST * (1.0 - seen);
#endif
    float share_of_noise = abs(change) / noise;
    float jump = clamp(share_of_noise - 1.0, 0.0, 1.0);
    float doubt = clamp(2.0 * share_of_noise - 1.0, 0.0, 1.0);
    if (doubt > 0.0)
        frames = min(frames, max(FORGET, floor(gHistory.x * (1.0 - doubt))));
    vec2 means = clamp(last.xy + jump * change, 0.0, 1.0);
    change -= jump * change;
#if RAW
    // A pixel that was estimated itself counts for more than one between others, if each gets its turn.
    bool picked = ((pixel - ivec2(gPick)) & 1) == ivec2(0);
    const float MOST = RAYS != 0 ? PICKED_RAYS : PICKED;
    float share = min(mix(1.0, picked ? MOST : (4.0 - MOST) / 3.0, gTurns) / frames, 1.0);
#else
    float share = 1.0 / frames;
#endif
    means = frames > 1.0 ? mix(means, now, vec2(share, 1.0 / frames)) : now;
    return history_texel(means, change, linear_from_distance(distance), frames, normal_code(normal_view));
}
