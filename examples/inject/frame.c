/* SPDX-License-Identifier: MIT
 *
 * Draws the effect: copies depth, computes accessibility and multiplies it into the picture. If that fails, it logs the
 * reason once, and the program runs on unchanged.
 */
#define _POSIX_C_SOURCE 200809L
#include "inject.h"

#include <GL/glcorearb.h>
#include <glssao/glssao.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>

/* Rules count frames, for programs that draw all the time, and seconds, for those that draw on demand. */
enum { FRAMES_TO_FIND = 60, FRAMES_PER_RADIUS = 60, FRAMES_PER_LOOK = 10, FRAMES_WITHOUT = 60, REASONS = 16 };
static const double SECONDS_TO_FIND = 3.0, SECONDS_PER_RADIUS = 1.0, SECONDS_PER_LOOK = 0.25, SECONDS_WITHOUT = 2.0,
                    SECONDS_PER_LINE = 2.0;

static volatile sig_atomic_t is_on = 1;
static bool has_drawn; /* the effect, in any context */

static void toggle(int signal_number)
{
    (void)signal_number;
    is_on = !is_on;
}

/* SIGUSR1 switches the effect on and off, unless the program uses that signal itself. */
static void set_up(void)
{
    is_on = !inject_get_options()->off;
    struct sigaction old;
    if (sigaction(SIGUSR1, NULL, &old) == 0 && old.sa_handler == SIG_DFL) {
        struct sigaction action = {.sa_handler = toggle, .sa_flags = SA_RESTART};
        sigaction(SIGUSR1, &action, NULL);
    }
}

void inject_say_once(const char *reason)
{
    static char said[REASONS][240];
    static int count;
    for (int i = 0; i < count; ++i)
        if (strncmp(said[i], reason, sizeof said[i] - 1) == 0)
            return;
    if (count < REASONS)
        snprintf(said[count++], sizeof said[0], "%s", reason);
    inject_say("%s", reason);
}

static bool get_projection(const inject_context *c, unsigned framebuffer, int width, int height, inject_projection *out)
{
    const inject_options *o = inject_get_options();
    const bool found = inject_get_projection((inject_place){c->context, framebuffer}, out);
    if (o->fov == 0.0f)
        return found;
    const float focal = 1.0f / tanf(o->fov * 3.14159265f / 360.0f), n = o->near_plane, f = o->far_plane;
    *out = (inject_projection){{0}, false};
    out->matrix[0] = focal * (float)height / (float)width;
    out->matrix[5] = focal;
    out->matrix[10] = (f + n) / (n - f);
    out->matrix[11] = -1.0f;
    out->matrix[14] = 2.0f * f * n / (n - f);
    return true;
}

/* glDepthRange(1, 0) reverses depth after the projection. */
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

static void describe(const inject_context *c, const inject_projection *projection, char *out, size_t size)
{
    const float *p = projection->matrix, low = projection->zero_to_one ? 0.0f : -1.0f;
    if (p[11] == 0.0f) {
        snprintf(out, size, "on: %d x %d, orthographic, %g high, %g deep, radius %g", c->width, c->height,
                 (double)(2.0f / p[5]), (double)fabsf((1.0f - low) / p[10]), (double)c->radius);
        return;
    }
    const float at_low = p[14] / (low + p[10]), at_high = p[14] / (1.0f + p[10]);
    const bool is_reversed = fabsf(low + p[10]) < fabsf(1.0f + p[10]); /* the far end is where this is least */
    const float far_plane = is_reversed ? at_low : at_high;
    snprintf(out, size, "on: %d x %d, field of view %.1f degrees, near %g, far %g, radius %g%s", c->width, c->height,
             (double)(atanf(1.0f / p[5]) * 114.591559f), (double)(is_reversed ? at_high : at_low),
             far_plane > 0.0f ? (double)far_plane : HUGE_VAL, (double)c->radius, is_reversed ? ", reversed" : "");
}

/* The length up to which two "on:" lines agree if they describe the same picture: size, kind, and field of view or the
 * word "orthographic". Planes and radius change all the time in programs that fit them to the view. */
static size_t length_of_kind(const char *line)
{
    const char *const near_plane = strstr(line, ", near "), *const high = strstr(line, ", orthographic");
    return near_plane ? (size_t)(near_plane - line) : high ? (size_t)(high - line) + 14 : strlen(line);
}

