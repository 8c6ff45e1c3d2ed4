/* SPDX-License-Identifier: MIT
 *
 * The effect's normal map beside the host's depth, as a framebuffer for the host to draw into.
 */
#ifndef GLSSAO_NORMALS_H
#define GLSSAO_NORMALS_H

#include "gpu/functions.h"
#include "gpu/state.h"
#include "gpu/textures.h"
#include "log.h"

/* Between glssao_begin_normals and glssao_end_normals: what the latter puts back. */
typedef struct glssao__normals {
    bool is_open;
    gl_int host_framebuffer;
    gl_float host_viewport[4];
    gl_uint
        known_depth; /* for hosts that restore their state: a texture that was looked at, so that no call asks again */
    bool known_stencil;
} glssao__normals;

/* The state that glssao__normals_begin changes. */
glssao__state_need glssao__normals_need(void);

/* Attaches the depth texture to the normal map's framebuffer and clears both; runs between saving and restoring. */
glssao_result glssao__normals_begin(glssao__normals *normals, const glssao__gl *gl, const glssao__log *log,
                                    const glssao__target *normal_map, gl_uint depth_texture, bool host_restores);
/* Binds that framebuffer for the host, and notes what was bound unless the host restores its state itself. */
void glssao__normals_open(glssao__normals *normals, const glssao__gl *gl, const glssao__target *normal_map,
                          bool host_restores);
/* Whether that framebuffer is bound. */
bool glssao__normals_are_bound(const glssao__gl *gl, const glssao__target *normal_map);
/* Detaches the depth texture, and binds what was bound before unless the host restores its state itself. */
void glssao__normals_close(glssao__normals *normals, const glssao__gl *gl, const glssao__target *normal_map,
                           bool host_restores);

#endif
