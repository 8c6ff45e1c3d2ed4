/* SPDX-License-Identifier: MIT
 *
 * glssao_apply and glssao_apply_with: each option against its formula in double precision, by draws and by dispatches,
 * in each kind of framebuffer; where the result goes; and what is refused or told.
 */
#include "fixture.h"
#include "gl_counter.h"
#include "guest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { W = 64, H = 48 };

/* A room, its accessibility, and textures of the host. */
typedef struct room {
    fixture *f;
    glssao_effect *effect;
    glssao_frame frame;
    glssao_settings settings;
    float *access;
    GLuint strength, albedo;
    float strengths[W * H], albedos[W * H * 3];
} room;

static GLuint make_texture(GLenum format, int width, int height, GLenum components, const float *texels)
{
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)format, width, height, 0, components, GL_FLOAT, texels);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

/* Values from 0 to 1, and three that count as 0, 1 and 0. */
static float strength_at(int i)
{
    return i % 97 == 5 ? -3.0f : i % 97 == 6 ? 7.0f : i % 97 == 7 ? NAN : (float)(i % 11) / 10.0f;
}

static glssao_effect *make_effect(fixture *f, glssao_path path, int width, int height)
{
    glssao_config config = fixture_config(f, width, height);
    gl_counter_start(config.load, config.load_user);
    config.load = gl_counter_load;
    config.path = path;
    glssao_effect *effect = NULL;
    assert_int_equal(glssao_create(&config, &effect), GLSSAO_OK);
    return effect;
}

static room open_room(fixture *f, glssao_path path)
{
    room r = {.f = f, .settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH)};
    analytic_shape shapes[ANALYTIC_ROOM_SHAPES];
    analytic_room(shapes, 1.0);
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    r.frame = fixture_frame(&view, shapes, ANALYTIC_ROOM_SHAPES, W, H);
    r.settings.half_resolution = false;
    r.effect = make_effect(f, path, W, H);
    int w, h;
    r.access = fixture_compute(r.effect, &r.frame, &r.settings, &w, &h);
    assert_true(w == W && h == H);
    for (int i = 0; i < W * H; ++i) {
        r.strengths[i] = strength_at(i);
        for (int k = 0; k < 3; ++k)
            r.albedos[3 * i + k] = (float)((i * (k + 3)) % 17) / 16.0f;
    }
    r.strength = make_texture(GL_R32F, W, H, GL_RED, r.strengths);
    r.albedo = make_texture(GL_RGB32F, W, H, GL_RGB, r.albedos);
    return r;
}

static void close_room(room *r)
{
    glssao_destroy(r->effect);
    fixture_delete_frame(&r->frame);
    gl.DeleteTextures(1, &r->strength);
    gl.DeleteTextures(1, &r->albedo);
    free(r->access);
}

/* ---- a picture to apply to ---- */

static const float before[4] = {0.5f, 0.75f, 0.25f, 0.6f};

typedef struct target {
    GLuint texture, framebuffer;
    int width, height;
} target;

static void clear(const target *t)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    gl.ClearBufferfv(GL_COLOR, 0, before);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

static target make_target(GLenum format, int width, int height)
{
    target t = {.texture = make_texture(format, width, height, GL_RGBA, NULL), .width = width, .height = height};
    gl.GenFramebuffers(1, &t.framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, t.texture, 0);
    clear(&t);
    return t;
}

static void delete_target(target *t)
{
    gl.DeleteFramebuffers(1, &t->framebuffer);
    gl.DeleteTextures(1, &t->texture);
}

/* What the texels hold, without decoding sRGB. */
static float *read_target(const target *t)
{
    float *values = malloc((size_t)(t->width * t->height) * 4 * sizeof *values);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, t->framebuffer);
    gl.ReadPixels(0, 0, t->width, t->height, GL_RGBA, GL_FLOAT, values);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    return values;
}

/* ---- the formulas ---- */

static double unit(double v)
{
    return v > 0.0 ? fmin(v, 1.0) : 0.0;
}

