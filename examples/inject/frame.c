/* SPDX-License-Identifier: MIT
 *
 * One effect for each context of the program, made when it first swaps, and what happens at each swap: the window's
 * depth copied, accessibility computed and multiplied into the window's picture. Where that can't work the reason is
 * said once and the program goes on as if nothing were there.
 */
#define _POSIX_C_SOURCE 200809L
#include "inject.h"
#include "window_depth.h"

#include <GL/glcorearb.h>
#include <glssao/glssao.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CONTEXTS = 16, FRAMES_TO_FIND_A_PROJECTION = 60, FRAMES_PER_RADIUS = 60, FRAMES_PER_LOOK = 10, REASONS = 16 };

typedef struct target {
    void *context;
    bool given_up;
    glssao_effect *effect;
    window_depth *depth;
    int width, height;
    int frame; /* swaps so far */
    float radius;
    bool works;    /* said so once */
    bool is_drawn; /* in this frame, by a blit */
} target;

static target targets[CONTEXTS];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static volatile sig_atomic_t is_on = 1;

static void toggle(int signal_number)
{
    (void)signal_number;
    is_on = !is_on;
}

/* SIGUSR1 switches the effect, unless the program has a use for it. */
static void set_up(void)
{
    is_on = !inject_get_options()->off;
    struct sigaction old;
    if (sigaction(SIGUSR1, NULL, &old) == 0 && old.sa_handler == SIG_DFL) {
        struct sigaction action = {.sa_handler = toggle, .sa_flags = SA_RESTART};
        sigaction(SIGUSR1, &action, NULL);
    }
}

static void say_once(const char *reason)
{
    static char said[REASONS][160];
    static int count;
    for (int i = 0; i < count; ++i)
        if (strncmp(said[i], reason, sizeof said[i] - 1) == 0)
            return;
    if (count < REASONS)
        snprintf(said[count++], sizeof said[0], "%s", reason);
    inject_say("%s", reason);
}

static void log_line(glssao_log_level level, const char *message, void *user)
{
    (void)user;
    if (level == GLSSAO_LOG_ERROR)
        say_once(message);
}

static target *find_target(void *context)
{
    for (int i = 0; i < CONTEXTS; ++i)
        if (targets[i].context == context || !targets[i].context) {
            targets[i].context = context;
            return &targets[i];
        }
    return NULL;
}

static bool prepare(target *t, int width, int height)
{
    if (!t->effect) {
        glssao_config config = {
            .load = inject_real, .log = log_line, .width = width, .height = height, .no_timers = true};
        glssao_result result = glssao_create(&config, &t->effect);
        t->depth = result == GLSSAO_OK ? window_depth_create(inject_real, NULL) : NULL;
        if (!t->depth) {
            INJECT_REAL(PFNGLGETSTRINGPROC, GetString);
            const char *version = GetString ? (const char *)GetString(GL_VERSION) : NULL;
            inject_say("no effect in this context (%s): %s", version ? version : "version unknown",
                       glssao_result_string(result));
            glssao_destroy(t->effect);
            t->effect = NULL;
            return false;
        }
        t->width = width;
        t->height = height;
    }
    if (t->width != width || t->height != height) {
        if (glssao_resize(t->effect, width, height) != GLSSAO_OK)
            return false;
        t->width = width;
        t->height = height;
    }
    return true;
}

static bool get_projection(const target *t, GLuint framebuffer, inject_projection *out)
{
    const inject_options *o = inject_get_options();
    const bool found = inject_get_projection(framebuffer, out);
    if (o->fov > 0.0f) {
        const float focal = 1.0f / tanf(o->fov * 3.14159265f / 360.0f), n = o->near_plane, f = o->far_plane;
        *out = (inject_projection){{0}, false};
        out->matrix[0] = focal * (float)t->height / (float)t->width;
        out->matrix[5] = focal;
        out->matrix[10] = (f + n) / (n - f);
        out->matrix[11] = -1.0f;
        out->matrix[14] = 2.0f * f * n / (n - f);
        return true;
    }
    if (!found && t->frame >= FRAMES_TO_FIND_A_PROJECTION)
        say_once("no projection was seen; GLSSAO_INJECT_FOV, _NEAR and _FAR can tell a perspective one");
    return found;
}

/* glDepthRange(1, 0) turns depth about after the projection. */
static void follow_depth_range(inject_projection *p)
{
    INJECT_REAL(PFNGLGETFLOATVPROC, GetFloatv);
    GLfloat range[2] = {0.0f, 1.0f};
    GetFloatv(GL_DEPTH_RANGE, range);
    if (range[0] != 1.0f || range[1] != 0.0f || p->zero_to_one)
        return;
    p->matrix[10] = -p->matrix[10];
    p->matrix[14] = -p->matrix[14];
}

