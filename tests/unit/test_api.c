/* SPDX-License-Identifier: MIT
 *
 * Invalid arguments and unusable contexts give the right code, name the fault in the log, and change nothing.
 */
#include "fixture.h"

static const float PROJECTION[16] = {1, 0, 0,      0,  0, 1, 0,       0,
                                     0, 0, -1.02f, -1, 0, 0, -0.202f, 0}; /* 90 degrees, 0.1 to 10 */

/* ---- loaders that lie ---- */

typedef struct liar {
    fixture *f;
    const char *missing; /* a function that is not found */
    const char *version; /* NULL: the real one */
    bool wrong_offsets;  /* the driver does not lay uniform blocks out as std140 */
} liar;

static PFNGLGETINTEGERVPROC real_get_integerv;
static int claimed_major, claimed_minor;

static void APIENTRY claiming_get_integerv(GLenum name, GLint *out)
{
    if (name == GL_MAJOR_VERSION)
        *out = claimed_major;
    else if (name == GL_MINOR_VERSION)
        *out = claimed_minor;
    else
        real_get_integerv(name, out);
}

static PFNGLGETACTIVEUNIFORMSIVPROC real_get_active_uniformsiv;

static void APIENTRY wrong_get_active_uniformsiv(GLuint program, GLsizei n, const GLuint *indices, GLenum name,
                                                 GLint *out)
{
    real_get_active_uniformsiv(program, n, indices, name, out);
    if (name == GL_UNIFORM_OFFSET && *out >= 416)
        *out += 4;
}

static void *lying_load(const char *name, void *user)
{
    const liar *l = user;
    if (l->missing && strcmp(name, l->missing) == 0)
        return NULL;
    if (l->version && strcmp(name, "glGetIntegerv") == 0) {
        void *real = fixture_load(name, l->f->context);
        memcpy(&real_get_integerv, &real, sizeof real);
        sscanf(l->version, "%d.%d", &claimed_major, &claimed_minor);
        PFNGLGETINTEGERVPROC claiming = claiming_get_integerv;
        void *address;
        memcpy(&address, &claiming, sizeof address);
        return address;
    }
    if (l->wrong_offsets && strcmp(name, "glGetActiveUniformsiv") == 0) {
        void *real = fixture_load(name, l->f->context);
        memcpy(&real_get_active_uniformsiv, &real, sizeof real);
        PFNGLGETACTIVEUNIFORMSIVPROC wrong = wrong_get_active_uniformsiv;
        void *address;
        memcpy(&address, &wrong, sizeof address);
        return address;
    }
    return fixture_load(name, l->f->context);
}

static glssao_result create_with(fixture *f, liar *l)
{
    glssao_config config = fixture_config(f, 8, 8);
    config.load = lying_load;
    config.load_user = l;
    SCOPED(effect) glssao_effect *effect = (glssao_effect *)&config; /* must become NULL */
    fixture_clear_log(f);
    glssao_result result = glssao_create(&config, &effect);
    if (result != GLSSAO_OK)
        assert_null(effect);
    return result;
}

static glssao_result create_through(fixture *f, const char *missing, const char *version)
{
    return create_with(f, &(liar){.f = f, .missing = missing, .version = version});
}

TEST_GL(driver_with_other_block_offsets_is_refused)
{
    assert_int_equal(create_with(f, &(liar){.f = f, .wrong_offsets = true}), GLSSAO_SHADER_ERROR);
    assert_non_null(strstr(f->log, "block cbSsao: gBlurWeights has offset 420 in the driver and 416 in C"));
}

TEST_GL(each_missing_function_is_named)
{
    static const char *const names[] = {"glActiveTexture", "glGetIntegerv",  "glGetString",
                                        "glGenSamplers",   "glQueryCounter", "glViewport"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        assert_int_equal(create_through(f, names[i], NULL), GLSSAO_UNSUPPORTED_CONTEXT);
        assert_non_null(strstr(f->log, names[i]));
    }
}

