/* SPDX-License-Identifier: MIT
 *
 * Host state outside the saved table that could change a result: the effect neutralises it and gives it back, or
 * refuses the call and names it. Runs in core and compatibility contexts; a case that a context does not have is left
 * out there.
 */
#include "guest.h"

/* Of the compatibility profile, which glcorearb.h leaves out. */
enum {
    MAP_COLOR = 0x0D10,
    RED_SCALE = 0x0D14,
    RED_BIAS = 0x0D15,
    PIXEL_MAP_R_TO_R = 0x0C76,
    RENDER_MODE = 0x0C40,
    RENDER = 0x1C00,
    FEEDBACK = 0x1C01,
    SELECT = 0x1C02,
    FEEDBACK_2D = 0x0600,
    CLAMP_FRAGMENT_COLOR = 0x891B
};

static glssao_settings horizon(void)
{
    return glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
}

/* ---- fixed-function state ---- */

TEST_GL(clamped_fragment_colours_change_nothing)
{
    void(APIENTRY * clamp_color)(GLenum, GLenum);
    if (!guest_is_compatibility())
        return; /* the core profile has no such state */
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    guest_load(g.f, "glClampColor", &clamp_color);
    static const glssao_technique techniques[] = {GLSSAO_CLASSIC, GLSSAO_HEMISPHERE, GLSSAO_HORIZON};
    glssao_frame bare = g.frame; /* rebuilt normals are negative, distances above 1 */
    bare.normal_texture = 0;
    for (int i = 0; i < 3; ++i) {
        glssao_settings settings = glssao_default_settings(techniques[i], GLSSAO_HIGH);
        settings.half_resolution = techniques[i] == GLSSAO_HORIZON;
        SCOPED(memory) float *const wanted = guest_picture(&g, &bare, &settings);
        clamp_color(CLAMP_FRAGMENT_COLOR, GL_TRUE);
        SCOPED(memory) float *const got = guest_picture(&g, &bare, &settings);
        GLint now = 0;
        gl.GetIntegerv(CLAMP_FRAGMENT_COLOR, &now);
        clamp_color(CLAMP_FRAGMENT_COLOR, GL_FIXED_ONLY);
        guest_same_picture(got, wanted, "with GL_CLAMP_FRAGMENT_COLOR");
        assert_int_equal(now, GL_TRUE);
    }
}

/* Scale, bias and maps change texels on their way in (the random vectors) and out (the error of accumulation). */
static double error_of_accumulation(guest *g)
{
    const glssao_settings settings = horizon();
    for (int i = 0; i < 4; ++i)
        assert_int_equal(glssao_accumulate(g->effect, &g->frame, &settings), GLSSAO_OK);
    gl.Finish();
    return glssao_get_stats(g->effect).sampling_error;
}