/* Jimenez et al. 2016, section 5. */
static double with_bounces(double a, double albedo)
{
    const double x =
        (2.0404 * albedo - 0.3324) * a * a * a + (-4.7951 * albedo + 0.6417) * a * a + (2.7552 * albedo + 0.6903) * a;
    return fmin(fmax(x, a), 1.0);
}

/* The part of the picture that stays at a pixel. */
static double stays(const room *r, const glssao_apply_options *o, int i, int channel)
{
    double open = (double)r->access[i], strength = (double)o->intensity;
    if (o->albedo_texture)
        open = with_bounces(open, (double)r->albedos[3 * i + channel]);
    if (o->strength_texture)
        strength *= unit((double)r->strengths[i]);
    return 1.0 - strength * (1.0 - open);
}

static double encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

static const struct format {
    const char *name;
    GLenum format;
    double step;      /* between stored values near 1 */
    double brightest; /* what it can hold */
    bool is_image;    /* a compute shader can load and store it */
    bool has_alpha;
} formats[] = {
    {"RGBA8", GL_RGBA8, 1.0 / 255.0, 1.0, true, true},
    {"RGBA16", GL_RGBA16, 1.0 / 65535.0, 1.0, true, true},
    {"RGBA16F", GL_RGBA16F, 1.0 / 1024.0, 1e4, true, true},
    {"RGBA32F", GL_RGBA32F, 1e-5, 1e9, true, true}, /* the step of linear sampling */
    {"RGB10_A2", GL_RGB10_A2, 1.0 / 1023.0, 1.0, true, true},
    {"R11F_G11F_B10F", GL_R11F_G11F_B10F, 1.0 / 32.0, 1e4, true, false},
    {"SRGB8_ALPHA8", GL_SRGB8_ALPHA8, 1.0 / 255.0, 1.0, false, true},
};
enum { FORMATS = sizeof formats / sizeof *formats };

/* All pixels of a picture that was cleared, and applied to in its lower left corner. */
static void check_picture(const room *r, const glssao_apply_options *o, const struct format *format, bool is_linear,
                          const float *got, const char *what)
{
    for (int i = 0; i < W * H; ++i)
        for (int k = 0; k < 4; ++k) {
            const double color = k < 3 ? fmin((double)o->color[k], format->brightest) : 0.0;
            const double part = k < 3 ? stays(r, o, i, k) : 1.0;
            double wanted = (double)before[k] * part + color * (1.0 - part);
            if (!is_linear && k < 3)
                wanted = encode(wanted);
            if (k == 3 && !format->has_alpha)
                wanted = 1.0;
            const double tolerance = (k == 3 && format->format == GL_RGB10_A2 ? 0.34 : 1.5 * format->step) *
                                     (format->brightest > 1.0 ? fmax(wanted, 0.1) : 1.0);
            if (!(fabs((double)got[4 * i + k] - wanted) <= tolerance))
                fail_msg("%s, %s: channel %d of pixel %d is %g, want %g", format->name, what, k, i,
                         (double)got[4 * i + k], wanted);
        }
}

static int last_path(void)
{
    return fixture_hides_newer() ? GLSSAO_PATH_FRAGMENT : GLSSAO_PATH_COMPUTE;
}

