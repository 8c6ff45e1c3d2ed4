/* SPDX-License-Identifier: MIT
 *
 * The light that a surface gets from an environment: Ramamoorthi and Hanrahan 2001, "An Efficient Representation for
 * Irradiance Environment Maps", for matte ones; for mirrors the sums of GGX lobes of Karis 2013, "Real Shading in
 * Unreal Engine 4", seen along the normal, whose samples read levels of a pyramid as large as their share of the lobe
 * (Krivanek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling").
 */
#include "environment.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SAMPLES = 256, PYRAMID = 10 /* levels, ENVIRONMENT_WIDTH to 1 */ };
static const float pi = 3.14159265358979f;

typedef struct pyramid {
    environment_picture levels[PYRAMID];
} pyramid;

static bool make_picture(environment_picture *p, int width, int height)
{
    *p = (environment_picture){.width = width, .height = height};
    p->rgb = malloc(3 * (size_t)width * (size_t)height * sizeof(float));
    return p->rgb;
}

static const float *texel(const environment_picture *p, int x, int y)
{
    x = x < 0 ? x + p->width : x >= p->width ? x - p->width : x;
    y = y < 0 ? 0 : y >= p->height ? p->height - 1 : y;
    return p->rgb + 3 * ((size_t)y * (size_t)p->width + (size_t)x);
}

/* Adds `share` of the picture at uv: filtered linearly, wrapped round, held at the poles. */
static void add_filtered(const environment_picture *p, const float uv[2], float share, float sum[3])
{
    const float x = uv[0] * (float)p->width - 0.5f, y = uv[1] * (float)p->height - 0.5f;
    const float left = floorf(x), top = floorf(y), right_share = x - left, bottom_share = y - top;
    for (int i = 0; i < 4; i++) {
        const float *t = texel(p, (int)left + (i & 1), (int)top + (i >> 1));
        const float weight =
            share * (i & 1 ? right_share : 1 - right_share) * (i >> 1 ? bottom_share : 1 - bottom_share);
        for (int k = 0; k < 3; k++)
            sum[k] += weight * t[k];
    }
}

static void uv_of(const float direction[3], float out_uv[2])
{
    out_uv[0] = 0.5f + atan2f(direction[0], -direction[2]) / (2 * pi);
    out_uv[1] = acosf(fminf(fmaxf(direction[1], -1), 1)) / pi;
}

static void direction_of(const environment_picture *p, int x, int y, float out[3])
{
    const float turn = 2 * pi * (((float)x + 0.5f) / (float)p->width - 0.5f);
    const float down = pi * ((float)y + 0.5f) / (float)p->height;
    out[0] = sinf(down) * sinf(turn);
    out[1] = cosf(down);
    out[2] = -sinf(down) * cosf(turn);
}

/* Each texel is the mean of those it covers. */
static bool halve(const environment_picture *from, environment_picture *to)
{
    const int across = from->width > 1 ? 2 : 1, down = from->height > 1 ? 2 : 1;
    if (!make_picture(to, from->width / across, from->height / down))
        return false;
    for (int y = 0; y < to->height; y++)
        for (int x = 0; x < to->width; x++) {
            float sum[3] = {0};
            for (int i = 0; i < across * down; i++)
                for (int k = 0; k < 3; k++)
                    sum[k] += texel(from, x * across + i % across, y * down + i / across)[k];
            for (int k = 0; k < 3; k++)
                to->rgb[3 * (y * to->width + x) + k] = sum[k] / (float)(across * down);
        }
    return true;
}

