/* SPDX-License-Identifier: MIT
 *
 * Linked programs kept on disk between runs, in a folder that the host names. A file's name tells the driver, the
 * library's version and the program's sources; what does not fit, or is damaged, is not there. Nothing fails for want
 * of a file.
 */
#include "effect.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return text ? hash_bytes(hash, text, strlen(text) + 1) : hash; /* with its end, so that texts do not run together */
}

static uint64_t key_of(const glssao_effect *effect, enum glssao__shader shader, unsigned variant)
{
    const glssao__gl *gl = &effect->gl;
    const uint32_t version = glssao_version();
    uint64_t hash = hash_bytes(hash_start, &version, sizeof version);
    const gl_enum names[] = {GL_VENDOR, GL_RENDERER, GL_VERSION};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        hash = hash_text(hash, (const char *)gl->GetString(names[i]));
    const bool drawn = !(variant & VARIANT_COMPUTE);
    const gl_enum stages[] = {drawn ? GL_VERTEX_SHADER : GL_COMPUTE_SHADER, GL_FRAGMENT_SHADER};
    for (size_t i = 0; i < (drawn ? 2 : 1); ++i) {
        const char *sources[GLSSAO__PROGRAM_MAX_SOURCES];
        const int count = glssao__program_sources(gl, shader, variant, stages[i], sources);
        for (int k = 0; k < count; ++k)
            hash = hash_text(hash, sources[k]);
    }
    return hash;
}

/* False where there is no cache to ask. */
static bool find_path(const glssao_effect *effect, enum glssao__shader shader, uint64_t key, char out[PATH_LENGTH])
{
    if (!effect->cache_folder || !effect->gl.program_binaries)
        return false;
    const int length =
        snprintf(out, PATH_LENGTH, "%s/glssao-%s-%08lx%08lx.bin", effect->cache_folder,
                 glssao__program_shader_name(shader), (unsigned long)(key >> 32), (unsigned long)(key & 0xFFFFFFFFu));
    return length > 0 && length < PATH_LENGTH;
}

static void *read_file(const char *path, uint64_t key, file_head *out_head)
{
    FILE *file = fopen(path, "rb");
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

gl_uint glssao__cache_read(const glssao_effect *effect, enum glssao__shader shader, unsigned variant)
{
    const glssao__gl *gl = &effect->gl;
    const uint64_t key = effect->cache_folder ? key_of(effect, shader, variant) : 0;
    char path[PATH_LENGTH];
    file_head head;
    void *data = find_path(effect, shader, key, path) ? read_file(path, key, &head) : NULL;
    if (!data)
        return 0;
    gl_uint program = gl->CreateProgram();
    gl->ProgramBinary(program, head.format, data, (gl_sizei)head.length);
    free(data);
    gl_int ok = 0;
    gl->GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok)
        return program;
    gl->DeleteProgram(program); /* the driver knows better: it is compiled anew */
    return 0;
}

void glssao__cache_write(const glssao_effect *effect, enum glssao__shader shader, unsigned variant, gl_uint program)
{
    const glssao__gl *gl = &effect->gl;
    const uint64_t key = effect->cache_folder ? key_of(effect, shader, variant) : 0;
    char path[PATH_LENGTH], part[PATH_LENGTH + 8];
    gl_int length = 0;
    if (!find_path(effect, shader, key, path))
        return;
    gl->GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    void *data = length > 0 && length <= MOST_BYTES ? malloc((size_t)length) : NULL;
    if (!data)
        return;
    file_head head = {.key = key};
    gl_sizei written = 0;
    gl->GetProgramBinary(program, length, &written, &head.format, data);
    head.length = (uint32_t)written;
    head.sum = sum_of(&head, data);
    memcpy(head.magic, magic, sizeof magic);
    /* Under another name first: who reads meanwhile finds all of it or nothing. */
    snprintf(part, sizeof part, "%s.part", path);
    FILE *file = written > 0 ? fopen(part, "wb") : NULL;
    if (file) {
        const bool whole =
            fwrite(&head, sizeof head, 1, file) == 1 && fwrite(data, 1, head.length, file) == head.length;
        if (fclose(file) != 0 || !whole || rename(part, path) != 0)
            remove(part);
    }
    free(data);
}
