/* SPDX-License-Identifier: MIT
 *
 * glssao_apply and glssao_apply_with: where the result goes, which of the host's tests count, and what is refused or
 * told.
 */
#include "apply_room.h"
#include "guest.h"

enum { W = APPLY_W, H = APPLY_H };

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
            if (!(fabsf(value - apply_before[0] * part) < 1e-5f))
                fail_msg("%s: pixel %d, %d is %g, want %g", what, x, y, (double)value,
                         (double)(apply_before[0] * part));
        }
}

TEST_GL(rectangle_places_and_stretches)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= apply_last_path(); ++path) {
        apply_room r = apply_open_room(f, (glssao_path)path);
        apply_target t = apply_make_target(GL_RGBA32F, 3 * W, 2 * H);
        glssao_apply_options options = glssao_default_apply_options();
        options.framebuffer = t.framebuffer;
        const int place[4] = {W + 5, 7, W, H};
        memcpy(options.rectangle, place, sizeof place);
        assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
        float *got = apply_read_target(&t);
        check_place(got, t.width, t.height, place, r.access, "rectangle");
        free(got);

        apply_clear(&t);
        const int wide[4] = {3, 0, 2 * W, H};
        SCOPED(memory) float *stretched = malloc((size_t)(2 * W * H) * sizeof *stretched);
        for (int i = 0; i < 2 * W * H; ++i) {
            const int x = i % (2 * W), y = i / (2 * W), near = x / 2, other = near + (x % 2 ? 1 : -1);
            const int clamped = other < 0 ? 0 : other >= W ? W - 1 : other;
            stretched[i] = 0.75f * r.access[y * W + near] + 0.25f * r.access[y * W + clamped];
        }
        memcpy(options.rectangle, wide, sizeof wide);
        assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
        got = apply_read_target(&t);
        for (int i = 0; i < 2 * W * H; ++i) { /* linear filters have 8 bits of fraction at least */
            const double wanted = (double)(apply_before[0] * stretched[i]);
            assert_float_equal(got[4 * (i / (2 * W) * t.width + i % (2 * W) + 3)], wanted, 2e-3);
        }
        free(got);
        apply_delete_target(&t);
        apply_close_room(&r);
    }
}

/* Four views of one depth texture and one picture: each receives its own occlusion, with a strength texture alike. */
TEST_GL(four_views_in_one_framebuffer)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= apply_last_path(); ++path) {
        SCOPED(effect) glssao_effect *effect = apply_make_effect(f, (glssao_path)path, W, H);
        glssao_settings settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH);
        settings.half_resolution = false;
        SCOPED(memory)
        float *depth = malloc(4 * W * H * sizeof *depth), *strengths = malloc(4 * W * H * sizeof *strengths);
        analytic_view views[4];
        for (int i = 0; i < 4; ++i) {
            views[i] = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
            views[i].projection[0] *= 1.0f + 0.3f * (float)i;
            SCOPED(memory) float *part = NULL, *normals = NULL;
            analytic_render(&views[i], analytic_unit_room, ANALYTIC_ROOM_SHAPES, W, H, &part, &normals);
            for (int k = 0; k < W * H; ++k)
                depth[((k / W) + i / 2 * H) * 2 * W + k % W + i % 2 * W] = part[k];
        }
        for (int i = 0; i < 4 * W * H; ++i)
            strengths[i] = (float)(i % 13) / 12.0f;
        SCOPED(texture) const GLuint atlas = fixture_depth_texture(GL_DEPTH_COMPONENT32F, 2 * W, 2 * H, depth);
        SCOPED(texture) const GLuint strength = gl_make_texture(GL_R32F, GL_RED, GL_FLOAT, 2 * W, 2 * H, strengths);
        SCOPED(applied)
        apply_target plain = apply_make_target(GL_RGBA32F, 2 * W, 2 * H),
                     weighted = apply_make_target(GL_RGBA32F, 2 * W, 2 * H);
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
        SCOPED(memory) float *got = apply_read_target(&plain), *got_weighted = apply_read_target(&weighted);
        for (int y = 0; y < 2 * H; ++y)
            for (int x = 0; x < 2 * W; ++x) {
                const int at = y * 2 * W + x;
                const float a = wanted[y / H * 2 + x / W][y % H * W + x % W];
                assert_float_equal(got[4 * at], apply_before[0] * a, 1e-5f);
                assert_float_equal(got_weighted[4 * at], apply_before[0] * (1.0f - strengths[at] * (1.0f - a)), 1e-5f);
            }
        for (int i = 0; i < 4; ++i)
            free(wanted[i]);
    }
}

/* A picture without its margin goes to the corner; the strength texture has the margin. */
TEST_GL(margin_shifts_the_strength_texture)
{
    enum { M = 8, PW = W - 2 * M, PH = H - 2 * M };
    SCOPED(room) apply_room r = apply_open_room(f, GLSSAO_PATH_FRAGMENT);
    r.frame.margin = M;
    int w, h;
    SCOPED(memory) float *inner = fixture_compute(r.effect, &r.frame, &r.settings, &w, &h);
    assert_true(w == PW && h == PH);
    SCOPED(applied) apply_target t = apply_make_target(GL_RGBA32F, W, H);
    glssao_apply_options options = glssao_default_apply_options();
    options.framebuffer = t.framebuffer;
    options.strength_texture = r.strength;
    assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
    for (int i = 0; i < PW * PH; ++i) {
        const float strength = r.strengths[(i / PW + M) * W + i % PW + M];
        inner[i] = 1.0f - fminf(fmaxf(strength, 0.0f), 1.0f) * (1.0f - inner[i]);
    }
    SCOPED(memory) float *got = apply_read_target(&t);
    check_place(got, W, H, (const int[4]){0, 0, PW, PH}, inner, "margin");
}