/* The sky at ENVIRONMENT_WIDTH: halved while it is twice that or more, then filtered. */
static bool make_base(const environment_picture *sky, environment_picture *out)
{
    environment_picture own = *sky;
    bool done = true;
    while (done && own.width >= 2 * ENVIRONMENT_WIDTH) {
        environment_picture half;
        done = halve(&own, &half);
        if (own.rgb != sky->rgb)
            free(own.rgb);
        own = half;
    }
    done = done && make_picture(out, ENVIRONMENT_WIDTH, ENVIRONMENT_WIDTH / 2);
    for (int y = 0; done && y < out->height; y++)
        for (int x = 0; x < out->width; x++) {
            const float uv[2] = {((float)x + 0.5f) / (float)out->width, ((float)y + 0.5f) / (float)out->height};
            float *to = out->rgb + 3 * (y * out->width + x);
            memset(to, 0, 3 * sizeof *to);
            add_filtered(&own, uv, 1, to);
        }
    if (own.rgb != sky->rgb)
        free(own.rgb);
    return done;
}

static void basis(const float n[3], float out[9])
{
    const float x = n[0], y = n[1], z = n[2];
    const float terms[9] = {1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y};
    memcpy(out, terms, sizeof terms);
}

/* Projects radiance onto the harmonics. Each is multiplied by its factor under a cosine lobe over pi: 1, 2/3, 1/4. */
static void project(environment *e)
{
    /* Squares of the harmonics' constants. */
    const float one = 1 / (4 * pi), linear = 3 / (4 * pi), product = 15 / (4 * pi);
    const float norms[9] = {one,         linear * 2 / 3,    linear * 2 / 3, linear * 2 / 3, product / 4,
                            product / 4, 5 / (16 * pi) / 4, product / 4,    product / 4 / 4};
    const environment_picture *p = &e->mirrors[0];
    double sums[9][3] = {{0}};
    for (int y = 0; y < p->height; y++) {
        const float solid_angle =
            2 * pi / (float)p->width *
            (cosf(pi * (float)y / (float)p->height) - cosf(pi * (float)(y + 1) / (float)p->height));
        for (int x = 0; x < p->width; x++) {
            float direction[3], terms[9];
            direction_of(p, x, y, direction);
            basis(direction, terms);
            for (int i = 0; i < 9; i++)
                for (int k = 0; k < 3; k++)
                    sums[i][k] += (double)(solid_angle * terms[i] * texel(p, x, y)[k]);
        }
    }
    for (int i = 0; i < 9; i++)
        for (int k = 0; k < 3; k++)
            e->irradiance[i][k] = norms[i] * (float)sums[i][k];
}

typedef struct lobe_sample {
    float direction[3]; /* about +z */
    float weight;       /* all of a lobe's sum to 1 */
    float level;        /* of the pyramid */
} lobe_sample;

/* Van der Corput's sequence. */
static float reversed_bits(uint32_t i)
{
    uint32_t reversed = 0;
    for (int bit = 0; bit < 32; bit++)
        reversed |= (i >> bit & 1u) << (31 - bit);
    return (float)reversed * 2.3283064e-10f;
}

typedef struct lobe {
    lobe_sample samples[MOST_SAMPLES];
    int count;
} lobe;

static void make_lobe(float roughness, int count, lobe *out)
{
    out->count = count;
    const float alpha2 = roughness * roughness * roughness * roughness;
    const float texel_angle = 4 * pi / (ENVIRONMENT_WIDTH * ENVIRONMENT_WIDTH / 2);
    float sum = 0;
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        /* In opposite pairs, so that the lobe stays symmetric. */
        const uint32_t pair = i / 2;
        const float share = ((float)pair + 0.5f) / (0.5f * (float)count);
        const float turn = pi * (reversed_bits(pair) + (float)(i % 2));
        const float cos2 = (1 - share) / (1 + (alpha2 - 1) * share), cos_half = sqrtf(cos2);
        const float sin_half = sqrtf(fmaxf(1 - cos2, 0)), spread = cos2 * (alpha2 - 1) + 1;
        const float density = alpha2 / (pi * spread * spread) / 4; /* of reflected directions */
        lobe_sample *s = &out->samples[i];
        s->direction[0] = 2 * cos_half * sin_half * cosf(turn);
        s->direction[1] = 2 * cos_half * sin_half * sinf(turn);
        s->direction[2] = 2 * cos2 - 1;
        s->weight = fmaxf(s->direction[2], 0);
        s->level = fminf(fmaxf(0.5f * log2f(1 / ((float)count * density) / texel_angle), 0), PYRAMID - 2);
        sum += s->weight;
    }
    for (int i = 0; i < count; i++)
        out->samples[i].weight /= sum;
}

