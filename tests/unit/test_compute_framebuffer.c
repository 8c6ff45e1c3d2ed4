/* SPDX-License-Identifier: MIT
 *
 * glssao_compute_framebuffer: depth of every format arrives, with and without samples, from any part of a framebuffer,
 * and the result is that of glssao_compute; the effect follows the size; drivers and hosts that are difficult.
 */
#include "guest.h"

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

typedef struct host {
    GLuint framebuffer, renderbuffer;
} host;

/* Depth 0.25 left of SPLIT and 0.75 right of it, in all of width by height pixels. */
static host make_host(const struct format *format, int samples, int width, int height)
{
    host h;
    gl.GenFramebuffers(1, &h.framebuffer);
    gl.GenRenderbuffers(1, &h.renderbuffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, h.renderbuffer);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format->internal_format, width, height);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, h.framebuffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, format->has_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                               GL_RENDERBUFFER, h.renderbuffer);
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
    assert_int_equal(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    gl.ClearBufferfv(GL_DEPTH, 0, &(const float){0.25f});
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(SPLIT, 0, width, height);
    gl.ClearBufferfv(GL_DEPTH, 0, &(const float){0.75f});
    gl.Disable(GL_SCISSOR_TEST);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return h;
}

static void delete_host(host *h)
{
    gl.DeleteFramebuffers(1, &h->framebuffer);
    gl.DeleteRenderbuffers(1, &h->renderbuffer);
}
#define test_end_host delete_host /* for SCOPED */

static glssao_frame make_frame(void)
{
    glssao_frame frame = {0};
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    memcpy(frame.projection, view.projection, sizeof frame.projection);
    return frame;
}

static glssao_settings make_settings(void)
{
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    settings.half_resolution = false;
    return settings;
}

/* The effect's copy has that size, and 0.25 left of `split`. */
static void check_depth(const glssao_effect *effect, int width, int height, int split, const char *name)
{
    int w, h;
    const GLuint texture = glssao_map(effect, GLSSAO_MAP_DEPTH, &w, &h);
    assert_true(texture != 0 && w == width && h == height);
    SCOPED(memory) float *depth = fixture_read_depth(texture, width, height);
    for (int i = 0; i < width * height; ++i) {
        const float wanted = i % width < split ? 0.25f : 0.75f, difference = depth[i] - wanted;
        if (!(difference < 2e-5f && difference > -2e-5f))
            fail_msg("%s: depth %g at %d, %d", name, (double)depth[i], i % width, i / width);
    }
}

TEST_GL(every_depth_format_arrives)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    const glssao_settings settings = make_settings();
    glssao_frame frame = make_frame();
    memcpy(frame.viewport, (const int[4]){0, 0, W, H}, sizeof frame.viewport);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i)
        for (int samples = 0; samples <= 4; samples += 4) {
            SCOPED(host) host h = make_host(&formats[i], samples, W, H);
            for (int again = 0; again < 2; ++again) {
                if (glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings) != GLSSAO_OK)
                    fail_msg("%s, %d samples: %s", formats[i].name, samples, f->log);
                check_depth(effect, W, H, SPLIT, formats[i].name);
            }
        }
}

/* Draws a depth texture's texels into part of a framebuffer. */
static void put_depth(GLuint texture, const host *h, int x, int y)
{
    GLuint source;
    gl.GenFramebuffers(1, &source);
    gl.BindFramebuffer(GL_FRAMEBUFFER, source);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, h->framebuffer);
    gl.BlitFramebuffer(0, 0, W, H, x, y, x + W, y + H, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &source);
}

/* Anywhere in the framebuffer, with normals or without, the result is that of glssao_compute. */
TEST_GL(the_result_is_that_of_the_depth_as_a_texture)
{
    SCOPED(frame) glssao_frame frame = fixture_room(PERSPECTIVE, W, H);
    const GLuint normals = frame.normal_texture;
    SCOPED(host) host h = make_host(&formats[4], 0, 2 * W, 2 * H);
    put_depth(frame.depth_texture, &h, W, H / 2);
    const glssao_settings settings = make_settings();
    for (int i = 0; i < 2; ++i) {
        frame.normal_texture = i ? normals : 0;
        SCOPED(effect) glssao_effect *plain = fixture_effect(f, W, H), *window = fixture_effect(f, 8, 8);
        int w, height;
        SCOPED(memory) float *wanted = fixture_compute(plain, &frame, &settings, &w, &height);
        assert_true(w == W && height == H);
        glssao_frame copied = frame;
        copied.depth_texture = 0;
        memcpy(copied.viewport, (const int[4]){W, H / 2, W, H}, sizeof copied.viewport);
        assert_int_equal(glssao_compute_framebuffer(window, h.framebuffer, &copied, &settings), GLSSAO_OK);
        SCOPED(memory) float *got = fixture_read_ambient(window, &w, &height);
        assert_true(w == W && height == H);
        assert_memory_equal(got, wanted, W * H * sizeof *got);
    }
    frame.normal_texture = normals;
}

