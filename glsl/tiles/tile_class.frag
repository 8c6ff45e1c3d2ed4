// SPDX-License-Identifier: MIT
// Whether a tile needs an estimate. It needs none where the estimate's own rules leave every pixel at 1 whatever lies between
// the bounds: no surface is seen; no sample leaves its own texel; everything in reach lies within a range of distance that does
// not count; or the tile is a plane and everything in reach lies in it or below. proof.md has the proofs, and what they allow
// for rounding.
// MIDDLES 1: other tiles are taken for their middles, and a tile itself for that and its corners, before bounds are known. What
// spoils a plane there does so too when all of a tile counts, so a tile that needs an estimate here needs one in any case.
// in  u_ambient_map  bounds of tiles; fetched (MIDDLES 0)
// out o_needed       1: to be estimated, 0: open; with MIDDLES 1 how many tiles count for one that may be open, along either
//                    axis and with itself, as ring in tile_blocks.frag's code, and 0 for a tile that needs an estimate

#if !MIDDLES
uniform sampler2D u_ambient_map;
#endif
out float o_needed;

const int MOST_TILES = 16;    // in reach along an axis; with more, the tile is estimated unseen
const float FACING = 0.35;    // cosine: at more of a slant, horizon's polynomials leave more of a plane than a step of R16

vec3 bounds_of(ivec2 tile)
{
#if MIDDLES
    return vec3(distances_at(middle_of_tile(tile)), 0.0);
#else
    return texelFetch(u_ambient_map, tile, 0).xyz;
#endif
}

int counting = 1; // tiles that count along an axis, as far as needs_estimate() has looked

// How far samples reach, in texels; negative: there is no bound.
vec2 reach_of(float nearest, vec2 widest_ray)
{
    float reach = gTiles.y * gOcclusionRadius;
#if RADIUS_GROWS
    nearest = 1.0; // radius and picture grow alike
#endif
#if FROM_DEPTH
    // Samples lie in a ball, whose image is wider off the axis and nearer to the eye.
    float depth = orthographic() ? 1.0 : nearest - reach;
    vec2 wide = orthographic() ? vec2(reach) : reach * (1.0 + widest_ray);
#else
    float depth = orthographic() ? 1.0 : nearest;
    vec2 wide = vec2(reach);
#endif
    return depth > 0.0 ? wide / (texel_view() * depth) : vec2(-1.0);
}

vec2 corner_of(ivec2 tile, int i)
{
    vec2 corner = vec2(tile + ivec2(i & 1, i >> 1)) * float(tile_side());
    return uv_at(min(corner, vec2(map_size())) - 0.5);
}

#if PLANES
// Whether nothing of the other tile rises above the plane through `point`.
bool lies_below(ivec2 tile, float nearest, vec3 plane, vec3 point)
{
    float side = float(tile_side());
    vec2 middle = uv_at((vec2(tile) + 0.5) * side - 0.5);
    vec2 half_uv = 0.5 * side * (uv_at(vec2(1.0)) - uv_at(vec2(0.0)));
    // Heights over the parallel plane through the eye, at the corner where they are greatest. Seen from the plane's front,
    // every ray leads downwards, so the nearest surface is the highest.
    vec3 ray = ray_at(middle);
    float along = dot(plane, ray) + dot(abs(plane.xy * gRayDirection.xy), half_uv);
    float origin = dot(plane.xy, middle * gRayOrigin.xy + gRayOrigin.zw) + dot(abs(plane.xy * gRayOrigin.xy), half_uv);
    // The way by the eye is longer than any from the point to the other tile; the rays of a tile are alike.
    float farthest = length(point) + 2.0 * nearest * length(ray) + length(point.xy);
    return nearest > 0.0 && along < 0.0 && origin + along * nearest - dot(plane, point) < -gTiles.z * farthest;
}

#if MIDDLES
// How far the tile's corners are from its plane, as tile_rows.frag measures it.
float off_at_corners(ivec2 tile, vec3 plane)
{
    float turn = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = min(tile * tile_side() + ivec2(i & 1, i >> 1) * (tile_side() - 1), map_size() - 1);
        vec3 deviation = normal_at(texel) - plane;
        turn = max(turn, distances_at(texel).y > 0.0 ? dot(deviation, deviation) : 1.0);
    }
    return sqrt(turn);
}
#endif

