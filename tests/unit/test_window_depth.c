/* SPDX-License-Identifier: MIT
 *
 * examples/dropin/window_depth: the depth of a framebuffer arrives in the texture, for every depth format, with and
 * without samples, whatever the host has bound. Without depth, the reason is given.
 */
#include "fixture.h"
#include "window_depth.h"

#include <stdlib.h>
#include <string.h>

enum { W = 40, H = 30, SPLIT = 13 };

static const struct format {
    const char *name;
    GLenum internal_format;
    bool has_stencil;
} formats[] = {
    {"16 bits", GL_DEPTH_COMPONENT16, false},         {"24 bits", GL_DEPTH_COMPONENT24, false},
    {"24 and 8 bits", GL_DEPTH24_STENCIL8, true},     {"32 bits", GL_DEPTH_COMPONENT32, false},
    {"32 bits, float", GL_DEPTH_COMPONENT32F, false}, {"32 and 8 bits, float", GL_DEPTH32F_STENCIL8, true},
};

/* Depth 0.25 left of SPLIT and 0.75 right of it; bound as framebuffer, with *out_renderbuffer in it. */
static GLuint make_framebuffer(const struct format *format, int samples, GLuint *out_renderbuffer)
{
    GLuint framebuffer;
    gl.GenFramebuffers(1, &framebuffer);
    gl.GenRenderbuffers(1, out_renderbuffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, *out_renderbuffer);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format->internal_format, W, H);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, format->has_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                               GL_RENDERBUFFER, *out_renderbuffer);
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
    assert_int_equal(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    gl.ClearBufferfv(GL_DEPTH, 0, &(const float){0.25f});
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(SPLIT, 0, W, H);
    gl.ClearBufferfv(GL_DEPTH, 0, &(const float){0.75f});
    gl.Disable(GL_SCISSOR_TEST);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return framebuffer;
}

static void check_depth(GLuint texture, const char *name)
{
    assert_int_not_equal(texture, 0);
    float *depth = fixture_read_depth(texture, W, H);
    for (int i = 0; i < W * H; ++i) {
        const float wanted = i % W < SPLIT ? 0.25f : 0.75f, difference = depth[i] - wanted;
        if (!(difference < 2e-5f && difference > -2e-5f))
            fail_msg("%s: depth %g at %d, %d", name, (double)depth[i], i % W, i / W);
    }
    free(depth);
}

static void every_depth_format_arrives(void **state)
{
    fixture *f = *state;
    window_depth *copy = window_depth_create(fixture_load, f->context);
    assert_non_null(copy);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i)
        for (int samples = 0; samples <= 4; samples += 4) {
            GLuint renderbuffer, framebuffer = make_framebuffer(&formats[i], samples, &renderbuffer);
            const char *why = "untouched";
            const GLuint texture = window_depth_copy(copy, framebuffer, W, H, &why);
            if (why)
                fail_msg("%s, %d samples: %s", formats[i].name, samples, why);
            check_depth(texture, formats[i].name);
            assert_int_equal(window_depth_copy(copy, framebuffer, W, H, NULL), texture);
            gl.DeleteFramebuffers(1, &framebuffer);
            gl.DeleteRenderbuffers(1, &renderbuffer);
        }
    window_depth_destroy(copy);
}

static GLint get(GLenum name)
{
    GLint value = -1;
    gl.GetIntegerv(name, &value);
    return value;
}

/* A copy that left scissor test and unpack buffer on would be wrong; both must be as before after it. */
static void host_state_neither_harms_nor_is_harmed(void **state)
{
    fixture *f = *state;
    window_depth *copy = window_depth_create(fixture_load, f->context);
    GLuint renderbuffer, framebuffer = make_framebuffer(&formats[2], 0, &renderbuffer), texture, buffer, other;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, W, H, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.GenBuffers(1, &buffer);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    gl.BufferData(GL_PIXEL_UNPACK_BUFFER, 16, NULL, GL_STATIC_DRAW);
    gl.GenFramebuffers(1, &other);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, other);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(1, 1, 2, 2);

    const GLuint got = window_depth_copy(copy, framebuffer, W, H, NULL);
    assert_int_equal(get(GL_TEXTURE_BINDING_2D), texture);
    assert_int_equal(get(GL_PIXEL_UNPACK_BUFFER_BINDING), buffer);
    assert_int_equal(get(GL_DRAW_FRAMEBUFFER_BINDING), other);
    assert_int_equal(get(GL_READ_FRAMEBUFFER_BINDING), framebuffer);
    assert_int_equal(get(GL_READ_BUFFER), GL_COLOR_ATTACHMENT0); /* the host's framebuffer keeps its own */
    assert_true(gl.IsEnabled(GL_SCISSOR_TEST));
    gl.Disable(GL_SCISSOR_TEST);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    check_depth(got, "scrambled state");

    window_depth_destroy(copy);
    gl.DeleteTextures(1, &texture);
    gl.DeleteBuffers(1, &buffer);
    gl.DeleteFramebuffers(1, &other);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteRenderbuffers(1, &renderbuffer);
}

static void a_framebuffer_without_depth_is_told(void **state)
{
    fixture *f = *state;
    window_depth *copy = window_depth_create(fixture_load, f->context);
    GLuint color, framebuffer;
    gl.GenRenderbuffers(1, &color);
    gl.BindRenderbuffer(GL_RENDERBUFFER, color);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, W, H);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    const char *why = NULL;
    assert_int_equal(window_depth_copy(copy, framebuffer, W, H, &why), 0);
    assert_string_equal(why, "the framebuffer has no depth");
    window_depth_destroy(copy);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteRenderbuffers(1, &color);
}

static void *find_nothing(const char *name, void *user)
{
    (void)name;
    (void)user;
    return NULL;
}

static void a_loader_that_finds_nothing_is_survived(void **state)
{
    (void)state;
    assert_null(window_depth_create(find_nothing, NULL));
    window_depth_destroy(NULL);
}

int main(void)
{
#define GL_TEST(test) cmocka_unit_test_setup_teardown(test, NULL, fixture_no_gl_error)
    const struct CMUnitTest tests[] = {
        GL_TEST(every_depth_format_arrives),
        GL_TEST(host_state_neither_harms_nor_is_harmed),
        GL_TEST(a_framebuffer_without_depth_is_told),
        GL_TEST(a_loader_that_finds_nothing_is_survived),
    };
    return cmocka_run_group_tests(tests, fixture_setup, fixture_teardown);
}
