// SPDX-License-Identifier: MIT
// The rounds of the planar blur, and the step to full size, for a tile of the picture in shared memory: what the passes of
// planar_blur.frag and upsample.frag make of it, one after the other, without the way through a map in between.
// in  u_ambient_map  paired map; fetched
// out u_target       UPSAMPLE 1: accessibility at full size; else with PAIRED 1 the paired map, with 0 accessibility
// ROUNDS_1, ROUNDS_2 1: that many rounds, else none. WIDE 1: the first of them is not the blur's first.

layout(local_size_x = GROUP_X, local_size_y = GROUP_Y) in;
uniform sampler2D u_ambient_map;
writeonly uniform image2D u_target;

#if ROUNDS_2
#define ROUNDS 2
#elif ROUNDS_1
#define ROUNDS 1
#else
#define ROUNDS 0
#endif
#if UPSAMPLE
const int FACTOR = 2; // pixels of the target per texel
#else
const int FACTOR = 1;
#endif
const int THREADS = GROUP_X * GROUP_Y;
#if WIDE
const int FIRST_REACH = 3; // texels that each direction of the first round reads on either side
#else
const int FIRST_REACH = 2;
#endif
const int LATER_REACH = 3;
const bool LAST_WIDE = WIDE == 1 || ROUNDS == 2;
const int LAST_REACH = LAST_WIDE ? LATER_REACH : FIRST_REACH;
const int HALO = ROUNDS == 0 ? 0 : FIRST_REACH + (ROUNDS - 1) * LATER_REACH;
const int WIDTH = TILE_X + 2 * HALO + FACTOR - 1;  // texels of the tile, with those around it; upsampling reads one more
const int HEIGHT = TILE_Y + 2 * HALO + FACTOR - 1; // to the right and above

// Two of them, by turns; no array of arrays in GLSL 3.30.
const int OTHER = WIDTH * HEIGHT;
shared vec2 tiles[2 * OTHER];

// The tile's lower left texel, with those around it, in the map.
ivec2 corner()
{
    return ivec2(gl_WorkGroupID.xy) * ivec2(TILE_X, TILE_Y) + (gRegion.xy + ivec2(gOrigin)) / FACTOR - HALO;
}

void load_tile()
{
    ivec2 first = corner();
    ivec2 last = textureSize(u_ambient_map, 0) - 1;
    for (int i = int(gl_LocalInvocationIndex); i < OTHER; i += THREADS)
        tiles[i] = texelFetch(u_ambient_map, clamp(first + ivec2(i % WIDTH, i / WIDTH), ivec2(0), last), 0).rg;
    barrier();
}

// Accessibility at a place in the tiles, blurred along x (`by` 1) or y (`by` WIDTH), in the blur's first round or a later.
float blurred_at(int at, int by, bool wide)
{
    vec2 way = by == 1 ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    if (wide)
        return blurred_wide(tiles[at - 3 * by], tiles[at], tiles[at + 3 * by], way);
    return blurred(tiles[at - 2 * by], tiles[at - by], tiles[at], tiles[at + by], tiles[at + 2 * by], way);
}

// The tile that begins at `to` from the other, but for so many texels along its sides. Texels beyond the map repeat its
// edge.
void blur_tile(int from, int to, ivec2 but, int by, bool wide)
{
    ivec2 first = -corner();
    ivec2 last = first + textureSize(u_ambient_map, 0) - 1;
    int width = WIDTH - 2 * but.x;
    for (int i = int(gl_LocalInvocationIndex); i < width * (HEIGHT - 2 * but.y); i += THREADS) {
        ivec2 texel = but + ivec2(i % width, i / width);
        ivec2 inside = clamp(texel, first, last);
        int at = from + inside.y * WIDTH + inside.x;
        vec2 center = tiles[at];
        tiles[to + texel.y * WIDTH + texel.x] = paired(blurred_at(at, by, wide), center.y, normal_code(center));
    }
    barrier();
}

#if UPSAMPLE
vec4 pixel_of_tile(ivec2 pixel)
{
    ivec2 odd = pixel & 1; // margins are even, so it is odd in the map, too
    int a = (pixel.y / 2 + HALO) * WIDTH + pixel.x / 2 + HALO;
    int c = a + odd.y * WIDTH;
    ivec2 place = pixel + ivec2(gl_WorkGroupID.xy) * 2 * ivec2(TILE_X, TILE_Y) + gRegion.xy + ivec2(gOrigin);
    return vec4(upsampled(tiles[a], tiles[a + odd.x], tiles[c], tiles[c + odd.x], vec2(odd),
                          (vec2(place) + 0.5) / vec2(textureSize(u_depth_map, 0))));
}
#else
// The last direction of the last round, whose accessibility the paired map would round.
vec4 pixel_of_tile(ivec2 pixel)
{
    int at = OTHER + (pixel.y + HALO) * WIDTH + pixel.x + HALO;
    vec2 center = tiles[at];
#if PAIRED
    return vec4(paired(blurred_at(at, WIDTH, LAST_WIDE), center.y, normal_code(center)), 0.0, 1.0);
#else
    return vec4(blurred_at(at, WIDTH, LAST_WIDE));
#endif
}
#endif

void main()
{
    load_tile();
#if ROUNDS_2
    blur_tile(0, OTHER, ivec2(FIRST_REACH, 0), 1, WIDE == 1);
    blur_tile(OTHER, 0, ivec2(FIRST_REACH), WIDTH, WIDE == 1);
#endif
#if ROUNDS_1 || ROUNDS_2
    blur_tile(0, OTHER, ivec2(HALO, HALO - LAST_REACH), 1, LAST_WIDE);
#if UPSAMPLE
    blur_tile(OTHER, 0, ivec2(HALO, HALO), WIDTH, LAST_WIDE);
#endif
#endif
    const ivec2 made = FACTOR * ivec2(TILE_X, TILE_Y);
    for (int i = int(gl_LocalInvocationIndex); i < made.x * made.y; i += THREADS) {
        ivec2 pixel = ivec2(i % made.x, i / made.x);
        ivec2 place = pixel + ivec2(gl_WorkGroupID.xy) * made;
        if (all(lessThan(place, gRegion.zw)))
            imageStore(u_target, place + gRegion.xy, pixel_of_tile(pixel));
    }
}
