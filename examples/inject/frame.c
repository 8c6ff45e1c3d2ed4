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

enum {
    CONTEXTS = 16,
    FRAMES_TO_FIND_A_PROJECTION = 60,
    FRAMES_PER_RADIUS = 60,
    FRAMES_PER_LOOK = 10,
    SAMPLES = 4096,
    REASONS = 16
};

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

#define REAL(type, name)                                                                                               \
    type name;                                                                                                         \
    do {                                                                                                               \
        void *address_ = inject_real("gl" #name, NULL);                                                                \
        memcpy(&name, &address_, sizeof address_);                                                                     \
    } while (0)

static bool prepare(target *t, int width, int height)
{
    if (!t->effect) {
        glssao_config config = {
            .load = inject_real, .log = log_line, .width = width, .height = height, .no_timers = true};
        glssao_result result = glssao_create(&config, &t->effect);
        t->depth = result == GLSSAO_OK ? window_depth_create(inject_real, NULL) : NULL;
        if (!t->depth) {
            REAL(PFNGLGETSTRINGPROC, GetString);
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

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Reads the depth texture back, whatever the program set for packing. The caller frees. */
static float *read_depth(GLuint texture, int width, int height)
{
    REAL(PFNGLGETINTEGERVPROC, GetIntegerv);
    REAL(PFNGLPIXELSTOREIPROC, PixelStorei);
    REAL(PFNGLBINDBUFFERPROC, BindBuffer);
    REAL(PFNGLBINDTEXTUREPROC, BindTexture);
    REAL(PFNGLGETTEXIMAGEPROC, GetTexImage);
    static const GLenum names[] = {GL_PACK_SWAP_BYTES, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
                                   GL_PACK_ALIGNMENT};
    float *depth = malloc((size_t)width * (size_t)height * sizeof *depth);
    if (!depth)
        return NULL;
    GLint packing[5], buffer, bound;
    for (int i = 0; i < 5; ++i) {
        GetIntegerv(names[i], &packing[i]);
        PixelStorei(names[i], i == 4 ? 4 : 0);
    }
    GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer);
    GetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    BindTexture(GL_TEXTURE_2D, texture);
    GetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
    BindTexture(GL_TEXTURE_2D, (GLuint)bound);
    BindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)buffer);
    for (int i = 0; i < 5; ++i)
        PixelStorei(names[i], packing[i]);
    return depth;
}

/* A twelfth of the height that is in view at the median distance of what is seen; 0 where nothing is. */
static float fitting_radius(GLuint texture, int width, int height, const float p[16])
{
    float *depth = read_depth(texture, width, height);
    size_t count = 0, all = (size_t)width * (size_t)height;
    const size_t step = all > SAMPLES ? all / SAMPLES : 1;
    for (size_t i = 0; depth && i < all; i += step) {
        const float distance = p[14] / (2.0f * depth[i] - 1.0f + p[10]);
        if (depth[i] > 0.0f && depth[i] < 1.0f && isfinite(distance) && distance > 0.0f) /* 0: never cleared */
            depth[count++] = distance;
    }
    float radius = 0.0f;
    if (count > all / step / 200) {
        qsort(depth, count, sizeof *depth, compare_floats);
        radius = depth[count / 2] * 2.0f / p[5] / 12.0f;
    }
    free(depth);
    return radius;
}

static bool get_projection(const target *t, GLuint framebuffer, float projection[16])
{
    const inject_options *o = inject_get_options();
    const bool found = inject_get_projection(framebuffer, projection);
    if (o->fov > 0.0f) {
        const float focal = 1.0f / tanf(o->fov * 3.14159265f / 360.0f), n = o->near_plane, f = o->far_plane;
        memset(projection, 0, 16 * sizeof *projection);
        projection[0] = focal * (float)t->height / (float)t->width;
        projection[5] = focal;
        projection[10] = (f + n) / (n - f);
        projection[11] = -1.0f;
        projection[14] = 2.0f * f * n / (n - f);
        return true;
    }
    if (!found && t->frame >= FRAMES_TO_FIND_A_PROJECTION)
        say_once("no perspective projection was seen; GLSSAO_INJECT_FOV, _NEAR and _FAR can tell it");
    return found;
}

static void show_map_alone(GLuint framebuffer)
{
    REAL(PFNGLGETFLOATVPROC, GetFloatv);
    REAL(PFNGLCLEARCOLORPROC, ClearColor);
    REAL(PFNGLCLEARPROC, Clear);
    REAL(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer);
    REAL(PFNGLGETINTEGERVPROC, GetIntegerv);
    GLfloat color[4];
    GLint bound;
    GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    GetFloatv(GL_COLOR_CLEAR_VALUE, color);
    BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    ClearColor(1.0f, 1.0f, 1.0f, 1.0f);
    Clear(GL_COLOR_BUFFER_BIT);
    ClearColor(color[0], color[1], color[2], color[3]);
    BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)bound);
}

