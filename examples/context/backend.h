/* SPDX-License-Identifier: MIT
 *
 * What context.c and the ways to get a context (egl.c, osmesa.c) share; nobody else includes it.
 */
#ifndef GLSSAO_EXAMPLES_CONTEXT_BACKEND_H
#define GLSSAO_EXAMPLES_CONTEXT_BACKEND_H

#include "context.h"

/* The head of egl_context and osmesa_context. */
struct context {
    bool (*make_current)(context *c);
    void (*release)(context *c); /* leaves nothing of its kind current on this thread */
    void *(*load)(context *c, const char *name);
    void (*destroy)(context *c); /* not current on any thread any more */
    char description[256];
    bool software;
};

typedef enum egl_way { EGL_WAY_HARDWARE_DEVICE, EGL_WAY_SURFACELESS, EGL_WAY_SOFTWARE_DEVICE } egl_way;

/* Each makes a context and leaves it current on this thread; NULL with the reason in `error` on failure. */
context *context__egl_create(egl_way way, const context_options *options, char *error, size_t error_size);
context *context__osmesa_create(const context_options *options, char *error, size_t error_size);

/* Fills description and software from the current context. False, with the reason, if it is older than asked for. */
bool context__describe(context *c, const char *way, const context_options *options, char *error, size_t error_size);

/* ISO C has no cast from an object pointer to a function pointer; POSIX promises that the bytes agree. False, and
 * *out_function set to NULL, where the library has no such symbol. */
bool context__symbol(void *library, const char *name, void *out_function);

#endif
