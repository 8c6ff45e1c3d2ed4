/* SPDX-License-Identifier: MIT
 *
 * Compute and fragment shaders make pictures that no eye can tell apart. Also: which of the two a frame takes, and
 * that a loader that knows OpenGL 3.3 alone gives the fragment shaders' bits.
 */
#include "techniques.h"

/* ---- loaders ---- */

typedef struct host {
    fixture *f;
    bool knows_3_3_alone; /* finds no newer function */
    bool claims_3_3;      /* the context also reports 3.3; its extensions stay */
    bool claims_gpu;
    bool refuses_compute; /* no compute shader compiles */
} host;

static const host *asked; /* of the functions below */
static PFNGLGETINTEGERVPROC real_get_integerv;
static PFNGLGETSTRINGPROC real_get_string;

static void APIENTRY get_integerv(GLenum name, GLint *out)
{
    real_get_integerv(name, out);
    if (asked->claims_3_3 && (name == GL_MAJOR_VERSION || name == GL_MINOR_VERSION))
        *out = 3;
}

static const GLubyte *APIENTRY get_string(GLenum name)
{
    return asked->claims_gpu && name == GL_RENDERER ? (const GLubyte *)"A GPU of some make" : real_get_string(name);
}

static PFNGLCREATESHADERPROC real_create_shader;
static PFNGLGETSHADERIVPROC real_get_shader;
static GLuint last_compute_shader;

static GLuint APIENTRY create_shader(GLenum stage)
{
    const GLuint shader = real_create_shader(stage);
    last_compute_shader = stage == GL_COMPUTE_SHADER ? shader : 0;
    return shader;
}

static void APIENTRY get_shader(GLuint shader, GLenum name, GLint *out)
{
    real_get_shader(shader, name, out);
    if (asked->refuses_compute && name == GL_COMPILE_STATUS && shader == last_compute_shader)
        *out = GL_FALSE;
}

static void *load(const char *name, void *user)
{
    asked = user;
    void *address = context_load(name, asked->f->context);
#define WRAP(function, type, real, own)                                                                                \
    if (strcmp(name, function) == 0) {                                                                                 \
        memcpy(&(real), &address, sizeof address);                                                                     \
        memcpy(&address, &(type){own}, sizeof address);                                                                \
    }
    WRAP("glGetIntegerv", PFNGLGETINTEGERVPROC, real_get_integerv, get_integerv)
    WRAP("glGetString", PFNGLGETSTRINGPROC, real_get_string, get_string)
    WRAP("glCreateShader", PFNGLCREATESHADERPROC, real_create_shader, create_shader)
    WRAP("glGetShaderiv", PFNGLGETSHADERIVPROC, real_get_shader, get_shader)
#undef WRAP
    return asked->knows_3_3_alone && !fixture_is_of_3_3(name) ? NULL : address;
}

static glssao_result make(host *h, glssao_path path, int width, int height, glssao_effect **out)
{
    glssao_config config = fixture_config(h->f, width, height);
    config.load = load;
    config.load_user = h;
    config.path = path;
    fixture_clear_log(h->f);
    return glssao_create(&config, out);
}

/* ---- pictures ---- */

/* Fails unless the two agree as glssao_path promises: RMSE at most 1e-4, at most 1 pixel in 10,000 off by more than
 * 0.02. */
static void assert_agree(const picture *a, const picture *b, const char *what)
{
    double sum = 0.0;
    int beyond = 0;
    const int count = a->width * a->height;
    assert_true(a->width == b->width && a->height == b->height);
    for (int i = 0; i < count; ++i) {
        const double off = fabs((double)a->values[i] - (double)b->values[i]);
        beyond += !(off <= 0.02);
        sum += off * off;
    }
    if (!(sqrt(sum / count) <= 1e-4) || beyond > count / 10000)
        fail_msg("%s, %d x %d: RMSE %.2g between draws and dispatches, %d pixels off by more than 0.02", what, a->width,
                 a->height, sqrt(sum / count), beyond);
}

static glssao_frame room_frame(analytic_projection kind, int width, int height, depth_store depth, normal_store normal)
{
    const analytic_view view = analytic_make_view(kind, (double)width / height, 0.5, 40.0, 1.0);
    SCOPED(subject) subject s = subject_of(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, width, height);
    const glssao_frame frame = subject_frame(&s, depth, normal);
    return frame;
}

/* The variants of one fixture: fragment shaders as for a software rasteriser and as for a GPU, and compute shaders.
 * Sizes change by glssao_resize, so that each program compiles once. */
enum { WAYS = 3 };
static glssao_effect *ways[WAYS];

