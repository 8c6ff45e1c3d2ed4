/* SPDX-License-Identifier: MIT
 *
 * EGL contexts without a window system, on a device of EGL's device platform or on Mesa's surfaceless platform.
 *
 * The library is never closed and a display is never terminated. All contexts on one device share one display. EGL does
 * not count its users, so terminating it would end other contexts. Drivers also leave thread-local data and exit
 * handlers that point into their libraries.
 */
#define EGL_NO_X11 /* eglplatform.h: no X11 headers */
#define MESA_EGL_NO_X11_HEADERS
#include "backend.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* X(type suffix of PFNEGL...PROC, name without egl): functions that every EGL 1.4 exports. */
#define EGL_FUNCTIONS(X)                                                                                               \
    X(BINDAPI, BindAPI)                                                                                                \
    X(CHOOSECONFIG, ChooseConfig)                                                                                      \
    X(CREATECONTEXT, CreateContext)                                                                                    \
    X(CREATEPBUFFERSURFACE, CreatePbufferSurface)                                                                      \
    X(DESTROYCONTEXT, DestroyContext)                                                                                  \
    X(DESTROYSURFACE, DestroySurface)                                                                                  \
    X(GETERROR, GetError)                                                                                              \
    X(GETPROCADDRESS, GetProcAddress)                                                                                  \
    X(INITIALIZE, Initialize)                                                                                          \
    X(MAKECURRENT, MakeCurrent)                                                                                        \
    X(QUERYSTRING, QueryString)

struct egl_functions {
#define EGL_MEMBER(type, name) PFNEGL##type##PROC name;
    EGL_FUNCTIONS(EGL_MEMBER)
#undef EGL_MEMBER
};

typedef struct egl_context {
    context base;
    struct egl_functions egl;
    EGLDisplay display;
    EGLContext handle;
    EGLSurface surface; /* EGL_NO_SURFACE if contexts can be current without a surface */
    void *gl_library;   /* has the core functions if eglGetProcAddress only finds extensions; else NULL */
} egl_context;

enum { MAX_DEVICES = 64 };

static bool has_extension(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
            return true;
    return false;
}

static const char *error_name(EGLint code)
{
    switch (code) {
    case EGL_SUCCESS:
        return "no error reported";
    case EGL_NOT_INITIALIZED:
        return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
        return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
        return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
        return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
        return "EGL_BAD_CONFIG";
    case EGL_BAD_MATCH:
        return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
        return "EGL_BAD_PARAMETER";
    default:
        return "another EGL error";
    }
}

static bool make_current(context *c)
{
    egl_context *e = (egl_context *)c;
    return e->egl.BindAPI(EGL_OPENGL_API) && e->egl.MakeCurrent(e->display, e->surface, e->surface, e->handle);
}

