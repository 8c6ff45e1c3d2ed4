/* SPDX-License-Identifier: MIT
 *
 * Directions on the hemisphere: the first two dimensions of Sobol's sequence, Owen-scrambled anew for every point (by
 * the hash of Burley, "Practical hash-based Owen scrambling", JCGT 2020), on the disk by the concentric map of Shirley
 * and Chiu (1997). The scrambling of a point is a function of its number and the seed alone. Each point's estimate is
 * unbiased, and points are independent of each other, so that what is left of the noise averages out.
 */
#include "trace_internal.h"

#include <math.h>
#include <stdlib.h>

/* A bijection whose every output bit depends on every input bit (the finaliser of MurmurHash3). */
uint32_t trace_mix(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    return x ^ x >> 16;
}

static uint32_t reverse_bits(uint32_t x)
{
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
}

/* Owen scrambling of a number whose bits are reversed: each bit is flipped by a hash of those below it. Laine and
 * Karras's construction with the constants of Burley's section 3. */
static inline uint32_t scrambled(uint32_t reversed, uint32_t seed)
{
    uint32_t x = reversed + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    return x ^ x * 0x8d22f6e6u;
}

/* The results have their bits in order again, and lie in the middle of 2^23 steps from 0 to 1, so that none is a half,
 * where the map to the disk has its corner. */
static void scramble(const uint32_t reversed[TRACE_PACKET], uint32_t seed, float out[TRACE_PACKET])
{
    for (int i = 0; i < TRACE_PACKET; i++)
        out[i] = ((float)(int32_t)(reverse_bits(scrambled(reversed[i], seed)) >> 9) + 0.5f) * 0x1p-23f;
}

uint32_t trace_owen(uint32_t x, uint32_t seed)
{
    return reverse_bits(scrambled(reverse_bits(x), trace_mix(seed)));
}

uint32_t trace_sobol(uint32_t index, int dimension)
{
    uint32_t value = 0, column = 1u << 31;
    for (int bit = 0; bit < 32; bit++) {
        value ^= index >> bit & 1u ? column : 0;
        /* The generator matrices: the identity, and Pascal's triangle modulo 2. */
        column = dimension == 0 ? column >> 1 : column ^ column >> 1;
    }
    return value;
}

bool trace_samples_open(trace_samples *s, int count, trace_distribution distribution, uint32_t seed)
{
    *s = (trace_samples){.count = count, .distribution = distribution, .seed = seed};
    const int room = (count + TRACE_PACKET - 1) / TRACE_PACKET * TRACE_PACKET;
    s->second = malloc((size_t)room * sizeof *s->second);
    if (!s->second)
        return false;
    for (int i = 0; i < room; i++)
        s->second[i] = reverse_bits(trace_sobol((uint32_t)i, 1));
    return true;
}

void trace_samples_close(trace_samples *s)
{
    free(s->second);
    s->second = NULL;
}

/* From the unit square to the unit disk, areas kept in proportion, in place. Without branches and calls, so that
 * compilers make vector code of it. The series of sine and cosine are cut where single precision ends within an eighth
 * of a turn. */
static void map_to_disk(float u[TRACE_PACKET], float v[TRACE_PACKET])
{
    for (int i = 0; i < TRACE_PACKET; i++) {
        const float a = 2 * u[i] - 1, b = 2 * v[i] - 1, quarter_pi = 0.785398163f;
        const bool wide = a * a > b * b;
        const float radius = wide ? a : b, other = wide ? b : a;
        const float angle = quarter_pi * other / radius, square = angle * angle;
        const float cosine = 1 + square * (-1 / 2.0f + square * (1 / 24.0f + square * (-1 / 720.0f + square / 40320)));
        const float sine = angle * (1 + square * (-1 / 6.0f + square * (1 / 120.0f - square / 5040)));
        u[i] = radius * (wide ? cosine : sine);
        v[i] = radius * (wide ? sine : cosine);
    }
}

void trace_samples_get(const trace_samples *s, uint64_t point, int first, float x[TRACE_PACKET], float y[TRACE_PACKET],
                       float z[TRACE_PACKET])
{
    const uint32_t key = trace_mix(trace_mix(trace_mix(s->seed) ^ (uint32_t)(point >> 32)) + (uint32_t)point);
    uint32_t numbers[TRACE_PACKET];
    for (int i = 0; i < TRACE_PACKET; i++)
        numbers[i] = (uint32_t)(first + i);
    /* The first dimension is the sample's number with its bits reversed; reversed again it is the number itself. */
    scramble(numbers, trace_mix(key ^ 0x9e3779b9u), x);
    scramble(s->second + first, trace_mix(key ^ 0x7f4a7c15u), y);
    map_to_disk(x, y);
    const bool uniform = s->distribution == TRACE_UNIFORM;
    for (int i = 0; i < TRACE_PACKET; i++) {
        const float square = x[i] * x[i] + y[i] * y[i], inside = square < 1 ? square : 1;
        /* Cosine: the disk is the hemisphere's projection. Uniform: Lambert's equal-area map of the disk. */
        const float stretch = uniform ? sqrtf(2 - inside) : 1;
        x[i] *= stretch;
        y[i] *= stretch;
        z[i] = uniform ? 1 - inside : sqrtf(1 - inside);
    }
}
