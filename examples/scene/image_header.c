/* SPDX-License-Identifier: MIT
 *
 * Reads the headers of PNG and JPEG files.
 */
#include "image_header.h"

#include <string.h>

static unsigned read_be16(const uint8_t *at)
{
    return (unsigned)at[0] << 8 | at[1];
}

/* The size stands in the first chunk. */
static bool measure_png(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    static const uint8_t magic[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    if (size < 33 || memcmp(data, magic, sizeof magic) != 0 || memcmp(data + 12, "IHDR", 4) != 0)
        return false;
    /* More than 16 bits is too large whatever the rest says. */
    *out_width = read_be16(data + 16) ? UINT16_MAX : read_be16(data + 18);
    *out_height = read_be16(data + 20) ? UINT16_MAX : read_be16(data + 22);
    return true;
}

/* A DHT segment is one table after the other: a byte that says which, 16 counts, as many codes as they add up to.
 * `left` is what the segment's length says; a decoder reads zeros past the file's end. */
static bool check_huffman_tables(const uint8_t *data, size_t size, size_t at, long left)
{
    while (left > 0) {
        size_t codes = 0;
        for (size_t i = at + 1; i < at + 17 && i < size; ++i)
            codes += data[i];
        if (codes > 256)
            return false;
        at += 17 + codes;
        left -= 17 + (long)codes;
    }
    return true;
}

/* Goes from marker to marker as a decoder does: what lies between segments, coded pixels too, is passed over byte by
 * byte up to the next one. */
static bool measure_jpeg(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    enum { SOF0 = 0xc0, DHT = 0xc4, JPG = 0xc8, DAC = 0xcc, SOF15 = 0xcf, RST0 = 0xd0, SOI = 0xd8, EOI = 0xd9 };
    *out_width = *out_height = 0;
    if (size < 4 || data[0] != 0xff || data[1] != SOI)
        return false;
    size_t at = 2;
    while (at + 4 <= size) {
        const uint8_t marker = data[at + 1];
        if (data[at] != 0xff || marker == 0xff) {
            ++at;
        } else if (marker <= 1 || (marker >= RST0 && marker <= SOI)) {
            at += 2; /* these have no segment */
        } else if (marker == EOI) {
            break;
        } else {
            const unsigned length = read_be16(data + at + 2);
            if (length < 2 || (marker == DHT && !check_huffman_tables(data, size, at + 4, (long)length - 2)))
                return false;
            if (marker >= SOF0 && marker <= SOF15 && marker != DHT && marker != JPG && marker != DAC &&
                at + 9 <= size) {
                const unsigned height = read_be16(data + at + 5), width = read_be16(data + at + 7);
                *out_height = height > *out_height ? height : *out_height;
                *out_width = width > *out_width ? width : *out_width;
            }
            at += 2 + length;
        }
    }
    return *out_width && *out_height;
}

bool image_measure(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    return measure_png(data, size, out_width, out_height) || measure_jpeg(data, size, out_width, out_height);
}
