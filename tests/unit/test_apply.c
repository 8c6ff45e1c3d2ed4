/* SPDX-License-Identifier: MIT
 *
 * glssao_apply and glssao_apply_with: each option against its formula in double precision, by draws and by dispatches,
 * in each kind of framebuffer.
 */
#include "apply_room.h"
#include "gl_counter.h"
#include "guest.h"

enum { W = APPLY_W, H = APPLY_H };

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
static double stays(const apply_room *r, const glssao_apply_options *o, int i, int channel)
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

/* How far a picture that is multiplied in linear light may be off in its sRGB code. It is encoded twice, when it is
 * cleared and when it is stored. A conversion to integers may miss by 0.6 steps (Direct3D's
 * FLOAT32_TO_INTEGER_TOLERANCE_IN_ULP; OpenGL states none), and the first miss shrinks as the picture darkens. In
 * between, OpenGL asks the blender for no more bits than the picture has: the source may be rounded to 8 bits, and in
 * half floats its complement, the picture and two products by 2^-12 at most each, as none exceeds 1. The slope of the
 * code carries that over, up to 12.92 near black. Measured on an H200: 1.52 steps. */
static double srgb_tolerance(double linear)
{
    const double slope = linear <= 0.0031308 ? 12.92 : 1.055 / 2.4 * pow(linear, 1.0 / 2.4 - 1.0);
    return (0.6 + 0.6) / 255.0 + slope * (0.5 / 255.0 + 4.0 * 0x1p-12);
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
static void check_picture(const apply_room *r, const glssao_apply_options *o, const struct format *format,
                          bool is_linear, const float *got, const char *what)
{
    for (int i = 0; i < W * H; ++i)
        for (int k = 0; k < 4; ++k) {
            const double color = k < 3 ? fmin((double)o->color[k], format->brightest) : 0.0;
            const double part = k < 3 ? stays(r, o, i, k) : 1.0;
            const double linear = (double)apply_before[k] * part + color * (1.0 - part);
            const bool is_encoded = !is_linear && k < 3;
            double wanted = is_encoded ? encode(linear) : linear;
            if (k == 3 && !format->has_alpha)
                wanted = 1.0;
            double tolerance = (k == 3 && format->format == GL_RGB10_A2 ? 0.34 : 1.5 * format->step) *
                               (format->brightest > 1.0 ? fmax(wanted, 0.1) : 1.0);
            if (is_encoded)
                tolerance = srgb_tolerance(linear);
            if (!(fabs((double)got[4 * i + k] - wanted) <= tolerance))
                fail_msg("%s, %s: channel %d of pixel %d is %g, want %g", format->name, what, k, i,
                         (double)got[4 * i + k], wanted);
        }
}

TEST_GL(each_option_follows_its_formula)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= apply_last_path(); ++path) {
        SCOPED(room) apply_room r = apply_open_room(f, (glssao_path)path);
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
                SCOPED(applied) apply_target t = apply_make_target(formats[k].format, W, H);
                char what[64];
                snprintf(what, sizeof what, "path %d, options %d", path, i);
                options[i].framebuffer = t.framebuffer;
                (void)gl_counter_take();
                assert_int_equal(glssao_apply_with(r.effect, &options[i]), GLSSAO_OK);
                const gl_counts counts = gl_counter_take();
                const bool dispatches = path == GLSSAO_PATH_COMPUTE && formats[k].is_image;
                assert_true(counts.dispatches == dispatches && counts.draws == !dispatches && counts.unordered == 0);
                assert_int_equal(glssao_get_stats(r.effect).passes[GLSSAO_PASS_APPLY].draw_calls, 1);
                SCOPED(memory) float *got = apply_read_target(&t);
                /* GL_FRAMEBUFFER_SRGB is off: what is stored is multiplied, and was cleared so. */
                check_picture(&r, &options[i], &formats[k], true, got, what);
            }
        assert_string_equal(r.f->log, "");
    }
}