static void each_option_follows_its_formula(void **state)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path(); ++path) {
        room r = open_room(*state, (glssao_path)path);
        glssao_apply_options options[8];
        for (int i = 0; i < 8; ++i)
            options[i] = glssao_default_apply_options();
        options[1].intensity = 0.25f;
        options[2].intensity = 0.0f;
        memcpy(options[3].color, (const float[3]){0.25f, 0.75f, 3.0f}, sizeof options[3].color);
        options[4].strength_texture = r.strength;
        options[5].albedo_texture = r.albedo;
        options[6] = options[3];
        options[6].intensity = 0.75f;
        options[6].strength_texture = r.strength;
        options[6].albedo_texture = r.albedo;
        options[7] = options[4];
        memcpy(options[7].rectangle, (const int[4]){0, 0, W, H}, sizeof options[7].rectangle);
        for (int k = 0; k < FORMATS; ++k)
            for (int i = 0; i < 8; ++i) {
                target t = make_target(formats[k].format, W, H);
                char what[64];
                snprintf(what, sizeof what, "path %d, options %d", path, i);
                options[i].framebuffer = t.framebuffer;
                (void)gl_counter_take();
                assert_int_equal(glssao_apply_with(r.effect, &options[i]), GLSSAO_OK);
                const gl_counts counts = gl_counter_take();
                const bool dispatches = path == GLSSAO_PATH_COMPUTE && formats[k].is_image;
                assert_true(counts.dispatches == dispatches && counts.draws == !dispatches && counts.unordered == 0);
                float *got = read_target(&t);
                /* GL_FRAMEBUFFER_SRGB is off: what is stored is multiplied, and was cleared so. */
                check_picture(&r, &options[i], &formats[k], true, got, what);
                free(got);
                delete_target(&t);
            }
        assert_string_equal(r.f->log, "");
        close_room(&r);
    }
}

/* Light is multiplied, so a stored 8-bit code changes by less than the factor. */
static void sRGB_framebuffers_multiply_light_while_the_host_has_them_on(void **state)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path(); ++path) {
        room r = open_room(*state, (glssao_path)path);
        glssao_apply_options options = glssao_default_apply_options();
        memcpy(options.color, (const float[3]){0.0f, 0.25f, 0.5f}, sizeof options.color);
        for (int i = 0; i < 2; ++i) {
            gl.Enable(GL_FRAMEBUFFER_SRGB);
            target t = make_target(GL_SRGB8_ALPHA8, W, H);
            options.framebuffer = t.framebuffer;
            if (i == 0)
                memset(options.color, 0, sizeof options.color);
            else
                options.color[2] = 0.5f;
            assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
            assert_true(gl.IsEnabled(GL_FRAMEBUFFER_SRGB));
            gl.Disable(GL_FRAMEBUFFER_SRGB);
            float *got = read_target(&t);
            check_picture(&r, &options, &formats[FORMATS - 1], false, got, "sRGB on");
            free(got);
            delete_target(&t);
        }
        close_room(&r);
    }
}

/* The formula itself at albedos that the paper plots: none adds nothing, white keeps most of the light. */
static void bounces_brighten_with_albedo(void **state)
{
    (void)state;
    for (int i = 0; i <= 20; ++i) {
        const double a = i / 20.0;
        assert_true(with_bounces(a, 0.0) - a < 0.015 && with_bounces(a, 0.9) >= with_bounces(a, 0.5));
        assert_true(fabs(with_bounces(1.0, a) - 1.0) < 1e-3);
    }
    assert_true(with_bounces(0.5, 0.9) > 0.68);
}

/* ---- where it goes ---- */

/* Fails where a pixel inside is not before x access[shift], or one outside has changed. */
static void check_place(const float *got, int width, int height, const int place[4], const float *access,
                        const char *what)
{
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool inside = x >= place[0] && y >= place[1] && x < place[0] + place[2] && y < place[1] + place[3];
            const float part = inside ? access[(y - place[1]) * place[2] + x - place[0]] : 1.0f;
            const float value = got[4 * (y * width + x)];
            if (!(fabsf(value - before[0] * part) < 1e-5f))
                fail_msg("%s: pixel %d, %d is %g, want %g", what, x, y, (double)value, (double)(before[0] * part));
        }
}