/* glViewport says which part, the effect takes its size, and glssao_apply covers it. */
TEST_GL(viewport_and_size_of_the_host_are_followed)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, 8, 8);
    const glssao_settings settings = make_settings();
    const glssao_frame frame = make_frame();
    SCOPED(host) host h = make_host(&formats[2], 0, W, H);
    SCOPED(texture) const GLuint color = fixture_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, W, H, NULL);
    gl.BindFramebuffer(GL_FRAMEBUFFER, h.framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color, 0);
    gl.DrawBuffer(GL_COLOR_ATTACHMENT0);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    static const int parts[][4] = {{0, 0, W, H}, {7, 5, 20, 18}, {7, 5, 20, 18}, {3, 0, 31, H}, {0, 0, W, H}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) {
        const int *p = parts[i];
        gl.BindFramebuffer(GL_FRAMEBUFFER, h.framebuffer);
        gl.ClearBufferfv(GL_COLOR, 0, (const float[4]){0.0f, 0.0f, 0.0f, 0.0f});
        gl.Viewport(p[0], p[1], p[2], p[3]);
        assert_int_equal(glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_OK);
        check_depth(effect, p[2], p[3], SPLIT - p[0], "viewport");
        glssao_apply_options options = glssao_default_apply_options();
        options.framebuffer = h.framebuffer;
        options.show = true;
        assert_int_equal(glssao_apply_with(effect, &options), GLSSAO_OK);
        int w, height;
        SCOPED(memory)
        float *access = fixture_read_ambient(effect, &w, &height), *got = fixture_read_texture(color, W, H, 1);
        assert_true(w == p[2] && height == p[3]);
        for (int k = 0; k < W * H; ++k) {
            const int x = k % W - p[0], y = k / W - p[1];
            const bool inside = x >= 0 && y >= 0 && x < p[2] && y < p[3];
            const float wanted = inside ? access[y * w + x] : 0.0f;
            assert_float_equal(got[k], wanted, 0.003f);
        }
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.Viewport(0, 0, W, H);
}

/* ---- what is refused ---- */

static void check_refused(fixture *f, glssao_result got, glssao_result wanted, const char *text)
{
    const char *const newline = strchr(f->log, '\n');
    if (got != wanted || !strstr(f->log, text) || !newline || newline[1])
        fail_msg("%s: result %d, log: %s", text, (int)got, f->log);
    fixture_clear_log(f);
}

TEST_GL(bad_arguments_are_named)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, 8, 8);
    const glssao_settings settings = make_settings();
    SCOPED(host) host h = make_host(&formats[2], 0, W, H);
    glssao_frame good = make_frame(), frame;
    memcpy(good.viewport, (const int[4]){0, 0, W, H}, sizeof good.viewport);
#define REFUSED(member, value, text)                                                                                   \
    frame = good;                                                                                                      \
    frame.member = value;                                                                                              \
    check_refused(f, glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_INVALID_ARGUMENT,    \
                  text)
    REFUSED(depth_texture, 7, "frame.depth_texture = 7: want 0");
    REFUSED(depth_kind, GLSSAO_DEPTH_VIEW_DISTANCE, "frame.depth_kind = 1");
    REFUSED(depth_kind, GLSSAO_DEPTH_NORMAL_ALPHA, "frame.depth_kind = 2");
    REFUSED(multisample, true, "frame.multisample");
    REFUSED(viewport[0], -1, "frame.viewport = -1, 0, 40, 30");
    REFUSED(viewport[2], 0, "frame.viewport = 0, 0, 0, 30");
    REFUSED(viewport[3], 2147483647, "frame.viewport = 0, 0, 40, 2147483647");
    REFUSED(viewport[1], 2147483647, "frame.viewport = 0, 2147483647, 40, 30");
    REFUSED(projection[0], 0.0f, "frame.projection is singular");
    REFUSED(margin, 3, "frame.margin");
    REFUSED(back_texture, 9, "frame.second_texture");
#undef REFUSED
    frame = good;
    const glssao_result invalid = GLSSAO_INVALID_ARGUMENT;
    check_refused(f, glssao_compute_framebuffer(effect, 4242, &frame, &settings), invalid, "framebuffer = 4242");
    check_refused(f, glssao_compute_framebuffer(effect, h.framebuffer, NULL, &settings), invalid, "frame is NULL");
    check_refused(f, glssao_compute_framebuffer(effect, h.framebuffer, &frame, NULL), invalid, "settings is NULL");
    assert_int_equal(glssao_compute_framebuffer(NULL, h.framebuffer, &frame, &settings), invalid);
    int w, height;
    glssao_map(effect, GLSSAO_MAP_NORMAL, &w, &height);
    assert_true(w == 8 && height == 8); /* nothing has changed */
    assert_int_equal(glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_OK);
}