static void assert_alike(fixture *f, const char *what, int width, int height, const glssao_frame *frame,
                         const glssao_settings *settings)
{
    picture pictures[WAYS] = {{0}};
    for (int i = 0; i < WAYS; ++i) {
        if (i == 1 && settings->technique != GLSSAO_HORIZON)
            continue; /* on a GPU its fragment shaders are the same */
        host *const h = &(host){.f = f, .claims_gpu = i == 1};
        const glssao_path path = i == 2 ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
        if (!ways[i])
            assert_int_equal(make(h, path, width, height, &ways[i]), GLSSAO_OK);
        assert_int_equal(glssao_resize(ways[i], width, height), GLSSAO_OK);
        const glssao_plan plan = glssao_plan_frame(ways[i], frame, settings);
        assert_int_equal(plan.path, path);
        assert_true(strlen(plan.path_reason) > 0);
        int dispatching = 0;
        for (int k = 0; k < GLSSAO_PASS_COUNT; ++k)
            dispatching += plan.passes[k].compute;
        assert_true((dispatching > 0) == (i == 2));
        pictures[i] = subject_shade_by(f, ways[i], frame, settings);
    }
    assert_true(picture_least(&pictures[0]) < 0.99 || width * height < 100); /* some pixel is occluded */
    for (int i = 1; i < WAYS; ++i)
        if (pictures[i].values)
            assert_agree(&pictures[0], &pictures[i], what);
    for (int i = 0; i < WAYS; ++i)
        free(pictures[i].values);
}

static int end_ways(void **state)
{
    for (int i = 0; i < WAYS; ++i) {
        glssao_destroy(ways[i]);
        ways[i] = NULL;
    }
    return fixture_no_gl_error(state);
}
#define TEST_WAYS(name) TEST_OF(name, fixture, f, end_ways)

static glssao_settings wide_horizon(glssao_quality quality)
{
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, quality);
    s.radius = 1.0f;
    return s;
}

static int stride = 1;

TEST_WAYS(techniques_and_qualities_agree)
{
    SCOPED(frame) glssao_frame frame = room_frame(PERSPECTIVE, 97, 63, DEPTH_24, NORMAL_32F);
    for (int i = 0; i < CONFIGURATIONS; i += stride) {
        configuration c = configuration_of(i);
        if (c.settings.blur == GLSSAO_BLUR_NONE)
            continue;
        assert_alike(f, c.name, 97, 63, &frame, &c.settings);
    }
}

TEST_WAYS(blurs_and_sizes_of_the_result_agree)
{
    glssao_frame frame = room_frame(ORTHOGRAPHIC_REVERSED, 66, 51, DEPTH_32F, NORMAL_16F);
    for (int blur = GLSSAO_BLUR_NONE; blur <= GLSSAO_BLUR_PLANAR; ++blur)
        for (int size = 0; size < 3; ++size) { /* full, half, upsampled */
            glssao_settings s = wide_horizon(GLSSAO_LOW);
            s.blur = (glssao_blur)blur;
            s.blur_rounds = blur == GLSSAO_BLUR_PLANAR ? 5 - size : 1 + blur % 2; /* a dispatch runs up to two */
            s.half_resolution = size > 0;
            s.upsample = size > 1;
            char what[64];
            snprintf(what, sizeof what, "blur %d, size %d", blur, size);
            assert_alike(f, what, 66, 51, &frame, &s);
        }
    fixture_delete_frame(&frame);
}

TEST_WAYS(odd_and_small_sizes_agree)
{
    static const int sizes[][2] = {{1, 40}, {47, 2}, {8, 8}, {17, 33}, {128, 9}};
    const glssao_settings s = wide_horizon(GLSSAO_MEDIUM);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        SCOPED(frame) glssao_frame frame = room_frame(PERSPECTIVE, sizes[i][0], sizes[i][1], DEPTH_32F, NORMAL_32F);
        assert_alike(f, "size", sizes[i][0], sizes[i][1], &frame, &s);
    }
}

TEST_WAYS(ways_to_hand_over_agree)
{
    static const struct {
        analytic_projection projection;
        depth_store depth;
        normal_store normal;
    } stores[] = {{PERSPECTIVE_OFF_CENTRE, DEPTH_16, NORMAL_NONE},
                  {PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE, DEPTH_32F_STENCIL, NORMAL_UNSIGNED_8},
                  {PERSPECTIVE, DISTANCE_32F, NORMAL_OCTAHEDRAL},
                  {ORTHOGRAPHIC, ALPHA_16F, NORMAL_32F}};
    const glssao_settings s = wide_horizon(GLSSAO_MEDIUM);
    for (size_t i = 0; i < sizeof stores / sizeof *stores; ++i) {
        SCOPED(frame) glssao_frame frame = room_frame(stores[i].projection, 64, 48, stores[i].depth, stores[i].normal);
        assert_alike(f, subject_depth_name(stores[i].depth), 64, 48, &frame, &s);
    }
}

