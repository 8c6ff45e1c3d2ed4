/* SPDX-License-Identifier: MIT
 *
 * Contexts of OSMesa, Mesa's own offscreen interface. It needs no EGL and no device. Mesa dropped it in 25.1, so the
 * library is opened at run time, and the few functions that are used are declared here.
 */
#include "backend.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

/* Values of GL/osmesa.h. */
enum {
    OSMESA_FORMAT = 0x22,
    OSMESA_RGBA = 0x1908,
    OSMESA_UNSIGNED_BYTE = 0x1401,
    OSMESA_PROFILE = 0x33,
    OSMESA_CORE_PROFILE = 0x34,
    OSMESA_COMPAT_PROFILE = 0x35,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37
};

typedef struct osmesa_context {
    context base;
    void *(*create)(const int *attributes, void *share);
    void (*destroy)(void *handle);
    unsigned char (*make_current)(void *handle, void *buffer, unsigned type, int width, int height);
    void *(*get_proc_address)(const char *name);
    void *handle;
    unsigned char
        buffer[4]; /* OSMesa needs a picture to make a context current: one pixel. Drawing goes to framebuffers */
} osmesa_context;

static bool make_current(context *c)
{
    osmesa_context *o = (osmesa_context *)c;
    return o->make_current(o->handle, o->buffer, OSMESA_UNSIGNED_BYTE, 1, 1);
}

static void release(context *c)
{
    osmesa_context *o = (osmesa_context *)c;
    o->make_current(NULL, NULL, 0, 0, 0);
}

static void *load(context *c, const char *name)
{
    return ((osmesa_context *)c)->get_proc_address(name);
}

static void destroy(context *c)
{
    osmesa_context *o = (osmesa_context *)c;
    if (o->handle)
        o->destroy(o->handle);
    free(o);
}

/* The library is never closed: Mesa leaves thread-local data and exit handlers that point into it. */
static void *open_library(void)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        void *library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
        if (library)
            return library;
    }
    return NULL;
}

context *context__osmesa_create(const context_options *options, char *error, size_t error_size)
{
    void *library = open_library();
    if (!library) {
        snprintf(error, error_size, "libOSMesa.so.8 is not installed");
        return NULL;
    }
    osmesa_context *o = calloc(1, sizeof *o);
    if (!o) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    o->base = (context){.make_current = make_current, .release = release, .load = load, .destroy = destroy};
    if (!context__symbol(library, "OSMesaCreateContextAttribs", &o->create) ||
        !context__symbol(library, "OSMesaDestroyContext", &o->destroy) ||
        !context__symbol(library, "OSMesaMakeCurrent", &o->make_current) ||
        !context__symbol(library, "OSMesaGetProcAddress", &o->get_proc_address)) {
        snprintf(error, error_size, "libOSMesa is too old: no core profiles");
        free(o);
        return NULL;
    }

    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              options->compatibility ? OSMESA_COMPAT_PROFILE : OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              options->major,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              options->minor,
                              0,
                              0};
    const osmesa_context *share = (const osmesa_context *)options->share;
    const bool alike = !share || share->base.make_current == make_current;
    o->handle = alike ? o->create(attributes, share ? share->handle : NULL) : NULL;
    if (!alike)
        snprintf(error, error_size, "the context to share with is not OSMesa's");
    else if (!o->handle)
        snprintf(error, error_size, "OSMesaCreateContextAttribs refuses this version");
    else if (!make_current(&o->base))
        snprintf(error, error_size, "OSMesaMakeCurrent failed");
    else if (context__describe(&o->base, "OSMesa", options, error, error_size))
        return &o->base;
    else
        release(&o->base);
    destroy(&o->base);
    return NULL;
}
