/* SPDX-License-Identifier: MIT
 *
 * The checks that come before parsing. tinygltf 2.7 reads eight bytes past a BIN chunk whose length
 * is wrong, recurses once per level of nested extras, and copies the BIN chunk for each buffer without a URI.
 */
#include "gltf_file.h"

#include "read_file.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_FILE_BYTES = INT32_MAX, /* tinygltf counts in int */
    MOST_JSON_DEPTH = 64,
    MOST_JSON_VALUES = 4 << 20,   /* a parsed value takes up to 150 bytes */
    MOST_COPIED_BYTES = 256 << 20 /* of the BIN chunk, for buffers after the first */
};

/* Most elements of the arrays at the root; each becomes a structure of some hundred bytes to some kilobytes. */
static const struct {
    const char *name;
    size_t most;
} root_arrays[] = {{"buffers", 4096},   {"materials", 65536},         {"images", 65536}, {"textures", 65536},
                   {"samplers", 65536}, {"cameras", 65536},           {"skins", 65536},  {"animations", 65536},
                   {"scenes", 65536},   {"", 1 << 19 /* any other */}};

const char *gltf_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool gltf_uri_is_local(const char *uri)
{
    if (!*uri || *uri == '/' || strpbrk(uri, "\\:"))
        return false;
    for (const char *segment = uri; segment; segment = strchr(segment, '/')) {
        segment += *segment == '/';
        if (!strncmp(segment, "..", 2) && (!segment[2] || segment[2] == '/'))
            return false;
    }
    return true;
}

static size_t read_u32(const uint8_t *at)
{
    return (size_t)at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
}

static void write_u32(uint8_t *at, size_t value)
{
    for (int i = 0; i < 4; ++i)
        at[i] = (uint8_t)(value >> 8 * i);
}

/* The chunk at `at`: its payload's size. False where it does not lie inside the file. */
static bool read_chunk(const gltf_file *f, size_t at, int number, size_t *out_size, scene_fault *fault)
{
    if (f->size - at < 8)
        return scene_fail(fault, "GLB chunk %d: its header is cut short", number);
    *out_size = read_u32(f->data + at);
    if (*out_size > f->size - at - 8)
        return scene_fail(fault, "GLB chunk %d: %zu bytes said, %zu left in the file", number, *out_size,
                          f->size - at - 8);
    if (*out_size % 4)
        return scene_fail(fault, "GLB chunk %d: %zu bytes, not a multiple of 4", number, *out_size);
    return true;
}

/* Finds the JSON and BIN chunks, and hides what follows them, which tinygltf would refuse. */
static bool check_glb(gltf_file *f, scene_fault *fault)
{
    enum { HEADER = 12, CHUNK_HEADER = 8, JSON = 0x4e4f534a, BIN = 0x004e4942 };
    if (f->size < HEADER)
        return scene_fail(fault, "the GLB header is cut short");
    if (read_u32(f->data + 4) != 2)
        return scene_fail(fault, "GLB version %zu, only 2 is known", read_u32(f->data + 4));
    if (read_u32(f->data + 8) > f->size)
        return scene_fail(fault, "the GLB header says %zu bytes, the file has %zu", read_u32(f->data + 8), f->size);
    if (read_u32(f->data + 8) < HEADER)
        return scene_fail(fault, "the GLB header says %zu bytes", read_u32(f->data + 8));
    f->size = read_u32(f->data + 8); /* what follows is not part of it */
    if (!read_chunk(f, HEADER, 0, &f->json_size, fault))
        return false;
    if (read_u32(f->data + HEADER + 4) != JSON)
        return scene_fail(fault, "GLB chunk 0 is not JSON");
    f->json_begin = HEADER + CHUNK_HEADER;
    const size_t second = f->json_begin + f->json_size;
    size_t end = second;
    if (second < f->size) {
        size_t size = 0;
        if (!read_chunk(f, second, 1, &size, fault))
            return false;
        if (read_u32(f->data + second + 4) == BIN && size) {
            f->bin_size = size;
            end += CHUNK_HEADER + size;
        }
    }
    f->size = end;
    write_u32(f->data + 8, end);
    return true;
}

