/* SPDX-License-Identifier: MIT
 *
 * A driver without memory for a map: the call says OUT_OF_MEMORY, leaves no GL error, and the effect still works.
 * First with sizes that a real driver may refuse, then with a driver that is made to fail as some do: the texture
 * level has its size, the framebuffer is not complete, and glGetError holds GL_OUT_OF_MEMORY.
 */
#include "guest.h"

/* ---- a driver that fails ---- */

static struct {
    fixture *f;
    int to_go;        /* allocations until one fails; negative: none fails */
    bool happened;    /* one has failed */
    bool is_missing;  /* the framebuffer that is checked next lacks its texture */
    bool holds_error; /* glGetError has not told yet */
} driver;

static void APIENTRY tex_image(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height, GLint border,
                               GLenum format, GLenum type, const void *pixels)
{
    gl.TexImage2D(target, level, internal, width, height, border, format, type, pixels);
    if (pixels || driver.to_go < 0 || driver.to_go-- > 0)
        return;
    driver.happened = driver.is_missing = driver.holds_error = true;
}

static GLenum APIENTRY check_framebuffer(GLenum target)
{
    if (!driver.is_missing)
        return gl.CheckFramebufferStatus(target);
    driver.is_missing = false;
    return GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT;
}

static GLenum APIENTRY get_error(void)
{
    if (!driver.holds_error)
        return gl.GetError();
    driver.holds_error = false;
    return GL_OUT_OF_MEMORY;
}

static void *load(const char *name, void *user)
{
    /* ISO C has no cast from a function to an object pointer. */
    void *address = fixture_load(name, user);
    if (strcmp(name, "glTexImage2D") == 0)
        memcpy(&address, &(PFNGLTEXIMAGE2DPROC[1]){tex_image}, sizeof address);
    if (strcmp(name, "glCheckFramebufferStatus") == 0)
        memcpy(&address, &(PFNGLCHECKFRAMEBUFFERSTATUSPROC[1]){check_framebuffer}, sizeof address);
    if (strcmp(name, "glGetError") == 0)
        memcpy(&address, &(PFNGLGETERRORPROC[1]){get_error}, sizeof address);
    return address;
}

typedef struct act {
    const char *name;
    glssao_quality quality;
    int margin;
    bool creates, resizes, accumulates;
} act;

static glssao_result run(guest *g, const act *a)
{
    glssao_config config = fixture_config(g->f, GUEST_W, GUEST_H);
    config.load = load;
    if (a->creates)
        return glssao_create(&config, &g->effect);
    if (a->resizes)
        return glssao_resize(g->effect, GUEST_W + 2, GUEST_H);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, a->quality);
    glssao_frame frame = g->frame;
    frame.margin = a->margin;
    return a->accumulates ? glssao_accumulate(g->effect, &frame, &settings)
                          : glssao_compute(g->effect, &frame, &settings);
}

/* False where the call made fewer textures. */
static bool fail_once(guest *g, const act *a, int number)
{
    static const act creation = {"create", GLSSAO_LOW, 0, true, false, false};
    if (!a->creates)
        assert_int_equal(run(g, &creation), GLSSAO_OK);
    fixture_clear_log(g->f);
    driver.to_go = number;
    driver.happened = false;
    const glssao_result result = run(g, a);
    const bool left = driver.holds_error;
    driver.to_go = -1;
    driver.is_missing = driver.holds_error = false;
    guest_no_error(a->name);
    if (result != (driver.happened ? GLSSAO_OUT_OF_MEMORY : GLSSAO_OK))
        fail_msg("%s, allocation %d: %s: %s", a->name, number, glssao_result_string(result), g->f->log);
    if (left)
        fail_msg("%s, allocation %d: GL_OUT_OF_MEMORY is left to the host", a->name, number);
    if (driver.happened) {
        assert_non_null(strstr(g->f->log, "memory"));
        assert_int_equal(run(g, a), GLSSAO_OK);
    }
    glssao_destroy(g->effect);
    g->effect = NULL;
    return driver.happened;
}

TEST_GL(a_map_without_memory_is_told_as_such)
{
    static const act acts[] = {
        {"create", GLSSAO_LOW, 0, true, false, false},
        {"resize", GLSSAO_LOW, 0, false, true, false},
        {"compute", GLSSAO_ULTRA, 0, false, false, false},
        {"compute with a margin", GLSSAO_HIGH, 8, false, false, false},
        {"accumulate", GLSSAO_LOW, 0, false, false, true},
    };
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    glssao_destroy(g.effect);
    g.effect = NULL;
    driver.to_go = -1;
    for (size_t i = 0; i < sizeof acts / sizeof *acts; ++i) {
        int number = 0;
        while (fail_once(&g, &acts[i], number))
            ++number;
        assert_true(number >= 1);
    }
}

/* ---- a real driver ---- */

/* llvmpipe takes textures of 2 GiB at most; a normal map of this size has 2 GiB. A driver that takes it is fine. */
TEST_GL(a_size_that_the_driver_refuses_leaves_no_error)
{
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const glssao_config config = fixture_config(f, largest, largest);
    SCOPED(effect) glssao_effect *effect = NULL;
    fixture_clear_log(f);
    const glssao_result result = glssao_create(&config, &effect);
    print_message("%d x %d: %s\n", largest, largest, glssao_result_string(result));
    guest_no_error("the largest size");
    assert_true(result == GLSSAO_OK ? effect != NULL : result == GLSSAO_OUT_OF_MEMORY && effect == NULL);
    assert_true((result == GLSSAO_OK) == (strstr(f->log, "memory") == NULL));
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
