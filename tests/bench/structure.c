/* SPDX-License-Identifier: MIT
 *
 * Grain and specks.
 */
#include "structure.h"

#include "filter.h"
#include "measure.h"

#include <math.h>
#include <stdlib.h>

/* exp(-2 pi^2 sigma^2 / 8^2) = 1/2 */
static const double halving_sigma = 1.4991;
static const float steepest = 0.01f; /* change of the truth from pixel to pixel */
static const float inside = 0.999f;  /* share of the blur's weight on smooth pixels */

static void blur(const grain_places *g, const float *in, double sigma, float *out)
{
    const kernel k = kernel_gaussian(sigma, (int)ceil(4 * sigma));
    filter_picture(in, g->width, g->height, &k, &k, FILTER_ZERO, g->scratch[2], out);
}

bool grain_create(grain_places *g, const float *truth, const uint8_t *classes, int width, int height)
{
    *g = (grain_places){.width = width, .height = height};
    const size_t count = (size_t)width * (size_t)height;
    g->smooth = calloc(count, 1);
    g->weight = calloc(count, 4 * sizeof *g->weight);
    if (!g->smooth || !g->weight)
        return false;
    for (size_t i = 0; i < 3; i++)
        g->scratch[i] = g->weight + (i + 1) * count;
    float *blurred = g->scratch[0], *seen = g->scratch[1];
    for (size_t i = 0; i < count; i++) {
        seen[i] = classes[i] != PIXEL_NONE;
        blurred[i] = seen[i] * truth[i];
    }
    blur(g, blurred, 3, blurred);
    blur(g, seen, 3, seen);
    for (size_t i = 0; i < count; i++)
        blurred[i] = seen[i] > 0 ? blurred[i] / seen[i] : 0;
    for (int y = 1; y + 1 < height; y++)
        for (int x = 1; x + 1 < width; x++) {
            const size_t i = (size_t)y * (size_t)width + (size_t)x;
            const float dx = (blurred[i + 1] - blurred[i - 1]) / 2;
            const float dy = (blurred[i + (size_t)width] - blurred[i - (size_t)width]) / 2;
            g->smooth[i] = classes[i] == PIXEL_SMOOTH && hypotf(dx, dy) < steepest;
        }
    for (size_t i = 0; i < count; i++)
        g->weight[i] = g->smooth[i];
    blur(g, g->weight, halving_sigma, g->weight);
    return true;
}

void grain_destroy(grain_places *g)
{
    free(g->smooth);
    free(g->weight);
    *g = (grain_places){.width = 0};
}

double grain_measure(grain_places *g, const float *picture)
{
    const size_t count = (size_t)g->width * (size_t)g->height;
    float *blurred = g->scratch[0];
    for (size_t i = 0; i < count; i++)
        blurred[i] = g->smooth[i] ? picture[i] : 0;
    blur(g, blurred, halving_sigma, blurred);
    double sum = 0, pixels = 0;
    for (size_t i = 0; i < count; i++) {
        if (!(g->weight[i] > inside)) /* the mean of one side alone would hold the picture's slope */
            continue;
        const double left = (double)picture[i] - (double)blurred[i] / (double)g->weight[i];
        sum += left * left;
        pixels++;
    }
    return pixels > 0 ? sqrt(sum / pixels) : 0;
}

int count_specks(const float *picture, const float *truth, const uint8_t *classes, int width, int height)
{
    int specks = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            float least = INFINITY;
            for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; j++)
                for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++)
                    if (classes[j * width + i] != PIXEL_NONE)
                        least = fminf(least, truth[j * width + i]);
            specks += classes[y * width + x] != PIXEL_NONE && picture[y * width + x] < least - 0.5f;
        }
    return specks;
}