bool lies_in_plane(ivec2 tile, vec3 bounds, vec3 plane, vec3 point)
{
    ivec2 middle = middle_of_tile(tile);
    vec3 to_middle = position_view_from_uv(uv_at(vec2(middle)), distances_at(middle).x) - point;
    return bounds.z <= gTiles.z && length(normal_at(middle) - plane) <= gTiles.z &&
           abs(dot(plane, to_middle)) <= gTiles.z * length(to_middle);
}

// No occluder: sky that is out of reach.
bool is_open_sky(vec3 bounds, float farthest)
{
#if FROM_DEPTH
    return bounds.y == 0.0 && bounds.x > farthest + wanted_radius(farthest);
#else
    return bounds.y == 0.0;
#endif
}
#endif

bool needs_estimate(ivec2 tile)
{
    vec3 own = bounds_of(tile);
    if (own.y == 0.0 || own.x >= gFadeFar.x)
        return false;
    vec2 widest_ray = vec2(0.0);
    for (int i = 0; i < 4; ++i)
        widest_ray = max(widest_ray, abs(ray_at(corner_of(tile, i)).xy));
    vec2 reach = reach_of(own.x, widest_ray);
    if (reach.x < 0.0)
        return true;
#if !FROM_DEPTH
    if (max(reach.x, reach.y) < 0.49)
        return false;
#endif
    ivec2 tiles = (map_size() + tile_side() - 1) / tile_side();
    float side = float(tile_side());
    // Bounded first, since large numbers do not fit an integer.
    vec2 low = max(floor((vec2(tile) * side - reach - 1.0) / side), vec2(-1.0));
    vec2 high = min(floor((vec2(tile + 1) * side + reach + 1.0) / side), vec2(tiles));
    ivec2 first = max(ivec2(low), ivec2(0));
    ivec2 last = min(ivec2(high), tiles - 1);
    if (any(greaterThan(last - first, ivec2(MOST_TILES))))
        return true;
    counting = 2 + max(max(last.x - tile.x, tile.x - first.x), max(last.y - tile.y, tile.y - first.y));
    bool flat_all = false;
#if PLANES
    ivec2 middle = middle_of_tile(tile);
    vec3 plane = normal_at(middle);
    vec3 point = position_view_from_uv(uv_at(vec2(middle)), distances_at(middle).x);
#if MIDDLES
    own.z = off_at_corners(tile, plane);
#endif
    flat_all = own.z <= gTiles.z;
#if !FROM_DEPTH
    // On the picture's edge a sample may be clamped to a texel at right angles to its slice, where rounding decides.
    flat_all = flat_all && all(greaterThan(tile, ivec2(0))) && all(lessThan(tile, tiles - 1));
#endif
    for (int i = 0; i < 4; ++i) {
        vec3 ray = ray_at(corner_of(tile, i));
        flat_all = flat_all && -dot(plane, ray) >= FACING * length(ray);
    }
#endif
    float nearest = own.x;
    bool may_be_open = flat_all || gTiles.w > 0.0;
    for (int y = first.y; y <= last.y && may_be_open; ++y)
        for (int x = first.x; x <= last.x && may_be_open; ++x) {
            vec3 other = bounds_of(ivec2(x, y));
            nearest = min(nearest, other.x);
#if PLANES
            flat_all = flat_all && (is_open_sky(other, own.y) || lies_in_plane(ivec2(x, y), other, plane, point) ||
                                    lies_below(ivec2(x, y), other.x, plane, point));
            may_be_open = flat_all || gTiles.w > 0.0;
#endif
        }
    // Allows for the rounding of the two distances.
    return !flat_all && !(own.y - nearest + 1e-6 * own.y < gTiles.w);
}

void main()
{
    bool needed = needs_estimate(ivec2(gl_FragCoord.xy));
#if MIDDLES
    o_needed = needed ? 0.0 : 33.0 * float(counting); // one more than middles reach, since bounds may reach farther
#else
    o_needed = needed ? 1.0 : 0.0;
#endif
}
