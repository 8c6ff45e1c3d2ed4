/* SPDX-License-Identifier: MIT
 *
 * Keeps one effect for each context of the program, and destroys it together with its context.
 */
#include "inject.h"

#include <GL/glcorearb.h>
#include <glssao/glssao.h>
#include <stdlib.h>

static inject_context *contexts;

static const char *version_text(void)
{
    INJECT_REAL(PFNGLGETSTRINGPROC, GetString);
    const char *const text = GetString ? (const char *)GetString(GL_VERSION) : NULL;
    return text ? text : "version unknown";
}

inject_context *inject_context_of(void *context)
{
    inject_context *c = contexts;
    while (c && c->context != context)
        c = c->next;
    if (!c && (c = calloc(1, sizeof *c))) {
        INJECT_REAL(PFNGLGETINTEGERVPROC, GetIntegerv);
        GLint viewport[4] = {0}; /* the window's size in a new context; its widgets are smaller */
        GetIntegerv(GL_VIEWPORT, viewport);
        *c = (inject_context){.next = contexts,
                              .context = context,
                              .is_embedded = strncmp(version_text(), "OpenGL ES", 9) == 0,
                              .largest = (double)viewport[2] * (double)viewport[3] / 3.0,
                              .first = inject_seconds()};
        contexts = c;
    }
    return c;
}

inject_context *inject_next_context(inject_context *c)
{
    return c ? c->next : contexts;
}

static void log_line(glssao_log_level level, const char *message, void *user)
{
    (void)user;
    if (level == GLSSAO_LOG_ERROR)
        inject_say_once(message);
}

static bool make(inject_context *c, int width, int height)
{
    const glssao_config config = {
        .load = inject_real, .log = log_line, .width = width, .height = height, .no_timers = true};
    const glssao_result result = glssao_create(&config, &c->effect);
    if (result == GLSSAO_OK) {
        c->width = width;
        c->height = height;
        return true;
    }
    inject_say("no effect in this context (%s): %s", version_text(), glssao_result_string(result));
    c->given_up = true;
    return false;
}

bool inject_prepare_context(inject_context *c, int width, int height)
{
    if (c->given_up)
        return false;
    if (c->is_embedded) {
        inject_say("no effect in this context (%s): OpenGL ES is not supported", version_text());
        c->given_up = true;
        return false;
    }
    if (!c->effect)
        return make(c, width, height);
    if (c->width == width && c->height == height)
        return true;
    c->width = width;
    c->height = height;
    c->radius = 0.0f; /* it belonged to another picture */
    return true;
}

/* Without its context, an effect can't be destroyed: GL deletes its objects with the context, or with the last that
 * shares them, and its memory (some kilobytes) stays. */
void inject_forget_context(void *context, bool is_current)
{
    for (inject_context **at = &contexts; *at; at = &(*at)->next)
        if ((*at)->context == context) {
            inject_context *const gone = *at;
            *at = gone->next;
            if (is_current)
                glssao_destroy(gone->effect);
            free(gone);
            return;
        }
}