TEST_GL(framebuffers_that_hold_no_depth_are_named)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, 8, 8);
    const glssao_settings settings = make_settings();
    glssao_frame frame = make_frame();
    memcpy(frame.viewport, (const int[4]){0, 0, W, H}, sizeof frame.viewport);
    GLuint color, framebuffer, empty;
    gl.GenRenderbuffers(1, &color);
    gl.BindRenderbuffer(GL_RENDERBUFFER, color);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, W, H);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    gl.GenFramebuffers(1, &empty);
    gl.BindFramebuffer(GL_FRAMEBUFFER, empty);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    char text[128];
    snprintf(text, sizeof text, "framebuffer = %u: it has no depth buffer", framebuffer);
    check_refused(f, glssao_compute_framebuffer(effect, framebuffer, &frame, &settings), GLSSAO_INVALID_ARGUMENT, text);
    snprintf(text, sizeof text, "framebuffer = %u: not complete: 0x8CD7 GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT",
             empty);
    check_refused(f, glssao_compute_framebuffer(effect, empty, &frame, &settings), GLSSAO_FRAMEBUFFER_ERROR, text);

    /* The effect's own copy, handed back to it. */
    SCOPED(host) host h = make_host(&formats[1], 0, W, H);
    assert_int_equal(glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_OK);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                            glssao_map(effect, GLSSAO_MAP_DEPTH, NULL, NULL), 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    check_refused(f, glssao_compute_framebuffer(effect, framebuffer, &frame, &settings), GLSSAO_INVALID_ARGUMENT,
                  "its depth buffer is the effect's own copy");
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteFramebuffers(1, &empty);
    gl.DeleteRenderbuffers(1, &color);
}

/* ---- drivers and hosts ---- */

enum { REFUSES_NOTHING, REFUSES_BLITS, REFUSES_ALL };
static int driver;
static PFNGLBLITFRAMEBUFFERPROC real_blit;
static PFNGLCOPYTEXSUBIMAGE2DPROC real_copy;
static int blits, copies, errors_asked;
static PFNGLGETERRORPROC real_get_error;

static void cause_error(void)
{
    gl.UseProgram(0);
    PFNGLUNIFORM1IPROC set = gl.Uniform1i;
    set(0, 0);
}

static void APIENTRY blit(GLint x0, GLint y0, GLint x1, GLint y1, GLint a, GLint b, GLint c, GLint d, GLbitfield mask,
                          GLenum filter)
{
    ++blits;
    if (driver == REFUSES_NOTHING)
        real_blit(x0, y0, x1, y1, a, b, c, d, mask, filter);
    else
        cause_error();
}

static void APIENTRY copy(GLenum target, GLint level, GLint a, GLint b, GLint x, GLint y, GLsizei w, GLsizei h)
{
    ++copies;
    if (driver != REFUSES_ALL)
        real_copy(target, level, a, b, x, y, w, h);
    else
        cause_error();
}

static GLenum APIENTRY get_error(void)
{
    ++errors_asked;
    return real_get_error();
}

static void *load_of_a_driver(const char *name, void *user)
{
    void *address = fixture_load(name, user);
#define REPLACE(text, real, own)                                                                                       \
    if (strcmp(name, text) == 0) {                                                                                     \
        memcpy(&real, &address, sizeof address);                                                                       \
        void (*function)(void) = (void (*)(void))own;                                                                  \
        memcpy(&address, &function, sizeof address);                                                                   \
    }
    REPLACE("glBlitFramebuffer", real_blit, blit)
    REPLACE("glCopyTexSubImage2D", real_copy, copy)
    REPLACE("glGetError", real_get_error, get_error)
#undef REPLACE
    return address;
}

static glssao_effect *effect_of_a_driver(fixture *f, bool host_restores_state)
{
    glssao_config config = fixture_config(f, W, H);
    config.load = load_of_a_driver;
    config.host_restores_state = host_restores_state;
    glssao_effect *effect = NULL;
    assert_int_equal(glssao_create(&config, &effect), GLSSAO_OK);
    return effect;
}

