/* SPDX-License-Identifier: MIT
 *
 * The functions that end a picture or part of one: clears, framebuffers bound, blitted and read, contexts switched and
 * destroyed. Each reports its event before it happens.
 */
#include "hooks.h"

HOOK void glClear(unsigned mask);
HOOK void glClearBufferfv(unsigned buffer, int index, const float *values);
HOOK void glClearBufferfi(unsigned buffer, int index, float depth, int stencil);
HOOK void glBindFramebuffer(unsigned target, unsigned framebuffer);
HOOK void glBindFramebufferEXT(unsigned target, unsigned framebuffer);
HOOK void glBlitFramebuffer(int x0, int y0, int x1, int y1, int to_x0, int to_y0, int to_x1, int to_y1, unsigned mask,
                            unsigned filter);
HOOK void glBlitFramebufferEXT(int x0, int y0, int x1, int y1, int to_x0, int to_y0, int to_x1, int to_y1,
                               unsigned mask, unsigned filter);
HOOK void glReadPixels(int x, int y, int width, int height, unsigned format, unsigned type, void *pixels);
HOOK int glXMakeCurrent(void *display, unsigned long drawable, void *context);
HOOK int glXMakeContextCurrent(void *display, unsigned long draw, unsigned long read, void *context);
HOOK void glXDestroyContext(void *display, void *context);
HOOK unsigned eglMakeCurrent(void *display, void *draw, void *read, void *context);
HOOK unsigned eglDestroyContext(void *display, void *context);

/* ---- clears ---- */

/* A clear that the scissor limits to less than half of the viewport belongs to an icon. */
static bool is_whole(void)
{
    REAL(PFNGLISENABLEDPROC, glIsEnabled);
    REAL(PFNGLGETINTEGERVPROC, glGetIntegerv);
    GLint box[4] = {0}, viewport[4] = {0};
    if (!glIsEnabled_real || !glGetIntegerv_real || !glIsEnabled_real(GL_SCISSOR_TEST))
        return true;
    glGetIntegerv_real(GL_SCISSOR_BOX, box);
    glGetIntegerv_real(GL_VIEWPORT, viewport);
    return 2.0 * box[2] * box[3] >= 1.0 * viewport[2] * viewport[3];
}

static bool writes_depth(void)
{
    REAL(PFNGLGETBOOLEANVPROC, glGetBooleanv);
    GLboolean mask = GL_TRUE;
    if (glGetBooleanv_real)
        glGetBooleanv_real(GL_DEPTH_WRITEMASK, &mask);
    return mask;
}

static void report_clear(bool color, bool depth)
{
    depth = depth && writes_depth();
    if ((color || depth) && is_whole())
        inject_before_clear(hooks_place(GL_DRAW_FRAMEBUFFER_BINDING), color, depth);
}

void glClear(unsigned mask)
{
    typedef void (*clear_fn)(unsigned);
    REAL(clear_fn, glClear);
    if (hooks_enter())
        report_clear((mask & GL_COLOR_BUFFER_BIT) != 0, (mask & GL_DEPTH_BUFFER_BIT) != 0);
    if (glClear_real)
        glClear_real(mask);
    hooks_leave();
}

void glClearBufferfv(unsigned buffer, int index, const float *values)
{
    REAL(PFNGLCLEARBUFFERFVPROC, glClearBufferfv);
    if (hooks_enter())
        report_clear(buffer == GL_COLOR && index == 0, buffer == GL_DEPTH);
    if (glClearBufferfv_real)
        glClearBufferfv_real(buffer, index, values);
    hooks_leave();
}

void glClearBufferfi(unsigned buffer, int index, float depth, int stencil)
{
    REAL(PFNGLCLEARBUFFERFIPROC, glClearBufferfi);
    if (hooks_enter())
        report_clear(false, true);
    if (glClearBufferfi_real)
        glClearBufferfi_real(buffer, index, depth, stencil);
    hooks_leave();
}

/* ---- framebuffers ---- */