/* ---- the host's tests ---- */

static void add_stencil(const fixture *f, const apply_target *t, GLuint *out_renderbuffer)
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

/* Pixels where x < W / 2 pass the scissor test, those where y < H / 2 the stencil test. */
TEST_GL(tests_of_the_host_are_kept_on_request_and_ignored_once_told)
{
    for (int path = GLSSAO_PATH_FRAGMENT; path <= apply_last_path(); ++path) {
        SCOPED(room) apply_room r = apply_open_room(f, (glssao_path)path);
        apply_target t = apply_make_target(GL_RGBA32F, W, H);
        GLuint stencil;
        add_stencil(r.f, &t, &stencil);
        for (int i = 0; i < 8; ++i) {
            glssao_apply_options options = glssao_default_apply_options();
            options.framebuffer = t.framebuffer;
            options.keep_scissor = i & 1;
            options.keep_stencil = i & 2;
            apply_clear(&t);
            gl.Enable(GL_SCISSOR_TEST);
            gl.Scissor(0, 0, W / 2, H);
            gl.Enable(GL_STENCIL_TEST);
            gl.StencilFunc(GL_EQUAL, 1, 0xFF);
            assert_int_equal(glssao_apply_with(r.effect, &options), GLSSAO_OK);
            assert_true(gl.IsEnabled(GL_SCISSOR_TEST) && gl.IsEnabled(GL_STENCIL_TEST));
            gl.Disable(GL_SCISSOR_TEST);
            gl.Disable(GL_STENCIL_TEST);
            SCOPED(memory) float *got = apply_read_target(&t);
            for (int k = 0; k < W * H; ++k) {
                const bool passes =
                    (!options.keep_scissor || k % W < W / 2) && (!options.keep_stencil || k / W < H / 2);
                assert_float_equal(got[4 * k], apply_before[0] * (passes ? r.access[k] : 1.0f), 1e-5f);
            }
        }
        assert_int_equal(apply_count_lines(r.f->log, "GL_SCISSOR_TEST is on and ignored"), 1);
        assert_int_equal(apply_count_lines(r.f->log, "GL_STENCIL_TEST is on and ignored"), 1);
        assert_int_equal(apply_count_lines(r.f->log, "\n"), 2);
        gl.StencilFunc(GL_ALWAYS, 0, 0xFF);
        gl.DeleteRenderbuffers(1, &stencil);
        apply_delete_target(&t);
        fixture_clear_log(r.f);
    }
}

TEST_GL(other_state_that_has_no_effect_is_told_once)
{
    SCOPED(room) apply_room r = apply_open_room(f, GLSSAO_PATH_FRAGMENT);
    SCOPED(applied) apply_target t = apply_make_target(GL_RGBA32F, 2 * W, H);
    glssao_apply_options placed = glssao_default_apply_options();
    placed.framebuffer = t.framebuffer;
    memcpy(placed.rectangle, (const int[4]){0, 0, W, H}, sizeof placed.rectangle);
    gl.Viewport(W, 0, W, H); /* a second view, which the host forgot to name */
    assert_int_equal(glssao_apply_with(r.effect, &placed), GLSSAO_OK);
    assert_string_equal(r.f->log, "");
    for (int i = 0; i < 3; ++i)
        assert_int_equal(glssao_apply(r.effect, t.framebuffer), GLSSAO_OK);
    assert_int_equal(apply_count_lines(r.f->log, "glViewport lies elsewhere"), 1);
    gl.ColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE); /* the left eye of an anaglyph */
    for (int i = 0; i < 2; ++i)
        assert_int_equal(glssao_apply(r.effect, t.framebuffer), GLSSAO_OK);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    assert_int_equal(apply_count_lines(r.f->log, "glColorMask"), 1);
    assert_int_equal(apply_count_lines(r.f->log, "\n"), 2);
    gl.Viewport(0, 0, W, H);
    fixture_clear_log(r.f);
}

/* ---- what can't be ---- */

TEST_GL(bad_options_are_named_and_change_nothing)
{
    apply_room r = apply_open_room(f, GLSSAO_PATH_FRAGMENT);
    apply_target t = apply_make_target(GL_RGBA32F, W, H);
    const GLuint small = gl_make_texture(GL_R8, GL_RED, GL_FLOAT, W / 2, H, NULL);
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
        apply_clear(&t);                                                                                               \
        fixture_clear_log(r.f);                                                                                        \
        if (glssao_apply_with(r.effect, &o) != GLSSAO_INVALID_ARGUMENT || !strstr(r.f->log, text) ||                   \
            apply_count_lines(r.f->log, "\n") != 1)                                                                    \
            fail_msg("%s = %s: %s", #member, #value, r.f->log);                                                        \
        float *got = apply_read_target(&t);                                                                            \
        for (int i = 0; i < W * H; ++i)                                                                                \
            assert_memory_equal(got + 4 * i, apply_before, sizeof apply_before);                                       \
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
    apply_delete_target(&t);
    fixture_clear_log(r.f);
    apply_close_room(&r);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
