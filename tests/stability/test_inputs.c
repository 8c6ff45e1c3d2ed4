/* SPDX-License-Identifier: MIT
 *
 * Textures that are copied first give the same picture as plain ones: one sample of several, a viewport in larger
 * textures, logarithmic depth. Unreadable input is refused and named; a texture that stays attached to another
 * framebuffer is fine.
 */
#include "techniques.h"

enum { W = 60, H = 44, X = 13, Y = 7, LARGE_W = 96, LARGE_H = 64, NUMBERS = 6 };
static const int numbers[NUMBERS] = {0, 5, 12, 17, 18, 23}; /* configurations */

static subject room(void)
{
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    return subject_of(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, W, H);
}

/* ---- textures that are drawn into, since multisample textures cannot be filled otherwise ---- */

static GLuint compile_copier(void)
{
    static const char *const vertex =
        "#version 330\nvoid main() { gl_Position = vec4(vec2(gl_VertexID % 2, gl_VertexID / 2)"
        " * 4.0 - 1.0, 0.0, 1.0); }\n";
    static const char *const fragment =
        "#version 330\nuniform sampler2D u_map; uniform vec4 u_instead; out vec4 o_color;\n"
        "void main() { vec4 t = texelFetch(u_map, ivec2(gl_FragCoord.xy), 0);\n"
        "if (u_instead.w > 0.0) t = u_instead; gl_FragDepth = t.r; o_color = t; }\n";
    return fixture_program(vertex, fragment);
}

/* A multisample texture whose first sample holds `plain`'s texels; its other samples hold values that would spoil the
 * picture. */
static GLuint multisampled(GLuint plain, GLenum internal, bool is_depth)
{
    GLuint texture, framebuffer, vertex_array, program = compile_copier();
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
    gl.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, 4, internal, W, H, GL_TRUE);
    gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, is_depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
                            GL_TEXTURE_2D_MULTISAMPLE, texture, 0);
    assert_int_equal(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    gl.GenVertexArrays(1, &vertex_array);
    gl.BindVertexArray(vertex_array);
    gl.Viewport(0, 0, W, H);
    gl.UseProgram(program);
    gl.BindTexture(GL_TEXTURE_2D, plain);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_ALWAYS);
    gl.Enable(GL_SAMPLE_MASK);
    for (int i = 0; i < 2; ++i) {
        gl.SampleMaski(0, i ? ~1u : 1u);
        gl.Uniform4f(gl.GetUniformLocation(program, "u_instead"), 0.3f, 0.3f, 0.3f, i ? 1.0f : 0.0f);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl.Disable(GL_SAMPLE_MASK);
    gl.SampleMaski(0, ~0u);
    gl.Disable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteVertexArrays(1, &vertex_array);
    gl.UseProgram(0);
    gl.DeleteProgram(program);
    return texture;
}

/* The same map inside a larger one; the rest of that holds values that would spoil the picture. */
static float *enlarged(const float *values, int channels)
{
    float *large = malloc((size_t)LARGE_W * LARGE_H * (size_t)channels * sizeof *large);
    for (int y = 0; y < LARGE_H; ++y)
        for (int x = 0; x < LARGE_W; ++x)
            for (int c = 0; c < channels; ++c) {
                const bool inside = x >= X && y >= Y && x < X + W && y < Y + H;
                large[(y * LARGE_W + x) * channels + c] = inside ? values[((y - Y) * W + x - X) * channels + c] : 0.2f;
            }
    return large;
}

static void assert_same(fixture *f, const glssao_frame *plain, const glssao_frame *other, double most)
{
    for (int i = 0; i < NUMBERS; ++i) {
        const configuration c = configuration_of(numbers[i]);
        SCOPED(picture)
        picture a = subject_shade(f, W, H, plain, &c.settings), b = subject_shade(f, W, H, other, &c.settings);
        assert_true(a.width == b.width && a.height == b.height && picture_is_sound(&b) && picture_mean(&a) < 0.995);
        double apart = 0.0;
        for (int k = 0; k < a.width * a.height; ++k)
            apart += fabs((double)a.values[k] - (double)b.values[k]) / (a.width * a.height);
        if (apart > most)
            fail_msg("%s: %g apart", c.name, apart);
    }
}