TEST_GL(drivers_that_refuse_the_blit_copy_texels)
{
    const glssao_settings settings = make_settings();
    glssao_frame frame = make_frame();
    memcpy(frame.viewport, (const int[4]){5, 3, W, H}, sizeof frame.viewport);
    SCOPED(host) host h = make_host(&formats[1], 0, W + 9, H + 9);
    for (int i = REFUSES_NOTHING; i <= REFUSES_ALL; ++i) {
        SCOPED(effect) glssao_effect *effect = effect_of_a_driver(f, false);
        driver = i;
        blits = copies = 0;
        for (int k = 0; k < 3; ++k) {
            const glssao_result result = glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings);
            if (i == REFUSES_ALL)
                check_refused(f, result, GLSSAO_INVALID_ARGUMENT, "the driver copies no depth from it");
            else
                assert_int_equal(result, GLSSAO_OK);
            if (i != REFUSES_ALL)
                check_depth(effect, W, H, SPLIT - 5, "driver");
        }
        assert_true(i == REFUSES_NOTHING ? blits == 3 && copies == 0
                    : i == REFUSES_BLITS ? blits == 1 && copies == 3
                                         : copies == 3);
        driver = REFUSES_NOTHING;
    }
}

/* An error that the host had is there afterwards; later copies don't ask for errors. */
TEST_GL(errors_of_the_host_stay)
{
    if (GLSSAO_CHECK_GL)
        skip(); /* such builds ask for errors after every pass and take the host's */
    SCOPED(effect) glssao_effect *effect = effect_of_a_driver(f, false);
    const glssao_settings settings = make_settings();
    glssao_frame frame = make_frame();
    memcpy(frame.viewport, (const int[4]){0, 0, W, H}, sizeof frame.viewport);
    SCOPED(host) host h = make_host(&formats[1], 0, W, H);
    cause_error();
    assert_int_equal(glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_OK);
    assert_int_equal(gl.GetError(), GL_INVALID_OPERATION);
    assert_int_equal(gl.GetError(), GL_NO_ERROR);
    gl.Enable(GL_INVALID_ENUM);
    errors_asked = 0;
    assert_int_equal(glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_OK);
    assert_int_equal(errors_asked, 0);
    assert_int_equal(gl.GetError(), GL_INVALID_ENUM);
}

/* With config.host_restores_state the part is told, not looked up. test_guest_calls counts its queries. */
TEST_GL(hosts_that_restore_state_name_the_part)
{
    SCOPED(effect) glssao_effect *effect = effect_of_a_driver(f, true);
    const glssao_settings settings = make_settings();
    glssao_frame frame = make_frame();
    host h = make_host(&formats[1], 0, W, H);
    check_refused(f, glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_INVALID_ARGUMENT,
                  "frame.viewport is empty");
    for (int i = 0; i < 4; ++i) { /* another size makes the copy anew */
        memcpy(frame.viewport, (const int[4]){0, 0, W - i / 2, H}, sizeof frame.viewport);
        assert_int_equal(glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_OK);
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        check_depth(effect, W - i / 2, H, SPLIT, "a host that restores its state");
    }
    gl.UseProgram(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    delete_host(&h);
}

/* The copy counts in the time of the inputs, of frames that came to something. */
TEST_GL(the_copy_is_timed)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    const glssao_settings settings = make_settings();
    glssao_frame frame = make_frame(), bad = make_frame();
    bad.normal_texture = 4242;
    memcpy(frame.viewport, (const int[4]){0, 0, W, H}, sizeof frame.viewport);
    memcpy(bad.viewport, frame.viewport, sizeof bad.viewport);
    host h = make_host(&formats[1], 0, W, H);
    for (int i = 0; i < 6; ++i) { /* more often than there are sets of timers */
        assert_int_equal(glssao_compute_framebuffer(effect, h.framebuffer, &frame, &settings), GLSSAO_OK);
        assert_int_equal(glssao_compute_framebuffer(effect, h.framebuffer, &bad, &settings), GLSSAO_INVALID_ARGUMENT);
        bad.multisample = !bad.multisample; /* refused before the copy, then after it */
        gl.Finish();
        const glssao_stats stats = glssao_get_stats(effect);
        assert_true(stats.frame == (uint64_t)i + 1 && stats.timed_frame == stats.frame);
        double sum = 0.0;
        for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass)
            sum += fmax(stats.passes[pass].gpu_ms, 0.0);
        assert_true(stats.passes[GLSSAO_PASS_INPUTS].gpu_ms > 0.0);
        assert_true(fabs(stats.gpu_ms - sum) < 1e-9);
        assert_int_equal(stats.passes[GLSSAO_PASS_INPUTS].draw_calls, 0);
    }
    memset(frame.viewport, 0, sizeof frame.viewport);
    frame.depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT24, W, H, NULL);
    assert_int_equal(glssao_compute(effect, &frame, &settings), GLSSAO_OK);
    gl.Finish();
    assert_true(glssao_get_stats(effect).passes[GLSSAO_PASS_INPUTS].gpu_ms < 0.0); /* no copy */
    fixture_clear_log(f);
    gl.DeleteTextures(1, &frame.depth_texture);
    delete_host(&h);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
