/* SPDX-License-Identifier: MIT
 *
 * A recording in memory, for loading and drawing.
 */
#pragma once

#include "replay.h"

enum { MAX_TEXTURES = 32, MAX_PROGRAMS = 64, MAX_PASSES = 32, MAX_SAMPLERS = 16, MAX_UNIFORMS = 64, MAX_VALUES = 512 };
enum { MAX_TARGETS = 4, LINE_LENGTH = 32768, NAME_LENGTH = 64 };

typedef struct uniform {
    GLint location;
    GLenum type;
    int count; /* of array elements */
    float *values;
} uniform;

typedef struct pass {
    GLuint program, framebuffer;
    int viewport[4], target_count, sampler_count, uniform_count;
    int targets[MAX_TARGETS];
    bool cleared;
    float clear[4];
    struct {
        GLint location;
        int texture; /* below 0: input -1 - texture */
    } samplers[MAX_SAMPLERS];
    uniform uniforms[MAX_UNIFORMS];
} pass;

struct replay {
    GLuint textures[MAX_TEXTURES];
    int sizes[MAX_TEXTURES][2], texture_count;
    GLuint programs[MAX_PROGRAMS]; /* the replayer's */
    int program_count, pass_count, output;
    pass passes[MAX_PASSES];
    bool cleared; /* while loading: the next pass clears its targets */
    float clear[4];
};

typedef union function {
    void *pointer;
    PFNGLGETACTIVEUNIFORMPROC get_active_uniform;
    PFNGLUNIFORM1FVPROC uniform1fv;
    PFNGLUNIFORMMATRIX2FVPROC uniform_matrix2fv;
} function;

struct replayer {
    function get_active_uniform, uniform1fv, uniform_matrix2fv;
    GLuint vertex_array, buffer;
    int program_count; /* ever compiled; the last MAX_PROGRAMS are kept */
    struct {
        char name[2 * NAME_LENGTH];
        GLuint program;
    } programs[MAX_PROGRAMS];
};

GLuint replay_make_texture(GLenum internal, GLenum format, GLenum type, const int size[2], bool linear, bool repeat,
                           const void *data);
