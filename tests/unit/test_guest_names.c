/* SPDX-License-Identifier: MIT
 *
 * Names of objects that the host hands over, has deleted, or has bound by another effect: each call either does what it
 * promises or refuses and changes nothing. Runs in core and compatibility contexts.
 */
#include "guest.h"

/* ---- framebuffer names ---- */

TEST_GL(apply_refuses_a_name_that_is_no_framebuffer)
{
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
    SCOPED(target) const fixture_target bound = guest_make_white();
    GLuint deleted;
    gl.GenFramebuffers(1, &deleted);
    gl.BindFramebuffer(GL_FRAMEBUFFER, deleted);
    gl.BindFramebuffer(GL_FRAMEBUFFER, bound.framebuffer);
    gl.DeleteFramebuffers(1, &deleted);
    const GLuint names[] = {deleted, 4000000000u, 77777};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        fixture_clear_log(g.f);
        const glssao_result result = glssao_apply(g.effect, names[i]);
        guest_refused(&g, result, "framebuffer = ", i ? "a name never generated" : "a deleted framebuffer");
        GLint draw = 0, read = 0;
        gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
        gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
        assert_true(draw == (GLint)bound.framebuffer && read == draw);
        assert_int_equal(guest_count_dark(&bound), 0);
    }
    fixture_clear_log(g.f);
    assert_int_equal(glssao_apply(g.effect, bound.framebuffer), GLSSAO_OK);
    assert_true(guest_count_dark(&bound) > 0);
}

/* ---- textures ---- */

static GLuint make_of_target(const fixture *f, GLenum kind)
{
    PFNGLTEXIMAGE1DPROC image_1d;
    PFNGLTEXIMAGE3DPROC image_3d;
    PFNGLTEXBUFFERPROC tex_buffer;
    guest_load(f, "glTexImage1D", &image_1d);
    guest_load(f, "glTexImage3D", &image_3d);
    guest_load(f, "glTexBuffer", &tex_buffer);
    GLuint name;
    gl.GenTextures(1, &name);
    gl.BindTexture(kind, name);
    switch (kind) {
    case GL_TEXTURE_1D:
        image_1d(kind, 0, GL_R32F, GUEST_W, 0, GL_RED, GL_FLOAT, NULL);
        break;
    case GL_TEXTURE_3D:
    case GL_TEXTURE_2D_ARRAY:
        image_3d(kind, 0, GL_R32F, GUEST_W, GUEST_H, 1, 0, GL_RED, GL_FLOAT, NULL);
        break;
    case GL_TEXTURE_CUBE_MAP:
        for (GLenum face = 0; face < 6; ++face)
            gl.TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_R32F, GUEST_H, GUEST_H, 0, GL_RED, GL_FLOAT,
                          NULL);
        break;
    case GL_TEXTURE_BUFFER:
        break; /* without a buffer */
    case GL_TEXTURE_2D_MULTISAMPLE:
        gl.TexImage2DMultisample(kind, 4, GL_DEPTH_COMPONENT24, GUEST_W, GUEST_H, GL_TRUE);
        break;
    default:
        gl.TexImage2D(kind, 0, GL_DEPTH_COMPONENT24, GUEST_W, GUEST_H, 0, GL_DEPTH_COMPONENT, GL_FLOAT, NULL);
    }
    gl.BindTexture(kind, 0);
    return name;
}

/* Hands `name` over in each field of a frame in turn, and to glssao_begin_normals. */
static void refuse_everywhere(guest *g, GLuint name, bool multisample, const char *what)
{
    static const char *const fields[] = {"frame.depth_texture", "frame.normal_texture", "frame.back_texture",
                                         "frame.second_texture"};
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    for (int i = multisample ? 0 : -1; i < 4; ++i) {
        char which[128];
        glssao_result result;
        glssao_frame frame = g->frame;
        snprintf(which, sizeof which, "%s as %s", what, i < 0 ? "glssao_begin_normals' texture" : fields[i]);
        fixture_clear_log(g->f);
        if (i < 0) {
            result = glssao_begin_normals(g->effect, name);
        } else {
            uint32_t *const textures[] = {&frame.depth_texture, &frame.normal_texture, &frame.back_texture,
                                          &frame.second_texture};
            if (i >= 2)
                frame.back_texture = frame.second_texture = frame.depth_texture;
            *textures[i] = name;
            frame.multisample = multisample;
            result = glssao_compute(g->effect, &frame, &settings);
        }
        /* With multisample set, the first texture that is a plain one is named, which need not be ours. */
        guest_refused(g, result, multisample ? "frame." : i < 0 ? "depth_texture" : fields[i], which);
    }
}