static void say_on(const target *t, const inject_projection *projection)
{
    const float *p = projection->matrix, low = projection->zero_to_one ? 0.0f : -1.0f;
    if (p[11] == 0.0f) {
        inject_say("on: %d x %d, orthographic, %g high, %g deep, radius %g", t->width, t->height, (double)(2.0f / p[5]),
                   (double)fabsf((1.0f - low) / p[10]), (double)t->radius);
        return;
    }
    const float at_low = p[14] / (low + p[10]), at_high = p[14] / (1.0f + p[10]);
    const bool is_reversed = fabsf(low + p[10]) < fabsf(1.0f + p[10]); /* the far end is where this is least */
    const float far_plane = is_reversed ? at_low : at_high;
    inject_say("on: %d x %d, field of view %.1f degrees, near %g, far %g, radius %g%s", t->width, t->height,
               (double)(atanf(1.0f / p[5]) * 114.591559f), (double)(is_reversed ? at_high : at_low),
               far_plane > 0.0f ? (double)far_plane : HUGE_VAL, (double)t->radius, is_reversed ? ", reversed" : "");
}

/* The first frames, of which some programs draw no more, then now and then. */
static bool is_radius_due(const target *t)
{
    const bool known = t->radius > 0.0f;
    return t->frame % (known ? FRAMES_PER_RADIUS : FRAMES_PER_LOOK) == 1 || (!known && t->frame < FRAMES_PER_LOOK);
}

/* Into the window, 0, or a framebuffer of the program's own; false where nothing was drawn. */
static bool draw_effect(target *t, GLuint framebuffer)
{
    const inject_options *o = inject_get_options();
    inject_projection projection;
    if (!get_projection(t, framebuffer, &projection) || !is_on)
        return false;
    follow_depth_range(&projection);
    const char *why = NULL;
    const GLuint depth = window_depth_copy(t->depth, framebuffer, t->width, t->height, &why);
    if (!depth) {
        say_once(why);
        return false;
    }
    if (o->radius > 0.0f)
        t->radius = o->radius;
    else if (is_radius_due(t)) {
        const float radius = inject_fitting_radius(depth, t->width, t->height, &projection);
        t->radius = radius > 0.0f ? radius : t->radius;
    }
    if (!(t->radius > 0.0f)) {
        if (t->frame >= FRAMES_TO_FIND_A_PROJECTION)
            say_once(
                "the window's depth is empty: the program draws elsewhere, or clears it before it shows a picture");
        return false;
    }
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)o->quality);
    settings.radius = t->radius;
    if (o->power > 0.0f)
        settings.power = o->power;
    glssao_frame frame = {.depth_texture = depth, .clip_zero_to_one = projection.zero_to_one};
    memcpy(frame.projection, projection.matrix, sizeof frame.projection);
    if (glssao_compute(t->effect, &frame, &settings) != GLSSAO_OK)
        return false;
    if (o->map)
        inject_clear_to_white(framebuffer);
    if (glssao_apply(t->effect, framebuffer) != GLSSAO_OK)
        return false;
    if (!t->works) {
        t->works = true;
        say_on(t, &projection);
    }
    return true;
}

/* Locked until release; NULL, and not locked, where there is no effect to be had. */
static target *acquire(void *context)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_up);
    pthread_mutex_lock(&lock);
    target *t = context ? find_target(context) : NULL;
    if (!t)
        pthread_mutex_unlock(&lock);
    return t;
}

static bool is_ready(target *t, int width, int height)
{
    if (!t->given_up)
        t->given_up = !prepare(t, width, height);
    return !t->given_up;
}

void inject_blit(void *context, unsigned framebuffer, int width, int height)
{
    target *t = acquire(context);
    if (!t)
        return;
    inject_projection unused; /* a framebuffer that was not drawn anew must not be darkened once more */
    if (!t->is_drawn && inject_get_projection(framebuffer, &unused) && is_ready(t, width, height))
        t->is_drawn = draw_effect(t, framebuffer);
    pthread_mutex_unlock(&lock);
}

void inject_swap(void *context, int width, int height)
{
    target *t = width > 0 && height > 0 ? acquire(context) : NULL;
    if (!t)
        return;
    const inject_options *o = inject_get_options();
    const bool is_last = ++t->frame == o->picture_frame && o->picture;
    const bool ok = !is_last || !o->before || inject_write_picture(o->before, width, height);
    if (!t->is_drawn && is_ready(t, width, height))
        draw_effect(t, 0);
    t->is_drawn = false;
    inject_end_frame();
    if (is_last)
        _Exit(inject_write_picture(o->picture, width, height) && ok ? 0 : 1);
    pthread_mutex_unlock(&lock);
}
