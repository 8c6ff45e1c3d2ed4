/* SPDX-License-Identifier: MIT
 *
 * examples/context: every kind gives a current core context of 3.3 or later; several exist at the same time and on
 * several threads; a failure says in one line what was tried. Where libOSMesa is not installed (Mesa 25.1 and later
 * lack it) its part is skipped. EGL is always required.
 */
#define _POSIX_C_SOURCE 200809L

#include "context.h"
#include "gl.h"
#include "testing.h"

#include <dlfcn.h>
#include <pthread.h>

static bool osmesa_installed(void)
{
    void *library = dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL);
    if (!library)
        library = dlopen("libOSMesa.so", RTLD_LAZY | RTLD_LOCAL);
    return library != NULL;
}

static context *create(context_kind kind)
{
    char error[1024] = "";
    context *c = context_create(&(context_options){.kind = kind}, error, sizeof error);
    if (!c)
        print_error("%s\n", error);
    assert_non_null(c);
    return c;
}

static void load_functions(context *c)
{
    char error[256] = "";
    if (!gl_load(context_load, c, error, sizeof error))
        fail_msg("%s", error);
}

/* Clears a 1 x 1 picture of the context and reads it back. */
static void assert_clears_to(context *c, uint8_t red)
{
    assert_true(context_make_current(c));
    load_functions(c);
    GLuint texture, framebuffer;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    assert_int_equal(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    gl.ClearColor((float)red / 255.0f, 0, 0, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    uint8_t pixel[4] = {0};
    gl.ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    assert_int_equal(pixel[0], red);
    assert_int_equal(gl.GetError(), GL_NO_ERROR);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(1, &texture);
}

static void assert_core_3_3(context_kind kind)
{
    context *c = create(kind);
    load_functions(c);
    GLint major = 0, minor = 0, profile = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    assert_true(major > 3 || (major == 3 && minor >= 3));
    assert_int_equal(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    assert_clears_to(c, 77);
    context_destroy(c);
}

TEST(auto_gives_core_3_3)
{
    assert_core_3_3(CONTEXT_AUTO);
}

TEST(egl_gives_core_3_3)
{
    assert_core_3_3(CONTEXT_EGL);
}

TEST(osmesa_gives_core_3_3)
{
    if (!osmesa_installed())
        skip();
    assert_core_3_3(CONTEXT_OSMESA);
}

TEST(compatibility_is_given_where_asked_for)
{
    char error[1024] = "";
    context *c = context_create(&(context_options){.compatibility = true}, error, sizeof error);
    assert_non_null(c);
    load_functions(c);
    GLint profile = 0;
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    assert_int_equal(profile, GL_CONTEXT_COMPATIBILITY_PROFILE_BIT);
    context_destroy(c);
}

TEST(description_names_the_renderer)
{
    context *c = create(CONTEXT_AUTO);
    load_functions(c);
    const char *renderer = (const char *)gl.GetString(GL_RENDERER);
    assert_non_null(strstr(context_description(c), renderer));
    assert_null(strchr(context_description(c), '\n'));
    assert_int_equal(context_is_software(c), strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe"));
    context_destroy(c);
}

TEST(unknown_version_fails_in_one_line)
{
    const struct {
        context_kind kind;
        const char *tried[2];
    } cases[] = {{CONTEXT_AUTO, {"EGL surfaceless", "OSMesa"}},
                 {CONTEXT_EGL, {"EGL surfaceless", "EGL software device"}},
                 {CONTEXT_OSMESA, {"OSMesa", "OSMesa"}}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char error[1024] = "";
        assert_null(
            context_create(&(context_options){.kind = cases[i].kind, .major = 9, .minor = 9}, error, sizeof error));
        assert_non_null(strstr(error, "9.9"));
        assert_non_null(strstr(error, cases[i].tried[0]));
        assert_non_null(strstr(error, cases[i].tried[1]));
        assert_null(strchr(error, '\n'));
    }
}

TEST(short_error_buffers_are_not_overrun)
{
    char error[8];
    memset(error, 'x', sizeof error);
    assert_null(context_create(&(context_options){.major = 9, .minor = 9}, error, 4));
    assert_string_equal(error, "no ");
    assert_int_equal(error[4], 'x');
}

static void assert_two_live_side_by_side(context_kind first_kind, context_kind second_kind)
{
    context *first = create(first_kind), *second = create(second_kind);
    for (int round = 0; round < 3; round++) {
        assert_clears_to(first, 10);
        assert_clears_to(second, 200);
    }
    context_destroy(first); /* not current: the other one stays usable */
    assert_clears_to(second, 30);
    context_destroy(second);
}

TEST(two_egl_contexts_live_side_by_side)
{
    assert_two_live_side_by_side(CONTEXT_EGL, CONTEXT_EGL);
}

TEST(egl_and_osmesa_live_side_by_side)
{
    if (!osmesa_installed())
        skip();
    assert_two_live_side_by_side(CONTEXT_EGL, CONTEXT_OSMESA);
    assert_two_live_side_by_side(CONTEXT_OSMESA, CONTEXT_EGL);
}

/* The table in gl.h is one for the whole process, so threads call what context_load finds. */
static void *clear_on_thread(void *kind)
{
    char error[1024] = "";
    for (int round = 0; round < 4; round++) {
        context *c = context_create(&(context_options){.kind = *(const context_kind *)kind}, error, sizeof error);
        if (!c)
            return NULL;
        void *addresses[] = {context_load("glGetString", c), context_load("glFinish", c)};
        PFNGLGETSTRINGPROC get_string;
        PFNGLFINISHPROC finish;
        memcpy(&get_string, &addresses[0], sizeof get_string);
        memcpy(&finish, &addresses[1], sizeof finish);
        finish();
        const bool alive = get_string(GL_VERSION) != NULL;
        context_destroy(c);
        if (!alive)
            return NULL;
    }
    return kind;
}

TEST(threads_make_contexts_of_their_own)
{
    context_kind kinds[] = {CONTEXT_EGL, osmesa_installed() ? CONTEXT_OSMESA : CONTEXT_EGL, CONTEXT_AUTO};
    pthread_t threads[3];
    for (int i = 0; i < 3; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, clear_on_thread, &kinds[i]), 0);
    for (int i = 0; i < 3; i++) {
        void *result = NULL;
        pthread_join(threads[i], &result);
        assert_non_null(result);
    }
}

TEST(moves_to_a_new_context_after_destroy)
{
    for (int i = 0; i < 5; i++) {
        context *c = create(CONTEXT_AUTO);
        assert_clears_to(c, (uint8_t)(50 * i));
        context_destroy(c);
    }
    context_destroy(NULL);
}

TEST_MAIN(NULL, NULL, NULL)