/* What the scan of the JSON text knows. */
typedef struct json_scan {
    size_t depth, values;
    const char *name; /* the last string at the root, which names what follows */
    size_t name_size;
    size_t limit, elements; /* of the root's array that is being read */
    bool in_buffers;
} json_scan;

/* A name written with escapes would pass by the limits. */
static bool enter_root_array(json_scan *scan, scene_fault *fault)
{
    if (scan->name_size && memchr(scan->name, '\\', scan->name_size))
        return scene_fail(fault, "JSON: a name at the root is written with escapes");
    size_t i = 0;
    while (*root_arrays[i].name && (strlen(root_arrays[i].name) != scan->name_size ||
                                    memcmp(root_arrays[i].name, scan->name, scan->name_size) != 0))
        ++i;
    scan->limit = root_arrays[i].most;
    scan->in_buffers = i == 0;
    scan->elements = 1;
    return true;
}

/* Moves `at` from the string's first quote to its last; false where it does not end. */
static bool skip_string(const char *text, size_t size, size_t *at, json_scan *scan, scene_fault *fault)
{
    const size_t begin = *at + 1;
    size_t end = begin;
    while (end < size && text[end] != '"')
        end += text[end] == '\\' ? 2 : 1;
    if (end >= size)
        return scene_fail(fault, "JSON: a string does not end");
    if (scan->depth == 1) {
        scan->name = text + begin;
        scan->name_size = end - begin;
    }
    *at = end;
    return true;
}

static bool count_value(json_scan *scan, const gltf_file *f, scene_fault *fault)
{
    if (++scan->values > MOST_JSON_VALUES)
        return scene_fail(fault, "JSON: more than %d values", MOST_JSON_VALUES);
    if (scan->depth == 2 && scan->elements > scan->limit)
        return scene_fail(fault, "JSON: more than %zu %.*s", scan->limit, (int)scan->name_size, scan->name);
    if (scan->depth == 2 && scan->in_buffers && f->bin_size && scan->elements - 1 > MOST_COPIED_BYTES / f->bin_size)
        return scene_fail(fault, "JSON: too many buffers for a BIN chunk of %zu bytes", f->bin_size);
    return true;
}

/* Depth and counts only: whether it is JSON at all is the parser's to say. */
static bool check_json(const gltf_file *f, scene_fault *fault)
{
    const char *text = (const char *)f->data + f->json_begin;
    json_scan scan = {0};
    for (size_t at = 0; at < f->json_size; ++at) {
        switch (text[at]) {
        case '"':
            if (!skip_string(text, f->json_size, &at, &scan, fault))
                return false;
            break;
        case '{':
        case '[':
            if (++scan.depth > MOST_JSON_DEPTH)
                return scene_fail(fault, "JSON: nested more than %d deep", MOST_JSON_DEPTH);
            if (scan.depth == 2 && !enter_root_array(&scan, fault))
                return false;
            if (!count_value(&scan, f, fault))
                return false;
            break;
        case ',':
            scan.elements += scan.depth == 2;
            if (!count_value(&scan, f, fault))
                return false;
            break;
        case '}':
        case ']':
            scan.depth -= scan.depth > 0;
            break;
        default:
            break;
        }
    }
    return true;
}

bool gltf_file_open(gltf_file *out, const char *path, scene_fault *fault)
{
    const char *reason = NULL;
    memset(out, 0, sizeof *out);
    out->data = read_file(path, MOST_FILE_BYTES, &out->size, &reason);
    if (!out->data)
        return scene_fail(fault, "%s", reason);
    out->binary = out->size >= 4 && !memcmp(out->data, "glTF", 4);
    out->json_size = out->size;
    if (out->size && (!out->binary || check_glb(out, fault)) && check_json(out, fault))
        return true;
    scene_fail(fault, "the file is empty");
    free(out->data);
    out->data = NULL;
    return false;
}
