// SPDX-License-Identifier: MIT
// Rounds of the planar blur, and the step to full size, for a tile of the picture in shared memory. The result is that of
// planar_blur.frag and upsample.frag one after the other, without a map in between.
// in  u_ambient_map  paired values; fetched
// out u_target       UPSAMPLE 1: accessibility at full size, with RAW 1 blocks as upsample.frag draws them; else by OUTPUT:
//                    accessibility or the paired value
// out u_bent_target  UPSAMPLE 1, BENT 1 or OUTPUT_BENT: bent normal and accessibility
// ROUNDS: how many rounds, 0 to 2. WIDE 1: the first of them is not the first of the blur.
//
// Invocations lie along a row of the tile, one for each texel and for each that the blur reads around it, so that no address
// needs a division. Those at the ends of a row compute values that nothing reads.

layout(local_size_x = GROUP_X, local_size_y = GROUP_Y) in;
uniform sampler2D u_ambient_map;
writeonly uniform image2D u_target;
#if UPSAMPLE && BENT || OUTPUT == OUTPUT_BENT
writeonly uniform image2D u_bent_target;
#endif

#if UPSAMPLE && !RAW
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
const int MADE_X = WIDTH - 2 * HALO - UPSAMPLE; // upsampling reads one more to the right and above
const int MADE_Y = GROUP_ROWS - 2 * HALO - UPSAMPLE;

// Two tiles, which each step reads and writes by turns, in one array (GLSL 3.30 has no arrays of arrays). The margins at both
// ends are for what the ends of rows read beyond.
const int FIRST = LATER_REACH;
const int SECOND = FIRST + WIDTH * GROUP_ROWS;
shared PAIRED tiles[SECOND + WIDTH * GROUP_ROWS + LATER_REACH];
shared bool any_shaded; // something occludes a texel of the tile

// The steps of the blur: the first round takes one along x and one along y, a later round a single one.
const int ALONG_X = 0;
const int ALONG_Y = 1;
const int AROUND = 2;

// The last of them, which tile it reads, and which it writes.
#if WIDE || ROUNDS == 2
const int LAST_STEP = AROUND;
#else
const int LAST_STEP = ALONG_Y;
#endif
#if (WIDE == 1) == (ROUNDS == 2)
const int LAST_FROM = SECOND;
const int LAST_TO = FIRST;
#else
const int LAST_FROM = FIRST;
const int LAST_TO = SECOND;
#endif

// Where the map begins and ends, in texels of the tile.
ivec2 low = ivec2(0), high = ivec2(0); // set by main(); the values spare a warning of Mesa's

