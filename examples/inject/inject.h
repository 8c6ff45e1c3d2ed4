/* SPDX-License-Identifier: MIT
 *
 * glssao-inject is a library to preload (LD_PRELOAD) into an OpenGL program that knows nothing of glssao. This header
 * is what its files share.
 *
 *   lookup.c            finds the real functions behind the hooks
 *   hooks*.c            the functions that the program calls instead: each does what was asked and reports an event
 *   scenes.c            decides from these events when the effect is due, and in which framebuffer
 *   seen.c, matrices.c  keep the projections that the program sets; recognise a projection by its structure
 *   contexts.c          one effect for each context of the program
 *   frame.c             draws the effect, with a radius from radius.c
 *   picture.c, options.c  pictures for tests; the environment, the clock and the messages
 */
#pragma once

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
     * is shown, and before the effect is drawn at the swap; the program then ends. */
    const char *picture, *before;
    int picture_frame;
} inject_options;

const inject_options *inject_get_options(void);
/* A line on stderr, numbers with a decimal point. */
void inject_say(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Between these, this thread reads and writes numbers with a decimal point, whatever the program's locale. */
typedef struct inject_locale {
    void *handle;
} inject_locale;
inject_locale inject_use_plain_locale(void);
void inject_restore_locale(inject_locale before);

/* ---- clock.c ---- */

/* Seconds since some moment; never runs backwards. */
double inject_seconds(void);

/* ---- matrices.c, seen.c ---- */

/* A framebuffer (0: the window) of a context. */
typedef struct inject_place {
    void *context;
    unsigned framebuffer;
} inject_place;

typedef struct inject_projection {
    float matrix[16]; /* column-major */
    bool zero_to_one; /* glClipControl */
} inject_projection;

/* A perspective projection, if `m`, column-major, is one, or is one times a view or model-view matrix that rotates,
 * moves and scales alike in all directions. Then *out_matrix is that projection alone. Reversed depth is fine. */
bool inject_perspective_of(const float m[16], bool zero_to_one, float out_matrix[16]);
/* The same for orthographic projections, whose size and depth follow from the product, but not their centre. Flat ones
 * and those with y downwards are an interface's and are refused. */
bool inject_orthographic_of(const float m[16], bool zero_to_one, float out_matrix[16]);

/* Counts a matrix that the program set while it drew there. */
void inject_note_matrix(const float m[16], inject_place place);
/* Counts every matrix in the contents of a uniform buffer, `size` bytes, for every place. */
void inject_note_buffer(const void *data, size_t size);
/* The convention of the matrices to come. */
void inject_note_clip_control(bool zero_to_one);
/* Depth was written there under the matrix noted last; `weight` says how much. */
void inject_note_draw(inject_place place, float weight);
/* The projection of this frame under which most depth was written there, or, where no draw was seen, that most
 * matrices were made with. Perspective goes before orthographic. False where there was none. A window keeps the
 * projection of an earlier frame while its context has none elsewhere; an orthographic one replaces a perspective one
 * only after 60 frames or a second without perspective. */
bool inject_get_projection(inject_place place, inject_projection *out);
/* Forgets the frame's matrices for every context, but keeps what windows keep. */
void inject_end_frame(void);
/* Forgets what a context kept: another one may get its address. */
void inject_forget_projections(void *context);

/* ---- lookup.c ---- */

/* The OpenGL, GLX or EGL function itself, never one of the hooks; NULL where there is none. A glssao_load_fn. */
void *inject_real(const char *name, void *user);
/* libc's, never the hook. */
void *inject_real_dlsym(void *handle, const char *name);
/* The function that the program gets for a name: the hook if there is one, else `real`. */
void *inject_hooked(const char *name, void *real);

/* A local pointer to a function of OpenGL's, without "gl"; looked up once, for looking up takes microseconds. */
#define INJECT_REAL(type, name)                                                                                        \
    static void *name##_address;                                                                                       \
    type name;                                                                                                         \
    do {                                                                                                               \
        if (!name##_address)                                                                                           \
            name##_address = inject_real("gl" #name, NULL);                                                            \
        memcpy(&name, &name##_address, sizeof name##_address);                                                         \
    } while (0)

/* ---- radius.c ---- */

/* A twelfth of the height in view at the median distance of the visible surfaces; 0 if there are none. */
float inject_fitting_radius(unsigned depth_texture, int width, int height, const inject_projection *projection);

/* ---- picture.c ---- */

/* The window's back buffer as a PPM. Does not restore state: the program ends afterwards. */
bool inject_write_picture(const char *path, int width, int height);

/* ---- scenes.c: events, in the context that is current ---- */

/* `count` vertices are about to be drawn, 0: an unknown number. */
void inject_before_draw(void *context, int count);
/* A clear of a framebuffer is about to happen. */
void inject_before_clear(inject_place place, bool color, bool depth);
/* Another draw framebuffer is about to be bound. */
void inject_before_bind(inject_place left, unsigned next);
/* The colours of a framebuffer are about to be blitted somewhere from its whole area. */
void inject_before_blit(inject_place place, int width, int height);
/* The program is about to read pixels of a framebuffer back. */
void inject_before_read(inject_place place);
/* Another context, or none, is about to become current in place of this one. */
void inject_before_switch(void *context);
/* A context is about to be destroyed; `is_current`: it is current on this thread. */
void inject_before_destroy(void *context, bool is_current);
/* The buffers of the context are about to be swapped. */
void inject_before_swap(void *context, int width, int height);

/* ---- contexts.c ---- */

struct glssao_effect;

typedef struct inject_context {
    struct inject_context *next;
    void *context;
    bool is_embedded; /* OpenGL ES */
    bool given_up;    /* no effect can be made, which was said */
    struct glssao_effect *effect;
    int width, height; /* of the effect */
    int frame;         /* swaps so far */
    double first;      /* seconds, of the first swap */
    bool is_drawn;     /* the effect, in this frame, in drawn_framebuffer */
    unsigned drawn_framebuffer;
    double largest; /* viewport, in pixels, that was drawn with lately */
    /* The frame and the time of the last search for a radius, and its result; 0: nothing found yet. */
    int radius_frame;
    double radius_time;
    float radius;
    /* The last "on:" line (empty: none, or no longer true), its time, and when the effect was drawn last. */
    char said[160];
    double said_time, drawn_time;
    int drawn_frame;
} inject_context;

/* The current context's own, made when it is first asked for. NULL where memory has run out. */
inject_context *inject_context_of(void *context);
/* The next one after `c`, the first after NULL; NULL at the end. */
inject_context *inject_next_context(inject_context *c);
/* Makes an effect; false on failure. */
bool inject_prepare_context(inject_context *c, int width, int height);
/* The context is about to be destroyed; `is_current`: on this thread, so that its objects can be deleted. */
void inject_forget_context(void *context, bool is_current);

/* ---- frame.c ---- */

/* Draws the effect into that framebuffer, `width` by `height` from its lower left corner; false where it did not. */
bool inject_draw_effect(inject_context *c, unsigned framebuffer, int width, int height);
/* A frame of that context ends. */
void inject_end_of_frame(inject_context *c, bool has_effect);
/* Says a line, but each one once. */
void inject_say_once(const char *reason);