#define BIND_HOOK(name)                                                                                                \
    void name(unsigned target, unsigned framebuffer)                                                                   \
    {                                                                                                                  \
        REAL(PFNGLBINDFRAMEBUFFERPROC, name);                                                                          \
        if (hooks_enter() && target != GL_READ_FRAMEBUFFER)                                                            \
            inject_before_bind(hooks_place(GL_DRAW_FRAMEBUFFER_BINDING), framebuffer);                                 \
        if (name##_real)                                                                                               \
            name##_real(target, framebuffer);                                                                          \
        hooks_leave();                                                                                                 \
    }
BIND_HOOK(glBindFramebuffer)
BIND_HOOK(glBindFramebufferEXT)

#define BLIT_HOOK(name)                                                                                                \
    void name(int x0, int y0, int x1, int y1, int to_x0, int to_y0, int to_x1, int to_y1, unsigned mask,               \
              unsigned filter)                                                                                         \
    {                                                                                                                  \
        REAL(PFNGLBLITFRAMEBUFFERPROC, name);                                                                          \
        if (hooks_enter() && (mask & GL_COLOR_BUFFER_BIT) && x0 == 0 && y0 == 0 && x1 > 0 && y1 > 0) {                 \
            const inject_place place = hooks_place(GL_READ_FRAMEBUFFER_BINDING);                                       \
            if (place.framebuffer != 0)                                                                                \
                inject_before_blit(place, x1, y1);                                                                     \
        }                                                                                                              \
        if (name##_real)                                                                                               \
            name##_real(x0, y0, x1, y1, to_x0, to_y0, to_x1, to_y1, mask, filter);                                     \
        hooks_leave();                                                                                                 \
    }
BLIT_HOOK(glBlitFramebuffer)
BLIT_HOOK(glBlitFramebufferEXT)

/* Programs read single depths to find the object under the pointer. Such reads change nothing. */
void glReadPixels(int x, int y, int width, int height, unsigned format, unsigned type, void *pixels)
{
    REAL(PFNGLREADPIXELSPROC, glReadPixels);
    if (hooks_enter() && format != GL_DEPTH_COMPONENT && format != GL_STENCIL_INDEX && format != GL_DEPTH_STENCIL)
        inject_before_read(hooks_place(GL_READ_FRAMEBUFFER_BINDING));
    if (glReadPixels_real)
        glReadPixels_real(x, y, width, height, format, type, pixels);
    hooks_leave();
}

/* ---- contexts ---- */

static void report_switch(const void *next)
{
    void *const current = hooks_context();
    if (current && current != next)
        inject_before_switch(current);
}

int glXMakeCurrent(void *display, unsigned long drawable, void *context)
{
    typedef int (*make_current_fn)(void *, unsigned long, void *);
    REAL(make_current_fn, glXMakeCurrent);
    if (hooks_enter())
        report_switch(context);
    const int ok = glXMakeCurrent_real ? glXMakeCurrent_real(display, drawable, context) : 0;
    hooks_leave();
    return ok;
}

int glXMakeContextCurrent(void *display, unsigned long draw, unsigned long read, void *context)
{
    typedef int (*make_current_fn)(void *, unsigned long, unsigned long, void *);
    REAL(make_current_fn, glXMakeContextCurrent);
    if (hooks_enter())
        report_switch(context);
    const int ok = glXMakeContextCurrent_real ? glXMakeContextCurrent_real(display, draw, read, context) : 0;
    hooks_leave();
    return ok;
}

unsigned eglMakeCurrent(void *display, void *draw, void *read, void *context)
{
    typedef unsigned (*make_current_fn)(void *, void *, void *, void *);
    REAL(make_current_fn, eglMakeCurrent);
    if (hooks_enter())
        report_switch(context);
    const unsigned ok = eglMakeCurrent_real ? eglMakeCurrent_real(display, draw, read, context) : 0;
    hooks_leave();
    return ok;
}

void glXDestroyContext(void *display, void *context)
{
    typedef void (*destroy_fn)(void *, void *);
    REAL(destroy_fn, glXDestroyContext);
    if (hooks_enter() && context)
        inject_before_destroy(context, context == hooks_context());
    if (glXDestroyContext_real)
        glXDestroyContext_real(display, context);
    hooks_leave();
}

unsigned eglDestroyContext(void *display, void *context)
{
    typedef unsigned (*destroy_fn)(void *, void *);
    REAL(destroy_fn, eglDestroyContext);
    if (hooks_enter() && context)
        inject_before_destroy(context, context == hooks_context());
    const unsigned ok = eglDestroyContext_real ? eglDestroyContext_real(display, context) : 0;
    hooks_leave();
    return ok;
}
