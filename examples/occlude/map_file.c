/* SPDX-License-Identifier: MIT
 *
 * Finds out which format a file has, and what its numbers mean.
 */
#define _POSIX_C_SOURCE 200809L
#include "map_format.h"
#include "read_file.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool map_fail(const map_reader *r, const char *format, ...)
{
    if (r->error_size == 0)
        return false;
    const int used = snprintf(r->error, r->error_size, "%s: ", r->path);
    if (used < 0 || (size_t)used >= r->error_size)
        return false;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->error + used, r->error_size - (size_t)used, format, arguments);
    va_end(arguments);
    return false;
}

bool map_allocate(const map_reader *r, long long width, long long height, long long channels, map_file *out_map)
{
    if (width < 1 || height < 1 || width > MAP_LARGEST_SIDE || height > MAP_LARGEST_SIDE)
        return map_fail(r, "a map of %lld x %lld is outside 1 to %d", width, height, MAP_LARGEST_SIDE);
    if (channels < 1 || channels > 4)
        return map_fail(r, "%lld channels: want 1 to 4", channels);
    *out_map = (map_file){.width = (int)width, .height = (int)height, .channels = (int)channels, .full = 1};
    out_map->values = malloc((size_t)width * (size_t)height * (size_t)channels * sizeof *out_map->values);
    return out_map->values || map_fail(r, "out of memory for %lld x %lld pixels", width, height);
}

uint8_t *map_read_rest(const map_reader *r, size_t size)
{
    const long start = ftell(r->file);
    const long end = start >= 0 && fseek(r->file, 0, SEEK_END) == 0 ? ftell(r->file) : -1;
    if (end < start || fseek(r->file, start, SEEK_SET) != 0) {
        map_fail(r, "not a regular file");
        return NULL;
    }
    if ((size_t)(end - start) != size) {
        map_fail(r, "%zu bytes of values, where its header promises %zu", (size_t)(end - start), size);
        return NULL;
    }
    uint8_t *bytes = malloc(size);
    if (!bytes || fread(bytes, 1, size, r->file) != size) {
        map_fail(r, bytes ? "can't be read" : "out of memory");
        free(bytes);
        return NULL;
    }
    return bytes;
}

/* IEEE 754 half precision. */
static float decode_half(uint32_t bits)
{
    const uint32_t exponent = bits >> 10 & 31, fraction = bits & 1023;
    const float size = exponent == 31  ? (fraction ? NAN : INFINITY)
                       : exponent == 0 ? ldexpf((float)fraction, -24)
                                       : ldexpf((float)(fraction | 1024), (int)exponent - 25);
    return bits & 0x8000 ? -size : size;
}

float map_decode(const uint8_t *bytes, map_number kind, int size, bool big_endian)
{
    uint64_t bits = 0;
    for (int i = 0; i < size; ++i)
        bits = bits << 8 | bytes[big_endian ? i : size - 1 - i];
    if (kind == MAP_UNSIGNED)
        return (float)bits;
    if (kind == MAP_SIGNED) {
        const uint64_t sign = UINT64_C(1) << (8 * size - 1);
        return (float)((int64_t)(bits ^ sign) - (int64_t)sign);
    }
    if (size == 2)
        return decode_half((uint32_t)bits);
    if (size == 4) {
        const uint32_t word = (uint32_t)bits;
        float value;
        memcpy(&value, &word, sizeof value);
        return value;
    }
    double value;
    memcpy(&value, &bits, sizeof value);
    return (float)value;
}

static bool read_map(const char *path, int wanted, map_file *out_map, char *error, size_t error_size)
{
    static const struct {
        const char *magic;
        size_t size;
        bool (*read)(const map_reader *r, map_file *out_map);
    } formats[] = {
        {"PF", 2, map_read_pfm},
        {"Pf", 2, map_read_pfm},
        {"\x89PNG\r\n\x1a\n", 8, map_read_png},
        {"\x93NUMPY", 6, map_read_npy},
        {"\x76\x2f\x31\x01", 4, map_read_exr},
    };
    *out_map = (map_file){0};
    map_reader r = {.path = path, .wanted = wanted, .error = error, .error_size = error_size};
    const char *reason = NULL;
    const int descriptor = read_file_open(path, &reason);
    r.file = descriptor >= 0 ? fdopen(descriptor, "rb") : NULL;
    if (!r.file) {
        if (descriptor >= 0)
            close(descriptor);
        return map_fail(&r, "%s", reason ? reason : strerror(errno));
    }
    char magic[64] = {0};
    const size_t length = fread(magic, 1, sizeof magic, r.file);
    rewind(r.file);
    bool known = false, ok = false;
    for (size_t i = 0; i < sizeof formats / sizeof *formats && !known; ++i)
        if (length >= formats[i].size && memcmp(magic, formats[i].magic, formats[i].size) == 0) {
            known = true;
            ok = formats[i].read(&r, out_map);
        }
    if (!known)
        map_fail(&r, "%s",
                 read_file_find_mistake(magic, length) ? read_file_find_mistake(magic, length)
                 : length == 0                         ? "it is empty"
                                                       : "neither PFM, PNG, .npy nor OpenEXR");
    fclose(r.file);
    if (ok && wanted != 0 && out_map->channels != wanted)
        ok = map_fail(&r, "%d channels, where %s", out_map->channels,
                      wanted == 1 ? "depth has one" : "normals have three");
    if (!ok)
        map_file_free(out_map);
    return ok;
}

bool map_file_read(const char *path, map_file *out_map, char *error, size_t error_size)
{
    return read_map(path, 0, out_map, error, error_size);
}

/* A map that is not wanted is freed, with the reason in the error. */
static bool require(bool good, map_file *map, const char *path, const char *reason, char *error, size_t error_size)
{
    if (!good) {
        snprintf(error, error_size, "%s: %s", path, reason);
        map_file_free(map);
    }
    return good;
}

bool map_file_read_depth(const char *path, float scale, map_file *out_map, char *error, size_t error_size)
{
    if (!read_map(path, 1, out_map, error, error_size) ||
        !require(out_map->full != 255, out_map, path, "8 bits a pixel: depth needs 16", error, error_size) ||
        !require(scale > 0.0f && isfinite(scale), out_map, path, "the scale is not a positive number", error,
                 error_size))
        return false;
    const size_t count = (size_t)out_map->width * (size_t)out_map->height;
    for (size_t i = 0; i < count; ++i)
        out_map->values[i] *= scale;
    return true;
}

bool map_file_read_normals(const char *path, map_file *out_map, char *error, size_t error_size)
{
    if (!read_map(path, 3, out_map, error, error_size))
        return false;
    const size_t count = 3 * (size_t)out_map->width * (size_t)out_map->height;
    for (size_t i = 0; i < count && out_map->full != 1; ++i)
        out_map->values[i] = 2.0f * out_map->values[i] / (float)out_map->full - 1.0f;
    return true;
}

void map_file_free(map_file *map)
{
    free(map->values);
    *map = (map_file){0};
}
