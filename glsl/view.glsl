// SPDX-License-Identifier: MIT
// From stored depth to view space, for any perspective or orthographic projection. Included by passes that read depth.

// PRECISE stands for `precise` where the driver knows it, else for nothing. A compiler may fuse and reorder in one shader what it
// leaves in another; this way fragment and compute shaders have the same bits, down to what is held against thresholds.
// Where it is known on a GPU, three things are written as takes it least: FMA(a, b, c), a b + c, rounded once; ROOT(x), the square
// root of a variable above 0, without the reciprocal that some compilers make it with; ROUND(x), to the nearest whole number,
// even in between, of less than 2^22, by the sum with one so large that no fraction is left.

// DEPTH_IS_DISTANCE 1: the host stores view distance, not window depth. DEPTH_IN_ALPHA 1: in the alpha of its normal map.
uniform sampler2D u_depth_map; // as the host stores it

// Where the target's lower left corner lies in the maps, in pixels: not 0 for the last pass of a frame with a margin.
uniform vec2 gOrigin;

#if COMPUTE
uniform ivec4 gRegion; // of the target, pixels: lower left corner and size of what is written
#endif

// The pixel's centre in the target.
vec2 target_center()
{
#if COMPUTE
    return vec2(ivec2(gl_GlobalInvocationID.xy) + gRegion.xy) + 0.5;
#else
    return gl_FragCoord.xy;
#endif
}

// The same in the maps that the passes read.
vec2 pixel_center()
{
    return target_center() + gOrigin;
}

// The same in uv, as every pass has it, whatever geometry it is drawn with.
vec2 pixel_uv()
{
    return pixel_center() * gInvRenderTargetSize;
}

// Farther than any surface: stands for sky and for depths that are no number. Its square still fits a float.
const float FAR_AWAY = 1e15;

float depth_component(vec4 texel)
{
#if DEPTH_IN_ALPHA
    return texel.a;
#else
    return texel.r;
#endif
}

// View distance (scene units) of a stored depth. Both ends of the depth range are exact constants and are blended
// as (1 - d) a + d b, because a + d (b - a) cancels where far is much larger than near.
float distance_from_depth(float depth)
{
#if DEPTH_IS_DISTANCE
    float distance = depth;
#else
    vec4 k = gDistanceFromDepth;
    PRECISE float distance = ((1.0 - depth) * k.x + depth * k.y) / ((1.0 - depth) * k.z + depth * k.w);
#endif
    // An infinite far plane divides by 0 at the sky, 0 / 0 is possible beyond it, and hosts may store infinity or what
    // is no number (a comparison with it is false): none of them may reach a sum.
    return abs(distance) < FAR_AWAY ? distance : FAR_AWAY;
}

// What a step of the depth format comes to in view distance (scene units), and what single precision loses anyway.
float depth_step(float distance)
{
    PRECISE float length = gDepthStep.x + distance * (gDepthStep.y + distance * gDepthStep.z);
    return length;
}

// A quantity that is linear across the picture of a plane: 1 / distance in perspective, distance itself where the
// projection is orthographic. PERSPECTIVE 1: it is known not to be, which spares choices and registers.
bool orthographic()
{
#if PERSPECTIVE
    return false;
#else
    return gRayDirection.x == 0.0;
#endif
}

float linear_from_distance(float distance)
{
    PRECISE float linear = orthographic() ? distance : 1.0 / distance;
    return linear;
}

// The same of a stored depth that is not sky.
float linear_from_depth(float depth)
{
#if DEPTH_IS_DISTANCE
    return linear_from_distance(depth);
#else
    vec4 k = gDistanceFromDepth;
    PRECISE vec2 fraction = vec2((1.0 - depth) * k.x + depth * k.y, (1.0 - depth) * k.z + depth * k.w);
    fraction = orthographic() ? fraction : fraction.yx;
    PRECISE float linear = fraction.x / fraction.y;
    return linear;
#endif
}

// What an error of `length` (scene units) about a surface comes to in it.
float linear_error(float length, float linear)
{
    PRECISE float error = orthographic() ? length : length * linear * linear;
    return error;
}

