// SPDX-License-Identifier: MIT
// Rounds of the planar blur, and the step to full size, for a tile of the picture in shared memory. The result is that of
// planar_blur.frag and upsample.frag one after the other, without a map in between.
// in  u_ambient_map  paired values; fetched
// out u_target       UPSAMPLE 1: accessibility at full size, with RAW 1 blocks as upsample.frag draws them; else by OUTPUT:
//                    accessibility or the paired value
// out u_bent_target  UPSAMPLE 1, BENT 1 or OUTPUT_BENT: bent normal and accessibility
// ROUNDS: how many rounds, 0 to 2. WIDE 1: the first of them is not the first of the blur.
//
// Invocations lie along a row of the tile, one for each texel and for each that the blur reads around it, so that the blur's
// addresses need no division. Those at the ends of a row compute values that nothing reads.

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

// The tile, which each step of the blur rewrites. The margins at both ends are for what the ends of rows read beyond.
const int MARGIN = LATER_REACH;
const int TEXELS = MARGIN + WIDTH * GROUP_ROWS + MARGIN;
shared vec2 tile[TEXELS]; // the first two numbers of the paired values
#if BENT
shared vec2 hidden[TEXELS]; // the others
#endif
shared bool any_shaded; // something occludes a texel of the tile

// The steps of the blur: the first round takes one along x and one along y, a later round a single one.
const int ALONG_X = 0;
const int ALONG_Y = 1;
const int AROUND = 2;
#if WIDE || ROUNDS == 2
const int LAST_STEP = AROUND;
#else
const int LAST_STEP = ALONG_Y;
#endif

// Where the map begins and ends, in texels of the tile.
ivec2 low = ivec2(0), high = ivec2(0); // set by main(); the values spare a warning of Mesa's

PAIRED texel_at(int at)
{
#if BENT
    return PAIRED(tile[at], hidden[at]);
#else
    return tile[at];
#endif
}

// The index of the invocation's texel in a row. Beyond the map its edge repeats.
int place(int row)
{
    return MARGIN + clamp(row, low.y, high.y) * WIDTH + clamp(int(gl_LocalInvocationID.x), low.x, high.x);
}

