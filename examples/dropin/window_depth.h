/* SPDX-License-Identifier: MIT
 *
 * Copies the depth buffer of a window to a texture, for programs that draw straight into their window. Copy this file
 * and window_depth.c into your program. Multisampled depth is resolved: OpenGL takes one sample of each pixel.
 */
#ifndef WINDOW_DEPTH_H
#define WINDOW_DEPTH_H

#include <stdbool.h>

typedef struct window_depth window_depth;

/* Needs a current context of OpenGL 3.0 or later. `load` finds GL functions, as glssao_config's does. NULL on failure.
 */
window_depth *window_depth_create(void *(*load)(const char *name, void *user), void *user);

/* Copies the depth of the lower left `width` by `height` pixels of `framebuffer` (0: the window). Gives a
 * GL_TEXTURE_2D of that size; its name stays the same until the size changes. Gives 0 and a reason in *out_why (static
 * text) where there is no depth or it can't be copied. GL state is left as found, but pending GL errors are lost. */
unsigned window_depth_copy(window_depth *depth, unsigned framebuffer, int width, int height, const char **out_why);

/* The context must be current. NULL is fine. */
void window_depth_destroy(window_depth *depth);

#endif
