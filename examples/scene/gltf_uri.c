/* SPDX-License-Identifier: MIT
 *
 * Decodes URIs, and keeps files to the folders that they may come from.
 */
#define _XOPEN_SOURCE 700 /* realpath */
#include "gltf_uri.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

bool gltf_uri_is_data(const char *uri)
{
    return !strncasecmp(uri, "data:", 5);
}

/* The value of a digit, -1 for anything else. */
static int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* RFC 4648, either alphabet; white space and padding are passed over. */
static bool decode_base64(const char *text, uint8_t *out, size_t *out_size)
{
    uint32_t bits = 0;
    int held = 0;
    *out_size = 0;
    for (; *text; ++text) {
        const int digit = base64_digit(*text);
        if (digit < 0 && !strchr("=\r\n\t ", *text))
            return false;
        if (digit < 0)
            continue;
        bits = bits << 6 | (uint32_t)digit;
        held += 6;
        if (held >= 8) {
            held -= 8;
            out[(*out_size)++] = (uint8_t)(bits >> held);
        }
    }
    return true;
}

/* RFC 3986, section 2.1; a percent sign without two hexadecimal digits stands for itself. */
static size_t decode_percent(const char *text, uint8_t *out)
{
    size_t size = 0;
    while (*text) {
        const int high = *text == '%' ? hex_digit(text[1]) : -1, low = high < 0 ? -1 : hex_digit(text[2]);
        out[size++] = low < 0 ? (uint8_t)*text : (uint8_t)(16 * high + low);
        text += low < 0 ? 1 : 3;
    }
    return size;
}

static bool says_base64(const char *uri, const char *comma)
{
    for (const char *at = uri; at + 7 <= comma; ++at)
        if (!strncasecmp(at, ";base64", 7) && (at[7] == ',' || at[7] == ';'))
            return true;
    return false;
}

uint8_t *gltf_uri_decode_data(const char *uri, size_t *out_size)
{
    const char *comma = strchr(uri, ',');
    uint8_t *data = comma ? malloc(strlen(comma) + 1) : NULL;
    *out_size = 0;
    if (!data)
        return NULL;
    if (!says_base64(uri, comma)) {
        *out_size = decode_percent(comma + 1, data);
    } else if (!decode_base64(comma + 1, data, out_size)) {
        free(data);
        return NULL;
    }
    return data;
}

static bool has_scheme(const char *uri)
{
    const size_t length =
        strspn(uri, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-."); /* RFC 3986, section 3.1 */
    return length && uri[length] == ':';
}

/* Resolves "." and ".." in place. False where the name leads out of the folder that it is relative to. */
static bool normalize(char *name)
{
    char *out = name; /* never passes `in`: the result is no longer than the text read so far */
    for (const char *in = name; *in; in += *in == '/') {
        const size_t length = strcspn(in, "/");
        if (length == 2 && !strncmp(in, "..", 2)) {
            if (out == name)
                return false;
            while (out != name && *--out != '/')
                continue;
        } else if (length && !(length == 1 && *in == '.')) {
            if (out != name)
                *out++ = '/';
            memmove(out, in, length);
            out += length;
        }
        in += length;
    }
    *out = '\0';
    return *name;
}

static char *join(const char *folder, const char *name)
{
    const size_t begin = strlen(folder), size = strlen(name) + 1;
    char *path = malloc(begin + size);
    if (path) {
        memcpy(path, folder, begin);
        memcpy(path + begin, name, size);
    }
    return path;
}

/* Where both exist, links followed. */
static bool holds(const char *root, const char *path)
{
    char *from = realpath(root, NULL), *to = realpath(path, NULL);
    const size_t length = from ? strlen(from) : 0;
    const bool held = from && to && !strncmp(from, to, length) && (to[length] == '/' || !strcmp(from, "/"));
    free(from);
    free(to);
    return held;
}

/* As gltf_uri_find_file, of a decoded name, which is overwritten. */
static char *resolve(char *name, const char *folder, const char *root)
{
    if (!*name || *name == '/' || has_scheme(name))
        return NULL;
    char *outside = join(folder, name);
    if (normalize(name)) {
        free(outside);
        return join(folder, name);
    }
    if (outside && root && holds(root, outside))
        return outside;
    free(outside);
    return NULL;
}

/* Spellings of a file name, in the order that they are tried: percent-decoded, as written, and decoded with backslashes
 * turned into slashes. */
enum { SPELLING_COUNT = 3 };

static void spell(const char *uri, int spelling, char *out)
{
    const size_t size = strlen(uri) + 1;
    memset(out, 0, size);
    if (spelling == 1)
        memcpy(out, uri, size);
    else
        decode_percent(uri, (uint8_t *)out);
    for (char *at = out; spelling == 2 && *at; ++at)
        *at = *at == '\\' ? '/' : *at;
}

char *gltf_uri_find_file(const char *uri, const char *folder, const char *root)
{
    char *name = malloc(strlen(uri) + 1), *found = NULL;
    for (int i = 0; name && i < SPELLING_COUNT; ++i) {
        spell(uri, i, name);
        char *path = resolve(name, folder, root);
        if (i == 0) {
            found = path;
            if (!path || access(path, F_OK) == 0)
                break;
        } else if (path && access(path, F_OK) == 0) {
            free(found);
            found = path;
            break;
        } else {
            free(path);
        }
    }
    free(name);
    return found;
}
