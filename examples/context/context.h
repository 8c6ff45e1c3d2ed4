/* SPDX-License-Identifier: MIT
 *
 * Offscreen OpenGL contexts for machines without a display: EGL's device platform, EGL surfaceless (Mesa) and OSMesa
 * behind one interface. No window system is involved. Libraries are opened at run time, so that a machine can lack some
 * of them.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct context context;

typedef enum context_kind {
    CONTEXT_AUTO = 0, /* a hardware EGL device first, then EGL surfaceless, OSMesa, a software EGL device */
    CONTEXT_EGL,      /* a hardware EGL device first, then surfaceless, then a software EGL device */
    CONTEXT_OSMESA
} context_kind;

typedef struct context_options {
    context_kind kind;
    int major, minor;   /* requested version; 0, 0 means 3.3 */
    bool compatibility; /* false: core profile */
    context *share;     /* share textures, buffers and programs with this context; NULL: share nothing */
} context_options;

/* Makes a context and makes it current on this thread. NULL on failure, with one line in `error` that names each way
 * that was tried and why it failed. */
context *context_create(const context_options *options, char *error, size_t error_size);

/* Releases and deletes a context that is not current on another thread. NULL is allowed. */
void context_destroy(context *c);

/* Makes it current on the calling thread and replaces any other context of this interface. It must not be current on
 * another thread. */
bool context_make_current(context *c);

/* A description for people: "EGL surfaceless: llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa ...". */
const char *context_description(const context *c);

/* True for a software rasteriser (llvmpipe, softpipe, swrast, SwiftShader). */
bool context_is_software(const context *c);

/* A glssao_load_fn; `user` is the context. */
void *context_load(const char *name, void *user);
