/* SPDX-License-Identifier: MIT
 *
 * What the effect asks of the host's GL: no query of state that the call does not change, no timer that makes the
 * CPU wait, and nothing that a debug context complains about.
 */
#include "guest.h"

/* ---- queries ---- */

/* What was asked since counting began; with the state that was asked for where that is what distinguishes. */
static struct {
    int count;
    GLenum names[1024];
} queries;

static void note(GLenum name)
{
    if (queries.count < 1024)
        queries.names[queries.count] = name;
    queries.count++;
}

static void APIENTRY get_integer(GLenum name, GLint *out)
{
    note(name);
    gl.GetIntegerv(name, out);
}

static void APIENTRY get_float(GLenum name, GLfloat *out)
{
    note(name);
    gl.GetFloatv(name, out);
}

static void APIENTRY get_boolean(GLenum name, GLboolean *out)
{
    note(name);
    gl.GetBooleanv(name, out);
}

static void APIENTRY get_integer_i(GLenum name, GLuint index, GLint *out)
{
    note(name);
    gl.GetIntegeri_v(name, index, out);
}

static void APIENTRY get_integer64_i(GLenum name, GLuint index, GLint64 *out)
{
    note(name);
    gl.GetInteger64i_v(name, index, out);
}

static void APIENTRY get_boolean_i(GLenum name, GLuint index, GLboolean *out)
{
    note(name);
    gl.GetBooleani_v(name, index, out);
}

static GLboolean APIENTRY is_enabled(GLenum name)
{
    note(name);
    return gl.IsEnabled(name);
}

static GLboolean APIENTRY is_enabled_i(GLenum name, GLuint index)
{
    note(name);
    return gl.IsEnabledi(name, index);
}

static GLboolean APIENTRY is_texture(GLuint texture)
{
    note(GL_TEXTURE);
    return gl.IsTexture(texture);
}

static void APIENTRY get_level(GLenum target, GLint level, GLenum name, GLint *out)
{
    note(name);
    gl.GetTexLevelParameteriv(target, level, name, out);
}

static GLenum APIENTRY check_framebuffer(GLenum target)
{
    note(GL_FRAMEBUFFER_COMPLETE);
    return gl.CheckFramebufferStatus(target);
}

/* Not in the tests' table of functions. */
static PFNGLGETTEXPARAMETERIVPROC real_get_texture_parameter;
static PFNGLGETTEXTUREPARAMETERIVPROC real_get_parameter_of_texture;
static PFNGLGETFRAMEBUFFERATTACHMENTPARAMETERIVPROC real_get_attachment;
static PFNGLISFRAMEBUFFERPROC real_is_framebuffer;
static PFNGLGETERRORPROC real_get_error;

static void APIENTRY get_texture_parameter(GLenum target, GLenum name, GLint *out)
{
    note(name);
    real_get_texture_parameter(target, name, out);
}

static void APIENTRY get_parameter_of_texture(GLuint texture, GLenum name, GLint *out)
{
    note(name);
    real_get_parameter_of_texture(texture, name, out);
}

static void APIENTRY get_attachment(GLenum target, GLenum attachment, GLenum name, GLint *out)
{
    note(name);
    real_get_attachment(target, attachment, name, out);
}

static GLboolean APIENTRY is_framebuffer(GLuint framebuffer)
{
    note(GL_FRAMEBUFFER);
    return real_is_framebuffer(framebuffer);
}

static GLenum APIENTRY get_error(void)
{
    if (!GLSSAO_CHECK_GL) /* such a build asks after each call */
        note(GL_NO_ERROR);
    return real_get_error();
}

static void *watched_user; /* of load, for loaders without an argument */

/* ---- timers ---- */

/* A GPU that never gets round to a timestamp. */
static struct {
    bool never_ready;
    GLuint counted[1024];
    int counts;
    int reused; /* timestamps asked for anew before the last was there */
    int waits;  /* results asked for before they were there */
} timers;

static void APIENTRY query_counter(GLuint id, GLenum target)
{
    for (int i = 0; i < timers.counts; ++i)
        timers.reused += timers.never_ready && timers.counted[i] == id;
    if (timers.counts < 1024)
        timers.counted[timers.counts++] = id;
    gl.QueryCounter(id, target);
}

static void APIENTRY get_query(GLuint id, GLenum name, GLint *out)
{
    GLuint value = 0;
    gl.GetQueryObjectuiv(id, name, &value);
    *out = name == GL_QUERY_RESULT_AVAILABLE && timers.never_ready ? 0 : (GLint)value;
    timers.waits += name == GL_QUERY_RESULT && timers.never_ready;
}