static void rectangle_places_and_stretches(void **state)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path(); ++path) {
        room r = open_room(*state, (glssao_path)path);
        target t = make_target(GL_RGBA32F, 3 * W, 2 * H);
        glssao_apply_options options = glssao_default_apply_options();
        options.framebuffer = t.framebuffer;
        const int place[4] = {W + 5, 7, W, H};
        memcpy(options.rectangle, place, sizeof place);
        assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
        float *got = read_target(&t);
        check_place(got, t.width, t.height, place, r.access, "rectangle");
        free(got);

        clear(&t);
        const int wide[4] = {3, 0, 2 * W, H};
        float *stretched = malloc((size_t)(2 * W * H) * sizeof *stretched);
        for (int i = 0; i < 2 * W * H; ++i) {
            const int x = i % (2 * W), y = i / (2 * W), near = x / 2, other = near + (x % 2 ? 1 : -1);
            const int clamped = other < 0 ? 0 : other >= W ? W - 1 : other;
            stretched[i] = 0.75f * r.access[y * W + near] + 0.25f * r.access[y * W + clamped];
        }
        memcpy(options.rectangle, wide, sizeof wide);
        assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
        got = read_target(&t);
        for (int i = 0; i < 2 * W * H; ++i) { /* linear filters have 8 bits of fraction at least */
            const double wanted = (double)(before[0] * stretched[i]);
            assert_float_equal(got[4 * (i / (2 * W) * t.width + i % (2 * W) + 3)], wanted, 2e-3);
        }
        free(stretched);
        free(got);
        delete_target(&t);
        close_room(&r);
    }
}

/* Four views of one depth texture and one picture: each receives its own occlusion, with a strength texture alike. */
static void four_views_in_one_framebuffer(void **state)
{
    analytic_shape shapes[ANALYTIC_ROOM_SHAPES];
    analytic_room(shapes, 1.0);
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path(); ++path) {
        glssao_effect *effect = make_effect(*state, (glssao_path)path, W, H);
        glssao_settings settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH);
        settings.half_resolution = false;
        float *depth = malloc(4 * W * H * sizeof *depth), *strengths = malloc(4 * W * H * sizeof *strengths);
        analytic_view views[4];
        for (int i = 0; i < 4; ++i) {
            views[i] = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
            views[i].projection[0] *= 1.0f + 0.3f * (float)i;
            float *part, *normals;
            analytic_render(&views[i], shapes, ANALYTIC_ROOM_SHAPES, W, H, &part, &normals);
            for (int k = 0; k < W * H; ++k)
                depth[((k / W) + i / 2 * H) * 2 * W + k % W + i % 2 * W] = part[k];
            free(part);
            free(normals);
        }
        for (int i = 0; i < 4 * W * H; ++i)
            strengths[i] = (float)(i % 13) / 12.0f;
        const GLuint atlas = fixture_depth_texture(GL_DEPTH_COMPONENT32F, 2 * W, 2 * H, depth);
        const GLuint strength = make_texture(GL_R32F, 2 * W, 2 * H, GL_RED, strengths);
        target plain = make_target(GL_RGBA32F, 2 * W, 2 * H), weighted = make_target(GL_RGBA32F, 2 * W, 2 * H);
        float *wanted[4];
        for (int i = 0; i < 4; ++i) {
            glssao_frame frame = {.depth_texture = atlas, .viewport = {i % 2 * W, i / 2 * H, W, H}};
            memcpy(frame.projection, views[i].projection, sizeof frame.projection);
            int w, h;
            wanted[i] = fixture_compute(effect, &frame, &settings, &w, &h);
            assert_int_equal(glssao_apply(effect, plain.framebuffer), GLSSAO_OK);
            glssao_apply_options options = glssao_default_apply_options();
            options.framebuffer = weighted.framebuffer;
            options.strength_texture = strength;
            assert_int_equal(glssao_apply_with(effect, &options), GLSSAO_OK);
        }
        float *got = read_target(&plain), *got_weighted = read_target(&weighted);
        for (int y = 0; y < 2 * H; ++y)
            for (int x = 0; x < 2 * W; ++x) {
                const int at = y * 2 * W + x;
                const float a = wanted[y / H * 2 + x / W][y % H * W + x % W];
                assert_float_equal(got[4 * at], before[0] * a, 1e-5f);
                assert_float_equal(got_weighted[4 * at], before[0] * (1.0f - strengths[at] * (1.0f - a)), 1e-5f);
            }
        for (int i = 0; i < 4; ++i)
            free(wanted[i]);
        free(got);
        free(got_weighted);
        free(depth);
        free(strengths);
        delete_target(&plain);
        delete_target(&weighted);
        gl.DeleteTextures(1, &atlas);
        gl.DeleteTextures(1, &strength);
        glssao_destroy(effect);
    }
}

