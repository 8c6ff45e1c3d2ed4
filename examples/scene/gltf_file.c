/* SPDX-License-Identifier: MIT
 *
 * Reads files, finds the chunks of a GLB, and checks how deep and how full the JSON is before it is parsed.
 */
#include "gltf_file.h"

#include "read_file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { CHUNK_HEADER = 8, MOST_JSON_DEPTH = 64, JSON_VALUE_BYTES = 200 };

uint8_t *gltf_read_file(const char *path, uint64_t limit, size_t *out_size, const char **out_reason)
{
    const size_t most = limit < SIZE_MAX / 4 ? (size_t)limit : SIZE_MAX / 4;
    uint8_t *data = strcmp(path, "-") != 0 ? read_file(path, most, out_size, out_reason)
                                           : read_stream(STDIN_FILENO, most, out_size, out_reason);
    const char *mistake = data ? read_file_find_mistake(data, *out_size) : NULL;
    if (mistake) {
        *out_reason = mistake;
        free(data);
        data = NULL;
    }
    return data;
}

const char *gltf_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static size_t read_u32(const uint8_t *at)
{
    return (size_t)at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
}

/* The chunk at `at`: its payload's size. False where it does not lie inside the file. */
static bool read_chunk(const gltf_file *f, size_t at, int number, size_t *out_size, failure *fault)
{
    if (f->size - at < CHUNK_HEADER)
        return fault_set(fault, "GLB chunk %d: its header is cut short", number);
    *out_size = read_u32(f->data + at);
    return *out_size <= f->size - at - CHUNK_HEADER ||
           fault_set(fault, "GLB chunk %d: %zu bytes said, %zu left in the file", number, *out_size,
                     f->size - at - CHUNK_HEADER);
}

static bool is_bin_chunk(const gltf_file *f, size_t at)
{
    return at <= f->size && f->size - at >= CHUNK_HEADER && !memcmp(f->data + at + 4, "BIN", 4);
}

/* Chunks should be multiples of 4 bytes long. Some programs forget the padding and put the next chunk right behind;
 * others put it where the padding would end. */
static bool find_bin(gltf_file *f, size_t at, failure *fault)
{
    const size_t aligned = (at + 3) / 4 * 4;
    at = is_bin_chunk(f, at) ? at : aligned;
    if (at >= f->size)
        return true;
    size_t size = 0;
    if (!read_chunk(f, at, 1, &size, fault))
        return false;
    f->unaligned = f->unaligned || size % 4;
    if (is_bin_chunk(f, at)) {
        f->bin_begin = at + CHUNK_HEADER;
        f->bin_size = size;
    }
    return true;
}

static bool check_glb(gltf_file *f, failure *fault)
{
    enum { HEADER = 12 };
    if (f->size < HEADER)
        return fault_set(fault, "the GLB header is cut short");
    if (read_u32(f->data + 4) != 2)
        return fault_set(fault, "GLB version %zu, only 2 is known", read_u32(f->data + 4));
    if (read_u32(f->data + 8) > f->size)
        return fault_set(fault, "the GLB header says %zu bytes, the file has %zu", read_u32(f->data + 8), f->size);
    if (read_u32(f->data + 8) < HEADER)
        return fault_set(fault, "the GLB header says %zu bytes", read_u32(f->data + 8));
    f->size = read_u32(f->data + 8); /* what follows is not part of it */
    if (!read_chunk(f, HEADER, 0, &f->json_size, fault))
        return false;
    if (memcmp(f->data + HEADER + 4, "JSON", 4) != 0)
        return fault_set(fault, "GLB chunk 0 is not JSON");
    f->json_begin = HEADER + CHUNK_HEADER;
    f->unaligned = f->json_size % 4;
    return find_bin(f, f->json_begin + f->json_size, fault);
}

/* Moves `at` from the string's first quote to its last; false where it does not end. */
static bool skip_string(const char *text, size_t size, size_t *at, failure *fault)
{
    size_t end = *at + 1;
    while (end < size && text[end] != '"')
        end += text[end] == '\\' ? 2 : 1;
    if (end >= size)
        return fault_set(fault, "JSON: a string does not end");
    *at = end;
    return true;
}

/* Checks only the depth and the number of values; the parser checks the syntax. A parsed value and the structure built
 * from it take up to JSON_VALUE_BYTES. */
static bool check_json(const gltf_file *f, memory_budget *budget, failure *fault)
{
    const char *text = (const char *)f->data + f->json_begin;
    size_t depth = 0, values = 0;
    for (size_t at = 0; at < f->json_size; ++at) {
        switch (text[at]) {
        case '"':
            if (!skip_string(text, f->json_size, &at, fault))
                return false;
            break;
        case '{':
        case '[':
            if (++depth > MOST_JSON_DEPTH)
                return fault_set(fault, "JSON: nested more than %d deep", MOST_JSON_DEPTH);
            ++values;
            break;
        case ',':
            ++values;
            break;
        case '}':
        case ']':
            depth -= depth > 0;
            break;
        default:
            break;
        }
    }
    return memory_budget_charge(budget, (uint64_t)values * JSON_VALUE_BYTES, "its JSON", fault);
}

bool gltf_file_open(gltf_file *out, const char *path, memory_budget *budget, failure *fault)
{
    const char *reason = NULL;
    memset(out, 0, sizeof *out);
    out->data = gltf_read_file(path, budget->left, &out->size, &reason);
    if (!out->data)
        return fault_set(fault, "%s", reason);
    out->binary = out->size >= 4 && !memcmp(out->data, "glTF", 4);
    out->json_size = out->size;
    if (out->size && memory_budget_charge(budget, out->size, "the file", fault) &&
        (!out->binary || check_glb(out, fault)) && check_json(out, budget, fault))
        return true;
    fault_set(fault, "the file is empty");
    free(out->data);
    out->data = NULL;
    return false;
}