static void say_on(inject_context *c, const inject_projection *projection)
{
    char line[sizeof c->said];
    const inject_locale before = inject_use_plain_locale();
    describe(c, projection, line, sizeof line);
    inject_restore_locale(before);
    const size_t length = length_of_kind(line);
    const double now = inject_seconds();
    const bool is_same = c->said[0] && length == length_of_kind(c->said) && strncmp(line, c->said, length) == 0;
    if (is_same || (c->said[0] && now - c->said_time < SECONDS_PER_LINE))
        return;
    memcpy(c->said, line, sizeof line);
    c->said_time = now;
    inject_say("%s", line);
}

/* Reading depth back is slow, so it happens only now and then, and more often until a radius is found. */
static bool is_radius_due(const inject_context *c)
{
    const bool known = c->radius > 0.0f;
    const int frames = c->frame - c->radius_frame;
    const double seconds = inject_seconds() - c->radius_time;
    return frames >= (known ? FRAMES_PER_RADIUS : FRAMES_PER_LOOK) ||
           seconds >= (known ? SECONDS_PER_RADIUS : SECONDS_PER_LOOK);
}

static bool is_long_enough(const inject_context *c)
{
    return c->frame >= FRAMES_TO_FIND || (c->frame > 1 && inject_seconds() - c->first >= SECONDS_TO_FIND);
}

static bool find_radius(inject_context *c, unsigned depth, const inject_projection *projection)
{
    const inject_options *o = inject_get_options();
    if (o->radius > 0.0f) {
        c->radius = o->radius;
    } else if (is_radius_due(c)) {
        const float radius = inject_fitting_radius(depth, c->width, c->height, projection);
        c->radius = radius > 0.0f ? radius : c->radius;
        c->radius_frame = c->frame;
        c->radius_time = inject_seconds();
    }
    if (!(c->radius > 0.0f) && is_long_enough(c))
        inject_say_once("the depth buffer is empty: if a scene is in view, the program draws it in a way that is not "
                        "followed; try it with its post-processing and anti-aliasing switched off, and see "
                        "docs/inject.md");
    return c->radius > 0.0f;
}

/* With a radius of 0 the call copies depth and computes nothing. The radius of this frame or the next follows from the
 * copy. */
static bool compute(inject_context *c, unsigned framebuffer, int width, int height, const inject_projection *projection)
{
    const inject_options *o = inject_get_options();
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)o->quality);
    if (o->power > 0.0f)
        settings.power = o->power;
    glssao_frame frame = {.viewport = {0, 0, width, height}, .clip_zero_to_one = projection->zero_to_one};
    memcpy(frame.projection, projection->matrix, sizeof frame.projection);
    for (int i = 0; i < 2; ++i) {
        settings.radius = c->radius;
        if (glssao_compute_framebuffer(c->effect, framebuffer, &frame, &settings) != GLSSAO_OK ||
            !find_radius(c, glssao_map(c->effect, GLSSAO_MAP_DEPTH, NULL, NULL), projection))
            return false;
        if (settings.radius > 0.0f)
            return true;
    }
    return false;
}

bool inject_draw_effect(inject_context *c, unsigned framebuffer, int width, int height)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_up);
    inject_projection projection;
    if (!get_projection(c, framebuffer, width, height, &projection) || !is_on ||
        !inject_prepare_context(c, width, height))
        return false;
    follow_depth_range(&projection);
    if (!compute(c, framebuffer, width, height, &projection))
        return false;
    glssao_apply_options options = glssao_default_apply_options();
    options.framebuffer = framebuffer;
    options.show = inject_get_options()->map;
    if (glssao_apply_with(c->effect, &options) != GLSSAO_OK)
        return false;
    has_drawn = true;
    c->drawn_time = inject_seconds();
    c->drawn_frame = c->frame;
    say_on(c, &projection);
    return true;
}

void inject_end_of_frame(inject_context *c, bool has_effect)
{
    const double now = inject_seconds();
    if (has_effect || !is_on || c->given_up)
        return;
    if (c->said[0] && c->frame - c->drawn_frame >= FRAMES_WITHOUT && now - c->drawn_time >= SECONDS_WITHOUT) {
        c->said[0] = '\0';
        inject_say("off: no scene for %.0f seconds", SECONDS_WITHOUT);
    }
    inject_projection unused;
    /* A program may draw its scene in one context and show it in another. */
    if (!has_drawn && is_long_enough(c) && !get_projection(c, 0, 1, 1, &unused))
        inject_say_once("no projection was seen; GLSSAO_INJECT_FOV, _NEAR and _FAR can tell a perspective one");
}
