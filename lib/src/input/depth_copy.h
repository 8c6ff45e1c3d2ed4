/* SPDX-License-Identifier: MIT
 *
 * A copy of the depth buffer of one of the host's framebuffers, as a texture.
 */
#ifndef GLSSAO_INPUT_DEPTH_COPY_H
#define GLSSAO_INPUT_DEPTH_COPY_H

#include "gpu/state.h"
#include "gpu/timers.h"

/* All zero: nothing was copied yet. The texture keeps its name. */
typedef struct glssao__depth_copy {
    gl_uint texture, framebuffer;
    gl_enum format;
    int width, height;
    gl_uint source;  /* the framebuffer that the last copy came from */
    bool is_checked; /* a copy from there in this format and size worked */
    bool blit_fails; /* so texels are copied instead */
    bool is_new;     /* the last copy gave the texture another size or format */
} glssao__depth_copy;

glssao__state_need glssao__depth_copy_need(void);

/* Copies x, y, width, height pixels of the framebuffer's depth, or one sample of each. With `host_restores`, a copy
 * like the last asks OpenGL nothing. Needs the state above. Timed as SECTION_DEPTH_COPY. May fail with
 * INVALID_ARGUMENT, FRAMEBUFFER_ERROR and OUT_OF_MEMORY. */
glssao_result glssao__depth_copy_take(glssao__depth_copy *copy, const glssao__gl *gl, glssao__timers *timers,
                                      const glssao__log *log, gl_uint framebuffer, const int rectangle[4],
                                      bool host_restores);
void glssao__depth_copy_destroy(glssao__depth_copy *copy, const glssao__gl *gl);

#endif
