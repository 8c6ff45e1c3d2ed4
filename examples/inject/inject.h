/* SPDX-License-Identifier: MIT
 *
 * glssao-inject, a library to preload (LD_PRELOAD) into an OpenGL program that knows nothing of glssao: what its files
 * share. lookup.c and hooks.c stand between the program and OpenGL, matrices.c finds the projection among the matrices
 * that go by, frame.c draws the effect before the buffers are swapped, options.c reads the environment.
 */
#ifndef GLSSAO_INJECT_H
#define GLSSAO_INJECT_H

#include <stdbool.h>

/* ---- options.c: the environment, read once ---- */

typedef struct inject_options {
    float fov;                   /* GLSSAO_INJECT_FOV: vertical, degrees; 0: found among the matrices */
    float near_plane, far_plane; /* GLSSAO_INJECT_NEAR, _FAR, scene units */
    float radius;                /* GLSSAO_INJECT_RADIUS, scene units; 0: a share of what is seen */
    float power;                 /* GLSSAO_INJECT_POWER */
    int quality;                 /* GLSSAO_INJECT_QUALITY: low, medium, high, ultra */
    bool off;                    /* GLSSAO_INJECT_OFF: starts switched off */
    bool map;                    /* GLSSAO_INJECT_MAP: shows accessibility alone */
    bool verbose;                /* GLSSAO_INJECT_VERBOSE */
    /* GLSSAO_INJECT_PICTURE and GLSSAO_INJECT_BEFORE: FILE.ppm, frame GLSSAO_INJECT_FRAME (100, counted from 1) as it
     * is shown and as the program drew it; the program then ends. */
    const char *picture, *before;
    int picture_frame;
} inject_options;

const inject_options *inject_get_options(void);
void inject_say(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* ---- matrices.c ---- */

/* A perspective projection, column-major, if `m` is one, or is one times a view or model-view matrix that rotates,
 * moves and scales alike in all directions. Then *out_projection is that projection alone. */
bool inject_perspective_of(const float m[16], float out_projection[16]);

/* Counts a matrix that the program set while it drew into `framebuffer` (0: the window). */
void inject_note_matrix(const float m[16], unsigned framebuffer);
/* The projection that most matrices of the frame, set for that framebuffer, were made with; false where there was none.
 * For the window that of an earlier frame is good too, as long as no framebuffer has one in this frame. */
bool inject_get_projection(unsigned framebuffer, float out_projection[16]);
/* Forgets the frame's matrices. */
void inject_end_frame(void);

/* ---- lookup.c ---- */

/* The OpenGL, GLX or EGL function itself, never one of the hooks; NULL where there is none. A glssao_load_fn. */
void *inject_real(const char *name, void *user);
/* libc's, never the hook. */
void *inject_real_dlsym(void *handle, const char *name);
/* What the program is given for a name whose real function is at `real`: the hook, if there is one. */
void *inject_hooked(const char *name, void *real);

/* ---- frame.c ---- */

/* Before the buffers of the current context, told apart by `context`, are swapped. */
void inject_swap(void *context, int width, int height);
/* Before the colours of a framebuffer of the program's own are blitted somewhere from its whole area. */
void inject_blit(void *context, unsigned framebuffer, int width, int height);

#endif
