/* SPDX-License-Identifier: MIT
 *
 * Decides when the effect is due. A program's scene is complete, and its depth still there, when
 *   - the window is swapped;
 *   - depth alone is cleared (games do so before a weapon or an interface): the picture stays, its depth goes;
 *   - a framebuffer is blitted, left for the window, left by its context, or drawn from into another one.
 * Where a framebuffer has several such moments in a frame, the earliest is taken that had as much depth written before
 * it as any in the last frame. The effect is drawn once a frame in each context.
 */
#include "inject.h"

#include <GL/glcorearb.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

enum { SCENES = 64, LEAST_SIZE = 64, FRAMES_KEPT = 120 };

typedef struct scene {
    inject_place place;
    int width, height; /* what the viewports covered, from the lower left corner */
    float weight; /* depth written since it was cleared: share of the framebuffer, times the logarithm of vertices */
    int moment;   /* number of the next one, in this frame, from 0 */
    float best_weight, last_weight; /* at the heaviest moment of this frame so far, and of the last frame */
    int best_moment, last_moment;   /* last_moment -1: there was none */
    bool is_left;                   /* another framebuffer was bound since */
    bool lasts;                     /* its context was left with it complete once: it is complete then alone */
    int idle;                       /* frames without a draw */
} scene;

static scene scenes[SCENES];
static int scene_count;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static scene *find(inject_place place)
{
    for (int i = 0; i < scene_count; ++i)
        if (scenes[i].place.context == place.context && scenes[i].place.framebuffer == place.framebuffer)
            return &scenes[i];
    return NULL;
}

static scene *find_or_add(inject_place place)
{
    scene *s = find(place);
    if (s)
        return s;
    if (scene_count < SCENES) {
        s = &scenes[scene_count++];
    } else {
        s = &scenes[0];
        for (int i = 1; i < SCENES; ++i)
            s = scenes[i].idle > s->idle ? &scenes[i] : s;
    }
    *s = (scene){.place = place, .last_moment = -1};
    return s;
}

/* Whether a framebuffer of the program's own holds a picture that can be multiplied: one buffer of colours that are no
 * integers, and depth. */
static bool holds_picture(unsigned framebuffer)
{
    INJECT_REAL(PFNGLGETINTEGERVPROC, GetIntegerv);
    INJECT_REAL(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer);
    INJECT_REAL(PFNGLGETFRAMEBUFFERATTACHMENTPARAMETERIVPROC, GetFramebufferAttachmentParameteriv);
    GLint bound = 0, color = GL_NONE, type = GL_NONE, depth = GL_NONE, second = GL_NONE;
    GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    GetIntegerv(GL_DRAW_BUFFER1, &second);
    GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                        GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &color);
    GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE,
                                        &depth);
    if (color != GL_NONE)
        GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                            GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
    BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)bound);
    return color != GL_NONE && depth != GL_NONE && second == GL_NONE && type != GL_INT && type != GL_UNSIGNED_INT;
}

/* No other framebuffer of its context had more depth written in the last frame. */
static bool is_main(const scene *s)
{
    for (int i = 0; i < scene_count; ++i)
        if (scenes[i].place.context == s->place.context && scenes[i].last_moment >= 0 && scenes[i].idle <= 1 &&
            scenes[i].last_weight > (s->last_moment >= 0 ? s->last_weight : 0.0f))
            return false;
    return true;
}

static bool has_history(const scene *s)
{
    return s->last_moment >= 0;
}

/* An icon or a picking picture is much smaller than the context's other pictures. */
static bool is_large(const inject_context *c, double width, double height)
{
    return width >= LEAST_SIZE && height >= LEAST_SIZE && 3.0 * width * height >= c->largest;
}

static void draw_in(inject_context *c, unsigned framebuffer, int width, int height)
{
    c->is_drawn = inject_draw_effect(c, framebuffer, width, height);
    c->drawn_framebuffer = framebuffer;
}

