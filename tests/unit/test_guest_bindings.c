/* SPDX-License-Identifier: MIT
 *
 * What the host has bound stays bound, whatever the effect does to its own maps, and no call leaves a GL error.
 * Runs in core and compatibility contexts.
 */
#include "guest.h"

#include <stdio.h>
#include <stdlib.h>

enum { UNITS = 16 }; /* every context has so many; the effect uses the first eight */

/* ---- maps of the effect on the host's units ---- */

typedef struct change {
    const char *name;
    glssao_technique technique;
    glssao_quality quality;
    int half, upsample; /* -1: as the quality has it */
    int margin;
    bool layers, tiles, accumulate;
} change;

static const change changes[] = {
    {"ultra", GLSSAO_HORIZON, GLSSAO_ULTRA, -1, -1, 0, false, false, false},
    {"high", GLSSAO_HORIZON, GLSSAO_HIGH, -1, -1, 0, false, false, false},
    {"full size", GLSSAO_HORIZON, GLSSAO_LOW, 0, 0, 0, false, false, false},
    {"half size, not upsampled", GLSSAO_HORIZON, GLSSAO_LOW, 1, 0, 0, false, false, false},
    {"half size, upsampled", GLSSAO_HORIZON, GLSSAO_LOW, 1, 1, 0, false, false, false},
    {"margin of 8", GLSSAO_HORIZON, GLSSAO_LOW, 1, 1, 8, false, false, false},
    {"margin of 4", GLSSAO_HORIZON, GLSSAO_LOW, 0, 0, 4, false, false, false},
    {"layers", GLSSAO_HORIZON, GLSSAO_LOW, -1, -1, 0, true, false, false},
    {"tiles", GLSSAO_HORIZON, GLSSAO_LOW, -1, -1, 0, false, true, false},
    {"accumulation", GLSSAO_HORIZON, GLSSAO_LOW, -1, -1, 0, false, false, true},
    {"classic, half size", GLSSAO_CLASSIC, GLSSAO_HIGH, 1, 0, 0, false, false, false},
    {"classic, full size", GLSSAO_CLASSIC, GLSSAO_HIGH, 0, 0, 0, false, false, false},
    {"hemisphere", GLSSAO_HEMISPHERE, GLSSAO_LOW, -1, -1, 0, false, false, false},
};
enum { CHANGES = sizeof changes / sizeof *changes };

static void run_change(guest *g, const change *c)
{
    glssao_settings settings = glssao_default_settings(c->technique, c->quality);
    glssao_frame frame = g->frame;
    if (c->half >= 0)
        settings.half_resolution = c->half;
    if (c->upsample >= 0)
        settings.upsample = c->upsample;
    if (c->tiles)
        settings.tiles = GLSSAO_TILES_ON;
    if (c->layers)
        frame.back_texture = frame.second_texture = frame.depth_texture;
    frame.margin = c->margin;
    const glssao_result result =
        c->accumulate ? glssao_accumulate(g->effect, &frame, &settings) : glssao_compute(g->effect, &frame, &settings);
    if (result != GLSSAO_OK)
        fail_msg("%s: %s", c->name, g->f->log);
}

static GLuint bound_on(GLuint unit)
{
    GLint name = 0;
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &name);
    return (GLuint)name;
}

/* Binds every map of the effect, one a unit; a map that is not there leaves its unit empty. */
static void bind_maps(const guest *g, GLuint out_names[GLSSAO_MAP_TILES + 1])
{
    for (GLuint id = 0; id <= GLSSAO_MAP_TILES; ++id) {
        out_names[id] = glssao_map(g->effect, (glssao_map_id)id, NULL, NULL);
        gl.ActiveTexture(GL_TEXTURE0 + id);
        gl.BindTexture(GL_TEXTURE_2D, out_names[id]);
    }
}

/* The map was kept, and is bound still; or it was deleted, which leaves the unit empty (OpenGL 3.3, section 3.8.1).
 * A name that GL made anew by binding it has no size. A name that now is another map of the effect is wrong, too. */