TEST_WAYS(margins_layers_and_viewports_agree)
{
    const analytic_shape wall[] = {{ANALYTIC_PLANE, {0.0, 0.0, -9.0}, {0.0, 0.0, 1.0}}};
    const analytic_view view = analytic_make_view(PERSPECTIVE, 90.0 / 70.0, 0.5, 40.0, 1.0);
    SCOPED(subject) subject behind = subject_of(&view, wall, 1, 90, 70);
    SCOPED(frame) glssao_frame second = subject_frame(&behind, DEPTH_32F, NORMAL_NONE);
    SCOPED(frame) glssao_frame frame = room_frame(PERSPECTIVE, 90, 70, DEPTH_32F, NORMAL_32F);
    for (int i = 0; i < 8; ++i) {
        glssao_settings s = wide_horizon(i % 2 ? GLSSAO_MEDIUM : GLSSAO_LOW);
        glssao_frame changed = frame;
        changed.margin = i & 2 ? 10 : 0;
        changed.back_texture = changed.second_texture = i & 4 ? second.depth_texture : 0;
        /* In turn, each kind of pass is the last, which cuts off the margin. */
        if (i == 7)
            s.blur_rounds = 0;
        if (i == 2 || i == 3)
            s.upsample = false;
        if (i == 2)
            s.blur = GLSSAO_BLUR_NONE;
        if (i == 3)
            s.blur = GLSSAO_BLUR_GAUSSIAN;
        assert_alike(f, "margin and layers", 90, 70, &changed, &s);
        memcpy(changed.viewport, (const int[4]){3, 5, 80, 60}, sizeof changed.viewport);
        assert_alike(f, "viewport", 80, 60, &changed, &s);
    }
}

/* Rays alone and as a correction, at each size of rays and estimate. */
TEST_WAYS(rays_agree)
{
    float values[66 * 51];
    for (int i = 0; i < 66 * 51; ++i)
        values[i] = i * 7 % 11 == 0 ? -1.0f : 0.5f * (float)(i * 5 % 3);
    SCOPED(frame) glssao_frame frame = room_frame(PERSPECTIVE, 66, 51, DEPTH_32F, NORMAL_NONE);
    for (int i = 0; i < 16; ++i) {
        const bool half = i & 1, is_half = i & 2, margin = i & 4;
        const int width = half ? 33 : 66, height = half ? 26 : 51;
        glssao_settings s = i & 8 ? wide_horizon(GLSSAO_MEDIUM) : glssao_default_settings(GLSSAO_RAYS, GLSSAO_HIGH);
        s.half_resolution = is_half;
        s.upsample = i % 3 != 0;
        s.power = 1.0f + (float)(i % 2);
        frame.margin = margin ? 8 : 0;
        frame.rays_texture = fixture_texture(GL_R32F, GL_RED, GL_FLOAT, width, height, values);
        assert_alike(f, "rays", 66, 51, &frame, &s);
        gl.DeleteTextures(1, &frame.rays_texture);
        frame.rays_texture = 0;
    }
}

/* Estimates are added by drawing; the passes before and after may be dispatched. */
TEST_WAYS(accumulated_estimates_agree)
{
    picture pictures[2];
    SCOPED(frame) glssao_frame frame = room_frame(PERSPECTIVE, 64, 48, DEPTH_32F, NORMAL_32F);
    const glssao_settings s = wide_horizon(GLSSAO_LOW);
    for (int i = 0; i < 2; ++i) {
        host *const h = &(host){.f = f};
        SCOPED(effect) glssao_effect *effect = NULL;
        assert_int_equal(make(h, i ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT, 64, 48, &effect), GLSSAO_OK);
        for (int k = 0; k < 3; ++k)
            assert_int_equal(glssao_accumulate(effect, &frame, &s), GLSSAO_OK);
        pictures[i].values = fixture_read_ambient(effect, &pictures[i].width, &pictures[i].height);
    }
    assert_agree(&pictures[0], &pictures[1], "accumulated");
    free(pictures[0].values);
    free(pictures[1].values);
}