TEST_GL(a_texture_of_another_target_leaves_no_error)
{
    static const struct {
        GLenum value;
        const char *name;
    } kinds[] = {
        {GL_TEXTURE_1D, "a 1D texture"},
        {GL_TEXTURE_3D, "a 3D texture"},
        {GL_TEXTURE_2D_ARRAY, "an array texture"},
        {GL_TEXTURE_CUBE_MAP, "a cube map"},
        {GL_TEXTURE_RECTANGLE, "a rectangle texture"},
        {GL_TEXTURE_BUFFER, "a buffer texture"},
        {GL_TEXTURE_2D_MULTISAMPLE, "a multisample texture"},
    };
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i) {
        GLuint name = make_of_target(g.f, kinds[i].value);
        guest_no_error("making textures");
        refuse_everywhere(&g, name, false, kinds[i].name);
        if (kinds[i].value != GL_TEXTURE_2D_MULTISAMPLE)
            refuse_everywhere(&g, name, true, kinds[i].name);
        gl.DeleteTextures(1, &name);
        refuse_everywhere(&g, name, false, "a deleted texture");
    }
    refuse_everywhere(&g, 4000000000u, false, "a name never generated");
    SCOPED(texture) GLuint empty = 0;
    gl.GenTextures(1, &empty);
    refuse_everywhere(&g, empty, false, "a texture never bound");
    gl.BindTexture(GL_TEXTURE_2D, empty);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    refuse_everywhere(&g, empty, false, "a texture without an image");
}

/* An error of the host's own that nobody asked for yet is the host's to find. */
TEST_GL(the_hosts_own_error_stays)
{
    if (GLSSAO_CHECK_GL)
        skip(); /* such builds ask for errors after every pass and take the host's */
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    SCOPED(texture) GLuint name = make_of_target(g.f, GL_TEXTURE_3D);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    glssao_frame wrong = g.frame;
    wrong.depth_texture = name;
    gl.Enable(GL_TEXTURE_BINDING_2D); /* no capability: GL_INVALID_ENUM */
    assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
    assert_int_equal(gl.GetError(), GL_INVALID_ENUM);
    gl.Enable(GL_TEXTURE_BINDING_2D);
    assert_int_equal(glssao_compute(g.effect, &wrong, &settings), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(gl.GetError(), GL_INVALID_ENUM);
    assert_int_equal(gl.GetError(), 0);
}

/* ---- programs and pairs ---- */

/* GL deletes a program that is current once another becomes current, and no call brings it back. */
TEST_GL(a_deleted_program_that_is_current_stays_current)
{
    SCOPED(guest) guest g = guest_open(f, GLSSAO_PATH_AUTO);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
    SCOPED(target) const fixture_target t = guest_make_white();
    const GLuint program = fixture_program("#version 330\nvoid main() { gl_Position = vec4(0.0); }\n",
                                           "#version 330\nout vec4 o_color;\nvoid main() { o_color = vec4(1.0); }\n");
    gl.UseProgram(program);
    gl.DeleteProgram(program);
    guest_no_error("deleting the current program");
    for (int i = 0; i < 4; ++i) {
        static const char *const names[] = {"glssao_compute", "glssao_apply", "glssao_accumulate", "glssao_create"};
        glssao_effect *other = NULL;
        const glssao_config config = fixture_config(g.f, GUEST_W, GUEST_H);
        fixture_clear_log(g.f);
        guest_refused(&g,
                      i == 0   ? glssao_compute(g.effect, &g.frame, &settings)
                      : i == 1 ? glssao_apply(g.effect, t.framebuffer)
                      : i == 2 ? glssao_accumulate(g.effect, &g.frame, &settings)
                               : glssao_create(&config, &other),
                      "program", names[i]);
        GLint current = 0, linked = 0;
        gl.GetIntegerv(GL_CURRENT_PROGRAM, &current);
        assert_int_equal(current, program);
        gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
        assert_int_equal(linked, GL_TRUE);
        guest_no_error(names[i]);
    }
    gl.UseProgram(0);
    assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
}

/* Either the pairs are undone in any order, or the end that comes too early is refused, changes nothing, and works
 * once the inner pair has ended. */
TEST_GL(crossed_pairs_give_the_hosts_framebuffer_back)
{
    SCOPED(guest) guest a = guest_open(f, GLSSAO_PATH_AUTO), b = guest_open(f, GLSSAO_PATH_AUTO);
    SCOPED(target) const fixture_target t = guest_make_white();
    gl.Viewport(3, 5, 17, 19);
    GLuint depth[2];
    for (int i = 0; i < 2; ++i)
        depth[i] = make_of_target(a.f, GL_TEXTURE_2D);
    fixture_clear_log(a.f);
    assert_int_equal(glssao_begin_normals(a.effect, depth[0]), GLSSAO_OK);
    const glssao_result inner = glssao_begin_normals(b.effect, depth[1]);
    GLint of_b = 0, now = 0;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &of_b);
    const glssao_result early = glssao_end_normals(a.effect);
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &now);
    if (inner == GLSSAO_OK) {
        assert_int_equal(now, of_b); /* the host still draws b's normals */
        assert_int_equal(glssao_end_normals(b.effect), GLSSAO_OK);
        if (early != GLSSAO_OK)
            assert_int_equal(glssao_end_normals(a.effect), GLSSAO_OK);
    }
    if (inner != GLSSAO_OK || early != GLSSAO_OK)
        assert_non_null(strstr(a.f->log, "normals"));
    GLint draw = 0, read = 0, viewport[4];
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
    gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
    gl.GetIntegerv(GL_VIEWPORT, viewport);
    assert_true(draw == (GLint)t.framebuffer && read == draw);
    assert_true(viewport[0] == 3 && viewport[1] == 5 && viewport[2] == 17 && viewport[3] == 19);
    guest_no_error("crossed pairs");
    gl.DeleteTextures(2, depth);
}

int main(void)
{
    const int core = test_run("core", fixture_setup, fixture_teardown);
    return core + test_run("compatibility", guest_setup_compatibility, fixture_teardown);
}
