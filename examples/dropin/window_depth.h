/* SPDX-License-Identifier: MIT
 *
 * The depth buffer of a window as a texture, for programs that draw straight into their window. Copy this file and
 * window_depth.c into your program. Multisampled depth is resolved: GL takes one sample of each pixel.
 */
#ifndef WINDOW_DEPTH_H
#define WINDOW_DEPTH_H

#include <stdbool.h>

typedef struct window_depth window_depth;

/* In the current context, 3.0 or later. `load` finds GL functions; glssao_config's can be used. NULL on failure. */
window_depth *window_depth_create(void *(*load)(const char *name, void *user), void *user);

/* Copies the depth of the lower left `width` by `height` pixels of `framebuffer` (0: the window). Gives a
 * GL_TEXTURE_2D of that size, the same name each time until the size changes; or 0 with *out_why (static text) where
 * there is no depth, or none that can be copied. Leaves GL state as found; errors that glGetError held are gone. */
unsigned window_depth_copy(window_depth *depth, unsigned framebuffer, int width, int height, const char **out_why);

/* The context must be current. NULL is fine. */
void window_depth_destroy(window_depth *depth);

#endif