static void draw(inject_context *c, const scene *s)
{
    if (c->is_drawn || !(s->weight > 0.0f) || !is_large(c, s->width, s->height))
        return;
    if (s->place.framebuffer == 0 || holds_picture(s->place.framebuffer))
        draw_in(c, s->place.framebuffer, s->width, s->height);
}

/* Handles a moment. `is_last`: the frame has no later one. */
static void at_moment(inject_context *c, scene *s, bool is_last)
{
    if (is_main(s) && (is_last || s->moment == s->last_moment))
        draw(c, s);
    if (s->weight > s->best_weight) {
        s->best_weight = s->weight;
        s->best_moment = s->moment;
    }
    ++s->moment;
    s->is_left = false;
}

/* Locked until unlock, where the context can have an effect. */
static inject_context *enter(void *context)
{
    if (!context)
        return NULL;
    pthread_mutex_lock(&lock);
    inject_context *const c = inject_context_of(context);
    if (c && !c->is_embedded && !c->given_up)
        return c;
    pthread_mutex_unlock(&lock);
    return NULL;
}

static void leave(void)
{
    pthread_mutex_unlock(&lock);
}

void inject_before_draw(void *context, int count)
{
    INJECT_REAL(PFNGLGETINTEGERVPROC, GetIntegerv);
    INJECT_REAL(PFNGLGETBOOLEANVPROC, GetBooleanv);
    INJECT_REAL(PFNGLISENABLEDPROC, IsEnabled);
    enum { UNKNOWN = 64 };
    inject_context *const c = enter(context);
    if (!c)
        return;
    GLint bound = 0, viewport[4] = {0};
    GLboolean mask = GL_FALSE;
    GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    GetIntegerv(GL_VIEWPORT, viewport);
    c->largest = fmax(c->largest, (double)viewport[2] * (double)viewport[3]);
    for (int i = 0; i < scene_count; ++i) /* drawn from, most likely */
        if (scenes[i].place.context == context && scenes[i].is_left && !scenes[i].lasts &&
            scenes[i].place.framebuffer != (unsigned)bound)
            at_moment(c, &scenes[i], false);
    GetBooleanv(GL_DEPTH_WRITEMASK, &mask);
    if (mask && IsEnabled(GL_DEPTH_TEST)) {
        const inject_place place = {context, (unsigned)bound};
        scene *const s = find_or_add(place);
        const int right = viewport[0] + viewport[2], top = viewport[1] + viewport[3];
        s->width = right > s->width ? right : s->width;
        s->height = top > s->height ? top : s->height;
        s->is_left = false;
        s->idle = 0;
        const float area = (float)s->width * (float)s->height;
        const float share = area > 0.0f ? (float)viewport[2] * (float)viewport[3] / area : 0.0f;
        const float weight = share * (1.0f + log2f((float)(count > 0 ? count : UNKNOWN)));
        s->weight += weight;
        inject_note_draw(place, weight);
    }
    leave();
}

void inject_before_clear(inject_place place, bool color, bool depth)
{
    inject_context *const c = enter(place.context);
    if (!c)
        return;
    scene *const s = find(place);
    if (s && color) { /* this drawing is not shown: it may serve to find the object under the pointer */
        s->weight = depth ? 0.0f : s->weight;
        s->best_weight = 0.0f;
        s->best_moment = s->moment = 0;
        if (c->drawn_framebuffer == place.framebuffer)
            c->is_drawn = false;
    } else if (s && depth && s->weight > 0.0f) {
        at_moment(c, s, !has_history(s));
        s->weight = 0.0f;
    }
    leave();
}

void inject_before_bind(inject_place place, unsigned next)
{
    inject_context *const c = place.framebuffer != 0 && place.framebuffer != next ? enter(place.context) : NULL;
    if (!c)
        return;
    scene *const s = find(place);
    if (s && s->weight > 0.0f) {
        s->is_left = true;
        if (next == 0)
            at_moment(c, s, true);
    }
    leave();
}

