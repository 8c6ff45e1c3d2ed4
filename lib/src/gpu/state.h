/* SPDX-License-Identifier: MIT
 *
 * The host's GL state: saved before a call changes it, set to what the passes need, and put back afterwards.
 */
#ifndef GLSSAO_GPU_STATE_H
#define GLSSAO_GPU_STATE_H

#include "gpu/functions.h"
#include "log.h"

enum {
    STATE_UNITS = 8,  /* texture units that a call may bind, from 0 */
    STATE_BLOCKS = 3, /* uniform buffer binding points that a call may bind, from 0 */
    STATE_DRAW_BUFFERS = 8,
    STATE_TOGGLES = 16,
    STATE_TRANSFERS = 24
};

/* Parts of the state. A call names those that it changes; the others cost nothing. */
enum {
    STATE_DRAW = 1,          /* what every draw depends on: program, target, viewport, masks, toggles */
    STATE_BLEND = 2,         /* blend functions and equations of draw buffer 0 */
    STATE_ALL_MASKS = 4,     /* the colour masks of all draw buffers, for framebuffers of the host */
    STATE_DEPTH_MASK = 8,    /* for clearing depth */
    STATE_TRANSFER = 16,     /* how pixels are packed, unpacked and scaled on their way */
    STATE_UNIFORMS = 32,     /* uniform buffer bindings */
    STATE_IMAGE = 64,        /* image unit 0, which compute shaders write through */
    STATE_READ = 128,        /* the read framebuffer */
    STATE_MULTISAMPLE = 256, /* the multisample texture of one unit */
    STATE_BLEND_COLOR = 512, /* the constant that blend functions may name */
    STATE_SECOND = 1024 /* of a second target: mask and blend switch of draw buffer 1, with STATE_IMAGE image unit 1 */
};

typedef struct glssao__state_need {
    unsigned parts;                  /* STATE_ bits */
    unsigned units;                  /* bit i: 2D texture and sampler of unit i */
    int blocks;                      /* with STATE_UNIFORMS: how many binding points, from 0 */
    int multisample_unit;            /* with STATE_MULTISAMPLE */
    bool keep_scissor, keep_stencil; /* with STATE_DRAW: the host's test stays as it is */
} glssao__state_need;

typedef struct glssao__state {
    glssao__state_need need;
    bool is_saved; /* false: the host restores its state itself, and nothing was asked */
    gl_int program, vertex_array, draw_framebuffer, read_framebuffer, active_texture;
    gl_float viewport[4];
    gl_int textures[STATE_UNITS], samplers[STATE_UNITS], multisample_texture;
    gl_int images[2][6]; /* name, level, layered, layer, access, format */
    gl_int uniform_buffer;
    struct {
        gl_int buffer;
        int64_t offset, size;
    } uniform_bindings[STATE_BLOCKS];
    gl_int unpack_buffer, pack_buffer;
    gl_float transfers[STATE_TRANSFERS];
    gl_int polygon_mode[2];
    gl_int clip_origin, clip_depth;
    gl_int clamp_fragment_color;
    gl_boolean depth_mask;
    gl_boolean color_masks[STATE_DRAW_BUFFERS][4];
    gl_int blend_function[4], blend_equation[2];
    gl_float blend_color[4];
    gl_boolean blend[2], scissor;
    gl_int scissor_box[4];
    gl_boolean toggles[STATE_TOGGLES];
} glssao__state;

/* Refuses state that can be neither neutralised nor put back: feedback and selection mode, active transform feedback,
 * and a current program that the host has deleted, which would be lost. Changes nothing. */
glssao_result glssao__state_check(const glssao__gl *gl, const glssao__log *log, const char *function);

/* Saves what `need` names and sets what the passes want. With `host_restores` nothing is asked: the wanted state is
 * set, and glssao__state_restore does nothing. */
void glssao__state_save(const glssao__gl *gl, const glssao__state_need *need, bool host_restores, glssao__state *out);
void glssao__state_restore(const glssao__gl *gl, const glssao__state *state);

/* Whether one of the toggles, for instance GL_STENCIL_TEST, was on when the state was saved. */
bool glssao__state_was_on(const glssao__state *state, gl_enum toggle);

/* For draws between save and restore, where the part is saved. */
void glssao__state_blend(const glssao__gl *gl, gl_enum source, gl_enum destination); /* colour; alpha stays */
void glssao__state_add(const glssao__gl *gl);                                        /* all channels */
void glssao__state_scissor(const glssao__gl *gl, const gl_int box[4]);               /* NULL: off */
void glssao__state_viewport(const glssao__gl *gl, const gl_float viewport[4]);

#endif
