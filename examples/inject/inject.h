/* SPDX-License-Identifier: MIT
 *
 * glssao-inject, a library to preload (LD_PRELOAD) into an OpenGL program that knows nothing of glssao: what its files
 * share. lookup.c, hooks.c (swaps) and hooks_matrices.c stand between the program and OpenGL, matrices.c tells a
 * projection by its structure, seen.c keeps those that go by, frame.c draws the effect before the buffers are swapped
 * with a radius from radius.c, picture.c writes files, options.c reads the environment.
 */
#ifndef GLSSAO_INJECT_H
#define GLSSAO_INJECT_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* ---- options.c: the environment, read once ---- */

typedef struct inject_options {
    float fov;                   /* GLSSAO_INJECT_FOV: vertical, degrees; 0: found among the matrices */
    float near_plane, far_plane; /* GLSSAO_INJECT_NEAR, _FAR, scene units */
    float radius;                /* GLSSAO_INJECT_RADIUS, scene units; 0: a share of what is seen */
    float power;                 /* GLSSAO_INJECT_POWER */
    int quality;                 /* GLSSAO_INJECT_QUALITY: low, medium, high, ultra */
    bool off;                    /* GLSSAO_INJECT_OFF: starts switched off */
    bool map;                    /* GLSSAO_INJECT_MAP: shows accessibility alone */
    /* GLSSAO_INJECT_PICTURE and GLSSAO_INJECT_BEFORE: FILE.ppm, frame GLSSAO_INJECT_FRAME (100, counted from 1) as it
     * is shown and as the program drew it; the program then ends. */
    const char *picture, *before;
    int picture_frame;
} inject_options;

const inject_options *inject_get_options(void);
void inject_say(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* ---- matrices.c, seen.c ---- */

typedef struct inject_projection {
    float matrix[16]; /* column-major */
    bool zero_to_one; /* glClipControl */
} inject_projection;

/* A perspective projection, if `m`, column-major, is one, or is one times a view or model-view matrix that rotates,
 * moves and scales alike in all directions. Then *out_matrix is that projection alone. Either way round in depth. */
bool inject_perspective_of(const float m[16], bool zero_to_one, float out_matrix[16]);
/* The same for orthographic projections, of which size and depth alone can be told, not where they are centred; flat
 * ones, and those with y downwards, are taken for an interface's and refused. */
bool inject_orthographic_of(const float m[16], bool zero_to_one, float out_matrix[16]);

#define INJECT_ANY_FRAMEBUFFER (~0u)
/* Counts a matrix that the program set while it drew into `framebuffer` (0: the window). */
void inject_note_matrix(const float m[16], unsigned framebuffer);
/* The same for every matrix in the contents of a uniform buffer, `size` bytes. */
void inject_note_buffer(const void *data, size_t size);
/* The convention of the matrices to come. */
void inject_note_clip_control(bool zero_to_one);
/* The perspective projection, or where there is none the orthographic one, that most matrices of the frame, set for
 * that framebuffer, were made with; false where there was none. For the window that of an earlier frame is good too,
 * as long as no framebuffer has one in this frame; an orthographic one takes over only when no perspective one was
 * seen for a second or so. */
bool inject_get_projection(unsigned framebuffer, inject_projection *out);
/* Forgets the frame's matrices. */
void inject_end_frame(void);

/* ---- lookup.c ---- */

/* The OpenGL, GLX or EGL function itself, never one of the hooks; NULL where there is none. A glssao_load_fn. */
void *inject_real(const char *name, void *user);
/* libc's, never the hook. */
void *inject_real_dlsym(void *handle, const char *name);
/* What the program is given for a name whose real function is at `real`: the hook, if there is one. */
void *inject_hooked(const char *name, void *real);

/* A local pointer to a function of OpenGL's, without "gl". */
#define INJECT_REAL(type, name)                                                                                        \
    type name;                                                                                                         \
    do {                                                                                                               \
        void *address_ = inject_real("gl" #name, NULL);                                                                \
        memcpy(&name, &address_, sizeof address_);                                                                     \
    } while (0)

/* ---- radius.c ---- */

/* A twelfth of the height that is in view at the median distance of what is seen; 0 where nothing is. */
float inject_fitting_radius(unsigned depth_texture, int width, int height, const inject_projection *projection);

/* ---- picture.c ---- */

/* The window's back buffer as a PPM. What it sets stays set: the program ends after it. */
bool inject_write_picture(const char *path, int width, int height);
void inject_clear_to_white(unsigned framebuffer);

/* ---- frame.c ---- */

/* Before the buffers of the current context, told apart by `context`, are swapped. */
void inject_swap(void *context, int width, int height);
/* Before the colours of a framebuffer of the program's own are blitted somewhere from its whole area. */
void inject_blit(void *context, unsigned framebuffer, int width, int height);

#endif
