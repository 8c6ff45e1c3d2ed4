/* SPDX-License-Identifier: MIT
 *
 * Reads the heads of image files.
 */
#include "image_header.h"

#include <string.h>

static unsigned read_be16(const uint8_t *at)
{
    return (unsigned)at[0] << 8 | at[1];
}

static bool begins(const uint8_t *data, size_t size, size_t at, const char *with, size_t length)
{
    return size >= at + length && !memcmp(data + at, with, length);
}

image_kind image_find_kind(const uint8_t *data, size_t size)
{
    if (begins(data, size, 0, "\x89PNG\r\n\x1a\n", 8))
        return IMAGE_PNG;
    if (begins(data, size, 0, "\xff\xd8", 2))
        return IMAGE_JPEG;
    if (begins(data, size, 0, "RIFF", 4) && begins(data, size, 8, "WEBP", 4))
        return IMAGE_WEBP;
    if (begins(data, size, 0, "\xabKTX 20\xbb", 8))
        return IMAGE_KTX2;
    if (begins(data, size, 4, "ftypavif", 8))
        return IMAGE_AVIF;
    return begins(data, size, 0, "DDS ", 4) ? IMAGE_DDS : IMAGE_UNKNOWN;
}

/* The first chunk holds the size. */
static bool measure_png(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    if (size < 33 || memcmp(data + 12, "IHDR", 4) != 0)
        return false;
    /* A size of more than 16 bits is too large in any case. */
    *out_width = read_be16(data + 16) ? UINT16_MAX : read_be16(data + 18);
    *out_height = read_be16(data + 20) ? UINT16_MAX : read_be16(data + 22);
    return *out_width && *out_height;
}

/* Follows the markers as a decoder does. Bytes between segments, such as coded pixels, are skipped up to the next
 * marker. */
static bool measure_jpeg(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    enum { SOF0 = 0xc0, DHT = 0xc4, JPG = 0xc8, DAC = 0xcc, SOF15 = 0xcf, RST0 = 0xd0, SOI = 0xd8, EOI = 0xd9 };
    *out_width = *out_height = 0;
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
            if (length < 2)
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

static unsigned read_le24(const uint8_t *at)
{
    return (unsigned)at[0] | (unsigned)at[1] << 8 | (unsigned)at[2] << 16;
}

/* WebP container specification: a canvas (VP8X), a lossless (VP8L) or a lossy bitstream (VP8) first. */
static bool measure_webp(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    if (size < 30)
        return false;
    if (!memcmp(data + 12, "VP8X", 4)) {
        *out_width = read_le24(data + 24) + 1;
        *out_height = read_le24(data + 27) + 1;
    } else if (!memcmp(data + 12, "VP8L", 4)) {
        const unsigned bits = read_le24(data + 21) | (unsigned)data[24] << 24;
        *out_width = (bits & 0x3fff) + 1;
        *out_height = (bits >> 14 & 0x3fff) + 1;
    } else {
        *out_width = ((unsigned)data[26] | (unsigned)data[27] << 8) & 0x3fff;
        *out_height = ((unsigned)data[28] | (unsigned)data[29] << 8) & 0x3fff;
    }
    return *out_width && *out_height;
}

bool image_measure(const uint8_t *data, size_t size, unsigned *out_width, unsigned *out_height)
{
    switch (image_find_kind(data, size)) {
    case IMAGE_PNG:
        return measure_png(data, size, out_width, out_height);
    case IMAGE_JPEG:
        return measure_jpeg(data, size, out_width, out_height);
    case IMAGE_WEBP:
        return measure_webp(data, size, out_width, out_height);
    default:
        return false;
    }
}
