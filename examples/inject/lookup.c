/* SPDX-License-Identifier: MIT
 *
 * Finds the real functions behind the hooks, and the hooks for a program that looks functions up itself.
 */
#define _GNU_SOURCE
#include "inject.h"

#include <dlfcn.h>
#include <string.h>

typedef void (*function)(void);

static struct hook {
    const char *name;
    void *real; /* from the program's last lookup; else NULL until it is needed */
} hooks[] = {
    {"dlsym", NULL},
    {"glXGetProcAddress", NULL},
    {"glXGetProcAddressARB", NULL},
    {"eglGetProcAddress", NULL},
    {"glXSwapBuffers", NULL},
    {"eglSwapBuffers", NULL},
    {"eglSwapBuffersWithDamageEXT", NULL},
    {"eglSwapBuffersWithDamageKHR", NULL},
    {"glUniformMatrix4fv", NULL},
    {"glProgramUniformMatrix4fv", NULL},
    {"glLoadMatrixf", NULL},
    {"glLoadMatrixd", NULL},
    {"glMultMatrixf", NULL},
    {"glMultMatrixd", NULL},
    {"glOrtho", NULL},
    {"glFrustum", NULL},
    {"glPopMatrix", NULL},
    {"glClipControl", NULL},
    {"glBufferData", NULL},
    {"glBufferSubData", NULL},
    {"glNamedBufferData", NULL},
    {"glNamedBufferSubData", NULL},
    {"glUnmapBuffer", NULL},
    {"glClear", NULL},
    {"glClearBufferfv", NULL},
    {"glClearBufferfi", NULL},
    {"glBindFramebuffer", NULL},
    {"glBindFramebufferEXT", NULL},
    {"glBlitFramebuffer", NULL},
    {"glBlitFramebufferEXT", NULL},
    {"glReadPixels", NULL},
    {"glXMakeCurrent", NULL},
    {"glXMakeContextCurrent", NULL},
    {"glXDestroyContext", NULL},
    {"eglMakeCurrent", NULL},
    {"eglDestroyContext", NULL},
    {"glBegin", NULL},
    {"glEnd", NULL},
    {"glNewList", NULL},
    {"glEndList", NULL},
    {"glDrawArrays", NULL},
    {"glDrawElements", NULL},
    {"glDrawRangeElements", NULL},
    {"glDrawArraysInstanced", NULL},
    {"glDrawElementsInstanced", NULL},
    {"glDrawElementsBaseVertex", NULL},
    {"glDrawRangeElementsBaseVertex", NULL},
    {"glDrawElementsInstancedBaseVertex", NULL},
    {"glMultiDrawArrays", NULL},
    {"glMultiDrawElements", NULL},
    {"glMultiDrawElementsBaseVertex", NULL},
    {"glDrawArraysIndirect", NULL},
    {"glDrawElementsIndirect", NULL},
    {"glMultiDrawArraysIndirect", NULL},
    {"glMultiDrawElementsIndirect", NULL},
    {"glCallList", NULL},
    {"glCallLists", NULL},
};
enum { HOOKS = sizeof hooks / sizeof *hooks };

static struct hook *find_hook(const char *name)
{
    for (int i = 0; i < HOOKS; ++i)
        if (strcmp(hooks[i].name, name) == 0)
            return &hooks[i];
    return NULL;
}

void *inject_real_dlsym(void *handle, const char *name)
{
    static void *(*lookup)(void *, const char *);
    if (!lookup) {
        static const char *const versions[] = {"GLIBC_2.34", "GLIBC_2.2.5", "GLIBC_2.17", "GLIBC_2.0", "GLIBC_2.27"};
        void *address = NULL;
        for (size_t i = 0; !address && i < sizeof versions / sizeof *versions; ++i)
            address = dlvsym(RTLD_NEXT, "dlsym", versions[i]);
        if (!address)
            return NULL;
        memcpy(&lookup, &address, sizeof address);
    }
    return lookup(handle, name);
}

/* The hook itself: this library's own symbol of that name. */
static void *own(const char *name)
{
    static void *self;
    if (!self) {
        Dl_info info;
        if (!dladdr((void *)hooks, &info))
            return NULL;
        self = dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
    }
    return self ? inject_real_dlsym(self, name) : NULL;
}

/* From the libraries that the program has loaded, however it did. */
static void *search(const char *name)
{
    void *address = inject_real_dlsym(RTLD_NEXT, name);
    static const char *const libraries[] = {"libGL.so.1", "libOpenGL.so.0", "libGLX.so.0", "libEGL.so.1"};
    for (size_t i = 0; !address && i < sizeof libraries / sizeof *libraries; ++i) {
        void *library = dlopen(libraries[i], RTLD_LAZY | RTLD_NOLOAD);
        if (!library)
            continue;
        address = inject_real_dlsym(library, name);
        dlclose(library); /* the program holds it */
    }
    return address;
}

void *inject_real(const char *name, void *user)
{
    (void)user;
    struct hook *hook = find_hook(name);
    if (hook && hook->real)
        return hook->real;
    void *address = search(name);
    /* EGL makes up a function for every name that begins with "gl", those of GLX too. */
    static const char *const lookups[] = {"glXGetProcAddressARB", "eglGetProcAddress"};
    const int count = strncmp(name, "gl", 2) != 0 ? 0 : strncmp(name, "glX", 3) == 0 ? 1 : 2;
    for (int i = 0; !address && i < count; ++i) {
        void *lookup = search(lookups[i]);
        function (*get)(const char *);
        memcpy(&get, &lookup, sizeof lookup);
        function found = lookup ? get(name) : NULL;
        memcpy(&address, &found, sizeof found);
    }
    if (hook)
        hook->real = address;
    return address;
}

void *inject_hooked(const char *name, void *real)
{
    struct hook *hook = real ? find_hook(name) : NULL;
    void *ours = hook ? own(name) : NULL;
    if (!ours || ours == real)
        return real;
    hook->real = real;
    return ours;
}