TEST_GL(functions_newer_than_3_3_are_optional)
{
    static const char *const names[] = {"glClipControl", "glViewportIndexedf", "glBlendFuncSeparatei",
                                        "glBlendEquationSeparatei"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        assert_int_equal(create_through(f, names[i], NULL), GLSSAO_OK);
}

TEST_GL(context_of_3_2_is_refused_and_3_3_taken)
{
    assert_int_equal(create_through(f, NULL, "3.2"), GLSSAO_UNSUPPORTED_CONTEXT);
    assert_non_null(strstr(f->log, "OpenGL 3.3"));
    assert_int_equal(create_through(f, NULL, "2.1"), GLSSAO_UNSUPPORTED_CONTEXT);
    assert_int_equal(create_through(f, NULL, "3.3"), GLSSAO_OK);
}

/* ---- create ---- */

TEST_GL(create_refuses_bad_sizes_and_null)
{
    static const int sizes[][2] = {{0, 8}, {8, 0}, {-1, 8}, {8, -2147483647}, {1 << 20, 8}, {8, 2147483647}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        glssao_config config = fixture_config(f, sizes[i][0], sizes[i][1]);
        glssao_effect *effect = (glssao_effect *)&config;
        fixture_clear_log(f);
        assert_int_equal(glssao_create(&config, &effect), GLSSAO_INVALID_ARGUMENT);
        assert_null(effect);
        assert_non_null(strstr(f->log, "size = "));
    }
    glssao_config config = fixture_config(f, 8, 8);
    config.load = NULL;
    glssao_effect *effect = NULL;
    assert_int_equal(glssao_create(&config, &effect), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_create(NULL, &effect), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_create(&config, NULL), GLSSAO_INVALID_ARGUMENT);
}

TEST_GL(null_effect_is_harmless)
{
    glssao_frame frame = {0};
    glssao_settings settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH);
    int w = 5, h = 5;
    assert_int_equal(glssao_compute(NULL, &frame, &settings), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_resize(NULL, 4, 4), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_begin_normals(NULL, 1), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_end_normals(NULL), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_apply(NULL, 0), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_map(NULL, GLSSAO_MAP_NORMAL, &w, &h), 0);
    assert_true(w == 0 && h == 0);
    assert_null(glssao_get_constants(NULL));
    assert_false(glssao_plan_frame(NULL, &frame, &settings).passes[GLSSAO_PASS_ESTIMATE].run);
    assert_int_equal(glssao_get_stats(NULL).draw_calls, 0);
    glssao_destroy(NULL);
}

/* ---- compute ---- */

typedef struct scene_inputs {
    glssao_effect *effect;
    glssao_frame frame;
    glssao_settings settings;
} scene_inputs;

static scene_inputs make_inputs(fixture *f)
{
    scene_inputs in = {.effect = fixture_effect(f, 16, 12),
                       .settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH)};
    float depth[16 * 12];
    for (int i = 0; i < 16 * 12; ++i)
        depth[i] = 0.9f + 0.005f * (float)(i % 5);
    in.frame.depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT32F, 16, 12, depth);
    memcpy(in.frame.projection, PROJECTION, sizeof PROJECTION);
    return in;
}

static void free_inputs(scene_inputs *in)
{
    gl.DeleteTextures(1, &in->frame.depth_texture);
    glssao_destroy(in->effect);
}
#define test_end_inputs free_inputs /* for SCOPED */

/* The call is refused, the log names the field, and picture, constants and stats stay as they were. */
static void check_refused(fixture *f, const scene_inputs *in, const glssao_frame *frame,
                          const glssao_settings *settings, const char *field)
{
    int w, h;
    uint32_t ambient = glssao_map(in->effect, GLSSAO_MAP_AMBIENT, &w, &h);
    SCOPED(memory) float *before = fixture_read_texture(ambient, w, h, 1);
    glssao_constants constants = *glssao_get_constants(in->effect);
    uint64_t frames = glssao_get_stats(in->effect).frame;
    fixture_clear_log(f);
    glssao_result result = glssao_compute(in->effect, frame, settings);
    if (result != GLSSAO_INVALID_ARGUMENT || !strstr(f->log, field))
        fail_msg("%s: result %d, log: %s", field, (int)result, f->log);
    const char *newline = strchr(f->log, '\n');
    assert_true(newline && newline[1] == '\0'); /* one line */
    assert_false(glssao_plan_frame(in->effect, frame, settings).passes[GLSSAO_PASS_BLUR].run &&
                 strncmp(field, "frame.", 6) != 0);
    assert_int_equal(glssao_map(in->effect, GLSSAO_MAP_AMBIENT, NULL, NULL), ambient);
    SCOPED(memory) float *after = fixture_read_texture(ambient, w, h, 1);
    assert_memory_equal(before, after, (size_t)(w * h) * sizeof *before);
    assert_memory_equal(&constants, glssao_get_constants(in->effect), sizeof constants);
    assert_int_equal(glssao_get_stats(in->effect).frame, frames);
}