/* Into the window, 0, or a framebuffer of the program's own; false where nothing was drawn. */
static bool draw_effect(target *t, GLuint framebuffer)
{
    const inject_options *o = inject_get_options();
    float projection[16];
    if (!get_projection(t, framebuffer, projection) || !is_on)
        return false;
    const char *why = NULL;
    const GLuint depth = window_depth_copy(t->depth, framebuffer, t->width, t->height, &why);
    if (!depth) {
        say_once(why);
        return false;
    }
    if (o->radius > 0.0f)
        t->radius = o->radius;
    else if (t->frame % (t->radius > 0.0f ? FRAMES_PER_RADIUS : FRAMES_PER_LOOK) == 1) {
        const float radius = fitting_radius(depth, t->width, t->height, projection);
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
    glssao_frame frame = {.depth_texture = depth};
    memcpy(frame.projection, projection, sizeof frame.projection);
    if (glssao_compute(t->effect, &frame, &settings) != GLSSAO_OK)
        return false;
    if (o->map)
        show_map_alone(framebuffer);
    if (glssao_apply(t->effect, framebuffer) != GLSSAO_OK)
        return false;
    if (!t->works) {
        t->works = true;
        const float far_plane = projection[14] / (projection[10] + 1.0f);
        inject_say("on: %d x %d, field of view %.1f degrees, near %g, far %g, radius %g", t->width, t->height,
                   (double)(atanf(1.0f / projection[5]) * 114.591559f),
                   (double)(projection[14] / (projection[10] - 1.0f)), far_plane > 0.0f ? (double)far_plane : HUGE_VAL,
                   (double)t->radius);
    }
    return true;
}

/* The window's back buffer as a PPM, for tests and documents. What it sets stays set: the program ends after it. */
static bool write_picture(const char *path, int width, int height)
{
    REAL(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer);
    REAL(PFNGLPIXELSTOREIPROC, PixelStorei);
    REAL(PFNGLREADPIXELSPROC, ReadPixels);
    REAL(PFNGLREADBUFFERPROC, ReadBuffer);
    const size_t count = (size_t)width * (size_t)height, row = (size_t)width * 3;
    unsigned char *rgb = malloc(4 * count); /* read as RGBA, which embedded contexts insist on */
    FILE *file = fopen(path, "wb");
    if (rgb && file) {
        BindFramebuffer(GL_FRAMEBUFFER, 0);
        ReadBuffer(GL_BACK);
        PixelStorei(GL_PACK_ALIGNMENT, 1);
        ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgb);
        for (size_t i = 0; i < count; ++i)
            memmove(rgb + 3 * i, rgb + 4 * i, 3);
        fprintf(file, "P6 %d %d 255\n", width, height);
        for (int y = height; y-- > 0;)
            fwrite(rgb + row * (size_t)y, row, 1, file);
    }
    const bool ok = rgb && file && fclose(file) == 0;
    free(rgb);
    if (!ok)
        inject_say("%s can't be written", path);
    return ok;
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
    float unused[16]; /* a framebuffer that was not drawn anew must not be darkened once more */
    if (!t->is_drawn && inject_get_projection(framebuffer, unused) && is_ready(t, width, height))
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
    const bool ok = !is_last || !o->before || write_picture(o->before, width, height);
    if (!t->is_drawn && is_ready(t, width, height))
        draw_effect(t, 0);
    t->is_drawn = false;
    inject_end_frame();
    if (is_last)
        _Exit(write_picture(o->picture, width, height) && ok ? 0 : 1);
    pthread_mutex_unlock(&lock);
}