/* A picture without its margin goes to the corner; the strength texture has the margin. */
static void margin_shifts_the_strength_texture(void **state)
{
    enum { M = 8, PW = W - 2 * M, PH = H - 2 * M };
    room r = open_room(*state, GLSSAO_PATH_FRAGMENT);
    r.frame.margin = M;
    int w, h;
    float *inner = fixture_compute(r.effect, &r.frame, &r.settings, &w, &h);
    assert_true(w == PW && h == PH);
    target t = make_target(GL_RGBA32F, W, H);
    glssao_apply_options options = glssao_default_apply_options();
    options.framebuffer = t.framebuffer;
    options.strength_texture = r.strength;
    assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
    for (int i = 0; i < PW * PH; ++i)
        inner[i] = 1.0f - (float)unit((double)r.strengths[(i / PW + M) * W + i % PW + M]) * (1.0f - inner[i]);
    float *got = read_target(&t);
    check_place(got, W, H, (const int[4]){0, 0, PW, PH}, inner, "margin");
    free(got);
    free(inner);
    delete_target(&t);
    close_room(&r);
}

static void show_replaces_the_picture(void **state)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path(); ++path) {
        room r = open_room(*state, (glssao_path)path);
        target t = make_target(GL_RGBA32F, W, H);
        glssao_apply_options options = glssao_default_apply_options();
        options.framebuffer = t.framebuffer;
        options.show = true;
        options.color[0] = 0.5f; /* has no say */
        assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
        float *got = read_target(&t);
        for (int i = 0; i < W * H; ++i) {
            for (int k = 0; k < 3; ++k)
                assert_float_equal(got[4 * i + k], r.access[i], 1e-5f);
            assert_float_equal(got[4 * i + 3], before[3], 0.0f);
        }
        free(got);
        delete_target(&t);
        close_room(&r);
    }
}

/* ---- the host's tests ---- */

static void add_stencil(const fixture *f, const target *t, GLuint *out_renderbuffer)
{
    PFNGLCLEARBUFFERIVPROC clear_buffer;
    guest_load(f, "glClearBufferiv", &clear_buffer);
    gl.GenRenderbuffers(1, out_renderbuffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, *out_renderbuffer);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, t->width, t->height);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, *out_renderbuffer);
    clear_buffer(GL_STENCIL, 0, (const GLint[]){0});
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, 0, W, H / 2);
    clear_buffer(GL_STENCIL, 0, (const GLint[]){1});
    gl.Disable(GL_SCISSOR_TEST);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

static int count_lines(const char *log, const char *word)
{
    int count = 0;
    for (const char *at = strstr(log, word); at; at = strstr(at + 1, word))
        ++count;
    return count;
}

/* Pixels where x < W / 2 pass the scissor test, those where y < H / 2 the stencil test. */
static void tests_of_the_host_are_kept_on_request_and_ignored_once_told(void **state)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path(); ++path) {
        room r = open_room(*state, (glssao_path)path);
        target t = make_target(GL_RGBA32F, W, H);
        GLuint stencil;
        add_stencil(r.f, &t, &stencil);
        for (int i = 0; i < 8; ++i) {
            glssao_apply_options options = glssao_default_apply_options();
            options.framebuffer = t.framebuffer;
            options.keep_scissor = i & 1;
            options.keep_stencil = i & 2;
            clear(&t);
            gl.Enable(GL_SCISSOR_TEST);
            gl.Scissor(0, 0, W / 2, H);
            gl.Enable(GL_STENCIL_TEST);
            gl.StencilFunc(GL_EQUAL, 1, 0xFF);
            assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
            assert_true(gl.IsEnabled(GL_SCISSOR_TEST) && gl.IsEnabled(GL_STENCIL_TEST));
            gl.Disable(GL_SCISSOR_TEST);
            gl.Disable(GL_STENCIL_TEST);
            float *got = read_target(&t);
            for (int k = 0; k < W * H; ++k) {
                const bool passes =
                    (!options.keep_scissor || k % W < W / 2) && (!options.keep_stencil || k / W < H / 2);
                assert_float_equal(got[4 * k], before[0] * (passes ? r.access[k] : 1.0f), 1e-5f);
            }
            free(got);
        }
        assert_int_equal(count_lines(r.f->log, "GL_SCISSOR_TEST is on and ignored"), 1);
        assert_int_equal(count_lines(r.f->log, "GL_STENCIL_TEST is on and ignored"), 1);
        assert_int_equal(count_lines(r.f->log, "\n"), 2);
        gl.StencilFunc(GL_ALWAYS, 0, 0xFF);
        gl.DeleteRenderbuffers(1, &stencil);
        delete_target(&t);
        fixture_clear_log(r.f);
        close_room(&r);
    }
}