CONTENTS blurred_at(int at, int kind)
{
    if (kind == AROUND)
        return blurred_wide(tiles[at - 3], tiles[at - 3 * WIDTH], tiles[at], tiles[at + 3 * WIDTH], tiles[at + 3]);
    int by = kind == ALONG_X ? 1 : WIDTH;
    return blurred(tiles[at - 2 * by], tiles[at - by], tiles[at], tiles[at + by], tiles[at + 2 * by],
                   kind == ALONG_X ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
}

// The index of a texel in the tile that begins at `tile`. Beyond the map its edge repeats.
int place(int tile, int row)
{
    return tile + clamp(row, low.y, high.y) * WIDTH + clamp(int(gl_LocalInvocationID.x), low.x, high.x);
}

// Blurs all rows but `but` at either end from one tile into the other.
void blur_tile(int from, int to, int but, int kind)
{
    for (int row = but + int(gl_LocalInvocationID.y); row < GROUP_ROWS - but; row += GROUP_Y) {
        int at = place(from, row);
        PAIRED center = tiles[at];
        tiles[to + row * WIDTH + int(gl_LocalInvocationID.x)] =
            paired(blurred_at(at, kind), center.y, normal_code(center));
    }
    barrier();
}

#if UPSAMPLE && RAW
// Of the four pixels that the texel is the lower left of, from the tile that begins at `from`.
void write(int from, int row, ivec2 texel)
{
    int at = from + row * WIDTH + int(gl_LocalInvocationID.x);
    if (any(greaterThanEqual(texel, gRegion.zw)))
        return;
    texel += gRegion.xy;
    fetch_corner_raws(texel);
    vec2 full_uv = (2.0 * vec2(texel) + gPick + 0.5) * gFullTexel;
    block four = upsampled_block(tiles[at], tiles[at + 1], tiles[at + WIDTH], tiles[at + WIDTH + 1], full_uv);
    imageStore(u_target, texel, vec4(four.lower_left, four.lower_right, four.upper_left, four.upper_right));
}
#elif UPSAMPLE
void store(ivec2 pixel, CONTENTS contents)
{
    if (any(greaterThanEqual(pixel, gRegion.zw)))
        return;
#if BENT
    imageStore(u_target, pixel + gRegion.xy, contents.xxxx);
    imageStore(u_bent_target, pixel + gRegion.xy, vec4(normalize(contents.yzw), contents.x));
#else
    imageStore(u_target, pixel + gRegion.xy, vec4(contents));
#endif
}

// The four pixels that the texel is the lower left of, from the tile that begins at `from`.
void write(int from, int row, ivec2 texel)
{
    int at = from + row * WIDTH + int(gl_LocalInvocationID.x);
    ivec2 pixel = 2 * texel;
    vec2 full_uv = (vec2(pixel + gRegion.xy) + 0.5 + gOrigin) * gFullTexel;
    block four = upsampled_block(tiles[at], tiles[at + 1], tiles[at + WIDTH], tiles[at + WIDTH + 1], full_uv);
    store(pixel, four.lower_left);
    store(pixel + ivec2(1, 0), four.lower_right);
    store(pixel + ivec2(0, 1), four.upper_left);
    store(pixel + ivec2(1, 1), four.upper_right);
}
#else
// The last step: a tile of paired values would round its accessibility.
void write(int from, int row, ivec2 texel)
{
    int at = place(from, row);
    PAIRED center = tiles[at];
    CONTENTS contents = any_shaded ? blurred_at(at, LAST_STEP) : OPEN;
    if (any(greaterThanEqual(texel, gRegion.zw)))
        return;
#if OUTPUT == OUTPUT_PAIRED
    PAIRED value = paired(contents, center.y, normal_code(center));
#if BENT
    imageStore(u_target, texel + gRegion.xy, value);
#else
    imageStore(u_target, texel + gRegion.xy, vec4(value, 0.0, 1.0));
#endif
#elif OUTPUT == OUTPUT_BENT
    vec2 full_uv = ((vec2(texel + gRegion.xy) + gOrigin) * float(gFactor) + 0.5) * gFullTexel;
    vec4 value = delivered(contents, is_far(center.y), normal_view_at_uv(full_uv));
    imageStore(u_target, texel + gRegion.xy, value.xxxx);
    imageStore(u_bent_target, texel + gRegion.xy, vec4(normalize(value.yzw), value.x));
#else
    imageStore(u_target, texel + gRegion.xy, vec4(contents));
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
        any_shaded = false;
    barrier();
    for (int row = int(gl_LocalInvocationID.y); row < GROUP_ROWS; row += GROUP_Y) {
        PAIRED texel = PAIRED(texelFetch(u_ambient_map, corner + clamp(ivec2(column, row), low, high), 0));
        tiles[FIRST + row * WIDTH + column] = texel;
        if (is_shaded(texel))
            any_shaded = true;
    }
    barrier();
    int from = FIRST;
    // Where nothing occludes, the blur changes nothing.
    if (any_shaded) {
#if WIDE && ROUNDS == 2
        blur_tile(FIRST, SECOND, FIRST_REACH, AROUND);
#elif !WIDE && ROUNDS > 0
        blur_tile(FIRST, SECOND, 0, ALONG_X);
#if ROUNDS == 2
        blur_tile(SECOND, FIRST, FIRST_REACH, ALONG_Y);
#endif
#endif
#if UPSAMPLE && ROUNDS > 0
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