TEST_GL(first_samples_are_taken)
{
    SCOPED(subject) subject s = room();
    for (int normals = 0; normals < 2; ++normals) {
        glssao_frame plain = subject_frame(&s, DEPTH_32F, normals ? NORMAL_16F : NORMAL_NONE), other = plain;
        other.multisample = true;
        other.depth_texture = multisampled(plain.depth_texture, GL_DEPTH_COMPONENT32F, true);
        if (normals)
            other.normal_texture = multisampled(plain.normal_texture, GL_RGBA16F, false);
        /* The host's bindings come back. */
        GLint bound = 0;
        for (int unit = 0; unit < 8; ++unit) {
            gl.ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
            gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, other.depth_texture);
        }
        assert_same(f, &plain, &other, 0.0);
        for (int unit = 0; unit < 8; ++unit) {
            gl.ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
            gl.GetIntegerv(GL_TEXTURE_BINDING_2D_MULTISAMPLE, &bound);
            assert_int_equal(bound, other.depth_texture);
        }
        gl.ActiveTexture(GL_TEXTURE0);
        gl.DeleteTextures(1, &other.depth_texture);
        if (normals)
            gl.DeleteTextures(1, &other.normal_texture);
        fixture_delete_frame(&plain);
    }
    glssao_frame plain = subject_frame(&s, ALPHA_32F, NORMAL_32F), other = plain;
    other.multisample = true;
    other.normal_texture = multisampled(plain.normal_texture, GL_RGBA32F, false);
    assert_same(f, &plain, &other, 0.0);
    gl.DeleteTextures(1, &other.normal_texture);
    fixture_delete_frame(&plain);
}

/* To the bit on llvmpipe. Hardware filters DEPTH24 otherwise than the floats of a copy. */
TEST_GL(viewports_are_crops)
{
    SCOPED(subject) subject s = room(), large = {.width = LARGE_W, .height = LARGE_H, .view = s.view};
    large.depth = enlarged(s.depth, 1);
    large.normals = enlarged(s.normals, 3);
    large.distance = enlarged(s.distance, 1);
    for (int depth = 0; depth < DEPTH_STORES; depth += 3) {
        SCOPED(frame) glssao_frame plain = subject_frame(&s, (depth_store)depth, NORMAL_32F);
        SCOPED(frame) glssao_frame other = subject_frame(&large, (depth_store)depth, NORMAL_32F);
        memcpy(other.viewport, (const int[4]){X, Y, W, H}, sizeof other.viewport);
        assert_same(f, &plain, &other, context_is_software(f->context) ? 0.0 : 1e-4);
    }
}

/* It rounds differently from window depth. */
TEST_GL(logarithms_are_undone)
{
    static const double constants[] = {0.0, 1.0, 0.01, 100.0};
    SCOPED(subject) subject s = room();
    for (int i = 0; i < 4; ++i) {
        const double c = i == 0 ? 1.0 : constants[i], far_distance = 40.0;
        subject stored = s;
        stored.depth = malloc((size_t)W * H * sizeof(float));
        for (int k = 0; k < W * H; ++k)
            stored.depth[k] = isfinite(s.distance[k])
                                  ? (float)(log(c * (double)s.distance[k] + 1.0) / log(c * far_distance + 1.0))
                                  : 1.0f;
        SCOPED(frame) glssao_frame plain = subject_frame(&s, DISTANCE_32F, NORMAL_32F);
        SCOPED(frame) glssao_frame other = subject_frame(&stored, DEPTH_32F, NORMAL_32F);
        other.depth_kind = GLSSAO_DEPTH_LOGARITHMIC;
        other.log_depth_far = (float)far_distance;
        other.log_depth_constant = (float)constants[i];
        assert_same(f, &plain, &other, 1e-3);
        free(stored.depth);
    }
}

/* ---- refused and named, or accepted ---- */

static void assert_refused(fixture *f, const glssao_frame *frame, const char *named)
{
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    glssao_effect *effect = fixture_shared_effect(f, W, H);
    fixture_clear_log(f);
    fixture_refused(f, glssao_compute(effect, frame, &settings), named);
}

TEST_GL(unreadable_inputs_are_named)
{
    SCOPED(subject) subject s = room();
    SCOPED(frame) const glssao_frame good = subject_frame(&s, DEPTH_24, NORMAL_32F);
    glssao_frame bad;
#define REFUSED(field, value, named)                                                                                   \
    bad = good;                                                                                                        \
    bad.field = value;                                                                                                 \
    assert_refused(f, &bad, named)
    REFUSED(multisample, true, "frame.depth_texture");
    (void)fixture_no_gl_error(NULL); /* a texture of another target cannot be bound, and OpenGL reports an error */
    REFUSED(viewport[0], -1, "frame.viewport[0]");
    REFUSED(viewport[1], -1, "frame.viewport[1]");
    REFUSED(viewport[2], W, "frame.viewport");
    REFUSED(depth_kind, GLSSAO_DEPTH_LOGARITHMIC, "frame.log_depth_far");
    bad.log_depth_far = 10.0f;
    bad.log_depth_constant = -1.0f;
    assert_refused(f, &bad, "frame.log_depth_constant");
    bad.log_depth_constant = NAN;
    assert_refused(f, &bad, "frame.log_depth_constant");
    bad = good;
    memcpy(bad.viewport, (const int[4]){1, 0, W, H}, sizeof bad.viewport);
    assert_refused(f, &bad, "frame.viewport");
    REFUSED(projection[0], 0.0f, "frame.projection is singular");
    REFUSED(projection[14], 0.0f, "frame.projection");
    REFUSED(projection[5], NAN, "frame.projection[5]");
    REFUSED(projection[10], INFINITY, "frame.projection[10]");
    REFUSED(projection[4], 0.1f, "frame.projection[4]");
#undef REFUSED
}