// What a step of the depth format comes to in it.
float linear_step(float linear)
{
    PRECISE vec2 shares = orthographic() ? vec2(1.0, linear * linear) : vec2(linear * linear, 1.0);
    PRECISE float sum = shares.x * gDepthStep.x + linear * gDepthStep.y + shares.y * gDepthStep.z;
    return sum;
}

// Whether a stored depth means that nothing was drawn.
bool is_sky(float depth)
{
#if DEPTH_IS_DISTANCE
    return !(abs(depth) < gSkyDepth) || depth == 0.0;
#else
    return depth == gSkyDepth;
#endif
}

// The full-size texel that stands for a pixel of the ambient map. At half size and even sizes, uv falls on the corner of
// four texels, where rounding would pick one at random and filtering would mix a silhouette's two sides (and let an
// infinite neighbour in, since 0 times infinity is no number); a quarter texel back, the lower left of the four is
// always meant. At full size uv is a centre already. May lie outside the map where uv does.
ivec2 texel_from_uv(vec2 uv)
{
    return ivec2(floor(uv * vec2(textureSize(u_depth_map, 0)) - 0.25));
}

vec2 uv_from_texel(ivec2 texel)
{
    return (vec2(texel) + 0.5) / vec2(textureSize(u_depth_map, 0));
}

// What the host stores at a texel of the map.
float fetched_depth(ivec2 texel)
{
    return depth_component(texelFetch(u_depth_map, texel, 0));
}

// How far off (scene units) the distance of a linearly filtered depth may be on a surface with this unit normal: filters
// weigh in steps of 1/256 of a texel, and a surface seen at a grazing angle changes much from texel to texel.
float filter_error(vec2 uv, float distance, vec3 normal_view)
{
    vec2 texel = (gRayOrigin.xy + distance * gRayDirection.xy) / vec2(textureSize(u_depth_map, 0));
    vec3 ray = vec3(uv * gRayDirection.xy + gRayDirection.zw, -1.0);
    // Edge-on, the surface lies along the ray, and there is no bound.
    return dot(abs(normal_view.xy), abs(texel)) / max(256.0 * abs(dot(normal_view, ray)), 1e-3);
}

// What the host stores at uv, filtered by the depth sampler.
float stored_depth(vec2 uv)
{
#if DEPTH_IS_DISTANCE
    // Distances that mean sky (0, infinite, no number) can't be mixed with others, which 0 would bring near: beside one of
    // them the nearest texel counts alone.
    ivec2 last = textureSize(u_depth_map, 0) - 1;
    vec2 texels = uv * vec2(last + 1);
    ivec2 low = clamp(ivec2(floor(texels - 0.5)), ivec2(0), last);
    ivec2 high = clamp(ivec2(floor(texels + 0.5)), ivec2(0), last);
    bool beside_sky = is_sky(fetched_depth(low)) || is_sky(fetched_depth(high)) ||
                      is_sky(fetched_depth(ivec2(low.x, high.y))) || is_sky(fetched_depth(ivec2(high.x, low.y)));
    if (beside_sky && uv == clamp(uv, 0.0, 1.0)) {
        float depth = fetched_depth(min(ivec2(texels), last));
        return is_sky(depth) ? FAR_AWAY : depth;
    }
#endif
    return depth_component(texture(u_depth_map, uv));
}

// What classic and hemisphere make of a radius below a pixel is what the depth filter shows between two texels, where no surface
// is: 1 from a pixel of the target on, below it less in proportion.
float radius_fade(float distance)
{
    vec2 pixel = abs(gRayOrigin.xy + distance * gRayDirection.xy) * gInvRenderTargetSize;
    float width = min(pixel.x, pixel.y);
    return width > gOcclusionRadius ? gOcclusionRadius / width : 1.0; // so that at the eye, where it is 0, nothing is divided
}

// The point that is seen at uv at a view distance (scene units).
vec3 position_view_from_uv(vec2 uv, float distance)
{
    vec2 origin = uv * gRayOrigin.xy + gRayOrigin.zw;
    vec2 direction = uv * gRayDirection.xy + gRayDirection.zw;
    return vec3(origin + distance * direction, -distance);
}