static void APIENTRY get_query_64(GLuint id, GLenum name, GLuint64 *out)
{
    timers.waits += name == GL_QUERY_RESULT && timers.never_ready;
    gl.GetQueryObjectui64v(id, name, out);
}

static void *load(const char *name, void *user)
{
    /* ISO C has no cast from a function to an object pointer. */
#define WRAP(type, function, wrapper)                                                                                  \
    if (strcmp(name, function) == 0)                                                                                   \
        memcpy(&address, &(type[1]){wrapper}, sizeof address);
    void *address = fixture_load(name, user);
#define KEEP(function, real)                                                                                           \
    if (strcmp(name, function) == 0)                                                                                   \
        memcpy(&real, &address, sizeof address);
    KEEP("glGetTexParameteriv", real_get_texture_parameter)
    KEEP("glGetTextureParameteriv", real_get_parameter_of_texture)
    KEEP("glGetFramebufferAttachmentParameteriv", real_get_attachment)
    KEEP("glIsFramebuffer", real_is_framebuffer)
    KEEP("glGetError", real_get_error)
#undef KEEP
    WRAP(PFNGLGETINTEGERVPROC, "glGetIntegerv", get_integer)
    WRAP(PFNGLGETFLOATVPROC, "glGetFloatv", get_float)
    WRAP(PFNGLGETBOOLEANVPROC, "glGetBooleanv", get_boolean)
    WRAP(PFNGLGETINTEGERI_VPROC, "glGetIntegeri_v", get_integer_i)
    WRAP(PFNGLGETINTEGER64I_VPROC, "glGetInteger64i_v", get_integer64_i)
    WRAP(PFNGLGETBOOLEANI_VPROC, "glGetBooleani_v", get_boolean_i)
    WRAP(PFNGLISENABLEDPROC, "glIsEnabled", is_enabled)
    WRAP(PFNGLISENABLEDIPROC, "glIsEnabledi", is_enabled_i)
    WRAP(PFNGLISTEXTUREPROC, "glIsTexture", is_texture)
    WRAP(PFNGLGETTEXLEVELPARAMETERIVPROC, "glGetTexLevelParameteriv", get_level)
    WRAP(PFNGLCHECKFRAMEBUFFERSTATUSPROC, "glCheckFramebufferStatus", check_framebuffer)
    WRAP(PFNGLGETTEXPARAMETERIVPROC, "glGetTexParameteriv", get_texture_parameter)
    if (address) /* newer than OpenGL 3.3 */
        WRAP(PFNGLGETTEXTUREPARAMETERIVPROC, "glGetTextureParameteriv", get_parameter_of_texture)
    WRAP(PFNGLGETFRAMEBUFFERATTACHMENTPARAMETERIVPROC, "glGetFramebufferAttachmentParameteriv", get_attachment)
    WRAP(PFNGLISFRAMEBUFFERPROC, "glIsFramebuffer", is_framebuffer)
    WRAP(PFNGLGETERRORPROC, "glGetError", get_error)
    WRAP(PFNGLQUERYCOUNTERPROC, "glQueryCounter", query_counter)
    WRAP(PFNGLGETQUERYOBJECTIVPROC, "glGetQueryObjectiv", get_query)
    WRAP(PFNGLGETQUERYOBJECTUI64VPROC, "glGetQueryObjectui64v", get_query_64)
#undef WRAP
    return address;
}

static guest open_watched(fixture *f)
{
    guest g = guest_open(f, GLSSAO_PATH_AUTO);
    glssao_destroy(g.effect);
    glssao_config config = fixture_config(g.f, GUEST_W, GUEST_H);
    config.load = load;
    config.path = GLSSAO_PATH_FRAGMENT;
    g.effect = NULL;
    assert_int_equal(glssao_create(&config, &g.effect), GLSSAO_OK);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
    assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
    return g;
}

/* A bound framebuffer to apply to. */
static GLuint bind_target(GLuint *out_texture)
{
    GLuint framebuffer;
    gl.GenTextures(1, out_texture);
    gl.BindTexture(GL_TEXTURE_2D, *out_texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, GUEST_W, GUEST_H, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *out_texture, 0);
    return framebuffer;
}

/* Where it can't dispatch, glssao_apply draws once, with one texture, into one framebuffer: it changes nothing of
 * these. */