static GLuint empty_texture(GLenum target, GLenum internal, GLenum format, GLenum type)
{
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(target, texture);
    if (target == GL_TEXTURE_2D_MULTISAMPLE)
        gl.TexImage2DMultisample(target, 4, internal, W, H, GL_TRUE);
    else if (target == GL_TEXTURE_2D_ARRAY)
        gl.TexImage3D(target, 0, (GLint)internal, W, H, 2, 0, format, type, NULL);
    else
        gl.TexImage2D(target == GL_TEXTURE_CUBE_MAP ? GL_TEXTURE_CUBE_MAP_POSITIVE_X : target, 0, (GLint)internal, W,
                      target == GL_TEXTURE_CUBE_MAP ? W : H, 0, format, type, NULL);
    gl.BindTexture(target, 0);
    return texture;
}

TEST_GL(formats_that_cannot_hold_it_are_named)
{
    static const struct {
        GLenum internal, format, type;
        glssao_depth depth_kind;
        int normal_kind;   /* -1: the texture is depth */
        const char *named; /* NULL: fits */
    } cases[] = {
        {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GLSSAO_DEPTH_WINDOW, -1, "%u: GL_RGBA8 can't hold depth"},
        {GL_R8, GL_RED, GL_UNSIGNED_BYTE, GLSSAO_DEPTH_LOGARITHMIC, -1, "%u: GL_R8 can't hold depth"},
        {GL_R16, GL_RED, GL_UNSIGNED_SHORT, GLSSAO_DEPTH_WINDOW, -1, NULL},
        {GL_R32F, GL_RED, GL_FLOAT, GLSSAO_DEPTH_WINDOW, -1, NULL},
        {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, GLSSAO_DEPTH_WINDOW, -1, "GL_R32UI is an integer format"},
        {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT, GLSSAO_DEPTH_VIEW_DISTANCE, -1,
         "GL_DEPTH_COMPONENT24 can't hold view distance"},
        {GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, GLSSAO_DEPTH_VIEW_DISTANCE, -1,
         "GL_DEPTH24_STENCIL8 can't hold view distance"},
        {GL_R16, GL_RED, GL_UNSIGNED_SHORT, GLSSAO_DEPTH_VIEW_DISTANCE, -1, "GL_R16 can't hold view distance"},
        {GL_R16F, GL_RED, GL_FLOAT, GLSSAO_DEPTH_VIEW_DISTANCE, -1, NULL},
        {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_SIGNED,
         "%u: GL_RGBA8 can't hold numbers below 0: want GLSSAO_NORMAL_UNSIGNED"},
        {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_UNSIGNED, NULL},
        {GL_RGBA8_SNORM, GL_RGBA, GL_BYTE, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_SIGNED, NULL},
        {GL_R11F_G11F_B10F, GL_RGB, GL_FLOAT, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_SIGNED,
         "GL_R11F_G11F_B10F can't hold numbers below 0"},
        {GL_RG16F, GL_RG, GL_FLOAT, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_SIGNED, "GL_RG16F has no third channel"},
        {GL_RG16F, GL_RG, GL_FLOAT, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_OCTAHEDRAL, NULL},
        {GL_RG8, GL_RG, GL_UNSIGNED_BYTE, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_OCTAHEDRAL,
         "GL_RG8 can't hold numbers below 0"},
        {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_UNSIGNED,
         "GL_RGBA32UI is an integer format"},
        {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT, GLSSAO_DEPTH_WINDOW, GLSSAO_NORMAL_SIGNED,
         "GL_DEPTH_COMPONENT24 can't hold normals"},
        {GL_RGB16F, GL_RGB, GL_FLOAT, GLSSAO_DEPTH_NORMAL_ALPHA, GLSSAO_NORMAL_SIGNED,
         "GL_RGB16F can't hold view distance in alpha"},
        {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GLSSAO_DEPTH_NORMAL_ALPHA, GLSSAO_NORMAL_UNSIGNED,
         "GL_RGBA8 can't hold view distance in alpha"},
        {GL_RGBA16F, GL_RGBA, GL_FLOAT, GLSSAO_DEPTH_NORMAL_ALPHA, GLSSAO_NORMAL_SIGNED, NULL},
    };
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    SCOPED(subject) subject s = room();
    SCOPED(frame) const glssao_frame good = subject_frame(&s, DEPTH_24, NORMAL_NONE);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        SCOPED(texture)
        const GLuint texture = empty_texture(GL_TEXTURE_2D, cases[i].internal, cases[i].format, cases[i].type);
        glssao_frame frame = good;
        frame.depth_kind = cases[i].depth_kind;
        frame.log_depth_far = 10.0f;
        *(cases[i].normal_kind < 0 ? &frame.depth_texture : &frame.normal_texture) = texture;
        frame.normal_kind = cases[i].normal_kind < 0 ? GLSSAO_NORMAL_SIGNED : (glssao_normal)cases[i].normal_kind;
        if (cases[i].named) {
            char named[128];
            const char *number = strstr(cases[i].named, "%u");
            snprintf(named, sizeof named, "%s", number ? number + 2 : cases[i].named);
            assert_refused(f, &frame, named);
        } else if (glssao_compute(fixture_shared_effect(f, W, H), &frame, &settings) != GLSSAO_OK) {
            fail_msg("case %zu: %s", i, f->log);
        }
    }
}