/* Light is multiplied, so a stored 8-bit code changes by less than the factor. */
TEST_GL(sRGB_framebuffers_multiply_light_while_the_host_has_them_on)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= apply_last_path(); ++path) {
        SCOPED(room) apply_room r = apply_open_room(f, (glssao_path)path);
        glssao_apply_options options = glssao_default_apply_options();
        memcpy(options.color, (const float[3]){0.0f, 0.25f, 0.5f}, sizeof options.color);
        for (int i = 0; i < 2; ++i) {
            gl.Enable(GL_FRAMEBUFFER_SRGB);
            SCOPED(applied) apply_target t = apply_make_target(GL_SRGB8_ALPHA8, W, H);
            options.framebuffer = t.framebuffer;
            if (i == 0)
                memset(options.color, 0, sizeof options.color);
            else
                options.color[2] = 0.5f;
            assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
            assert_true(gl.IsEnabled(GL_FRAMEBUFFER_SRGB));
            gl.Disable(GL_FRAMEBUFFER_SRGB);
            SCOPED(memory) float *got = apply_read_target(&t);
            check_picture(&r, &options, &formats[FORMATS - 1], false, got, "sRGB on");
        }
    }
}

/* The formula itself at albedos that the paper plots: none adds nothing, white keeps most of the light. */
TEST_GL(bounces_brighten_with_albedo)
{
    for (int i = 0; i <= 20; ++i) {
        const double a = i / 20.0;
        assert_true(with_bounces(a, 0.0) - a < 0.015 && with_bounces(a, 0.9) >= with_bounces(a, 0.5));
        assert_true(fabs(with_bounces(1.0, a) - 1.0) < 1e-3);
    }
    assert_true(with_bounces(0.5, 0.9) > 0.68);
}

TEST_GL(show_replaces_the_picture)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= apply_last_path(); ++path) {
        SCOPED(room) apply_room r = apply_open_room(f, (glssao_path)path);
        SCOPED(applied) apply_target t = apply_make_target(GL_RGBA32F, W, H);
        glssao_apply_options options = glssao_default_apply_options();
        options.framebuffer = t.framebuffer;
        options.show = true;
        options.color[0] = 0.5f; /* has no say */
        assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
        SCOPED(memory) float *got = apply_read_target(&t);
        for (int i = 0; i < W * H; ++i) {
            for (int k = 0; k < 3; ++k)
                assert_float_equal(got[4 * i + k], r.access[i], 1e-5f);
            assert_float_equal(got[4 * i + 3], apply_before[3], 0.0f);
        }
    }
}

/* A strength texture with another swizzle and base level reads as if it had none, and keeps both. */
TEST_GL(parameters_of_the_strength_texture_are_lent)
{
    SCOPED(room) apply_room r = apply_open_room(f, GLSSAO_PATH_FRAGMENT);
    SCOPED(applied) apply_target t = apply_make_target(GL_RGBA32F, W, H);
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
    SCOPED(memory) float *got = apply_read_target(&t);
    check_picture(&r, &options, &formats[3], true, got, "lent parameters");
    GLint red, base;
    gl.BindTexture(GL_TEXTURE_2D, r.strength);
    get(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, &red);
    get(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, &base);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    assert_true(red == GL_ZERO && base == 3);
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
    *out_texture = gl_make_texture(GL_RGBA8, GL_RGBA, GL_FLOAT, W << level, H << level, NULL);
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

TEST_GL(unusual_targets_get_the_same_picture)
{
    static const bool dispatches[UNUSUAL] = {[NO_MIPMAPS] = true, [SECOND_ATTACHMENT] = true};
    for (int path = GLSSAO_PATH_FRAGMENT; path <= apply_last_path(); ++path) {
        apply_room r = apply_open_room(f, (glssao_path)path);
        for (int kind = 0; kind < UNUSUAL; ++kind) {
            GLuint texture, renderbuffer;
            apply_target t = {
                .framebuffer = make_unusual((enum unusual)kind, &texture, &renderbuffer), .width = W, .height = H};
            const GLenum draws = kind == SECOND_ATTACHMENT ? GL_COLOR_ATTACHMENT1 : GL_COLOR_ATTACHMENT0;
            const GLenum none = GL_NONE;
            gl.DrawBuffers(1, &draws);
            apply_clear(&t);
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
            SCOPED(memory) float *got = apply_read_target(&t);
            check_picture(&r, &options, &formats[0], true, got, "unusual target");
            if (kind == NO_MIPMAPS)
                assert_int_equal(min_filter(r.f, texture), GL_NEAREST_MIPMAP_LINEAR); /* lent, and given back */
            gl.DeleteFramebuffers(1, &t.framebuffer);
            gl.DeleteTextures(1, &texture);
            gl.DeleteRenderbuffers(1, &renderbuffer);
        }
        apply_close_room(&r);
    }
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
