/* SPDX-License-Identifier: MIT
 *
 * Shared by context.c and the two backends, egl.c and osmesa.c.
 */
#pragma once

#include "context.h"

/* The first member of egl_context and osmesa_context. */
struct context {
    bool (*make_current)(context *c);
    void (*release)(context *c); /* makes no context of this kind current on this thread */
    void *(*load)(context *c, const char *name);
    void (*destroy)(context *c); /* it is not current on any thread */
    char description[256];
    bool software;
};

typedef enum egl_way { EGL_WAY_HARDWARE_DEVICE, EGL_WAY_SURFACELESS, EGL_WAY_SOFTWARE_DEVICE } egl_way;

/* Each makes a context and leaves it current on this thread. NULL, with the reason in `error`, on failure. */
context *context__egl_create(egl_way way, const context_options *options, char *error, size_t error_size);
context *context__osmesa_create(const context_options *options, char *error, size_t error_size);

/* Fills description and software from the current context. False, with the reason, if its version is too old. */
bool context__describe(context *c, const char *way, const context_options *options, char *error, size_t error_size);

/* Copies the address of a symbol: ISO C has no cast from an object pointer to a function pointer, but POSIX guarantees
 * the same representation. False, and *out_function is NULL, if the library has no such symbol. */
bool context__symbol(void *library, const char *name, void *out_function);