TEST_GL(compute_refuses_bad_settings)
{
    SCOPED(inputs) scene_inputs in = make_inputs(f);
    assert_int_equal(glssao_compute(in.effect, &in.frame, &in.settings), GLSSAO_OK);
    glssao_settings s;
#define REFUSED(field, value)                                                                                          \
    s = in.settings;                                                                                                   \
    s.field = value;                                                                                                   \
    check_refused(f, &in, &in.frame, &s, "settings." #field)
    REFUSED(radius, -1.0f);
    REFUSED(radius, NAN);
    REFUSED(radius, INFINITY);
    REFUSED(fade_start, -0.1f);
    REFUSED(fade_end, NAN);
    REFUSED(fade_end, 0.1f); /* before fade_start */
    REFUSED(surface_epsilon, -1.0f);
    REFUSED(power, -1.0f);
    REFUSED(power, 65.0f);
    REFUSED(sample_count, 0);
    REFUSED(sample_count, 15);
    REFUSED(blur_rounds, -1);
    REFUSED(blur_rounds, 17);
    REFUSED(history, -1);
    REFUSED(history, 64);
    REFUSED(blur_sigma, 0.0f);
    REFUSED(blur_sigma, 3.0f);
    REFUSED(blur_normal_threshold, 1.5f);
    REFUSED(blur_depth_threshold, -1.0f);
    REFUSED(thickness, -1.0f);
    REFUSED(thickness, 1e-4f);
    REFUSED(thickness, 1001.0f);
    REFUSED(thickness, NAN);
    REFUSED(fade_far_start, -1.0f);
    REFUSED(fade_far_end, NAN);
    REFUSED(fade_far_end, INFINITY);
    REFUSED(technique, (glssao_technique)7);
    REFUSED(blur, (glssao_blur)9);
    REFUSED(bent_normals, true); /* the technique is not horizon */
#undef REFUSED
    s = in.settings;
    s.fade_far_start = 5.0f;
    s.fade_far_end = 4.0f;
    check_refused(f, &in, &in.frame, &s, "settings.fade_far_end = 4: less than fade_far_start = 5");
    s = in.settings;
    s.technique = GLSSAO_HORIZON;
    s.sample_count = 14;
    check_refused(f, &in, &in.frame, &s, "settings.sample_count");
    s.technique = GLSSAO_HEMISPHERE;
    s.sample_count = 65;
    check_refused(f, &in, &in.frame, &s, "settings.sample_count");
    check_refused(f, &in, &in.frame, NULL, "settings is NULL");
    check_refused(f, &in, NULL, &in.settings, "frame is NULL");
    assert_int_equal(glssao_compute(in.effect, &in.frame, &in.settings), GLSSAO_OK); /* still usable */
}

TEST_GL(compute_refuses_bad_frames)
{
    SCOPED(inputs) scene_inputs in = make_inputs(f);
    assert_int_equal(glssao_compute(in.effect, &in.frame, &in.settings), GLSSAO_OK);
    glssao_frame frame;
#define REFUSED(member, value, text)                                                                                   \
    frame = in.frame;                                                                                                  \
    frame.member = value;                                                                                              \
    check_refused(f, &in, &frame, &in.settings, text)
    REFUSED(depth_texture, 0, "frame.depth_texture");
    REFUSED(depth_texture, 987654, "frame.depth_texture");
    REFUSED(normal_texture, 987654, "frame.normal_texture");
    REFUSED(depth_kind, (glssao_depth)5, "frame.depth_kind");
    REFUSED(normal_kind, (glssao_normal)5, "frame.normal_kind");
    REFUSED(depth_texture, glssao_map(in.effect, GLSSAO_MAP_AMBIENT, NULL, NULL), "frame texture");
    REFUSED(projection[0], NAN, "frame.projection[0]");
    REFUSED(projection[14], INFINITY, "frame.projection[14]");
    REFUSED(projection[0], 0.0f, "frame.projection is singular");
    REFUSED(projection[11], 1.0f, "frame.projection[11]");
    REFUSED(projection[3], 0.5f, "frame.projection[3]");
    REFUSED(projection[1], 0.5f, "frame.projection[1]");
    REFUSED(projection[14], 0.0f, "frame.projection is singular");
#undef REFUSED
    frame = in.frame;
    frame.depth_kind = GLSSAO_DEPTH_NORMAL_ALPHA; /* and no normal map */
    check_refused(f, &in, &frame, &in.settings, "frame.normal_texture");
    frame = in.frame;
    memset(frame.projection, 0, sizeof frame.projection);
    check_refused(f, &in, &frame, &in.settings, "frame.projection");

    float small[4 * 4] = {0};
    frame = in.frame;
    frame.depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT24, 4, 4, small);
    check_refused(f, &in, &frame, &in.settings, "frame.depth_texture"); /* not the full size */
    gl.DeleteTextures(1, &frame.depth_texture);
    check_refused(f, &in, &frame, &in.settings, "frame.depth_texture"); /* deleted */
}

