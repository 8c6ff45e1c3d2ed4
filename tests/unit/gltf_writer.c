/* SPDX-License-Identifier: MIT
 *
 * Writes small glTF files, and loads them.
 */
#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */
#include "gltf_writer.h"

#include "scene_validity.h"
#include "testing.h"

#include <ftw.h>

const float gltf_triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static char folder[] = "/tmp/glssao-test-XXXXXX";

int gltf_writer_setup(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_one(const char *path, const struct stat *about, int type, struct FTW *where)
{
    (void)about;
    (void)type;
    (void)where;
    return remove(path);
}

int gltf_writer_teardown(void **state)
{
    (void)state;
    return nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

const char *gltf_writer_path(const char *name)
{
    static char paths[2][512];
    static int turn;
    turn = !turn;
    snprintf(paths[turn], sizeof paths[turn], "%s/%s", folder, name);
    return paths[turn];
}

static void append(char *text, size_t room, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const size_t used = strlen(text);
    const int length = vsnprintf(text + used, room - used, format, arguments);
    va_end(arguments);
    assert_in_range(length, 0, room - used - 1);
}

int gltf_put_view(gltf_writer *w, const void *data, size_t bytes, int stride)
{
    assert_in_range(bytes, 1, sizeof w->bin - w->size - 4);
    memcpy(w->bin + w->size, data, bytes);
    append(w->views, sizeof w->views, "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu", w->size, bytes);
    if (stride)
        append(w->views, sizeof w->views, ",\"byteStride\":%d", stride);
    append(w->views, sizeof w->views, "},");
    w->size = (w->size + bytes + 3) / 4 * 4;
    return w->view_count++;
}

int gltf_put_accessor(gltf_writer *w, int view, int component_type, const char *type, size_t count, const char *more)
{
    append(w->accessors, sizeof w->accessors, "{\"componentType\":%d,\"type\":\"%s\",\"count\":%zu%s", component_type,
           type, count, more);
    if (view >= 0)
        append(w->accessors, sizeof w->accessors, ",\"bufferView\":%d", view);
    append(w->accessors, sizeof w->accessors, "},");
    return w->accessor_count++;
}

int gltf_put_floats(gltf_writer *w, const char *type, size_t count, const float *values)
{
    const size_t components = !strcmp(type, "SCALAR") ? 1 : !strcmp(type, "MAT4") ? 16 : (size_t)(type[3] - '0');
    const int view = gltf_put_view(w, values, count * components * sizeof *values, 0);
    return gltf_put_accessor(w, view, 5126, type, count, "");
}

gltf_writer gltf_begin(void)
{
    gltf_writer w = {0};
    gltf_put_floats(&w, "VEC3", 3, gltf_triangle);
    return w;
}

const char *gltf_write_bytes(const char *name, const void *data, size_t size)
{
    const char *path = gltf_writer_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    return path;
}

/* A JSON list of the elements, without the comma after the last. */
static void append_list(char *text, size_t room, const char *name, const char *elements)
{
    if (*elements)
        append(text, room, ",\"%s\":[%.*s]", name, (int)strlen(elements) - 1, elements);
}

static void append_base64(char *text, size_t room, const uint8_t *data, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const unsigned left = (unsigned)(size - i);
        const unsigned bits =
            (unsigned)data[i] << 16 | (left > 1 ? (unsigned)data[i + 1] << 8 : 0) | (left > 2 ? data[i + 2] : 0u);
        append(text, room, "%c%c%c%c", digits[bits >> 18], digits[bits >> 12 & 63],
               left > 1 ? digits[bits >> 6 & 63] : '=', left > 2 ? digits[bits & 63] : '=');
    }
}

/* The whole JSON; the function keeps the memory. */
static char *compose(const gltf_writer *w, int embedded, const char *rest)
{
    static char text[65536];
    snprintf(text, sizeof text, "{\"asset\":{\"version\":\"2.0\"}");
    if (w->size) {
        append(text, sizeof text, ",\"buffers\":[{\"byteLength\":%zu", w->size);
        if (embedded) {
            append(text, sizeof text, ",\"uri\":\"data:application/octet-stream;base64,");
            append_base64(text, sizeof text, w->bin, w->size);
            append(text, sizeof text, "\"");
        }
        append(text, sizeof text, "}]");
    }
    append_list(text, sizeof text, "bufferViews", w->views);
    append_list(text, sizeof text, "accessors", w->accessors);
    append(text, sizeof text, "%s%s}", *rest ? "," : "", rest);
    return text;
}

const char *gltf_write(const gltf_writer *w, const char *name, const char *rest)
{
    const char *path = gltf_writer_path(name), *text = w ? compose(w, 1, rest) : rest;
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    for (; *text; ++text)
        fputc(*text == '\'' ? '"' : *text, file);
    assert_int_equal(fclose(file), 0);
    return path;
}

static void put_u32(uint8_t *at, size_t value)
{
    for (int i = 0; i < 4; ++i)
        at[i] = (uint8_t)(value >> 8 * i);
}

const char *gltf_write_glb(const gltf_writer *w, const char *name, const char *rest)
{
    static uint8_t file[65536];
    char *json = compose(w, 0, rest);
    size_t json_size = strlen(json);
    while (json_size % 4)
        json[json_size++] = ' ';
    const size_t size = 12 + 8 + json_size + 8 + w->size;
    assert_in_range(size, 1, sizeof file);
    memcpy(file, "glTF", 4);
    put_u32(file + 4, 2);
    put_u32(file + 8, size);
    put_u32(file + 12, json_size);
    memcpy(file + 16, "JSON", 4);
    for (size_t i = 0; i < json_size; ++i)
        file[20 + i] = (uint8_t)(json[i] == '\'' ? '"' : json[i]);
    put_u32(file + 20 + json_size, w->size);
    memcpy(file + 24 + json_size, "BIN", 4);
    memcpy(file + 28 + json_size, w->bin, w->size);
    return gltf_write_bytes(name, file, size);
}

static void destroy(void *what)
{
    scene_destroy(what);
}

scene *gltf_scene(const char *path, const scene_load_options *options)
{
    char error[1024] = "";
    scene *s = scene_load_with(path, options, FAULT(error));
    if (!s)
        fail_msg("%s", error);
    test_release_later(destroy, s);
    if (scene_find_flaw(s))
        fail_msg("%s: %s", path, scene_find_flaw(s));
    return s;
}
