/* SPDX-License-Identifier: MIT
 *
 * The textures that a host hands over with a frame: what they must be, how exactly they hold depth, and texture
 * parameters that would change what a shader reads.
 */
#ifndef GLSSAO_INPUT_HOST_TEXTURES_H
#define GLSSAO_INPUT_HOST_TEXTURES_H

#include "input/formats.h"
#include "input/projection.h"
#include "log.h"

/* The textures of a frame, in this order. */
enum { HOST_DEPTH, HOST_NORMAL, HOST_BACK, HOST_SECOND, HOST_MOTION, HOST_RAYS, HOST_TEXTURES };

enum { HOST_PARAMETERS = 4, HOST_SEEN = 8 };

/* What is known of one texture. */
typedef struct glssao__host_texture {
    gl_uint name;
    gl_enum target;
    int width, height;
    glssao__format format;
    enum glssao__role role;
    glssao__precision precision;           /* of what stands for depth */
    bool has_changes;                      /* one of the parameters below was not what the passes want */
    gl_int parameters[HOST_PARAMETERS][4]; /* as the host has them */
} glssao__host_texture;

/* For hosts that restore their state themselves: textures that were looked at once, so that no call asks again. */
typedef struct glssao__host_textures {
    glssao__host_texture seen[HOST_SEEN];
    int next;
} glssao__host_textures;

/* The textures that one frame reads; name 0: not read. */
typedef struct glssao__host_inputs {
    glssao__host_texture textures[HOST_TEXTURES];
    glssao__precision precision; /* of depth */
} glssao__host_inputs;

/* The frame's texture names, 0 where one is not read. */
void glssao__host_names(const glssao_frame *frame, gl_uint out_names[HOST_TEXTURES]);

/* Refuses textures that are not what the frame says, and sets parameters that would change what is read. `size`: full
 * size in pixels. `unit`: a saved texture unit. `names`: of those that are read. `known`: NULL, or what to remember and
 * to consult before OpenGL. After GLSSAO_OK, glssao__host_textures_restore is due. */
glssao_result glssao__host_textures_check(const glssao__gl *gl, const glssao__log *log, const glssao_frame *frame,
                                          const int size[2], int unit, const gl_uint names[HOST_TEXTURES],
                                          glssao__host_textures *known, glssao__host_inputs *out);
/* Gives the textures their parameters back. */
void glssao__host_textures_restore(const glssao__gl *gl, const glssao__host_inputs *inputs, int unit);

/* Checks a texture that no frame names, but which lies as the frame's do: of the full size, or larger with `viewport`.
 * `field` names it in the log. Binds it to the active unit, and sets its parameters, which
 * glssao__host_texture_restore gives back. */
bool glssao__host_texture_check(const glssao__gl *gl, const glssao__log *log, const char *field, const int viewport[4],
                                const int size[2], glssao__host_textures *known, glssao__host_texture *t);
void glssao__host_texture_restore(const glssao__gl *gl, const glssao__host_texture *t);

/* The texture is to be looked at anew. */
void glssao__host_textures_forget(glssao__host_textures *known, gl_uint name);

/* Binds a texture to the active unit's `target` if it is of that kind; leaves no GL error. */
bool glssao__host_texture_bind(const glssao__gl *gl, gl_enum target, gl_uint texture);

#endif