TEST_GL(apply_asks_only_for_what_it_changes)
{
    static const struct {
        GLenum name;
        const char *text;
    } unchanged[] = {
        {GL_READ_FRAMEBUFFER_BINDING, "the read framebuffer"},
        {GL_UNIFORM_BUFFER_BINDING, "uniform buffers"},
        {GL_UNIFORM_BUFFER_START, "uniform buffers"},
        {GL_UNIFORM_BUFFER_SIZE, "uniform buffers"},
        {GL_PIXEL_UNPACK_BUFFER_BINDING, "the unpack buffer"},
        {GL_PIXEL_PACK_BUFFER_BINDING, "the pack buffer"},
        {GL_UNPACK_ALIGNMENT, "unpack alignment"},
        {GL_UNPACK_ROW_LENGTH, "unpack row length"},
        {GL_PACK_ALIGNMENT, "pack alignment"},
        {GL_PACK_ROW_LENGTH, "pack row length"},
        {GL_IMAGE_BINDING_NAME, "image units"},
        {GL_IMAGE_BINDING_FORMAT, "image units"},
    };
    SCOPED(guest) guest g = open_watched(f);
    GLuint texture, framebuffer;
    framebuffer = bind_target(&texture);
    queries.count = 0;
    assert_int_equal(glssao_apply(g.effect, framebuffer), GLSSAO_OK);
    const int count = queries.count;
    int units = 0;
    print_message("glssao_apply: %d queries\n", count);
    for (int i = 0; i < count && i < 1024; ++i) {
        units += queries.names[i] == GL_TEXTURE_BINDING_2D;
        for (size_t k = 0; k < sizeof unchanged / sizeof *unchanged; ++k)
            if (queries.names[i] == unchanged[k].name)
                fail_msg("glssao_apply asks for %s", unchanged[k].text);
    }
    if (units > 1)
        fail_msg("glssao_apply asks for the textures of %d units", units);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(1, &texture);
}

/* With config.host_restores_state, the second frame of the same textures asks OpenGL nothing, draws the same picture,
 * and get_proc finds the functions. */
static glssao_proc get_proc(const char *name)
{
    glssao_proc function;
    void *const address = load(name, watched_user);
    memcpy(&function, &address, sizeof function);
    return function;
}

TEST_GL(hosts_that_restore_state_are_asked_nothing)
{
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    SCOPED(memory) float *const wanted = guest_picture(&g, &g.frame, &settings);
    glssao_destroy(g.effect);
    glssao_config config = fixture_config(g.f, GUEST_W, GUEST_H);
    watched_user = config.load_user;
    config.load = NULL;
    config.get_proc = get_proc;
    config.host_restores_state = true;
    g.effect = NULL;
    assert_int_equal(glssao_create(&config, &g.effect), GLSSAO_OK);
    GLuint depth = fixture_depth_texture(GL_DEPTH_COMPONENT24, GUEST_W, GUEST_H, NULL), texture;
    const GLuint framebuffer = bind_target(&texture);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    glssao_frame window = {.viewport = {0, 0, GUEST_W, GUEST_H}};
    memcpy(window.projection, g.frame.projection, sizeof window.projection);
    const GLuint weights = fixture_normal_texture(GUEST_W, GUEST_H, NULL);
    for (int i = 0; i < 3; ++i) {
        queries.count = 0;
        assert_int_equal(glssao_begin_normals(g.effect, depth), GLSSAO_OK);
        assert_int_equal(glssao_end_normals(g.effect), GLSSAO_OK);
        assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
        assert_int_equal(glssao_apply(g.effect, framebuffer), GLSSAO_OK);
        for (unsigned k = 0; k < 32; ++k) {
            const glssao_apply_options options = {.framebuffer = framebuffer,
                                                  .intensity = 0.5f,
                                                  .color = {k & 1 ? 0.25f : 0.0f},
                                                  .strength_texture = k & 2 ? weights : 0,
                                                  .albedo_texture = k & 4 ? weights : 0,
                                                  .show = k & 8,
                                                  .keep_scissor = k & 16,
                                                  .keep_stencil = k & 16};
            assert_int_equal(glssao_apply_with(g.effect, &options), GLSSAO_OK);
        }
        assert_int_equal(glssao_compute_framebuffer(g.effect, framebuffer, &window, &settings), GLSSAO_OK);
        if (i > 0 && queries.count > 0)
            fail_msg("%d queries, the first for 0x%04X", queries.count, queries.names[0]);
    }
    SCOPED(memory) float *const got = guest_picture(&g, &g.frame, &settings);
    guest_same_picture(got, wanted, "a host that restores its state");
    assert_int_equal(glssao_resize(g.effect, GUEST_W / 2, GUEST_H), GLSSAO_OK);
    fixture_clear_log(g.f);
    guest_refused(&g, glssao_compute(g.effect, &g.frame, &settings), "frame.depth_texture", "another size");
    gl.UseProgram(0); /* as such a host does */
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(3, (const GLuint[3]){depth, texture, weights});
}