/* Which way a host's frames take, and the bits of the picture where they are drawn. */
TEST_WAYS(the_context_and_the_config_decide)
{
    static const struct {
        bool knows_3_3_alone, claims_3_3, claims_gpu;
        glssao_path path, got; /* AUTO: no effect */
    } cases[] = {
        {false, false, false, GLSSAO_PATH_FRAGMENT, GLSSAO_PATH_FRAGMENT},
        {false, false, false, GLSSAO_PATH_AUTO, GLSSAO_PATH_FRAGMENT},
        {false, false, false, GLSSAO_PATH_COMPUTE, GLSSAO_PATH_COMPUTE},
        {false, false, true, GLSSAO_PATH_AUTO, GLSSAO_PATH_COMPUTE},
        {false, false, true, GLSSAO_PATH_FRAGMENT, GLSSAO_PATH_FRAGMENT},
        {false, true, true, GLSSAO_PATH_AUTO, GLSSAO_PATH_COMPUTE}, /* by extensions, as some drivers of 3.3 offer it */
        {true, false, true, GLSSAO_PATH_AUTO, GLSSAO_PATH_FRAGMENT},
        {true, true, false, GLSSAO_PATH_AUTO, GLSSAO_PATH_FRAGMENT},
        {true, false, false, GLSSAO_PATH_COMPUTE, GLSSAO_PATH_AUTO},
    };
    SCOPED(frame) glssao_frame frame = room_frame(PERSPECTIVE, 64, 48, DEPTH_24, NORMAL_32F);
    const glssao_settings s = wide_horizon(GLSSAO_MEDIUM);
    picture wanted = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        host h = {f, cases[i].knows_3_3_alone, cases[i].claims_3_3, cases[i].claims_gpu, false};
        SCOPED(effect) glssao_effect *effect = NULL;
        const glssao_result made = make(&h, cases[i].path, 64, 48, &effect);
        /* Where the library decides, a real GPU counts like a claimed one. */
        const bool is_gpu = !context_is_software(f->context) && !cases[i].knows_3_3_alone;
        const glssao_path wanted_path =
            is_gpu && cases[i].path == GLSSAO_PATH_AUTO ? GLSSAO_PATH_COMPUTE : cases[i].got;
        if (cases[i].got == GLSSAO_PATH_AUTO) {
            assert_int_equal(made, GLSSAO_UNSUPPORTED_CONTEXT);
            assert_null(effect);
            assert_non_null(strstr(f->log, "config.path"));
            continue;
        }
        assert_int_equal(made, GLSSAO_OK);
        const glssao_plan plan = glssao_plan_frame(effect, &frame, &s);
        if (plan.path != wanted_path)
            fail_msg("case %d goes way %d: %s", (int)i, plan.path, plan.path_reason);
        picture got = subject_shade_by(f, effect, &frame, &s);
        assert_string_equal(f->log, "");
        if (i == 0)
            wanted = got;
        else if (wanted_path == GLSSAO_PATH_FRAGMENT)
            assert_memory_equal(got.values, wanted.values, (size_t)(64 * 48) * sizeof *got.values);
        if (i > 0)
            free(got.values);
    }
    free(wanted.values);
}

TEST_WAYS(an_unknown_path_is_refused)
{
    glssao_effect *none;
    assert_int_equal(make(&(host){.f = f}, (glssao_path)3, 64, 48, &none), GLSSAO_INVALID_ARGUMENT);
    assert_non_null(strstr(f->log, "config.path = 3"));
}

/* If the library chose compute shaders and the driver refuses them, the host notices nothing. */
TEST_WAYS(refused_compute_shaders_are_done_without)
{
    host h = {.f = f, .claims_gpu = true, .refuses_compute = true};
    SCOPED(frame) glssao_frame frame = room_frame(PERSPECTIVE, 64, 48, DEPTH_24, NORMAL_32F);
    const glssao_settings s = wide_horizon(GLSSAO_MEDIUM);
    for (int i = 0; i < 3; ++i) {
        SCOPED(effect) glssao_effect *effect = NULL;
        assert_int_equal(make(&h, GLSSAO_PATH_AUTO, 64, 48, &effect), GLSSAO_OK);
        assert_int_equal(glssao_plan_frame(effect, &frame, &s).path, GLSSAO_PATH_COMPUTE);
        assert_int_equal(i == 0   ? glssao_compute(effect, &frame, &s)
                         : i == 1 ? glssao_accumulate(effect, &frame, &s)
                                  : glssao_prepare(effect, &frame, &s),
                         GLSSAO_OK);
        assert_true(effect != NULL && glssao_plan_frame(effect, &frame, &s).path == GLSSAO_PATH_FRAGMENT);
        SCOPED(picture) picture p = subject_shade_by(f, effect, &frame, &s);
        assert_true(picture_least(&p) < 0.99);
        assert_string_equal(f->log, "");
    }
    SCOPED(effect) glssao_effect *required = NULL;
    assert_int_equal(make(&h, GLSSAO_PATH_COMPUTE, 64, 48, &required), GLSSAO_OK);
    assert_int_equal(glssao_compute(required, &frame, &s), GLSSAO_SHADER_ERROR);
}

int main(int argc, char **argv)
{
    stride = configuration_stride(argc, argv);
    return test_run(NULL, fixture_setup, fixture_teardown);
}
