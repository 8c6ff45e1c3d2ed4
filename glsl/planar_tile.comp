// SPDX-License-Identifier: MIT
// The rounds of the planar blur, and the step to full size, for a tile of the picture in shared memory: what the passes of
// planar_blur.frag and upsample.frag make of it, one after the other, without the way through a map in between.
// in  u_ambient_map  paired map; fetched
// out u_target       UPSAMPLE 1: accessibility at full size; else with PAIRED 1 the paired map, with 0 accessibility
// ROUNDS_1, ROUNDS_2 1: that many rounds, else none. WIDE 1: the first of them is not the blur's first.
//
// Invocations lie along a row of the tile, one a texel with those that the blur takes around it, so that no address needs a
// division; those at the ends of a row make what nobody reads.

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
#if WIDE
const int FIRST_REACH = 3; // texels that the first round reads on either side
#else
const int FIRST_REACH = 2;
#endif
const int LATER_REACH = 3;
const int HALO = ROUNDS == 0 ? 0 : FIRST_REACH + (ROUNDS - 1) * LATER_REACH;
const int WIDTH = GROUP_X;
const int MADE_X = WIDTH - 2 * HALO - FACTOR + 1; // upsampling reads one more to the right and above
const int MADE_Y = HEIGHT - 2 * HALO - FACTOR + 1;

// Two tiles, by turns, one after the other (GLSL 3.30 has no arrays of arrays), between what the ends of rows read beyond.
const int FIRST = LATER_REACH;
const int SECOND = FIRST + WIDTH * HEIGHT;
shared vec2 tiles[SECOND + WIDTH * HEIGHT + LATER_REACH];
shared bool is_shaded; // anything in the tile

// The steps of the blur: a round takes one along x and one along y, a later one a single step.
const int ALONG_X = 0;
const int ALONG_Y = 1;
const int AROUND = 2;

// The last of them, and which tile it reads.
#if WIDE || ROUNDS_2
const int LAST_STEP = AROUND;
#else
const int LAST_STEP = ALONG_Y;
#endif
#if WIDE == ROUNDS_2
const int LAST_FROM = SECOND;
const int LAST_TO = FIRST;
#else
const int LAST_FROM = FIRST;
const int LAST_TO = SECOND;
#endif

// Where the map begins and ends, in texels of the tile.
ivec2 low, high;

float blurred_at(int at, int kind)
{
    if (kind == AROUND)
        return blurred_wide(tiles[at - 3], tiles[at - 3 * WIDTH], tiles[at], tiles[at + 3 * WIDTH], tiles[at + 3]);
    int by = kind == ALONG_X ? 1 : WIDTH;
    return blurred(tiles[at - 2 * by], tiles[at - by], tiles[at], tiles[at + by], tiles[at + 2 * by],
                   kind == ALONG_X ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
}

// A place in the tile that begins at `tile`. Beyond the map lies its edge.
int place(int tile, int row)
{
    return tile + clamp(row, low.y, high.y) * WIDTH + clamp(int(gl_LocalInvocationID.x), low.x, high.x);
}

// Blurs all rows but so many at either end from one tile into the other.
void blur_tile(int from, int to, int but, int kind)
{
    for (int row = but + int(gl_LocalInvocationID.y); row < HEIGHT - but; row += GROUP_Y) {
        int at = place(from, row);
        vec2 center = tiles[at];
        tiles[to + row * WIDTH + int(gl_LocalInvocationID.x)] =
            paired(blurred_at(at, kind), center.y, normal_code(center));
    }
    barrier();
}

#if UPSAMPLE
void store(ivec2 pixel, float accessibility)
{
    if (all(lessThan(pixel, gRegion.zw)))
        imageStore(u_target, pixel + gRegion.xy, vec4(accessibility));
}

// The four pixels that the texel is the lower left of, from the tile that begins at `from`.
void write(int from, int row, ivec2 texel)
{
    int at = from + row * WIDTH + int(gl_LocalInvocationID.x);
    ivec2 pixel = 2 * texel;
    vec2 full_uv = (vec2(pixel + gRegion.xy) + 0.5 + gOrigin) * gFullTexel;
    vec4 block = upsampled_block(tiles[at], tiles[at + 1], tiles[at + WIDTH], tiles[at + WIDTH + 1], full_uv);
    store(pixel, block.x);
    store(pixel + ivec2(1, 0), block.y);
    store(pixel + ivec2(0, 1), block.z);
    store(pixel + ivec2(1, 1), block.w);
}
#else
// The last step, whose accessibility the paired map would round.
void write(int from, int row, ivec2 texel)
{
    int at = place(from, row);
    vec2 center = tiles[at];
    float accessibility = is_shaded ? blurred_at(at, LAST_STEP) : 1.0;
    if (any(greaterThanEqual(texel, gRegion.zw)))
        return;
#if PAIRED
    imageStore(u_target, texel + gRegion.xy, vec4(paired(accessibility, center.y, normal_code(center)), 0.0, 1.0));
#else
    imageStore(u_target, texel + gRegion.xy, vec4(accessibility));
#endif
}
#endif

void main()
{
    int column = int(gl_LocalInvocationID.x);
    ivec2 made = ivec2(gl_WorkGroupID.xy) * ivec2(MADE_X, MADE_Y); // the first texel, within the region
    ivec2 corner = made + (gRegion.xy + ivec2(gOrigin)) / FACTOR - HALO; // the tile's, in the map; margins are even
    low = -corner;
    high = low + ivec2(gEstimateSize) - 1;
    if (gl_LocalInvocationIndex == 0u)
        is_shaded = false;
    barrier();
    for (int row = int(gl_LocalInvocationID.y); row < HEIGHT; row += GROUP_Y) {
        vec2 texel = texelFetch(u_ambient_map, corner + clamp(ivec2(column, row), low, high), 0).rg;
        tiles[FIRST + row * WIDTH + column] = texel;
        if (texel.x < 1.0)
            is_shaded = true;
    }
    barrier();
    int from = FIRST;
    // The blur leaves a tile as it is in which nothing occludes.
    if (is_shaded) {
#if WIDE && ROUNDS_2
        blur_tile(FIRST, SECOND, FIRST_REACH, AROUND);
#elif !WIDE && (ROUNDS_1 || ROUNDS_2)
        blur_tile(FIRST, SECOND, 0, ALONG_X);
#if ROUNDS_2
        blur_tile(SECOND, FIRST, FIRST_REACH, ALONG_Y);
#endif
#endif
#if UPSAMPLE && (ROUNDS_1 || ROUNDS_2)
        blur_tile(LAST_FROM, LAST_TO, HALO, LAST_STEP);
        from = LAST_TO;
#elif !UPSAMPLE
        from = LAST_FROM;
#endif
    }
    if (column >= HALO && column < HALO + MADE_X)
        for (int row = HALO + int(gl_LocalInvocationID.y); row < HALO + MADE_Y; row += GROUP_Y)
            write(from, row, made + ivec2(column, row) - HALO);
}