static void check_maps(const guest *g, const GLuint names[GLSSAO_MAP_TILES + 1], const char *from, const char *to)
{
    char what[128];
    snprintf(what, sizeof what, "from %s to %s with maps bound", from, to);
    guest_no_error(what);
    for (GLuint id = 0; id <= GLSSAO_MAP_TILES; ++id) {
        const GLuint bound = bound_on(id);
        if (bound == 0)
            continue;
        GLint width = 0;
        gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
        if (bound != names[id] || width == 0)
            fail_msg("%s: map %u was texture %u, and its unit now holds texture %u of width %d", what, id, names[id],
                     bound, width);
        for (GLuint other = 0; other <= GLSSAO_MAP_TILES; ++other)
            if (other != id && names[other] != bound &&
                glssao_map(g->effect, (glssao_map_id)other, NULL, NULL) == bound)
                fail_msg("%s: texture %u was map %u and is map %u now", what, bound, id, other);
    }
}

static void maps_may_stay_bound_when_a_setting_changes(void **state)
{
    for (int from = 0; from < CHANGES; ++from) {
        guest g = guest_open(*state, GLSSAO_PATH_AUTO);
        for (int to = 0; to < CHANGES; ++to) {
            GLuint names[GLSSAO_MAP_TILES + 1];
            run_change(&g, &changes[from]);
            bind_maps(&g, names);
            run_change(&g, &changes[to]);
            check_maps(&g, names, changes[from].name, changes[to].name);
        }
        GLuint names[GLSSAO_MAP_TILES + 1];
        bind_maps(&g, names);
        assert_int_equal(glssao_resize(g.effect, GUEST_W / 2, GUEST_H), GLSSAO_OK);
        check_maps(&g, names, changes[from].name, "another size");
        guest_close(&g);
        guest_no_error("destroying an effect whose maps are bound");
        for (GLuint unit = 0; unit < UNITS; ++unit)
            assert_int_equal(bound_on(unit), 0);
    }
    gl.ActiveTexture(GL_TEXTURE0);
}

/* ---- every unit ---- */

static void every_unit_is_restored(void **state)
{
    guest g = guest_open(*state, GLSSAO_PATH_AUTO);
    GLuint textures[UNITS], samplers[UNITS], multisample;
    gl.GenTextures(UNITS, textures);
    gl.GenSamplers(UNITS, samplers);
    gl.GenTextures(1, &multisample);
    for (GLuint unit = 0; unit < UNITS; ++unit) {
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, multisample);
    }
    gl.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, 4, GL_DEPTH_COMPONENT24, GUEST_W, GUEST_H, GL_TRUE);
    for (int i = 0; i <= CHANGES; ++i) {
        for (GLuint unit = 0; unit < UNITS; ++unit) {
            gl.ActiveTexture(GL_TEXTURE0 + unit);
            gl.BindTexture(GL_TEXTURE_2D, textures[unit]);
            gl.BindSampler(unit, samplers[unit]);
        }
        const char *name = "apply";
        if (i < CHANGES) {
            name = changes[i].name;
            run_change(&g, &changes[i]);
        } else {
            assert_int_equal(glssao_apply(g.effect, 0), GLSSAO_FRAMEBUFFER_ERROR); /* there is no window */
        }
        GLint active = 0;
        gl.GetIntegerv(GL_ACTIVE_TEXTURE, &active);
        assert_int_equal(active, GL_TEXTURE0 + UNITS - 1);
        for (GLuint unit = 0; unit < UNITS; ++unit) {
            GLint sampler = 0, other = 0;
            const GLuint bound = bound_on(unit);
            gl.GetIntegerv(GL_SAMPLER_BINDING, &sampler);
            gl.GetIntegerv(GL_TEXTURE_BINDING_2D_MULTISAMPLE, &other);
            if (bound != textures[unit] || (GLuint)sampler != samplers[unit] || (GLuint)other != multisample)
                fail_msg("after %s, unit %u holds texture %u, sampler %d, multisample texture %d", name, unit, bound,
                         sampler, other);
        }
    }
    gl.ActiveTexture(GL_TEXTURE0);
    gl.DeleteTextures(UNITS, textures);
    gl.DeleteSamplers(UNITS, samplers);
    gl.DeleteTextures(1, &multisample);
    guest_close(&g);
}

/* ---- framebuffer names ---- */

typedef struct target {
    GLuint texture, framebuffer;
} target;