TEST_GL(textures_that_hold_no_motion_are_named)
{
    static const struct {
        GLenum internal, format, type;
        const char *named; /* NULL: fits */
    } cases[] = {
        {GL_RG16, GL_RG, GL_UNSIGNED_SHORT, "GL_RG16 can't hold motion: want GL_RG16F or GL_RG32F\n"},
        {GL_R32F, GL_RED, GL_FLOAT, "GL_R32F can't hold motion"},
        {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT, "GL_DEPTH_COMPONENT24 can't hold motion"},
        {0, GL_RG, GL_FLOAT, ": its level 0 has no storage\n"},
        {GL_RG16F, GL_RG, GL_FLOAT, NULL},
        {GL_RGBA32F, GL_RGBA, GL_FLOAT, NULL},
    };
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    settings.history = 4;
    SCOPED(subject) subject s = room();
    SCOPED(frame) glssao_frame frame = subject_frame(&s, DEPTH_24, NORMAL_NONE);
    for (int i = 0; i < 16; i += 5)
        frame.view[i] = 1.0f;
    glssao_effect *effect = fixture_shared_effect(f, W, H);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        if (cases[i].internal)
            frame.motion_texture = empty_texture(GL_TEXTURE_2D, cases[i].internal, cases[i].format, cases[i].type);
        else
            gl.GenTextures(1, &frame.motion_texture);
        gl.BindTexture(GL_TEXTURE_2D, frame.motion_texture); /* a name becomes a texture */
        gl.BindTexture(GL_TEXTURE_2D, 0);
        fixture_clear_log(f);
        const glssao_result result = glssao_compute(effect, &frame, &settings);
        if (result != (cases[i].named ? GLSSAO_INVALID_ARGUMENT : GLSSAO_OK) ||
            (cases[i].named && !strstr(f->log, cases[i].named)))
            fail_msg("case %zu: %s", i, f->log);
        gl.DeleteTextures(1, &frame.motion_texture);
    }
    fixture_clear_log(f);
    frame.motion_texture = 0;
}