CONTENTS blurred_at(int at, int kind)
{
    if (kind == AROUND)
        return with_accessibility(texel_at(at), blurred_wide(tile[at - 3], tile[at - 3 * WIDTH], tile[at],
                                                             tile[at + 3 * WIDTH], tile[at + 3]));
    int by = kind == ALONG_X ? 1 : WIDTH;
    return blurred(texel_at(at - 2 * by), texel_at(at - by), texel_at(at), texel_at(at + by), texel_at(at + 2 * by),
                   kind == ALONG_X ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
}

// Blurs all rows but `but` at either end.
void blur_tile(int but, int kind)
{
    const int ROWS_EACH = GROUP_ROWS / GROUP_Y; // of an invocation
    PAIRED texels[ROWS_EACH];
    for (int i = 0; i < ROWS_EACH; ++i) {
        int row = int(gl_LocalInvocationID.y) + i * GROUP_Y, at = place(row);
        if (row >= but && row < GROUP_ROWS - but)
            texels[i] = paired(blurred_at(at, kind), tile[at].y, normal_code(tile[at]));
    }
    barrier();
    for (int i = 0; i < ROWS_EACH; ++i) {
        int row = int(gl_LocalInvocationID.y) + i * GROUP_Y;
        int into = MARGIN + row * WIDTH + int(gl_LocalInvocationID.x);
        if (row >= but && row < GROUP_ROWS - but) {
            tile[into] = texels[i].xy;
#if BENT
            hidden[into] = texels[i].zw;
#endif
        }
    }
    barrier();
}

#if UPSAMPLE && BENT
// Brings the tile to full size, pixel by pixel, which takes fewer registers than block by block. `made`: its first texel, within
// the region.
void write_pixels(ivec2 made)
{
    const ivec2 SIZE = 2 * ivec2(MADE_X, MADE_Y);
    for (int i = int(gl_LocalInvocationIndex); i < SIZE.x * SIZE.y; i += GROUP_X * GROUP_Y) {
        ivec2 within = ivec2(i % SIZE.x, i / SIZE.x), odd = within & 1, pixel = 2 * made + within;
        if (any(greaterThanEqual(pixel, gRegion.zw)))
            continue;
        pixel += gRegion.xy;
        int a = MARGIN + (HALO + within.y / 2) * WIDTH + HALO + within.x / 2, c = a + odd.y * WIDTH;
        vec2 full_uv = (vec2(pixel) + 0.5 + gOrigin) * gFullTexel;
#if NORMALS == NORMALS_REBUILT
        fetch_corner_normals(full_uv);
#endif
        CONTENTS contents = upsampled(texel_at(a), texel_at(a + odd.x), texel_at(c), texel_at(c + odd.x), vec2(odd), full_uv);
        imageStore(u_target, pixel, contents.xxxx);
        imageStore(u_bent_target, pixel, vec4(normalize(contents.yzw), contents.x));
    }
}
#elif UPSAMPLE && RAW
// Of the four pixels that the texel is the lower left of.
void write(int row, ivec2 texel)
{
    int at = MARGIN + row * WIDTH + int(gl_LocalInvocationID.x);
    if (any(greaterThanEqual(texel, gRegion.zw)))
        return;
    texel += gRegion.xy;
    fetch_corner_raws(texel);
    vec2 full_uv = (2.0 * vec2(texel) + gPick + 0.5) * gFullTexel;
    block four = upsampled_block(tile[at], tile[at + 1], tile[at + WIDTH], tile[at + WIDTH + 1], full_uv);
    imageStore(u_target, texel, vec4(four.lower_left, four.lower_right, four.upper_left, four.upper_right));
}
#elif UPSAMPLE
void store(ivec2 pixel, float accessibility)
{
    if (all(lessThan(pixel, gRegion.zw)))
        imageStore(u_target, pixel + gRegion.xy, vec4(accessibility));
}

// The four pixels that the texel is the lower left of.
void write(int row, ivec2 texel)
{
    int at = MARGIN + row * WIDTH + int(gl_LocalInvocationID.x);
    ivec2 pixel = 2 * texel;
    vec2 full_uv = (vec2(pixel + gRegion.xy) + 0.5 + gOrigin) * gFullTexel;
    block four = upsampled_block(tile[at], tile[at + 1], tile[at + WIDTH], tile[at + WIDTH + 1], full_uv);
    store(pixel, four.lower_left);
    store(pixel + ivec2(1, 0), four.lower_right);
    store(pixel + ivec2(0, 1), four.upper_left);
    store(pixel + ivec2(1, 1), four.upper_right);
}
#else
// The last step: a tile of paired values would round its accessibility.
void write(int row, ivec2 texel)
{
    int at = place(row);
    CONTENTS contents = any_shaded ? blurred_at(at, LAST_STEP) : OPEN;
    if (any(greaterThanEqual(texel, gRegion.zw)))
        return;
#if OUTPUT == OUTPUT_PAIRED
    PAIRED value = paired(contents, tile[at].y, normal_code(tile[at]));
#if BENT
    imageStore(u_target, texel + gRegion.xy, value);
#else
    imageStore(u_target, texel + gRegion.xy, vec4(value, 0.0, 1.0));
#endif
#elif OUTPUT == OUTPUT_BENT
    vec2 full_uv = ((vec2(texel + gRegion.xy) + gOrigin) * float(gFactor) + 0.5) * gFullTexel;
    vec4 value = delivered(contents, is_far(tile[at].y), normal_view_at_uv(full_uv));
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
        int at = MARGIN + row * WIDTH + column;
        tile[at] = texel.xy;
#if BENT
        hidden[at] = texel.zw;
#endif
        if (is_shaded(texel))
            any_shaded = true;
    }
    barrier();
    // Where nothing occludes, the blur changes nothing.
    if (any_shaded) {
#if WIDE && ROUNDS == 2
        blur_tile(FIRST_REACH, AROUND);
#elif !WIDE && ROUNDS > 0
        blur_tile(0, ALONG_X);
#if ROUNDS == 2
        blur_tile(FIRST_REACH, ALONG_Y);
#endif
#endif
#if UPSAMPLE && ROUNDS > 0
        blur_tile(HALO, LAST_STEP);
#endif
    }
#if UPSAMPLE && BENT
    write_pixels(made);
#else
    if (column >= HALO && column < HALO + MADE_X)
        for (int row = HALO + int(gl_LocalInvocationID.y); row < HALO + MADE_Y; row += GROUP_Y)
            write(row, made + ivec2(column, row) - HALO);
#endif
}
