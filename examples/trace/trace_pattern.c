/* SPDX-License-Identifier: MIT
 *
 * Directions for a picture's pixels: a tile of them that is repeated. The rays of an aligned block of 4 x 4 pixels are
 * one Owen-scrambled Sobol net (a (0, m, 2)-net, so stratified in every way that boxes allow), dealt to the pixels in
 * Bayer's order. Blocks differ in the lower bits alone: the upper half of each coordinate's bits says in which cell of
 * a grid a point lies, and a pixel's place in its block decides about it. So 4 x 4 pixels that lie across blocks have
 * one point in each cell too, and what is left of the noise differs from block to block.
 */
#include "trace_internal.h"

#include <math.h>
#include <stdlib.h>

enum { BLOCK = 4, MOST_ROOM = 1 << 15, MOST_SIDE = 64 };

/* Bayer's order of a 4 x 4 block. */
static int place_in_block(int x, int y)
{
    const int across = x ^ y;
    return (across & 1) << 3 | (y & 1) << 2 | (across & 2) | (y & 2) >> 1;
}

/* Bits of both coordinates that the grid of cells takes, of so many points. */
static void choose_grid(int points, int out_bits[2])
{
    int bits = 0;
    while (1 << bits < points)
        bits++;
    out_bits[0] = (bits + 1) / 2;
    out_bits[1] = bits / 2;
}

/* Ray `number` of a pixel in one block: two fractions of 32 bits. */
static void find_point(int x, int y, int number, int room, uint32_t block_seed, uint32_t seed, const int grid[2],
                       uint32_t out[2])
{
    const int place = place_in_block(x % BLOCK, y % BLOCK);
    /* A pixel that traces some of its points only leaves out others than its neighbours do, and than the pixel of that
     * place in the next blocks: so the first rays of 16 x 16 pixels reach every cell of the grid. */
    const int swapped = place >> 3 | (place & 4) >> 1 | (place & 2) << 1 | (place & 1) << 3;
    const int turned = number ^ ((swapped ^ place_in_block(x / BLOCK, y / BLOCK)) & (room - 1));
    const uint32_t index = (uint32_t)(place * room + turned);
    for (int i = 0; i < 2; i++) {
        const uint32_t point = trace_sobol(index, i), upper = ~0u << (32 - grid[i]);
        const uint32_t shared = trace_owen(point, seed + (uint32_t)i),
                       own = trace_owen(point, block_seed + (uint32_t)i);
        out[i] = (shared & upper) | (own & ~upper);
    }
}

/* On the disk by the concentric map of Shirley and Chiu (1997), and up to the hemisphere. */
static void aim(const uint32_t point[2], float out[3])
{
    const double a = (point[0] + 0.5) * 0x1p-31 - 1, b = (point[1] + 0.5) * 0x1p-31 - 1,
                 quarter_pi = 0.7853981633974483;
    const bool wide = fabs(a) > fabs(b);
    const double radius = wide ? a : b; /* never 0 */
    const double angle = wide ? quarter_pi * b / a : 2 * quarter_pi - quarter_pi * a / b;
    out[0] = (float)(radius * cos(angle));
    out[1] = (float)(radius * sin(angle));
    out[2] = (float)sqrt(1 - radius * radius);
}

bool trace_pattern_open(trace_pattern *p, int rays, uint32_t seed)
{
    int side = MOST_SIDE, grid[2];
    while (side > BLOCK && side * side * rays > MOST_ROOM)
        side /= 2;
    const size_t count = (size_t)(side * side) * (size_t)rays;
    *p = (trace_pattern){.side = side, .rays = rays, .directions = malloc(count * sizeof *p->directions)};
    if (!p->directions)
        return false;
    int room = 1; /* the rays of a pixel are an aligned run of points, and so stratified themselves */
    while (room < rays)
        room *= 2;
    choose_grid(BLOCK * BLOCK * room, grid);
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            const uint32_t block = (uint32_t)(y / BLOCK * side + x / BLOCK);
            for (int k = 0; k < rays; k++) {
                uint32_t point[2];
                find_point(x, y, k, room, trace_mix(seed + 2 * block + 1), trace_mix(seed), grid, point);
                aim(point, p->directions[(size_t)(y * side + x) * (size_t)rays + (size_t)k]);
            }
        }
    return true;
}

void trace_pattern_close(trace_pattern *p)
{
    free(p->directions);
    p->directions = NULL;
}
