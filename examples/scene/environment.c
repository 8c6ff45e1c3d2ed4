/* SPDX-License-Identifier: MIT
 *
 * Reads an environment's picture from a file.
 */
#include "environment.h"

#include "gltf_file.h"
#include "image_decode.h"
#include "image_header.h"
#include "radiance.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SIDE = 16384 };
static const uint64_t most_bytes = UINT64_C(1) << 30;
static const float most_radiance = 65504; /* that half floats hold */

/* The factor by which the file's picture is reduced. */
static int reduction(int width)
{
    int by = 1;
    while (width / by > ENVIRONMENT_MOST_WIDTH)
        by *= 2;
    return by;
}

static bool make_sky(environment *e, int width, int height)
{
    const int by = reduction(width);
    e->sky.width = width / by;
    e->sky.height = height / by;
    e->sky.rgb = calloc((size_t)e->sky.width * (size_t)e->sky.height * 3, sizeof(float));
    return e->sky.rgb;
}

/* Adds a row of the file to the row of the sky that contains it. Leftover rows and columns at the ends are dropped. */
static void add_row(environment *e, int by, int y, const float *row)
{
    if (y / by >= e->sky.height)
        return;
    float *to = e->sky.rgb + 3 * (size_t)(y / by) * (size_t)e->sky.width;
    const float share = 1.0f / (float)(by * by);
    for (int x = 0; x < e->sky.width * by; x++)
        for (int k = 0; k < 3; k++)
            to[3 * (x / by) + k] += share * fminf(row[3 * x + k], most_radiance);
}

static const char *take_radiance(environment *e, radiance *r)
{
    uint8_t *scratch = malloc(4 * (size_t)r->width);
    float *row = malloc(3 * (size_t)r->width * sizeof *row);
    const char *fault = scratch && row && make_sky(e, r->width, r->height) ? NULL : "out of memory";
    for (int y = 0; !fault && y < r->height; y++) {
        if (radiance_read_row(r, scratch, row))
            add_row(e, reduction(r->width), y, row);
        else
            fault = "the Radiance picture is cut off or damaged";
    }
    free(scratch);
    free(row);
    return fault;
}

static const char *take_bytes(environment *e, int width, int height, const uint8_t *rgba)
{
    float linear[256];
    for (int i = 0; i < 256; i++) {
        const float c = (float)i / 255;
        linear[i] = c <= 0.04045f ? c / 12.92f : powf((c + 0.055f) / 1.055f, 2.4f);
    }
    float *row = malloc(3 * (size_t)width * sizeof *row);
    if (!row || !make_sky(e, width, height)) {
        free(row);
        return "out of memory";
    }
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++)
            for (int k = 0; k < 3; k++)
                row[3 * x + k] = linear[rgba[4 * ((size_t)y * (size_t)width + (size_t)x) + (size_t)k]];
        add_row(e, reduction(width), y, row);
    }
    free(row);
    return NULL;
}

/* NULL, or the fault; `text` has room for one. */
static const char *check_size(unsigned width, unsigned height, char text[128])
{
    if (width > MOST_SIDE || height > MOST_SIDE)
        return "too large, more than 16384 pixels on a side";
    snprintf(text, 128, "%u x %u pixels; an environment is twice as wide as high", width, height);
    return width == 2 * height ? NULL : text;
}

static const char *take_file(environment *e, const uint8_t *data, size_t size, char text[128])
{
    radiance r;
    unsigned width = 0, height = 0;
    if (radiance_open(&r, data, size)) {
        const char *fault = check_size((unsigned)r.width, (unsigned)r.height, text);
        return fault ? fault : take_radiance(e, &r);
    }
    if (!image_measure(data, size, &width, &height))
        return "neither a sound PNG, JPEG or WebP nor a Radiance picture";
    const char *fault = check_size(width, height, text);
    int w = 0, h = 0;
    uint8_t *rgba = NULL;
    if (!fault && !image_decode(data, size, &w, &h, &rgba))
        fault = "it cannot be decoded";
    if (!fault)
        fault = check_size((unsigned)w, (unsigned)h, text);
    if (!fault)
        fault = take_bytes(e, w, h, rgba);
    free(rgba);
    return fault;
}

static void dim(environment *e)
{
    float most = 0;
    for (int i = 0; i < 6; i++) {
        float axis[3] = {0, 0, 0}, got[3];
        axis[i / 2] = i % 2 ? 1.0f : -1.0f;
        environment_irradiance(e, axis, got);
        most = fmaxf(most, fmaxf(got[0], fmaxf(got[1], got[2])));
    }
    const float scale = most > 1 ? 1 / most : 1;
    for (int i = 0; i < 27; i++)
        e->irradiance[i / 3][i % 3] *= scale;
    environment_picture *pictures[ENVIRONMENT_LEVELS + 1] = {&e->sky};
    for (int i = 0; i < ENVIRONMENT_LEVELS; i++)
        pictures[i + 1] = &e->mirrors[i];
    for (int i = 0; i <= ENVIRONMENT_LEVELS; i++)
        for (size_t k = 0; k < 3 * (size_t)pictures[i]->width * (size_t)pictures[i]->height; k++)
            pictures[i]->rgb[k] *= scale;
}

environment *environment_load(const char *path, failure *fault)
{
    size_t size = 0;
    char text[128];
    const char *reason = NULL;
    uint8_t *data = gltf_read_file(path, most_bytes, &size, &reason);
    if (!data) {
        fault_set(fault, "%s: %s", path, reason);
        return NULL;
    }
    environment *e = calloc(1, sizeof *e);
    const char *wrong = e ? take_file(e, data, size, text) : "out of memory";
    free(data);
    if (!wrong && !environment_light(e))
        wrong = "out of memory";
    if (wrong) {
        fault_set(fault, "%s: %s", path, wrong);
        environment_destroy(e);
        return NULL;
    }
    dim(e);
    return e;
}

void environment_destroy(environment *e)
{
    if (!e)
        return;
    free(e->sky.rgb);
    for (int i = 0; i < ENVIRONMENT_LEVELS; i++)
        free(e->mirrors[i].rgb);
    free(e);
}