static void release(context *c)
{
    egl_context *e = (egl_context *)c;
    e->egl.BindAPI(EGL_OPENGL_API); /* chooses, for this thread, the API whose context is released */
    e->egl.MakeCurrent(e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

static void *load(context *c, const char *name)
{
    egl_context *e = (egl_context *)c;
    void *address = e->gl_library ? dlsym(e->gl_library, name) : NULL;
    if (!address) {
        __eglMustCastToProperFunctionPointerType function = e->egl.GetProcAddress(name);
        memcpy(&address, &function, sizeof address);
    }
    return address;
}

static void destroy(context *c)
{
    egl_context *e = (egl_context *)c;
    if (e->surface != EGL_NO_SURFACE)
        e->egl.DestroySurface(e->display, e->surface);
    if (e->handle != EGL_NO_CONTEXT)
        e->egl.DestroyContext(e->display, e->handle);
    free(e);
}

static bool open_library(struct egl_functions *egl, char *error, size_t error_size)
{
    void *library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        snprintf(error, error_size, "libEGL.so.1 is not installed");
        return false;
    }
#define EGL_LOAD(type, name)                                                                                           \
    if (!context__symbol(library, "egl" #name, &egl->name)) {                                                          \
        snprintf(error, error_size, "libEGL.so.1 has no function egl" #name);                                          \
        return false;                                                                                                  \
    }
    EGL_FUNCTIONS(EGL_LOAD)
#undef EGL_LOAD
    return true;
}

/* False, with the reason, if EGL cannot ask for contexts of that version and profile. */
static bool create_context(egl_context *e, bool egl_1_5, const char *extensions, const context_options *options,
                           char *error, size_t error_size)
{
    if (!egl_1_5 && !has_extension(extensions, "EGL_KHR_create_context")) {
        snprintf(error, error_size, "neither EGL 1.5 nor EGL_KHR_create_context");
        return false;
    }
    if (!e->egl.BindAPI(EGL_OPENGL_API)) {
        snprintf(error, error_size, "no desktop OpenGL (%s)", error_name(e->egl.GetError()));
        return false;
    }
    /* Asks for pbuffers: these platforms have no windows, which are the default. */
    const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                        EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    if (!e->egl.ChooseConfig(e->display, config_attributes, &config, 1, &count) || count < 1) {
        snprintf(error, error_size, "no EGL config for OpenGL");
        return false;
    }
    const EGLint profile =
        options->compatibility ? EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT : EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT;
    const EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         options->major,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         options->minor,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         profile,
                                         EGL_NONE};
    const egl_context *share = (const egl_context *)options->share;
    if (share && (share->base.make_current != make_current || share->display != e->display)) {
        snprintf(error, error_size, "the context to share with is of another display");
        return false;
    }
    e->handle = e->egl.CreateContext(e->display, config, share ? share->handle : EGL_NO_CONTEXT, context_attributes);
    if (e->handle == EGL_NO_CONTEXT) {
        snprintf(error, error_size, "eglCreateContext failed (%s)", error_name(e->egl.GetError()));
        return false;
    }
    if (!has_extension(extensions, "EGL_KHR_surfaceless_context")) {
        const EGLint pbuffer_attributes[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        e->surface = e->egl.CreatePbufferSurface(e->display, config, pbuffer_attributes);
        if (e->surface == EGL_NO_SURFACE) {
            snprintf(error, error_size, "eglCreatePbufferSurface failed (%s)", error_name(e->egl.GetError()));
            return false;
        }
    }
    return true;
}

/* Makes a context of that display current. NULL on failure. */
static context *create_on_display(const struct egl_functions *egl, EGLDisplay display, const char *way,
                                  const context_options *options, char *error, size_t error_size)
{
    EGLint major = 0, minor = 0;
    if (display == EGL_NO_DISPLAY || !egl->Initialize(display, &major, &minor)) {
        snprintf(error, error_size, "it can't be initialised (%s)", error_name(egl->GetError()));
        return NULL;
    }
    egl_context *e = calloc(1, sizeof *e);
    if (!e) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    *e = (egl_context){
        .base = {.make_current = make_current, .release = release, .load = load, .destroy = destroy},
        .egl = *egl,
        .display = display,
        .handle = EGL_NO_CONTEXT,
        .surface = EGL_NO_SURFACE,
    };
    const bool egl_1_5 = major > 1 || minor >= 5;
    const char *extensions = egl->QueryString(display, EGL_EXTENSIONS);
    if (!create_context(e, egl_1_5, extensions, options, error, error_size)) {
        destroy(&e->base);
        return NULL;
    }
    if (!egl_1_5 && !has_extension(extensions, "EGL_KHR_get_all_proc_addresses") &&
        !has_extension(egl->QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_KHR_client_get_all_proc_addresses")) {
        e->gl_library = dlopen("libOpenGL.so.0", RTLD_NOW | RTLD_LOCAL);
        if (!e->gl_library)
            e->gl_library = dlopen("libGL.so.1", RTLD_NOW | RTLD_LOCAL);
    }
    if (!make_current(&e->base))
        snprintf(error, error_size, "eglMakeCurrent failed (%s)", error_name(egl->GetError()));
    else if (context__describe(&e->base, way, options, error, error_size))
        return &e->base;
    else
        release(&e->base);
    destroy(&e->base);
    return NULL;
}

/* Returns a context of the first device of the wanted kind that gives one. */
static context *create_on_device(const struct egl_functions *egl, PFNEGLGETPLATFORMDISPLAYEXTPROC get_display,
                                 bool software, const context_options *options, char *error, size_t error_size)
{
    PFNEGLQUERYDEVICESEXTPROC query_devices = (PFNEGLQUERYDEVICESEXTPROC)egl->GetProcAddress("eglQueryDevicesEXT");
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string =
        (PFNEGLQUERYDEVICESTRINGEXTPROC)egl->GetProcAddress("eglQueryDeviceStringEXT");
    EGLDeviceEXT devices[MAX_DEVICES];
    EGLint count = 0;
    if (!query_devices || !query_device_string || !query_devices(MAX_DEVICES, devices, &count)) {
        snprintf(error, error_size, "devices can't be listed");
        return NULL;
    }
    snprintf(error, error_size, "none of the devices that EGL lists (%d) is one", (int)count);
    for (EGLint i = 0; i < count; i++) {
        if (has_extension(query_device_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software") != software)
            continue;
        EGLDisplay display = get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL);
        context *c = create_on_display(egl, display, "EGL device", options, error, error_size);
        if (c && !software && c->software) {
            snprintf(error, error_size, "it renders in software (%s)", c->description);
            release(c);
            destroy(c);
            c = NULL;
        }
        if (c)
            return c;
    }
    return NULL;
}

context *context__egl_create(egl_way way, const context_options *options, char *error, size_t error_size)
{
    struct egl_functions egl;
    if (!open_library(&egl, error, error_size))
        return NULL;
    /* NULL before EGL 1.5 without EGL_EXT_client_extensions. */
    const char *extensions = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display = NULL;
    if (has_extension(extensions, "EGL_EXT_platform_base"))
        get_display = (PFNEGLGETPLATFORMDISPLAYEXTPROC)egl.GetProcAddress("eglGetPlatformDisplayEXT");
    if (!get_display) {
        egl.GetError(); /* clears an error that the query may have left */
        snprintf(error, error_size, "libEGL has no EGL_EXT_platform_base");
        return NULL;
    }
    if (way == EGL_WAY_SURFACELESS) {
        if (!has_extension(extensions, "EGL_MESA_platform_surfaceless")) {
            snprintf(error, error_size, "libEGL has no EGL_MESA_platform_surfaceless");
            return NULL;
        }
        EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
        return create_on_display(&egl, display, "EGL surfaceless", options, error, error_size);
    }
    if (!has_extension(extensions, "EGL_EXT_platform_device")) {
        snprintf(error, error_size, "libEGL has no EGL_EXT_platform_device");
        return NULL;
    }
    return create_on_device(&egl, get_display, way == EGL_WAY_SOFTWARE_DEVICE, options, error, error_size);
}
