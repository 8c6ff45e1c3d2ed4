/* SPDX-License-Identifier: MIT
 *
 * Programs: compiled or read from the cache when first asked for, and kept for the life of the effect.
 */
#ifndef GLSSAO_GPU_PROGRAMS_H
#define GLSSAO_GPU_PROGRAMS_H

#include "gpu/functions.h"
#include "log.h"

enum { PROGRAM_UNIFORMS = 6 };

/* A program's name among others; the caller says what the bytes mean. */
typedef struct glssao__program_key {
    uint8_t bytes[48];
} glssao__program_key;

/* What a program is compiled from. A compute program has no vertex stage. */
typedef struct glssao__program_source {
    const char *name;                        /* for messages and file names */
    const char *vertex, *fragment, *compute; /* whole texts; NULL: no such stage */
} glssao__program_source;

/* One member of a uniform block, and where C keeps it. */
typedef struct glssao__block_member {
    char type[8]; /* of GLSL */
    char name[32];
    size_t count; /* of elements; 0: no array */
    size_t offset;
} glssao__block_member;

typedef struct glssao__block {
    const char *name;
    size_t size;         /* in C, rounded up to a vec4 */
    const char *members; /* as in GLSL: "mat4 gProj; // comment\n..." */
} glssao__block;

/* Names that all programs are tied to. Block i goes to binding point i. */
typedef struct glssao__program_ties {
    const glssao__block *blocks;
    int block_count;
    const struct glssao__sampler_name {
        const char *name;
        int unit;
    } * samplers;
    int sampler_count;
    const char *uniforms[PROGRAM_UNIFORMS]; /* plain uniforms that are set for each draw */
} glssao__program_ties;

typedef struct glssao__program {
    gl_uint name;
    gl_int locations[PROGRAM_UNIFORMS]; /* of the plain uniforms; -1: the program has none of that name */
} glssao__program;

/* All zero: none made yet. */
typedef struct glssao__programs {
    struct glssao__compiled {
        glssao__program_key key;
        glssao__program program;
    } * compiled;
    int count;
    char *cache_folder; /* NULL: linked programs are not kept on disk */
} glssao__programs;

/* NULL where no program of that key was made yet. */
const glssao__program *glssao__programs_find(const glssao__programs *programs, const glssao__program_key *key);

/* Compiles the program, or reads it from the cache, and checks the driver's layout of the blocks against C's. May fail
 * with SHADER_ERROR, after logging the driver's text and the numbered source, and with OUT_OF_MEMORY. */
glssao_result glssao__programs_make(glssao__programs *programs, const glssao__gl *gl, const glssao__log *log,
                                    const glssao__program_ties *ties, const glssao__program_key *key,
                                    const glssao__program_source *source);

void glssao__programs_destroy(glssao__programs *programs, const glssao__gl *gl);

/* Reads the next member of a block's text and moves *text behind it; false at the end. The offset is that of a C struct
 * of 4-byte numbers without padding, which the text must be arranged for. `out` holds the member before, or zero. */
bool glssao__block_next(const char **text, size_t *offset, glssao__block_member *out);

#endif
