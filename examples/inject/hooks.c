/* SPDX-License-Identifier: MIT
 *
 * The functions that a program calls here instead of in libGL, libEGL and, to look those up, in libc: lookups, swaps
 * and blits. Each does what was asked, and draws what glssao-inject wants besides. lookup.c lists their names.
 */
#include "hooks.h"

#define GLX_WIDTH 0x801D
#define GLX_HEIGHT 0x801E
#define EGL_WIDTH 0x3057
#define EGL_HEIGHT 0x3056

typedef void (*function)(void);
static _Thread_local int depth_of_calls; /* drivers and loaders call each other; only the outermost call counts */

HOOK void *dlsym(void *restrict handle, const char *restrict name);
HOOK function glXGetProcAddress(const unsigned char *name);
HOOK function glXGetProcAddressARB(const unsigned char *name);
HOOK function eglGetProcAddress(const char *name);
HOOK void glXSwapBuffers(void *display, unsigned long drawable);
HOOK unsigned eglSwapBuffers(void *display, void *surface);
HOOK unsigned eglSwapBuffersWithDamageEXT(void *display, void *surface, const int *rectangles, int count);
HOOK unsigned eglSwapBuffersWithDamageKHR(void *display, void *surface, const int *rectangles, int count);
HOOK void glBlitFramebuffer(int x0, int y0, int x1, int y1, int to_x0, int to_y0, int to_x1, int to_y1, unsigned mask,
                            unsigned filter);

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
    if (++depth_of_calls == 1 && glXQueryDrawable_real && glXGetCurrentContext_real) {
        unsigned width = 0, height = 0;
        glXQueryDrawable_real(display, drawable, GLX_WIDTH, &width);
        glXQueryDrawable_real(display, drawable, GLX_HEIGHT, &height);
        void *context = glXGetCurrentContext_real();
        if (context)
            inject_swap(context, (int)width, (int)height);
    }
    if (glXSwapBuffers_real)
        glXSwapBuffers_real(display, drawable);
    --depth_of_calls;
}

static void draw_egl(void *display, void *surface)
{
    typedef unsigned (*query_fn)(void *, void *, int, int *);
    typedef void *(*current_fn)(void);
    REAL(query_fn, eglQuerySurface);
    REAL(current_fn, eglGetCurrentContext);
    int width = 0, height = 0;
    if (depth_of_calls != 1 || !eglQuerySurface_real || !eglGetCurrentContext_real)
        return;
    eglQuerySurface_real(display, surface, EGL_WIDTH, &width);
    eglQuerySurface_real(display, surface, EGL_HEIGHT, &height);
    void *context = eglGetCurrentContext_real();
    if (context)
        inject_swap(context, width, height);
}

unsigned eglSwapBuffers(void *display, void *surface)
{
    typedef unsigned (*swap_fn)(void *, void *);
    REAL(swap_fn, eglSwapBuffers);
    ++depth_of_calls;
    draw_egl(display, surface);
    unsigned ok = eglSwapBuffers_real ? eglSwapBuffers_real(display, surface) : 0;
    --depth_of_calls;
    return ok;
}

typedef unsigned (*swap_damage_fn)(void *, void *, const int *, int);

unsigned eglSwapBuffersWithDamageEXT(void *display, void *surface, const int *rectangles, int count)
{
    REAL(swap_damage_fn, eglSwapBuffersWithDamageEXT);
    ++depth_of_calls;
    draw_egl(display, surface);
    unsigned ok =
        eglSwapBuffersWithDamageEXT_real ? eglSwapBuffersWithDamageEXT_real(display, surface, rectangles, count) : 0;
    --depth_of_calls;
    return ok;
}

unsigned eglSwapBuffersWithDamageKHR(void *display, void *surface, const int *rectangles, int count)
{
    REAL(swap_damage_fn, eglSwapBuffersWithDamageKHR);
    ++depth_of_calls;
    draw_egl(display, surface);
    unsigned ok =
        eglSwapBuffersWithDamageKHR_real ? eglSwapBuffersWithDamageKHR_real(display, surface, rectangles, count) : 0;
    --depth_of_calls;
    return ok;
}

/* ---- pictures drawn elsewhere ---- */

static void *current_context(void)
{
    typedef void *(*current_fn)(void);
    REAL(current_fn, glXGetCurrentContext);
    REAL(current_fn, eglGetCurrentContext);
    void *context = glXGetCurrentContext_real ? glXGetCurrentContext_real() : NULL;
    return context || !eglGetCurrentContext_real ? context : eglGetCurrentContext_real();
}

void glBlitFramebuffer(int x0, int y0, int x1, int y1, int to_x0, int to_y0, int to_x1, int to_y1, unsigned mask,
                       unsigned filter)
{
    REAL(PFNGLBLITFRAMEBUFFERPROC, glBlitFramebuffer);
    const unsigned framebuffer = hooks_framebuffer(GL_READ_FRAMEBUFFER_BINDING);
    if (++depth_of_calls == 1 && (mask & GL_COLOR_BUFFER_BIT) && framebuffer != 0 && x0 == 0 && y0 == 0 && x1 > 0 &&
        y1 > 0)
        inject_blit(current_context(), framebuffer, x1, y1);
    if (glBlitFramebuffer_real)
        glBlitFramebuffer_real(x0, y0, x1, y1, to_x0, to_y0, to_x1, to_y1, mask, filter);
    --depth_of_calls;
}