TEST_GL(orthographic_projection_of_no_extent_is_refused)
{
    SCOPED(inputs) scene_inputs in = make_inputs(f);
    glssao_frame frame = in.frame;
    const float flat[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0.5f, 1};
    memcpy(frame.projection, flat, sizeof flat);
    check_refused(f, &in, &frame, &in.settings, "frame.projection is singular");
}

TEST_GL(calls_out_of_order_are_refused)
{
    scene_inputs in = make_inputs(f);
    assert_int_equal(glssao_apply(in.effect, 0), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_end_normals(in.effect), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_begin_normals(in.effect, 0), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_begin_normals(in.effect, glssao_map(in.effect, GLSSAO_MAP_AMBIENT, NULL, NULL)),
                     GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_begin_normals(in.effect, in.frame.depth_texture), GLSSAO_OK);
    fixture_clear_log(f);
    assert_int_equal(glssao_begin_normals(in.effect, in.frame.depth_texture), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_compute(in.effect, &in.frame, &in.settings), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_apply(in.effect, 0), GLSSAO_INVALID_ARGUMENT);
    assert_int_equal(glssao_resize(in.effect, 4, 4), GLSSAO_INVALID_ARGUMENT);
    assert_non_null(strstr(f->log, "glssao_compute called before glssao_end_normals"));
    assert_int_equal(glssao_end_normals(in.effect), GLSSAO_OK);
    assert_int_equal(glssao_compute(in.effect, &in.frame, &in.settings), GLSSAO_OK);
    assert_int_equal(glssao_begin_normals(in.effect, in.frame.depth_texture), GLSSAO_OK);
    free_inputs(&in); /* destroyed before end: the host's framebuffer must be bound again */
    GLint bound = -1;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    assert_int_equal(bound, 0);
}

TEST_GL(resize_refuses_and_keeps_the_old_size)
{
    SCOPED(inputs) scene_inputs in = make_inputs(f);
    static const int sizes[][2] = {{0, 1}, {1, -1}, {1 << 24, 1}, {1, 1 << 24}};
    for (int i = 0; i < 4; ++i)
        assert_int_equal(glssao_resize(in.effect, sizes[i][0], sizes[i][1]), GLSSAO_INVALID_ARGUMENT);
    int w, h;
    glssao_map(in.effect, GLSSAO_MAP_NORMAL, &w, &h);
    assert_true(w == 16 && h == 12);
    assert_int_equal(glssao_compute(in.effect, &in.frame, &in.settings), GLSSAO_OK);
}

TEST_GL(other_map_belongs_to_the_last_frame)
{
    SCOPED(inputs) scene_inputs in = make_inputs(f);
    const glssao_settings horizon = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    const uint32_t plain = glssao_map(in.effect, GLSSAO_MAP_AMBIENT_OTHER, NULL, NULL);
    assert_int_equal(glssao_compute(in.effect, &in.frame, &horizon), GLSSAO_OK);
    assert_int_not_equal(glssao_map(in.effect, GLSSAO_MAP_AMBIENT_OTHER, NULL, NULL), plain);
    glssao_settings nothing = horizon;
    nothing.radius = 0.0f; /* no pass runs: the map of ones is the result */
    assert_int_equal(glssao_compute(in.effect, &in.frame, &nothing), GLSSAO_OK);
    assert_int_equal(glssao_map(in.effect, GLSSAO_MAP_AMBIENT_OTHER, NULL, NULL), plain);
    assert_int_equal(glssao_compute(in.effect, &in.frame, &horizon), GLSSAO_OK);
    assert_int_equal(glssao_resize(in.effect, 8, 8), GLSSAO_OK);
    int w, h;
    const uint32_t resized = glssao_map(in.effect, GLSSAO_MAP_AMBIENT_OTHER, &w, &h);
    assert_true(resized != 0 && w == 4 && h == 4);
}