static target make_white(void)
{
    target t;
    gl.GenTextures(1, &t.texture);
    gl.BindTexture(GL_TEXTURE_2D, t.texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, GUEST_W, GUEST_H, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.GenFramebuffers(1, &t.framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, t.texture, 0);
    gl.ClearBufferfv(GL_COLOR, 0, (const float[4]){1.0f, 1.0f, 1.0f, 1.0f});
    return t;
}

static int count_dark(const target *t)
{
    int count = 0;
    float *const pixels = fixture_read_texture(t->texture, GUEST_W, GUEST_H, 1);
    for (int i = 0; i < GUEST_W * GUEST_H; ++i)
        count += pixels[i] < 0.99f;
    free(pixels);
    return count;
}

static void delete_white(target *t)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &t->framebuffer);
    gl.DeleteTextures(1, &t->texture);
}

static void apply_refuses_a_name_that_is_no_framebuffer(void **state)
{
    guest g = guest_open(*state, GLSSAO_PATH_AUTO);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
    target bound = make_white();
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
        assert_int_equal(count_dark(&bound), 0);
    }
    fixture_clear_log(g.f);
    assert_int_equal(glssao_apply(g.effect, bound.framebuffer), GLSSAO_OK);
    assert_true(count_dark(&bound) > 0);
    delete_white(&bound);
    guest_close(&g);
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

static void a_texture_of_another_target_leaves_no_error(void **state)
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
    guest g = guest_open(*state, GLSSAO_PATH_AUTO);
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
    GLuint empty;
    gl.GenTextures(1, &empty);
    refuse_everywhere(&g, empty, false, "a texture never bound");
    gl.BindTexture(GL_TEXTURE_2D, empty);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    refuse_everywhere(&g, empty, false, "a texture without an image");
    gl.DeleteTextures(1, &empty);
    guest_close(&g);
}

/* An error of the host's own that nobody asked for yet is the host's to find. */
static void the_hosts_own_error_stays(void **state)
{
    guest g = guest_open(*state, GLSSAO_PATH_AUTO);
    GLuint name = make_of_target(g.f, GL_TEXTURE_3D);
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
    gl.DeleteTextures(1, &name);
    guest_close(&g);
}

/* ---- programs and pairs ---- */

static GLuint make_program(void)
{
    static const char *const sources[2] = {"#version 330\nvoid main() { gl_Position = vec4(0.0); }\n",
                                           "#version 330\nout vec4 o_color;\nvoid main() { o_color = vec4(1.0); }\n"};
    const GLuint program = gl.CreateProgram();
    for (int i = 0; i < 2; ++i) {
        const GLuint shader = gl.CreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        gl.ShaderSource(shader, 1, &sources[i], NULL);
        gl.CompileShader(shader);
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader);
    }
    gl.LinkProgram(program);
    return program;
}

/* GL deletes a program that is current once another becomes current, and no call brings it back. */
static void a_deleted_program_that_is_current_stays_current(void **state)
{
    guest g = guest_open(*state, GLSSAO_PATH_AUTO);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    assert_int_equal(glssao_compute(g.effect, &g.frame, &settings), GLSSAO_OK);
    target t = make_white();
    const GLuint program = make_program();
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
    delete_white(&t);
    guest_close(&g);
}

/* Either the pairs are undone in any order, or the end that comes too early is refused, changes nothing, and works
 * once the inner pair has ended. */
static void crossed_pairs_give_the_hosts_framebuffer_back(void **state)
{
    guest a = guest_open(*state, GLSSAO_PATH_AUTO), b = guest_open(*state, GLSSAO_PATH_AUTO);
    target t = make_white();
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
    delete_white(&t);
    gl.DeleteTextures(2, depth);
    guest_close(&a);
    guest_close(&b);
}

int main(void)
{
#define GL_TEST(test) cmocka_unit_test_setup_teardown(test, NULL, fixture_no_gl_error)
    const struct CMUnitTest tests[] = {
        GL_TEST(maps_may_stay_bound_when_a_setting_changes),
        GL_TEST(every_unit_is_restored),
        GL_TEST(apply_refuses_a_name_that_is_no_framebuffer),
        GL_TEST(a_texture_of_another_target_leaves_no_error),
        GL_TEST(the_hosts_own_error_stays),
        GL_TEST(a_deleted_program_that_is_current_stays_current),
        GL_TEST(crossed_pairs_give_the_hosts_framebuffer_back),
    };
    const int core = cmocka_run_group_tests_name("core", tests, fixture_setup, fixture_teardown);
    return core + cmocka_run_group_tests_name("compatibility", tests, guest_setup_compatibility, fixture_teardown);
}