static void other_state_that_has_no_effect_is_told_once(void **state)
{
    room r = open_room(*state, GLSSAO_PATH_FRAGMENT);
    target t = make_target(GL_RGBA32F, 2 * W, H);
    glssao_apply_options placed = glssao_default_apply_options();
    placed.framebuffer = t.framebuffer;
    memcpy(placed.rectangle, (const int[4]){0, 0, W, H}, sizeof placed.rectangle);
    gl.Viewport(W, 0, W, H); /* a second view, which the host forgot to name */
    assert_int_equal(glssao_apply_with(r.effect, &placed), GLSSAO_OK);
    assert_string_equal(r.f->log, "");
    for (int i = 0; i < 3; ++i)
        assert_int_equal(glssao_apply(r.effect, t.framebuffer), GLSSAO_OK);
    assert_int_equal(count_lines(r.f->log, "glViewport lies elsewhere"), 1);
    gl.ColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE); /* the left eye of an anaglyph */
    for (int i = 0; i < 2; ++i)
        assert_int_equal(glssao_apply(r.effect, t.framebuffer), GLSSAO_OK);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    assert_int_equal(count_lines(r.f->log, "glColorMask"), 1);
    assert_int_equal(count_lines(r.f->log, "\n"), 2);
    gl.Viewport(0, 0, W, H);
    fixture_clear_log(r.f);
    delete_target(&t);
    close_room(&r);
}

/* ---- what can't be ---- */

static void bad_options_are_named_and_change_nothing(void **state)
{
    room r = open_room(*state, GLSSAO_PATH_FRAGMENT);
    target t = make_target(GL_RGBA32F, W, H);
    const GLuint small = make_texture(GL_R8, W / 2, H, GL_RED, NULL);
    GLuint integer, array;
    gl.GenTextures(1, &integer);
    gl.BindTexture(GL_TEXTURE_2D, integer);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8UI, W, H, 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, NULL);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.GenTextures(1, &array);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, array);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, 0);
    glssao_apply_options good = glssao_default_apply_options(), o;
    good.framebuffer = t.framebuffer;
