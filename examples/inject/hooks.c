/* SPDX-License-Identifier: MIT
 *
 * The functions that a program calls here instead of in libGL, libEGL and, to look those up, in libc: lookups and
 * swaps. Each reports its event and calls the real function. lookup.c lists the names of all hooks.
 */
#include "hooks.h"

#define GLX_WIDTH 0x801D
#define GLX_HEIGHT 0x801E
#define EGL_WIDTH 0x3057
#define EGL_HEIGHT 0x3056

typedef void (*function)(void);

_Thread_local hooks_thread hooks_this_thread;

HOOK void *dlsym(void *restrict handle, const char *restrict name);
HOOK function glXGetProcAddress(const unsigned char *name);
HOOK function glXGetProcAddressARB(const unsigned char *name);
HOOK function eglGetProcAddress(const char *name);
HOOK void glXSwapBuffers(void *display, unsigned long drawable);
HOOK unsigned eglSwapBuffers(void *display, void *surface);
HOOK unsigned eglSwapBuffersWithDamageEXT(void *display, void *surface, const int *rectangles, int count);
HOOK unsigned eglSwapBuffersWithDamageKHR(void *display, void *surface, const int *rectangles, int count);

/* ---- what all hooks share ---- */

bool hooks_enter(void)
{
    hooks_thread *const t = &hooks_this_thread;
    return ++t->calls == 1 && !t->in_primitive && !t->in_list;
}

void hooks_leave(void)
{
    --hooks_this_thread.calls;
}

void *hooks_context(void)
{
    typedef void *(*current_fn)(void);
    REAL(current_fn, glXGetCurrentContext);
    REAL(current_fn, eglGetCurrentContext);
    void *context = glXGetCurrentContext_real ? glXGetCurrentContext_real() : NULL;
    return context || !eglGetCurrentContext_real ? context : eglGetCurrentContext_real();
}

unsigned hooks_framebuffer(GLenum binding)
{
    REAL(PFNGLGETINTEGERVPROC, glGetIntegerv);
    GLint framebuffer = 0;
    if (glGetIntegerv_real)
        glGetIntegerv_real(binding, &framebuffer);
    return (unsigned)framebuffer;
}

inject_place hooks_place(GLenum binding)
{
    return (inject_place){hooks_context(), hooks_framebuffer(binding)};
}

/* ---- looking functions up ---- */

void *dlsym(void *restrict handle, const char *restrict name)
{
    return inject_hooked(name, inject_real_dlsym(handle, name));
}

static function lookup_through(const char *lookup, const char *name)
{
    void *address = inject_real(lookup, NULL);
    if (!address)
        return NULL;
    function (*get)(const char *);
    memcpy(&get, &address, sizeof address);
    function found = get(name);
    memcpy(&address, &found, sizeof found);
    address = inject_hooked(name, address);
    memcpy(&found, &address, sizeof found);
    return found;
}

function glXGetProcAddress(const unsigned char *name)
{
    return lookup_through("glXGetProcAddress", (const char *)name);
}

function glXGetProcAddressARB(const unsigned char *name)
{
    return lookup_through("glXGetProcAddressARB", (const char *)name);
}

function eglGetProcAddress(const char *name)
{
    return lookup_through("eglGetProcAddress", name);
}

/* ---- swaps ---- */

void glXSwapBuffers(void *display, unsigned long drawable)
{
    typedef void (*swap_fn)(void *, unsigned long);
    typedef void (*query_fn)(void *, unsigned long, int, unsigned *);
    typedef void *(*current_fn)(void);
    REAL(swap_fn, glXSwapBuffers);
    REAL(query_fn, glXQueryDrawable);
    REAL(current_fn, glXGetCurrentContext);
    if (hooks_enter() && glXQueryDrawable_real && glXGetCurrentContext_real) {
        unsigned width = 0, height = 0;
        glXQueryDrawable_real(display, drawable, GLX_WIDTH, &width);
        glXQueryDrawable_real(display, drawable, GLX_HEIGHT, &height);
        inject_before_swap(glXGetCurrentContext_real(), (int)width, (int)height);
    }
    if (glXSwapBuffers_real)
        glXSwapBuffers_real(display, drawable);
    hooks_leave();
}

static void draw_egl(void *display, void *surface)
{
    typedef unsigned (*query_fn)(void *, void *, int, int *);
    typedef void *(*current_fn)(void);
    REAL(query_fn, eglQuerySurface);
    REAL(current_fn, eglGetCurrentContext);
    int width = 0, height = 0;
    if (!eglQuerySurface_real || !eglGetCurrentContext_real)
        return;
    eglQuerySurface_real(display, surface, EGL_WIDTH, &width);
    eglQuerySurface_real(display, surface, EGL_HEIGHT, &height);
    inject_before_swap(eglGetCurrentContext_real(), width, height);
}

unsigned eglSwapBuffers(void *display, void *surface)
{
    typedef unsigned (*swap_fn)(void *, void *);
    REAL(swap_fn, eglSwapBuffers);
    if (hooks_enter())
        draw_egl(display, surface);
    unsigned ok = eglSwapBuffers_real ? eglSwapBuffers_real(display, surface) : 0;
    hooks_leave();
    return ok;
}

typedef unsigned (*swap_damage_fn)(void *, void *, const int *, int);

unsigned eglSwapBuffersWithDamageEXT(void *display, void *surface, const int *rectangles, int count)
{
    REAL(swap_damage_fn, eglSwapBuffersWithDamageEXT);
    if (hooks_enter())
        draw_egl(display, surface);
    unsigned ok =
        eglSwapBuffersWithDamageEXT_real ? eglSwapBuffersWithDamageEXT_real(display, surface, rectangles, count) : 0;
    hooks_leave();
    return ok;
}

unsigned eglSwapBuffersWithDamageKHR(void *display, void *surface, const int *rectangles, int count)
{
    REAL(swap_damage_fn, eglSwapBuffersWithDamageKHR);
    if (hooks_enter())
        draw_egl(display, surface);
    unsigned ok =
        eglSwapBuffersWithDamageKHR_real ? eglSwapBuffersWithDamageKHR_real(display, surface, rectangles, count) : 0;
    hooks_leave();
    return ok;
}
