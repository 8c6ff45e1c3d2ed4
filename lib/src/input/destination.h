/* SPDX-License-Identifier: MIT
 *
 * Looks at a framebuffer of the host that a call draws into.
 */
#ifndef GLSSAO_INPUT_DESTINATION_H
#define GLSSAO_INPUT_DESTINATION_H

#include "gpu/functions.h"

/* A texture whose level 0 a compute shader can load and store. Texture 0: there is none. */
typedef struct glssao__image {
    gl_uint texture;
    gl_enum format;
    int kind;           /* IMAGE_ (values.glsl) */
    gl_int host_filter; /* to give back; 0: none was lent */
} glssao__image;

/* Whether the framebuffer, which is bound for drawing, has the texture for a colour, drawn into or not: reading it then
 * is a feedback loop (OpenGL 3.3, section 4.4.3). */
bool glssao__destination_has(const glssao__gl *gl, gl_uint framebuffer, gl_uint texture);

/* What the first draw buffer of the bound draw framebuffer draws into, where that is level 0 of a plain 2D texture in a
 * format that shaders can load and store. Binds it to the active texture unit. glssao__destination_give_back is due. */
glssao__image glssao__destination_image(const glssao__gl *gl, gl_uint framebuffer);

/* Gives the texture its own filter back, through the active texture unit. */
void glssao__destination_give_back(const glssao__gl *gl, const glssao__image *image);

#endif
