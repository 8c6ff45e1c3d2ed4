/* SPDX-License-Identifier: MIT
 *
 * Tries the ways to get an offscreen context. It also keeps two rules that no backend can keep alone: only one context
 * is current on a thread, whatever its kind, and the message of a failure names every way that was tried.
 */
#include "backend.h"

#include <GL/glcorearb.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The context that is current on this thread. EGL and OSMesa know only their own contexts, but in Mesa both use one
 * dispatch table for each thread (libglapi). So one kind must be released before the other is made current. */
static _Thread_local context *current;

typedef enum context_way { WAY_HARDWARE, WAY_SURFACELESS, WAY_OSMESA, WAY_SOFTWARE, WAY_COUNT } context_way;

static const char *const way_names[WAY_COUNT] = {
    [WAY_HARDWARE] = "EGL hardware device",
    [WAY_SURFACELESS] = "EGL surfaceless",
    [WAY_OSMESA] = "OSMesa",
    [WAY_SOFTWARE] = "EGL software device",
};

static context *try_way(context_way w, const context_options *options, char *error, size_t error_size)
{
    switch (w) {
    case WAY_HARDWARE:
        return context__egl_create(EGL_WAY_HARDWARE_DEVICE, options, error, error_size);
    case WAY_SURFACELESS:
        return context__egl_create(EGL_WAY_SURFACELESS, options, error, error_size);
    case WAY_SOFTWARE:
        return context__egl_create(EGL_WAY_SOFTWARE_DEVICE, options, error, error_size);
    default:
        return context__osmesa_create(options, error, error_size);
    }
}

static void release_current(void)
{
    if (current)
        current->release(current);
    current = NULL;
}

context *context_create(const context_options *options, char *error, size_t error_size)
{
    context_options wanted = *options;
    if (wanted.major == 0 && wanted.minor == 0) {
        wanted.major = 3;
        wanted.minor = 3;
    }

    char reasons[WAY_COUNT][256];
    bool tried[WAY_COUNT] = {false};
    for (int w = 0; w < WAY_COUNT; w++) {
        if ((wanted.kind == CONTEXT_EGL && w == WAY_OSMESA) || (wanted.kind == CONTEXT_OSMESA && w != WAY_OSMESA))
            continue;
        release_current();
        tried[w] = true;
        context *c = try_way((context_way)w, &wanted, reasons[w], sizeof reasons[w]);
        if (c) {
            current = c;
            return c;
        }
    }

    if (error_size == 0)
        return NULL;
    int length = snprintf(error, error_size, "no OpenGL %d.%d %s context:", wanted.major, wanted.minor,
                          wanted.compatibility ? "compatibility" : "core");
    const char *separator = "";
    for (int w = 0; w < WAY_COUNT; w++) {
        if (tried[w] && length >= 0 && (size_t)length < error_size) {
            length +=
                snprintf(error + length, error_size - (size_t)length, "%s %s: %s", separator, way_names[w], reasons[w]);
            separator = ";";
        }
    }
    return NULL;
}

void context_destroy(context *c)
{
    if (!c)
        return;
    if (current == c)
        release_current();
    c->destroy(c);
}

bool context_make_current(context *c)
{
    if (current == c)
        return true;
    if (current && current->make_current != c->make_current)
        release_current();
    if (!c->make_current(c))
        return false;
    current = c;
    return true;
}

const char *context_description(const context *c)
{
    return c->description;
}

bool context_is_software(const context *c)
{
    return c->software;
}

void *context_load(const char *name, void *user)
{
    context *c = user;
    return c->load(c, name);
}

static bool renderer_is_software(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader", "SWR"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strstr(renderer, names[i]))
            return true;
    return false;
}

bool context__describe(context *c, const char *way, const context_options *options, char *error, size_t error_size)
{
    void *address = c->load(c, "glGetString");
    if (!address) {
        snprintf(error, error_size, "it has no function glGetString");
        return false;
    }
    PFNGLGETSTRINGPROC get_string;
    memcpy(&get_string, &address, sizeof address);
    const char *renderer = (const char *)get_string(GL_RENDERER);
    const char *version = (const char *)get_string(GL_VERSION);
    if (!renderer || !version) {
        snprintf(error, error_size, "glGetString returns no renderer or version");
        return false;
    }
    int major = 0, minor = 0;
    if (sscanf(version, "%d.%d", &major, &minor) != 2 || major < options->major ||
        (major == options->major && minor < options->minor)) {
        snprintf(error, error_size, "%s only supports OpenGL %s", renderer, version);
        return false;
    }
    c->software = renderer_is_software(renderer);
    snprintf(c->description, sizeof c->description, "%s: %s, OpenGL %s", way, renderer, version);
    return true;
}

bool context__symbol(void *library, const char *name, void *out_function)
{
    void *address = dlsym(library, name);
    memcpy(out_function, &address, sizeof address);
    return address != NULL;
}