#define REFUSED(member, value, text)                                                                                   \
    do {                                                                                                               \
        o = good;                                                                                                      \
        o.member = value;                                                                                              \
        clear(&t);                                                                                                     \
        fixture_clear_log(r.f);                                                                                        \
        if (glssao_apply_with(r.effect, &o) != GLSSAO_INVALID_ARGUMENT || !strstr(r.f->log, text) ||                   \
            count_lines(r.f->log, "\n") != 1)                                                                          \
            fail_msg("%s = %s: %s", #member, #value, r.f->log);                                                        \
        float *got = read_target(&t);                                                                                  \
        for (int i = 0; i < W * H; ++i)                                                                                \
            assert_memory_equal(got + 4 * i, before, sizeof before);                                                   \
        free(got);                                                                                                     \
    } while (0)
    REFUSED(intensity, NAN, "options.intensity = nan: want 0 to 1");
    REFUSED(intensity, -0.01f, "options.intensity = -0.01");
    REFUSED(intensity, 1.01f, "options.intensity = 1.01");
    REFUSED(color[0], -1.0f, "options.color[0] = -1");
    REFUSED(color[1], NAN, "options.color[1] = nan");
    REFUSED(color[2], INFINITY, "options.color[2] = inf");
    REFUSED(rectangle[0], -1, "options.rectangle[0] = -1: less than 0");
    REFUSED(rectangle[1], -5, "options.rectangle[1] = -5: less than 0");
    REFUSED(rectangle[2], W, "options.rectangle[3] = 0"); /* a width alone */
    REFUSED(rectangle[3], H, "options.rectangle[2] = 0");
    REFUSED(rectangle[2], -W, "options.rectangle[2] = -64");
    REFUSED(rectangle[2], 2147483647, "options.rectangle[2] = 2147483647");
    REFUSED(rectangle[0], 2147483647, "options.rectangle[2] = 0");
    REFUSED(strength_texture, 987654, "options.strength_texture = 987654: no texture of this context");
    REFUSED(strength_texture, small, "not of the full size");
    REFUSED(strength_texture, integer, "an integer format");
    REFUSED(strength_texture, array, "not a GL_TEXTURE_2D");
    REFUSED(strength_texture, t.texture, "options.strength_texture is attached");
    REFUSED(albedo_texture, 987654, "options.albedo_texture = 987654: no texture of this context");
    REFUSED(albedo_texture, t.texture, "options.albedo_texture is attached");
    REFUSED(framebuffer, 4242, "framebuffer = 4242: no framebuffer of this context");
#undef REFUSED
    fixture_clear_log(r.f);
    assert_int_equal(glssao_apply_with(r.effect, NULL), GLSSAO_INVALID_ARGUMENT);
    assert_string_equal(r.f->log, "options is NULL\n");
    assert_int_equal(glssao_apply_with(NULL, &good), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_apply_with(r.effect, &good), GLSSAO_OK); /* still usable */
    gl.DeleteTextures(1, &small);
    gl.DeleteTextures(1, &integer);
    gl.DeleteTextures(1, &array);
    delete_target(&t);
    fixture_clear_log(r.f);
    close_room(&r);
}

/* A strength texture with another swizzle and base level reads as if it had none, and keeps both. */
static void parameters_of_the_strength_texture_are_lent(void **state)
{
    room r = open_room(*state, GLSSAO_PATH_FRAGMENT);
    target t = make_target(GL_RGBA32F, W, H);
    PFNGLGETTEXPARAMETERIVPROC get;
    guest_load(r.f, "glGetTexParameteriv", &get);
    gl.BindTexture(GL_TEXTURE_2D, r.strength);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, GL_ZERO);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 3);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    glssao_apply_options options = glssao_default_apply_options();
    options.framebuffer = t.framebuffer;
    options.strength_texture = r.strength;
    assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
    float *got = read_target(&t);
    check_picture(&r, &options, &formats[3], true, got, "lent parameters");
    GLint red, base;
    gl.BindTexture(GL_TEXTURE_2D, r.strength);
    get(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, &red);
    get(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, &base);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    assert_true(red == GL_ZERO && base == 3);
    free(got);
    delete_target(&t);
    close_room(&r);
}

/* ---- pictures that a compute shader can't write are drawn ---- */

enum unusual { RENDERBUFFER, SECOND_LEVEL, NO_MIPMAPS, SECOND_ATTACHMENT, NO_DRAW_BUFFER, UNUSUAL };

