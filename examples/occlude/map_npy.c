/* SPDX-License-Identifier: MIT
 *
 * NumPy's .npy (numpy.lib.format): magic, version, length of the header, and the header, which is a Python dictionary
 * such as
 * {'descr': '<f4', 'fortran_order': False, 'shape': (480, 640), }. Arrays of rows and columns, and channels last.
 */
#include "map_format.h"

#include <stdlib.h>
#include <string.h>

enum { LONGEST_HEADER = 4096 };

typedef struct npy_header {
    map_number kind;
    int size; /* bytes a number */
    bool big_endian, column_major;
    long long shape[3]; /* height, width, channels */
} npy_header;

/* The text behind a key of the dictionary; NULL where it is not there. */
static const char *find_value(const char *text, const char *key)
{
    const char *at = strstr(text, key);
    if (!at)
        return NULL;
    at += strlen(key);
    return at + strspn(at, "'\": ");
}

static bool parse_type(const char *at, npy_header *header)
{
    char order, kind, end;
    if (!at || sscanf(at, "%c%c%1d%c", &order, &kind, &header->size, &end) != 4 || (end != '\'' && end != '"') ||
        !strchr("<>|=", order))
        return false;
    header->big_endian = order == '>';
    header->kind = kind == 'f' ? MAP_FLOAT : kind == 'i' ? MAP_SIGNED : MAP_UNSIGNED;
    switch (kind) {
    case 'f':
        return header->size == 2 || header->size == 4 || header->size == 8;
    case 'i':
    case 'u':
        return header->size == 1 || header->size == 2 || header->size == 4 || header->size == 8;
    default:
        return false;
    }
}

static bool parse_shape(const char *at, npy_header *header)
{
    header->shape[2] = 1;
    int count = 0;
    for (at = at && *at == '(' ? at + 1 : ""; count < 3; ++count) {
        char *end;
        const long long value = strtoll(at, &end, 10);
        if (end == at)
            break;
        header->shape[count] = value;
        at = end + strspn(end, ", ");
    }
    return count >= 2 && *at == ')';
}

static bool read_header(const map_reader *r, npy_header *header)
{
    uint8_t start[10], more[2] = {0};
    char text[LONGEST_HEADER + 1];
    if (fread(start, 1, sizeof start, r->file) != sizeof start || start[6] < 1 || start[6] > 3 ||
        (start[6] > 1 && fread(more, 1, sizeof more, r->file) != sizeof more))
        return map_fail(r, "a damaged .npy header");
    const size_t length = start[8] | (size_t)start[9] << 8 | (size_t)more[0] << 16 | (size_t)more[1] << 24;
    if (length > LONGEST_HEADER || fread(text, 1, length, r->file) != length)
        return map_fail(r, "a damaged .npy header");
    text[length] = '\0';
    if (!parse_type(find_value(text, "descr"), header))
        return map_fail(r, "numbers of a type that is neither float nor integer");
    if (!parse_shape(find_value(text, "shape"), header))
        return map_fail(r, "not an array of rows and columns, or of rows, columns and channels");
    const char *order = find_value(text, "fortran_order");
    header->column_major = order && strncmp(order, "True", 4) == 0;
    return true;
}

bool map_read_npy(const map_reader *r, map_file *out_map)
{
    npy_header h = {0};
    if (!read_header(r, &h) || !map_allocate(r, h.shape[1], h.shape[0], h.shape[2], out_map))
        return false;
    const size_t height = (size_t)h.shape[0], width = (size_t)h.shape[1], channels = (size_t)h.shape[2];
    const size_t size = (size_t)h.size;
    uint8_t *bytes = map_read_rest(r, width * height * channels * size);
    float *value = out_map->values;
    for (size_t y = 0; bytes && y < height; ++y)
        for (size_t x = 0; x < width; ++x)
            for (size_t c = 0; c < channels; ++c) {
                const size_t at = h.column_major ? (c * width + x) * height + y : (y * width + x) * channels + c;
                *value++ = map_decode(bytes + at * size, h.kind, h.size, h.big_endian);
            }
    free(bytes);
    return bytes != NULL;
}