void inject_before_blit(inject_place place, int width, int height)
{
    inject_context *const c = enter(place.context);
    if (!c)
        return;
    inject_projection unused; /* a framebuffer that was not redrawn must not be darkened twice */
    if (!c->is_drawn && is_large(c, width, height) && inject_get_projection(place, &unused))
        draw_in(c, place.framebuffer, width, height);
    leave();
}

/* A picture that the program reads back is not meant to be seen. It may hold the numbers of objects. */
void inject_before_read(inject_place place)
{
    if (place.framebuffer == 0 || !enter(place.context))
        return;
    scene *const s = find(place);
    if (s) {
        s->weight = 0.0f;
        s->is_left = false;
    }
    leave();
}

/* Another context will show the framebuffer that is bound now. Those left before it were drawn from already. */
void inject_before_switch(void *context)
{
    INJECT_REAL(PFNGLGETINTEGERVPROC, GetIntegerv);
    inject_context *const c = enter(context);
    if (!c)
        return;
    GLint bound = 0;
    GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    scene *const s = bound ? find((inject_place){context, (unsigned)bound}) : NULL;
    if (s && s->weight > 0.0f && is_large(c, s->width, s->height)) {
        s->lasts = true;
        draw(c, s);
    }
    leave();
}

void inject_before_destroy(void *context, bool is_current)
{
    pthread_mutex_lock(&lock);
    inject_forget_context(context, is_current);
    inject_forget_projections(context);
    int kept = 0;
    for (int i = 0; i < scene_count; ++i)
        if (scenes[i].place.context != context)
            scenes[kept++] = scenes[i];
    scene_count = kept;
    pthread_mutex_unlock(&lock);
}

/* The scenes of a context that is swapped, and of those that never are, begin a new frame. */
static void end_frame(const inject_context *swapped)
{
    int kept = 0;
    for (int i = 0; i < scene_count; ++i) {
        scene s = scenes[i];
        inject_context *const c = inject_context_of(s.place.context);
        if (c && (c == swapped || c->frame == 0)) {
            if (s.weight > s.best_weight) { /* the swap is the last moment */
                s.best_weight = s.weight;
                s.best_moment = s.moment;
            }
            s.last_weight = s.best_weight;
            s.last_moment = s.best_weight > 0.0f ? s.best_moment : s.last_moment;
            s.best_weight = s.weight = 0.0f;
            s.is_left = false;
            s.best_moment = s.moment = s.width = s.height = 0;
            ++s.idle;
        }
        if (s.idle < FRAMES_KEPT)
            scenes[kept++] = s;
    }
    scene_count = kept;
    for (inject_context *c = inject_next_context(NULL); c; c = inject_next_context(c))
        if (c == swapped || c->frame == 0) {
            c->is_drawn = false;
            c->largest *= 0.95; /* forgets a larger window in time */
        }
    inject_end_frame();
}

void inject_before_swap(void *context, int width, int height)
{
    if (!context || width <= 0 || height <= 0)
        return;
    pthread_mutex_lock(&lock);
    inject_context *const c = inject_context_of(context);
    if (c) {
        const inject_options *o = inject_get_options();
        const bool is_last = ++c->frame == o->picture_frame && o->picture;
        const bool ok = !is_last || !o->before || inject_write_picture(o->before, width, height);
        if (c->is_embedded)
            (void)inject_prepare_context(c, width, height); /* says why nothing happens */
        else if (!c->is_drawn)
            draw_in(c, 0, width, height);
        inject_end_of_frame(c, c->is_drawn);
        end_frame(c);
        if (is_last)
            _Exit(inject_write_picture(o->picture, width, height) && ok ? 0 : 1);
    }
    pthread_mutex_unlock(&lock);
}