/* Two unit vectors square to a unit one and to each other. */
static void make_frame(const float axis[3], float out[2][3])
{
    const int helper = fabsf(axis[1]) < 0.9f ? 1 : 0;
    float up[3] = {0, 0, 0};
    up[helper] = 1;
    for (int i = 0; i < 2; i++) {
        const float *a = i ? axis : up, *b = i ? out[0] : axis;
        float length = 0;
        for (int k = 0; k < 3; k++) {
            out[i][k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
            length += out[i][k] * out[i][k];
        }
        for (int k = 0; k < 3; k++)
            out[i][k] /= sqrtf(length);
    }
}

static void sum_lobe(const pyramid *from, const lobe *over, const float axis[3], float out[3])
{
    float frame[2][3];
    make_frame(axis, frame);
    memset(out, 0, 3 * sizeof *out);
    for (int i = 0; i < over->count; i++) {
        const lobe_sample *s = &over->samples[i];
        float direction[3], uv[2];
        if (s->weight <= 0)
            continue;
        for (int k = 0; k < 3; k++)
            direction[k] = s->direction[0] * frame[0][k] + s->direction[1] * frame[1][k] + s->direction[2] * axis[k];
        uv_of(direction, uv);
        const int level = (int)s->level;
        const float next = s->level - (float)level;
        add_filtered(&from->levels[level], uv, s->weight * (1 - next), out);
        add_filtered(&from->levels[level + 1], uv, s->weight * next, out);
    }
}

static bool make_mirror(const pyramid *from, int level, environment_picture *out)
{
    lobe over;
    if (!make_picture(out, ENVIRONMENT_WIDTH >> level, ENVIRONMENT_WIDTH / 2 >> level))
        return false;
    /* Wider lobes take more samples, and have fewer texels. */
    make_lobe((float)level / (ENVIRONMENT_LEVELS - 1), 8 << level, &over);
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++) {
            float axis[3];
            direction_of(out, x, y, axis);
            sum_lobe(from, &over, axis, out->rgb + 3 * (y * out->width + x));
        }
    return true;
}

bool environment_light(environment *e)
{
    pyramid p = {.levels = {{0}}};
    bool done = make_base(&e->sky, &e->mirrors[0]);
    p.levels[0] = e->mirrors[0];
    for (int i = 1; done && i < PYRAMID; i++)
        done = halve(&p.levels[i - 1], &p.levels[i]);
    for (int i = 1; done && i < ENVIRONMENT_LEVELS; i++)
        done = make_mirror(&p, i, &e->mirrors[i]);
    for (int i = 1; i < PYRAMID; i++)
        free(p.levels[i].rgb);
    if (done)
        project(e);
    return done;
}

void environment_irradiance(const environment *e, const float normal_world[3], float out_rgb[3])
{
    float terms[9];
    basis(normal_world, terms);
    for (int k = 0; k < 3; k++) {
        out_rgb[k] = 0;
        for (int i = 0; i < 9; i++)
            out_rgb[k] += e->irradiance[i][k] * terms[i];
        out_rgb[k] = fmaxf(out_rgb[k], 0);
    }
}

void environment_mirrored(const environment *e, int level, const float direction_world[3], float out_rgb[3])
{
    float uv[2];
    uv_of(direction_world, uv);
    memset(out_rgb, 0, 3 * sizeof *out_rgb);
    add_filtered(&e->mirrors[level], uv, 1, out_rgb);
}
