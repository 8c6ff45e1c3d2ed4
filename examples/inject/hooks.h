/* SPDX-License-Identifier: MIT
 *
 * What the files with hooks share.
 */
#pragma once

#include "inject.h"

#include <GL/glcorearb.h>

#define HOOK __attribute__((visibility("default")))

/* REAL(type, name): a local pointer of that type to the real function, looked up once; NULL where there is none. */
#define REAL(type, name)                                                                                               \
    static void *name##_address;                                                                                       \
    type name##_real;                                                                                                  \
    do {                                                                                                               \
        if (!name##_address)                                                                                           \
            name##_address = inject_real(#name, NULL);                                                                 \
        memcpy(&name##_real, &name##_address, sizeof name##_address);                                                  \
    } while (0)

/* The framebuffer bound as GL_DRAW_FRAMEBUFFER_BINDING or GL_READ_FRAMEBUFFER_BINDING. */
unsigned hooks_framebuffer(GLenum binding);

/* The context that is current on this thread; NULL where none is. */
void *hooks_context(void);
/* What is bound there, in that context. */
inject_place hooks_place(GLenum binding);

/* Drivers and loaders call each other, so only the outermost call of a hook counts. */
typedef struct hooks_thread {
    int calls;
    bool in_primitive, in_list; /* between glBegin and glEnd, between glNewList and glEndList: GL may not be queried */
} hooks_thread;
extern _Thread_local hooks_thread hooks_this_thread;

/* Enters a hook. True if the event counts: in the outermost hook, with a context, while GL may be queried. Call
 * hooks_leave in either case. */
bool hooks_enter(void);
void hooks_leave(void);