TEST_GL(begin_normals_clears_to_the_documented_values)
{
    static const GLenum formats[] = {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F,
                                     GL_DEPTH24_STENCIL8};
    for (int i = 0; i < 4; ++i) {
        SCOPED(inputs) scene_inputs in = make_inputs(f);
        float depth[16 * 12] = {0};
        SCOPED(texture) GLuint texture = fixture_depth_texture(formats[i], 16, 12, depth);
        gl.ClearDepth(0.25);
        assert_int_equal(glssao_begin_normals(in.effect, texture), GLSSAO_OK);
        GLint viewport[4];
        gl.GetIntegerv(GL_VIEWPORT, viewport);
        assert_true(viewport[2] == 16 && viewport[3] == 12);
        assert_int_equal(glssao_end_normals(in.effect), GLSSAO_OK);
        gl.ClearDepth(1.0);
        SCOPED(memory) float *got = fixture_read_depth(texture, 16, 12);
        SCOPED(memory)
        float *normals = fixture_read_texture(glssao_map(in.effect, GLSSAO_MAP_NORMAL, NULL, NULL), 16, 12, 4);
        for (int k = 0; k < 16 * 12; ++k) {
            assert_float_equal(got[k], 0.25f, 1e-4f);
            assert_true(normals[4 * k] == 0.0f && normals[4 * k + 1] == 0.0f && normals[4 * k + 2] == 1.0f &&
                        normals[4 * k + 3] == 0.0f);
        }
    }
}

TEST_GL(maps_are_born_as_documented)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, 17, 9);
    int w, h;
    SCOPED(memory) float *ambient = fixture_read_texture(glssao_map(effect, GLSSAO_MAP_AMBIENT, &w, &h), 9, 5, 1);
    assert_true(w == 9 && h == 5);
    for (int i = 0; i < 9 * 5; ++i)
        assert_true(ambient[i] == 1.0f);
    static const struct {
        glssao_map_id id;
        int width;
        GLint format;
    } maps[] = {{GLSSAO_MAP_AMBIENT, 9, GL_R16},
                {GLSSAO_MAP_AMBIENT_OTHER, 9, GL_R16},
                {GLSSAO_MAP_NORMAL, 17, GL_RGBA16F},
                {GLSSAO_MAP_RANDOM_VECTOR, 256, GL_RGBA8}};
    for (int i = 0; i < 4; ++i) {
        GLint format = 0;
        gl.BindTexture(GL_TEXTURE_2D, glssao_map(effect, maps[i].id, &w, &h));
        gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        assert_int_equal(w, maps[i].width);
        assert_int_equal(format, maps[i].format);
    }
    assert_int_equal(glssao_map(effect, GLSSAO_MAP_DEPTH, &w, &h), 0);
    assert_int_equal(glssao_map(effect, (glssao_map_id)99, &w, &h), 0);
}

TEST_GL(timers_can_be_forbidden)
{
    SCOPED(inputs) scene_inputs in = make_inputs(f);
    glssao_destroy(in.effect);
    glssao_config config = fixture_config(f, 16, 12);
    config.no_timers = true;
    assert_int_equal(glssao_create(&config, &in.effect), GLSSAO_OK);
    assert_int_equal(glssao_compute(in.effect, &in.frame, &in.settings), GLSSAO_OK);
    gl.Finish();
    glssao_stats stats = glssao_get_stats(in.effect);
    assert_true(stats.gpu_ms < 0.0 && stats.passes[GLSSAO_PASS_ESTIMATE].gpu_ms < 0.0);
    assert_true(stats.draw_calls > 0);
}

TEST_GL(texts_are_never_null)
{
    for (int i = -1; i < 8; ++i)
        assert_true(strlen(glssao_result_string((glssao_result)i)) > 0);
    assert_int_equal(glssao_version(), GLSSAO_VERSION_MAJOR << 16 | GLSSAO_VERSION_MINOR << 8 | GLSSAO_VERSION_PATCH);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