/* *out_level: of the texture; *out_texture is 0 for a renderbuffer. */
static GLuint make_unusual(enum unusual kind, GLuint *out_texture, GLuint *out_renderbuffer)
{
    GLuint framebuffer;
    *out_renderbuffer = *out_texture = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    if (kind == RENDERBUFFER) {
        gl.GenRenderbuffers(1, out_renderbuffer);
        gl.BindRenderbuffer(GL_RENDERBUFFER, *out_renderbuffer);
        gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, W, H);
        gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, *out_renderbuffer);
        return framebuffer;
    }
    const int level = kind == SECOND_LEVEL;
    *out_texture = make_texture(GL_RGBA8, W << level, H << level, GL_RGBA, NULL);
    gl.BindTexture(GL_TEXTURE_2D, *out_texture);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level);
    if (level)
        gl.TexImage2D(GL_TEXTURE_2D, 1, GL_RGBA8, W, H, 0, GL_RGBA, GL_FLOAT, NULL);
    if (kind == NO_MIPMAPS) {
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 1000);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_LINEAR);
    }
    gl.BindTexture(GL_TEXTURE_2D, 0);
    const GLenum point = GL_COLOR_ATTACHMENT0 + (kind == SECOND_ATTACHMENT);
    const GLenum draws = kind == NO_DRAW_BUFFER ? GL_NONE : point;
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, *out_texture, level);
    gl.DrawBuffers(1, &draws);
    gl.ReadBuffer(point);
    return framebuffer;
}

static GLint min_filter(const fixture *f, GLuint texture)
{
    PFNGLGETTEXPARAMETERIVPROC get;
    GLint filter = 0;
    guest_load(f, "glGetTexParameteriv", &get);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    get(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, &filter);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return filter;
}

static void unusual_targets_get_the_same_picture(void **state)
{
    static const bool dispatches[UNUSUAL] = {[NO_MIPMAPS] = true, [SECOND_ATTACHMENT] = true};
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path(); ++path) {
        room r = open_room(*state, (glssao_path)path);
        for (int kind = 0; kind < UNUSUAL; ++kind) {
            GLuint texture, renderbuffer;
            target t = {
                .framebuffer = make_unusual((enum unusual)kind, &texture, &renderbuffer), .width = W, .height = H};
            const GLenum draws = kind == SECOND_ATTACHMENT ? GL_COLOR_ATTACHMENT1 : GL_COLOR_ATTACHMENT0;
            const GLenum none = GL_NONE;
            gl.DrawBuffers(1, &draws);
            clear(&t);
            gl.BindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
            if (kind == NO_DRAW_BUFFER)
                gl.DrawBuffers(1, &none);
            gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
            (void)gl_counter_take();
            if (glssao_apply(r.effect, t.framebuffer) != GLSSAO_OK)
                fail_msg("target %d: %s", kind, r.f->log);
            assert_int_equal(gl_counter_take().dispatches, path == GLSSAO_PATH_COMPUTE && dispatches[kind]);
            glssao_apply_options options = glssao_default_apply_options();
            if (kind == NO_DRAW_BUFFER)
                options.intensity = 0.0f; /* for the formula: nothing is drawn into */
            float *got = read_target(&t);
            check_picture(&r, &options, &formats[0], true, got, "unusual target");
            free(got);
            if (kind == NO_MIPMAPS)
                assert_int_equal(min_filter(r.f, texture), GL_NEAREST_MIPMAP_LINEAR); /* lent, and given back */
            gl.DeleteFramebuffers(1, &t.framebuffer);
            gl.DeleteTextures(1, &texture);
            gl.DeleteRenderbuffers(1, &renderbuffer);
        }
        close_room(&r);
    }
}

int main(void)
{
#define GL_TEST(test) cmocka_unit_test_setup_teardown(test, NULL, fixture_no_gl_error)
    const struct CMUnitTest tests[] = {
        GL_TEST(each_option_follows_its_formula),
        GL_TEST(sRGB_framebuffers_multiply_light_while_the_host_has_them_on),
        GL_TEST(bounces_brighten_with_albedo),
        GL_TEST(rectangle_places_and_stretches),
        GL_TEST(four_views_in_one_framebuffer),
        GL_TEST(margin_shifts_the_strength_texture),
        GL_TEST(show_replaces_the_picture),
        GL_TEST(tests_of_the_host_are_kept_on_request_and_ignored_once_told),
        GL_TEST(other_state_that_has_no_effect_is_told_once),
        GL_TEST(bad_options_are_named_and_change_nothing),
        GL_TEST(parameters_of_the_strength_texture_are_lent),
        GL_TEST(unusual_targets_get_the_same_picture),
    };
    return cmocka_run_group_tests(tests, fixture_setup, fixture_teardown);
}