/* Each message names what was found and what helps, and no binding changes. */
TEST_GL(targets_and_sizes_are_named)
{
    static const struct {
        GLenum target, binding;
        bool multisample;
        const char *named;
    } cases[] = {
        {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE, false,
         "a GL_TEXTURE_2D_MULTISAMPLE, not a GL_TEXTURE_2D: set frame.multisample"},
        {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D, true,
         "a GL_TEXTURE_2D, not a GL_TEXTURE_2D_MULTISAMPLE: frame.multisample must"},
        {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY, false,
         "a GL_TEXTURE_2D_ARRAY, not a GL_TEXTURE_2D: hand over"},
        {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP, false,
         "a GL_TEXTURE_CUBE_MAP, not a GL_TEXTURE_2D: hand over"},
        {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE, false,
         "a GL_TEXTURE_RECTANGLE, not a GL_TEXTURE_2D: copy it"},
    };
    subject s = room();
    const glssao_frame good = subject_frame(&s, DEPTH_24, NORMAL_NONE);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const GLuint texture = empty_texture(cases[i].target, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT);
        const GLuint other = empty_texture(cases[i].target, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT);
        glssao_frame frame = good;
        frame.depth_texture = texture;
        frame.multisample = cases[i].multisample;
        for (int bound = 0; bound < 3; ++bound) { /* nothing, another one, the texture itself */
            const GLuint names[] = {0, other, texture};
            GLint after = -1;
            gl.ActiveTexture(GL_TEXTURE1);
            gl.BindTexture(cases[i].target, names[bound]);
            assert_refused(f, &frame, cases[i].named);
            gl.GetIntegerv(cases[i].binding, &after);
            assert_int_equal(after, names[bound]);
            gl.BindTexture(cases[i].target, 0);
            gl.ActiveTexture(GL_TEXTURE0);
        }
        gl.DeleteTextures(1, &texture);
        gl.DeleteTextures(1, &other);
    }
    glssao_effect *effect = fixture_shared_effect(f, W + 2, H);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    fixture_clear_log(f);
    fixture_refused(f, glssao_compute(effect, &good, &settings),
                    "a GL_TEXTURE_2D of 60 x 44, not of the full size, 62 x 44: call glssao_resize");
    fixture_delete_frame(&good);
    subject_free(&s);
}

TEST_GL(a_map_that_a_pass_draws_into_is_refused)
{
    SCOPED(subject) subject s = room();
    glssao_frame frame = subject_frame(&s, DEPTH_24, NORMAL_NONE), bad = frame;
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    glssao_effect *effect = fixture_shared_effect(f, W, H);
    int w, h;
    assert_int_equal(glssao_compute(effect, &frame, &settings), GLSSAO_OK);
    bad.normal_texture = glssao_map(effect, GLSSAO_MAP_REBUILT_NORMAL, &w, &h);
    bad.normal_kind = GLSSAO_NORMAL_OCTAHEDRAL;
    assert_refused(f, &bad, "the effect's own map");
    bad = frame;
    bad.depth_texture = glssao_map(effect, GLSSAO_MAP_AMBIENT, &w, &h);
    assert_refused(f, &bad, "the effect's own map");

    fixture_delete_frame(&frame);
}

/* Drawn into, attached beside the drawn texture, or attached with no draw buffer: each is feedback. */
TEST_GL(applying_into_what_is_read_is_refused)
{
    SCOPED(subject) subject s = room();
    SCOPED(frame) glssao_frame frame = subject_frame(&s, DEPTH_24, NORMAL_32F);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    glssao_effect *effect = fixture_shared_effect(f, W, H);
    assert_int_equal(glssao_compute(effect, &frame, &settings), GLSSAO_OK);
    int w, h;
    const GLuint map = glssao_map(effect, GLSSAO_MAP_AMBIENT, &w, &h);
    SCOPED(target) const fixture_target target = fixture_make_target(GL_R16, w, h);
    static const struct {
        int map_at;
        GLenum draws;
        glssao_result result;
    } cases[] = {{0, GL_COLOR_ATTACHMENT0, GLSSAO_INVALID_ARGUMENT},
                 {1, GL_COLOR_ATTACHMENT0, GLSSAO_INVALID_ARGUMENT},
                 {0, GL_NONE, GLSSAO_INVALID_ARGUMENT},
                 {-1, GL_COLOR_ATTACHMENT0, GLSSAO_OK}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        for (int k = 0; k < 2; ++k)
            gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + (GLenum)k, GL_TEXTURE_2D,
                                    k == cases[i].map_at ? map : target.texture, 0);
        gl.DrawBuffers(1, &cases[i].draws);
        fixture_clear_log(f);
        assert_int_equal(glssao_apply(effect, target.framebuffer), cases[i].result);
        assert_true((strstr(f->log, "the accessibility map itself") != NULL) == (cases[i].map_at >= 0));
    }
}

/* The passes draw into framebuffers of their own, so this is no feedback, and most hosts do it. */
TEST_GL(depth_may_stay_attached_to_the_bound_framebuffer)
{
    SCOPED(subject) subject s = room();
    SCOPED(frame) glssao_frame frame = subject_frame(&s, DEPTH_24, NORMAL_32F);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    SCOPED(picture) picture detached = subject_shade(f, W, H, &frame, &settings);
    GLuint framebuffer;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, frame.depth_texture, 0);
    SCOPED(picture) picture attached = subject_shade(f, W, H, &frame, &settings);
    assert_memory_equal(detached.values, attached.values, (size_t)W * H * sizeof(float));
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
