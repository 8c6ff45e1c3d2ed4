/* SPDX-License-Identifier: MIT */
#include "radiance.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_SIDE = 65535, LINE_LENGTH = 256 };

/* The next line, without its end. False where there is none, or it is too long for any head. */
static bool read_line(radiance *r, char out[LINE_LENGTH])
{
    const char *start = (const char *)r->data + r->at;
    const size_t left = r->size - r->at;
    const char *end = left ? memchr(start, '\n', left) : NULL;
    if (!end || end - start >= LINE_LENGTH)
        return false;
    memcpy(out, start, (size_t)(end - start));
    out[end - start] = '\0';
    r->at += (size_t)(end - start) + 1;
    return true;
}

bool radiance_open(radiance *r, const uint8_t *data, size_t size)
{
    char line[LINE_LENGTH], rest;
    bool is_rgb = false;
    *r = (radiance){.data = data, .size = size};
    if (!read_line(r, line) || (strcmp(line, "#?RADIANCE") != 0 && strcmp(line, "#?RGBE") != 0))
        return false;
    do {
        if (!read_line(r, line))
            return false;
        is_rgb = is_rgb || strcmp(line, "FORMAT=32-bit_rle_rgbe") == 0;
    } while (line[0]);
    return is_rgb && read_line(r, line) && sscanf(line, "-Y %5d +X %5d%c", &r->height, &r->width, &rest) == 2 &&
           r->width > 0 && r->height > 0 && r->width <= MOST_SIDE && r->height <= MOST_SIDE;
}

/* One channel in runs: a count above 128 repeats the byte behind it, another one is followed by as many bytes. */
static bool read_runs(radiance *r, uint8_t *channel)
{
    for (int x = 0; x < r->width;) {
        if (r->size - r->at < 2)
            return false;
        const int count = r->data[r->at++], repeated = count > 128;
        const int length = repeated ? count - 128 : count;
        if (length == 0 || length > r->width - x || r->size - r->at < (size_t)(repeated ? 1 : length))
            return false;
        for (int i = 0; i < length; i++)
            channel[4 * x++] = r->data[r->at + (repeated ? 0 : (size_t)i)];
        r->at += repeated ? 1 : (size_t)length;
    }
    return true;
}

/* Without runs. The older format, where a colour of three ones repeats the one before, is refused. */
static bool read_flat(radiance *r, uint8_t *rgbe)
{
    const size_t length = 4 * (size_t)r->width;
    if (r->size - r->at < length)
        return false;
    memcpy(rgbe, r->data + r->at, length);
    r->at += length;
    for (size_t i = 0; i < length; i += 4)
        if (rgbe[i] == 1 && rgbe[i + 1] == 1 && rgbe[i + 2] == 1)
            return false;
    return true;
}

bool radiance_read_row(radiance *r, uint8_t *scratch, float *out_rgb)
{
    const uint8_t *head = r->data + r->at;
    bool done = r->size - r->at >= 4;
    if (done && r->width >= 8 && r->width < 32768 && head[0] == 2 && head[1] == 2 &&
        (head[2] << 8 | head[3]) == r->width) {
        r->at += 4;
        for (int channel = 0; done && channel < 4; channel++)
            done = read_runs(r, scratch + channel);
    } else {
        done = done && read_flat(r, scratch);
    }
    for (int x = 0; done && x < r->width; x++) {
        const uint8_t *rgbe = scratch + 4 * x;
        const float scale = rgbe[3] ? ldexpf(1, (int)rgbe[3] - 136) : 0;
        for (int k = 0; k < 3; k++)
            out_rgb[3 * x + k] = (float)rgbe[k] * scale;
    }
    return done;
}
