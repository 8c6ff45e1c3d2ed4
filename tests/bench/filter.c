/* SPDX-License-Identifier: MIT
 *
 * Tap by tap over whole rows, so that the compiler can use vector instructions.
 */
#include "filter.h"

#include <math.h>
#include <string.h>

kernel kernel_gaussian(double sigma, int radius)
{
    kernel k = {.radius = radius};
    double sum = 0;
    for (int i = -radius; i <= radius; i++)
        sum += exp(-i * i / (2 * sigma * sigma));
    for (int i = -radius; i <= radius; i++)
        k.taps[i + radius] = (float)(exp(-i * i / (2 * sigma * sigma)) / sum);
    return k;
}

static void add_scaled(float *to, const float *from, float factor, int count)
{
    for (int i = 0; i < count; i++)
        to[i] += factor * from[i];
}

/* In pieces, so that the padded piece fits on the stack whatever the width. */
static void filter_row(const float *in, int width, const kernel *k, filter_edge edge, float *out)
{
    enum { PIECE = 1024 };
    float padded[PIECE + 2 * FILTER_MAX_RADIUS];
    for (int start = 0; start < width; start += PIECE) {
        const int count = width - start < PIECE ? width - start : PIECE;
        for (int i = -k->radius; i < count + k->radius; i++) {
            const int x = start + i, inside = x < 0 ? 0 : x >= width ? width - 1 : x;
            padded[i + k->radius] = edge == FILTER_ZERO && inside != x ? 0 : in[inside];
        }
        memset(out + start, 0, (size_t)count * sizeof *out);
        for (int t = 0; t <= 2 * k->radius; t++)
            add_scaled(out + start, padded + t, k->taps[t], count);
    }
}

void filter_picture(const float *in, int width, int height, const kernel *along_x, const kernel *along_y,
                    filter_edge edge, float *scratch, float *out)
{
    for (int y = 0; y < height; y++)
        filter_row(in + (size_t)y * (size_t)width, width, along_x, edge, scratch + (size_t)y * (size_t)width);
    for (int y = 0; y < height; y++) {
        float *to = out + (size_t)y * (size_t)width;
        memset(to, 0, (size_t)width * sizeof *to);
        for (int t = -along_y->radius; t <= along_y->radius; t++) {
            const int from = y + t, inside = from < 0 ? 0 : from >= height ? height - 1 : from;
            if (edge == FILTER_REPLICATE || inside == from)
                add_scaled(to, scratch + (size_t)inside * (size_t)width, along_y->taps[t + along_y->radius], width);
        }
    }
}
