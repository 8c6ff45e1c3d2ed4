/* SPDX-License-Identifier: MIT
 *
 * What the files with hooks share.
 */
#ifndef GLSSAO_INJECT_HOOKS_H
#define GLSSAO_INJECT_HOOKS_H

#include "inject.h"

#include <GL/glcorearb.h>

#define HOOK __attribute__((visibility("default")))

/* REAL(type, name): a local pointer of that type to the real function; NULL where there is none. */
#define REAL(type, name)                                                                                               \
    type name##_real;                                                                                                  \
    do {                                                                                                               \
        void *address_ = inject_real(#name, NULL);                                                                     \
        memcpy(&name##_real, &address_, sizeof address_);                                                              \
    } while (0)

/* The framebuffer bound as GL_DRAW_FRAMEBUFFER_BINDING or GL_READ_FRAMEBUFFER_BINDING. */
unsigned hooks_framebuffer(GLenum binding);

#endif