TEST_GL(pixel_transfer_changes_nothing)
{
    void(APIENTRY * pixel_transfer)(GLenum, GLfloat);
    void(APIENTRY * pixel_map)(GLenum, GLsizei, const GLfloat *);
    if (!guest_is_compatibility() || fixture_hides_newer()) /* the core profile's functions alone can't set it */
        return;
    SCOPED(guest) guest calm = guest_open(f, GLSSAO_PATH_AUTO);
    guest_load(calm.f, "glPixelTransferf", &pixel_transfer);
    guest_load(calm.f, "glPixelMapfv", &pixel_map);
    const double wanted_error = error_of_accumulation(&calm);
    assert_true(wanted_error > 0.0);
    int w, h;
    SCOPED(memory)
    float *const wanted = fixture_read_texture(glssao_map(calm.effect, GLSSAO_MAP_RANDOM_VECTOR, &w, &h), 256, 256, 4);
    for (int i = 0; i < 2; ++i) {
        const char *const what = i ? "a pixel map" : "scale and bias";
        if (i) {
            pixel_map(PIXEL_MAP_R_TO_R, 2, (const GLfloat[2]){0.25f, 0.75f});
            pixel_transfer(MAP_COLOR, 1.0f);
        } else {
            pixel_transfer(RED_SCALE, 0.5f);
            pixel_transfer(RED_BIAS, 0.25f);
        }
        SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
        const glssao_frame own = g.frame; /* uploaded by this test, with the transfer on */
        g.frame = calm.frame;
        const double error = error_of_accumulation(&g);
        g.frame = own;
        GLfloat scale = 0.0f, bias = 0.0f, map = 0.0f;
        gl.GetFloatv(RED_SCALE, &scale);
        gl.GetFloatv(RED_BIAS, &bias);
        gl.GetFloatv(MAP_COLOR, &map);
        pixel_transfer(MAP_COLOR, 0.0f);
        pixel_transfer(RED_SCALE, 1.0f);
        pixel_transfer(RED_BIAS, 0.0f);
        SCOPED(memory)
        float *const got = fixture_read_texture(glssao_map(g.effect, GLSSAO_MAP_RANDOM_VECTOR, &w, &h), 256, 256, 4);
        for (int k = 0; k < 4 * 256 * 256; ++k)
            if (got[k] != wanted[k])
                fail_msg("with %s, a random vector holds %g instead of %g", what, (double)got[k], (double)wanted[k]);
        if (error != wanted_error)
            fail_msg("with %s, the error of accumulation is %g instead of %g", what, error, wanted_error);
        assert_true(scale == (i ? 1.0f : 0.5f) && bias == (i ? 0.0f : 0.25f) && map == (float)i);
    }
}

/* Without fragments there is no result, and leaving these modes would empty the host's buffer: refused. */
TEST_GL(feedback_and_selection_are_refused)
{
    GLint(APIENTRY * render_mode)(GLenum);
    void(APIENTRY * feedback_buffer)(GLsizei, GLenum, GLfloat *);
    void(APIENTRY * select_buffer)(GLsizei, GLuint *);
    if (!guest_is_compatibility())
        return;
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    guest_load(g.f, "glRenderMode", &render_mode);
    guest_load(g.f, "glFeedbackBuffer", &feedback_buffer);
    guest_load(g.f, "glSelectBuffer", &select_buffer);
    const glssao_settings settings = horizon();
    SCOPED(memory) float *const wanted = guest_picture(&g, &g.frame, &settings);
    static GLfloat feedback[64];
    static GLuint selection[64];
    feedback_buffer(64, FEEDBACK_2D, feedback);
    select_buffer(64, selection);
    for (int i = 0; i < 4; ++i) {
        const char *const what = i < 2 ? "feedback" : "selection";
        const GLint mode = i < 2 ? FEEDBACK : SELECT;
        GLint now = 0;
        render_mode((GLenum)mode);
        fixture_clear_log(g.f);
        const glssao_result result =
            i % 2 ? glssao_accumulate(g.effect, &g.frame, &settings) : glssao_compute(g.effect, &g.frame, &settings);
        gl.GetIntegerv(RENDER_MODE, &now);
        render_mode(RENDER);
        guest_refused(&g, result, "GL_RENDER_MODE", what);
        assert_int_equal(now, mode);
        SCOPED(memory) float *const got = guest_picture(&g, &g.frame, &settings);
        guest_same_picture(got, wanted, what);
    }
}

/* ---- conditional rendering and transform feedback ---- */

static GLuint query_without_samples(void)
{
    GLuint query;
    gl.GenQueries(1, &query);
    gl.BeginQuery(GL_SAMPLES_PASSED, query);
    gl.EndQuery(GL_SAMPLES_PASSED);
    return query;
}

/* Fails where the result has a pixel that is not 1. */
static void check_all_one(const glssao_effect *effect, const char *what)
{
    int w, h;
    const uint32_t map = glssao_map(effect, GLSSAO_MAP_AMBIENT, &w, &h);
    SCOPED(memory) float *const pixels = fixture_read_texture(map, w, h, 1);
    for (int i = 0; i < w * h; ++i)
        if (pixels[i] != 1.0f)
            fail_msg("%s: pixel %d, %d is %g instead of 1", what, i % w, i / w, (double)pixels[i]);
}

