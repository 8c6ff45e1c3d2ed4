/* SPDX-License-Identifier: MIT
 *
 * Linked programs on disk. A file's name tells the driver, the library's version and the program's source; a file that
 * does not fit, or is damaged, counts as absent. A linked program is code that the driver runs, so a file is trusted
 * only where nobody but the user could have put it there. No call fails for want of a file.
 */
#if !defined(_WIN32) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200809L /* mkstemp, O_NOFOLLOW */
#endif
#include "gpu/program_cache.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#include <process.h> /* Windows */
#else
#include <fcntl.h>    /* POSIX */
#include <sys/stat.h> /* POSIX */
#include <unistd.h>   /* POSIX */
#endif

enum { PATH_LENGTH = 4096, MOST_BYTES = 1 << 26 };

typedef struct file_head {
    char magic[8];
    uint64_t key;
    uint64_t sum; /* of format, length and the bytes that follow */
    uint32_t format, length;
} file_head;

static const char magic[8] = "glssao1";

/* FNV-1a (Fowler, Noll, Vo). */
static uint64_t hash_bytes(uint64_t hash, const void *data, size_t length)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < length; ++i)
        hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

static const uint64_t hash_start = 14695981039346656037u;

static uint64_t sum_of(const file_head *head, const void *data)
{
    const uint32_t numbers[2] = {head->format, head->length};
    return hash_bytes(hash_bytes(hash_start, numbers, sizeof numbers), data, head->length);
}

/* The text with its final 0, so that two texts do not run together. */
static uint64_t hash_text(uint64_t hash, const char *text)
{
    return text ? hash_bytes(hash, text, strlen(text) + 1) : hash;
}

static uint64_t key_of(const glssao__gl *gl, const glssao__program_source *source)
{
    const uint32_t version = glssao_version();
    uint64_t hash = hash_bytes(hash_start, &version, sizeof version);
    const gl_enum names[] = {GL_VENDOR, GL_RENDERER, GL_VERSION};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        hash = hash_text(hash, (const char *)gl->GetString(names[i]));
    return hash_text(hash_text(hash_text(hash, source->vertex), source->fragment), source->compute);
}

/* "/folder/glssao-horizon-0123456789abcdef.bin", from the name up to its first space. */
static bool find_path(const char *folder, const glssao__program_source *source, uint64_t key, char out[PATH_LENGTH])
{
    const int length =
        snprintf(out, PATH_LENGTH, "%s/glssao-%.*s-%08lx%08lx.bin", folder, (int)strcspn(source->name, " "),
                 source->name, (unsigned long)(key >> 32), (unsigned long)(key & 0xFFFFFFFFu));
    return length > 0 && length < PATH_LENGTH;
}

#if defined(_WIN32)
/* A user's own folders are protected by their access lists. */
bool glssao__program_cache_trusts(const char *folder)
{
    (void)folder;
    return true;
}

static FILE *open_trusted(const char *path)
{
    return fopen(path, "rb");
}

static FILE *create_part(const char *path, char part[PATH_LENGTH])
{
    const int length = snprintf(part, PATH_LENGTH, "%s.%d", path, _getpid());
    return length > 0 && length < PATH_LENGTH ? fopen(part, "wbx") : NULL;
}

static bool move_over(const char *part, const char *path)
{
    (void)remove(path); /* rename() of Windows does not replace a file */
    return rename(part, path) == 0;
}
#else
static bool is_ours_alone(const struct stat *s)
{
    return s->st_uid == geteuid() && (s->st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

bool glssao__program_cache_trusts(const char *folder)
{
    struct stat s;
    return stat(folder, &s) == 0 && S_ISDIR(s.st_mode) && is_ours_alone(&s);
}

static FILE *open_trusted(const char *path)
{
    struct stat s;
    const int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        return NULL;
    FILE *file =
        fstat(descriptor, &s) == 0 && S_ISREG(s.st_mode) && is_ours_alone(&s) ? fdopen(descriptor, "rb") : NULL;
    if (!file)
        close(descriptor);
    return file;
}

/* A new file of an unpredictable name, which nobody else can read or write. */
static FILE *create_part(const char *path, char part[PATH_LENGTH])
{
    const int length = snprintf(part, PATH_LENGTH, "%s.XXXXXX", path);
    const int descriptor = length > 0 && length < PATH_LENGTH ? mkstemp(part) : -1;
    if (descriptor < 0)
        return NULL;
    FILE *file = fdopen(descriptor, "wb");
    if (!file) {
        close(descriptor);
        (void)remove(part);
    }
    return file;
}

static bool move_over(const char *part, const char *path)
{
    return rename(part, path) == 0;
}
#endif

static void *read_file(const char *path, uint64_t key, file_head *out_head)
{
    FILE *file = open_trusted(path);
    if (!file)
        return NULL;
    void *data = NULL;
    if (fread(out_head, sizeof *out_head, 1, file) == 1 && memcmp(out_head->magic, magic, sizeof magic) == 0 &&
        out_head->key == key && out_head->length > 0 && out_head->length <= MOST_BYTES)
        data = malloc(out_head->length);
    const bool whole =
        data && fread(data, 1, out_head->length, file) == out_head->length && sum_of(out_head, data) == out_head->sum;
    fclose(file);
    if (whole)
        return data;
    free(data);
    return NULL;
}

gl_uint glssao__program_cache_read(const glssao__gl *gl, const char *folder, const glssao__program_source *source)
{
    if (!gl->program_binaries)
        return 0;
    const uint64_t key = key_of(gl, source);
    char path[PATH_LENGTH];
    file_head head;
    void *data = find_path(folder, source, key, path) ? read_file(path, key, &head) : NULL;
    if (!data)
        return 0;
    gl_uint program = gl->CreateProgram();
    gl->ProgramBinary(program, head.format, data, (gl_sizei)head.length);
    free(data);
    gl_int ok = 0;
    gl->GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok)
        return program;
    gl->DeleteProgram(program); /* the driver changed its mind: the program is compiled anew */
    return 0;
}

/* Writes under another name first: who reads meanwhile finds the whole file or none. */
static void write_file(const char *path, const file_head *head, const void *data)
{
    char part[PATH_LENGTH];
    FILE *file = create_part(path, part);
    if (!file)
        return;
    const bool whole = fwrite(head, sizeof *head, 1, file) == 1 && fwrite(data, 1, head->length, file) == head->length;
    if (fclose(file) != 0 || !whole || !move_over(part, path))
        (void)remove(part);
}

void glssao__program_cache_write(const glssao__gl *gl, const char *folder, const glssao__program_source *source,
                                 gl_uint program)
{
    if (!gl->program_binaries)
        return;
    file_head head = {.key = key_of(gl, source)};
    char path[PATH_LENGTH];
    gl_int length = 0;
    if (!find_path(folder, source, head.key, path))
        return;
    gl->GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    void *data = length > 0 && length <= MOST_BYTES ? malloc((size_t)length) : NULL;
    if (!data)
        return;
    gl_sizei written = 0;
    gl->GetProgramBinary(program, length, &written, &head.format, data);
    head.length = (uint32_t)written;
    head.sum = sum_of(&head, data);
    memcpy(head.magic, magic, sizeof magic);
    if (written > 0)
        write_file(path, &head, data);
    free(data);
}
