/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "read_file.h"

#include "inputs.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* Room for `size` bytes and the 0 behind them. */
static bool make_room(uint8_t **data, size_t size)
{
    uint8_t *grown = size < SIZE_MAX ? realloc(*data, size + 1) : NULL;
    *data = grown ? grown : *data;
    return grown;
}

/* Reads until the end; `expected` bytes of room to begin with save copies. */
static uint8_t *read_all(int descriptor, size_t expected, size_t limit, size_t *out_size, const char **out_reason)
{
    uint8_t *data = NULL;
    size_t size = 0, room = expected;
    *out_reason = make_room(&data, room) ? NULL : "not enough memory";
    while (!*out_reason) {
        if (size == room) { /* one byte more than the limit tells that there is more */
            room = room > limit ? room : room < 65536 ? 65536 : room < limit / 2 ? 2 * room : limit + 1;
            if (!make_room(&data, room)) {
                *out_reason = "not enough memory";
                break;
            }
        }
        const ssize_t got = read(descriptor, data + size, room - size);
        if (got == 0)
            break;
        if (got < 0 && errno != EINTR)
            *out_reason = strerror(errno);
        size += got > 0 ? (size_t)got : 0;
        if (size > limit)
            *out_reason = "too large";
    }
    if (*out_reason) {
        free(data);
        return NULL;
    }
    data[size] = '\0';
    *out_size = size;
    return data;
}

int read_file_open(const char *path, const char **out_reason)
{
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); /* a FIFO without a writer would block */
    struct stat about;
    if (file >= 0 && fstat(file, &about) == 0 && S_ISREG(about.st_mode))
        return file;
    *out_reason = file >= 0 ? "not a regular file" : strerror(errno);
    if (file >= 0)
        close(file);
    return -1;
}

uint8_t *read_file(const char *path, size_t limit, size_t *out_size, const char **out_reason)
{
    struct stat about;
    uint8_t *data = NULL;
    const int file = read_file_open(path, out_reason);
    if (file < 0)
        return NULL;
    if (fstat(file, &about) != 0)
        *out_reason = strerror(errno);
    else if ((uintmax_t)about.st_size > limit)
        *out_reason = "too large";
    else if ((data = read_all(file, (size_t)about.st_size + 1, limit, out_size, out_reason)))
        inputs_note(file, path);
    close(file);
    return data;
}

uint8_t *read_stream(int descriptor, size_t limit, size_t *out_size, const char **out_reason)
{
    inputs_note(descriptor, "standard input");
    return read_all(descriptor, 0, limit, out_size, out_reason);
}

const char *read_file_find_mistake(const void *data, size_t size)
{
    static const struct {
        const char *begin, *meaning;
    } mistakes[] = {
        {"version https://git-lfs", "this is a Git LFS pointer, not the file itself: fetch it with \"git lfs pull\""},
        {"<!doctype html", "this is an HTML page: the download was probably answered by a web page"},
        {"<html", "this is an HTML page: the download was probably answered by a web page"},
        {"\x1f\x8b\x08", "this is compressed with gzip: unpack it first"},
        {"PK\x03\x04", "this is a ZIP archive: unpack it first"},
        {"\xff\xfe", "this is text in UTF-16: save it as UTF-8"},
        {"\xfe\xff", "this is text in UTF-16: save it as UTF-8"},
    };
    for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; ++i) {
        const size_t length = strlen(mistakes[i].begin);
        if (size >= length && !strncasecmp(data, mistakes[i].begin, length))
            return mistakes[i].meaning;
    }
    return NULL;
}