/* GL has no query that tells, so the frame may be dropped; later frames must be right. */
TEST_GL(a_frame_under_conditional_rendering_harms_no_later_one)
{
    PFNGLBEGINCONDITIONALRENDERPROC begin;
    PFNGLENDCONDITIONALRENDERPROC end;
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    guest_load(g.f, "glBeginConditionalRender", &begin);
    guest_load(g.f, "glEndConditionalRender", &end);
    const GLuint query = query_without_samples();
    const glssao_settings settings = horizon();
    glssao_frame sky = g.frame;
    sky.only_sky = true;
    SCOPED(memory) float *const wanted = guest_picture(&g, &g.frame, &settings);
    begin(query, GL_QUERY_WAIT);
    (void)glssao_compute(g.effect, &g.frame, &settings);
    end();
    guest_no_error("conditional rendering");
    SCOPED(memory) float *const got = guest_picture(&g, &g.frame, &settings);
    guest_same_picture(got, wanted, "after conditional rendering");
    begin(query, GL_QUERY_WAIT);
    (void)glssao_compute(g.effect, &sky, &settings);
    SCOPED(effect)
    glssao_effect *other = fixture_effect(g.f, GUEST_W, GUEST_H); /* maps that are made are cleared, too */
    end();
    guest_no_error("conditional rendering");
    assert_int_equal(glssao_compute(g.effect, &sky, &settings), GLSSAO_OK);
    check_all_one(g.effect, "only sky, after conditional rendering");
    assert_int_equal(glssao_compute(other, &sky, &settings), GLSSAO_OK);
    check_all_one(other, "an effect made under conditional rendering");
    gl.DeleteQueries(1, &query);
}

/* Another program can't be taken while it is active (OpenGL 3.3, section 2.15). */
TEST_GL(active_transform_feedback_is_refused)
{
    PFNGLBEGINTRANSFORMFEEDBACKPROC begin;
    PFNGLENDTRANSFORMFEEDBACKPROC end;
    PFNGLTRANSFORMFEEDBACKVARYINGSPROC varyings;
    guest g = guest_open(f, GLSSAO_PATH_AUTO);
    GLint version[2];
    gl.GetIntegerv(GL_MAJOR_VERSION, &version[0]);
    if (version[0] < 4 || fixture_hides_newer()) { /* OpenGL 3.3 can't be asked */
        guest_close(&g);
        return;
    }
    guest_load(g.f, "glBeginTransformFeedback", &begin);
    guest_load(g.f, "glEndTransformFeedback", &end);
    guest_load(g.f, "glTransformFeedbackVaryings", &varyings);
    const glssao_settings settings = horizon();
    assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
    static const char *const source = "#version 330\nout vec4 v;\nvoid main() { gl_Position = v = vec4(0.0); }\n";
    static const char *const names[] = {"v"};
    GLuint buffer, array;
    const GLuint program = gl.CreateProgram(), shader = gl.CreateShader(GL_VERTEX_SHADER);
    gl.ShaderSource(shader, 1, &source, NULL);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
    varyings(program, 1, names, GL_INTERLEAVED_ATTRIBS);
    gl.LinkProgram(program);
    gl.GenBuffers(1, &buffer);
    gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
    gl.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, 4096, NULL, GL_STATIC_DRAW);
    gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.UseProgram(program);
    begin(GL_POINTS);
    guest_no_error("starting transform feedback");
    fixture_clear_log(g.f);
    const glssao_result result = glssao_compute(g.effect, &g.frame, &settings);
    end();
    guest_refused(&g, result, "transform feedback", "active transform feedback");
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, 0);
    gl.DeleteVertexArrays(1, &array);
    gl.DeleteBuffers(1, &buffer);
    gl.DeleteShader(shader);
    gl.DeleteProgram(program);
    guest_close(&g);
}

int main(void)
{
    const int core = test_run("core", fixture_setup, fixture_teardown);
    return core + test_run("compatibility", guest_setup_compatibility, fixture_teardown);
}