/* A driver blocks where a query is begun whose last result is still to come, or where a result is asked for early. */
TEST_GL(timers_never_make_the_cpu_wait)
{
    SCOPED(guest) guest g = open_watched(f);
    memset(&timers, 0, sizeof timers);
    timers.never_ready = true;
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
    for (int i = 0; i < 20; ++i) {
        assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
        const glssao_stats stats = glssao_get_stats(g.effect);
        assert_true(stats.draw_calls > 0 && stats.gpu_ms < 0.0);
    }
    assert_true(timers.counts > 0);
    assert_int_equal(timers.waits, 0);
    if (timers.reused)
        fail_msg("%d timestamps were begun anew before the last ones were there", timers.reused);
    timers.never_ready = false; /* the GPU has caught up: frames are timed again */
    gl.Finish();
    for (int i = 0; i < 20; ++i)
        assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
    gl.Finish();
    assert_true(glssao_get_stats(g.effect).gpu_ms >= 0.0);
}

/* ---- debug contexts ---- */

static char first_message[512];
static int messages;

static void APIENTRY take_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                  const GLchar *message, const void *user)
{
    (void)source;
    (void)type;
    (void)id;
    (void)length;
    (void)user;
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION)
        return;
    if (messages++ == 0)
        snprintf(first_message, sizeof first_message, "%s", message);
}

static void compute_all(guest *g)
{
    static const glssao_technique techniques[] = {GLSSAO_CLASSIC, GLSSAO_HEMISPHERE, GLSSAO_HORIZON};
    for (int t = 0; t < 3; ++t)
        for (int q = GLSSAO_LOW; q <= GLSSAO_ULTRA; ++q)
            for (int variant = 0; variant < 4; ++variant) {
                glssao_settings settings = glssao_default_settings(techniques[t], (glssao_quality)q);
                glssao_frame frame = g->frame;
                if (variant == 1)
                    frame.normal_texture = 0;
                if (variant == 2)
                    settings.tiles = GLSSAO_TILES_ON;
                if (variant == 3 && techniques[t] == GLSSAO_HORIZON) {
                    frame.margin = 4;
                    frame.back_texture = frame.second_texture = frame.depth_texture;
                    frame.viewport[2] = GUEST_W;
                    frame.viewport[3] = GUEST_H;
                }
                assert_int_equal(glssao_compute(g->effect, &frame, &settings), GLSSAO_OK);
                if (messages)
                    fail_msg("technique %d, quality %d, variant %d: \"%s\"", t, q, variant, first_message);
            }
}

TEST_GL(a_debug_context_has_nothing_to_say)
{
    PFNGLDEBUGMESSAGECALLBACKPROC set_callback;
    guest_load(f, "glDebugMessageCallback", &set_callback);
    set_callback(take_message, NULL);
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl.Enable(GL_TEXTURE_BINDING_2D); /* an error, which must be told: else this test could not fail */
    assert_int_equal(gl.GetError(), GL_INVALID_ENUM);
    assert_int_equal(messages, 1);
    const int last_path = fixture_hides_newer() ? GLSSAO_PATH_FRAGMENT : GLSSAO_PATH_COMPUTE;
    for (int path = GLSSAO_PATH_FRAGMENT; path <= last_path; ++path) {
        messages = 0;
        guest g = guest_open(f, (glssao_path)path);
        if (messages)
            fail_msg("glssao_create: \"%s\"", first_message);
        compute_all(&g);
        const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
        for (int i = 0; i < 3; ++i)
            assert_int_equal(glssao_accumulate(g.effect, &g.frame, &settings), GLSSAO_OK);
        (void)glssao_get_stats(g.effect);
        assert_int_equal(glssao_begin_normals(g.effect, g.frame.depth_texture), GLSSAO_OK);
        assert_int_equal(glssao_end_normals(g.effect), GLSSAO_OK);
        assert_int_equal(glssao_resize(g.effect, GUEST_W / 2, GUEST_H), GLSSAO_OK);
        guest_close(&g);
        if (messages)
            fail_msg("path %d: \"%s\"", path, first_message);
    }
    gl.Disable(GL_DEBUG_OUTPUT);
    set_callback(NULL, NULL);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
