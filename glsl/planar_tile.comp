// SPDX-License-Identifier: MIT
// The rounds of the planar blur, and the step to full size, for a tile of the picture in shared memory: what the passes of
// planar_blur.frag and upsample.frag make of it, one after the other, without the way through a map in between.
// in  u_ambient_map  paired map; fetched
// out u_target       UPSAMPLE 1: accessibility at full size; else with PAIRED 1 the paired map, with 0 accessibility
// ROUNDS_1, ROUNDS_2 1: that many rounds, else none.
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
const int WIDTH = GROUP_X;
const int HALO = 2 * ROUNDS; // each direction of a round reads two texels on either side
const int MADE_X = WIDTH - 2 * HALO - FACTOR + 1; // upsampling reads one more to the right and above
const int MADE_Y = HEIGHT - 2 * HALO - FACTOR + 1;

// Two tiles, by turns, one after the other (GLSL 3.30 has no arrays of arrays), between what the ends of rows read beyond.
const int FIRST = 2;
const int SECOND = FIRST + WIDTH * HEIGHT;
shared vec2 tiles[SECOND + WIDTH * HEIGHT + 2];

// Where the map begins and ends, in texels of the tile.
ivec2 low, high;

// Accessibility at a place, blurred along x (`by` 1) or y (`by` WIDTH).
float blurred_at(int at, int by)
{
    return blurred(tiles[at - 2 * by], tiles[at - by], tiles[at], tiles[at + by], tiles[at + 2 * by],
                   by == 1 ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
}

// A place in the tile that begins at `tile`. Beyond the map lies its edge.
int place(int tile, int row)
{
    return tile + clamp(row, low.y, high.y) * WIDTH + clamp(int(gl_LocalInvocationID.x), low.x, high.x);
}

// Blurs all rows but so many at either end from one tile into the other.
void blur_tile(int from, int to, int but, int by)
{
    for (int row = but + int(gl_LocalInvocationID.y); row < HEIGHT - but; row += GROUP_Y) {
        int at = place(from, row);
        vec2 center = tiles[at];
        tiles[to + row * WIDTH + int(gl_LocalInvocationID.x)] =
            paired(blurred_at(at, by), center.y, normal_code(center));
    }
    barrier();
}

#if UPSAMPLE
// The four pixels that belong to a texel.
void write(int row, ivec2 texel)
{
    int at = FIRST + row * WIDTH + int(gl_LocalInvocationID.x);
    vec2 a = tiles[at];
    vec2 b = tiles[at + 1];
    vec2 c = tiles[at + WIDTH];
    vec2 d = tiles[at + WIDTH + 1];
    vec2 full_size = vec2(textureSize(u_depth_map, 0));
    for (int i = 0; i < 4; ++i) {
        ivec2 odd = ivec2(i & 1, i >> 1);
        ivec2 pixel = 2 * texel + odd;
        if (pixel.x >= gRegion.z || pixel.y >= gRegion.w)
            continue;
        vec2 uv = (vec2(pixel + gRegion.xy) + 0.5 + gOrigin) / full_size;
        imageStore(u_target, pixel + gRegion.xy,
                   vec4(upsampled(a, odd.x == 1 ? b : a, odd.y == 1 ? c : a,
                                  odd.x == 1 ? (odd.y == 1 ? d : b) : (odd.y == 1 ? c : a), vec2(odd), uv)));
    }
}
#else
// The last direction of the last round, whose accessibility the paired map would round.
void write(int row, ivec2 texel)
{
    int at = place(SECOND, row);
    vec2 center = tiles[at];
    float accessibility = blurred_at(at, WIDTH);
    if (texel.x >= gRegion.z || texel.y >= gRegion.w)
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
    high = low + textureSize(u_ambient_map, 0) - 1;
    for (int row = int(gl_LocalInvocationID.y); row < HEIGHT; row += GROUP_Y)
        tiles[FIRST + row * WIDTH + column] =
            texelFetch(u_ambient_map, corner + clamp(ivec2(column, row), low, high), 0).rg;
    barrier();
#if ROUNDS_2
    blur_tile(FIRST, SECOND, 0, 1);
    blur_tile(SECOND, FIRST, 2, WIDTH);
#endif
#if ROUNDS_1 || ROUNDS_2
    blur_tile(FIRST, SECOND, HALO - 2, 1);
#if UPSAMPLE
    blur_tile(SECOND, FIRST, HALO, WIDTH);
#endif
#endif
    if (column >= HALO && column < HALO + MADE_X)
        for (int row = HALO + int(gl_LocalInvocationID.y); row < HALO + MADE_Y; row += GROUP_Y)
            write(row, made + ivec2(column, row) - HALO);
}
