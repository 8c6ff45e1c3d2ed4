/* SPDX-License-Identifier: MIT
 *
 * The classic and hemisphere estimates and the blur compared with their double-precision model, pixel by pixel.
 *
 * Tolerance on accessibility: 1.5 steps of R16 (rounding of the map and of the compared value) plus 2e-5 times power
 * (float arithmetic of 14 samples, steepened by the exponent). Whatever a threshold could flip is inside the model's
 * interval. The share of pixels with a wide interval is bounded too, so the test cannot pass by being vague.
 */
#include "analytic.h"
#include "fixture.h"
#include "kernel.h"
#include "model.h"

static const double R16_STEP = 1.0 / 65535.0;

/* The result of the linear wrapping sampler for each ambient pixel. Drivers may filter 8-bit texels with few bits, so
 * the model is fed the filtered vectors. */
static float *sampled_random_vectors(const glssao_effect *effect, int width, int height)
{
    const GLuint program =
        fixture_program("#version 330\nvoid main() {\n"
                        "vec2 c[6] = vec2[6](vec2(0,1), vec2(0,0), vec2(1,0), vec2(0,1), vec2(1,0), vec2(1,1));\n"
                        "gl_Position = vec4(2.0 * c[gl_VertexID] - 1.0, 0.0, 1.0); }\n",
                        "#version 330\nuniform vec2 u_texel;\nuniform sampler2D u_map;\nout vec4 o_color;\n"
                        "void main() { o_color = texture(u_map, 4.0 * (gl_FragCoord.xy * u_texel)); }\n");
    SCOPED(target) const fixture_target target = fixture_make_target(GL_RGBA32F, width, height);
    GLuint array;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.Viewport(0, 0, width, height);
    gl.UseProgram(program);
    gl.Uniform2f(gl.GetUniformLocation(program, "u_texel"), 1.0f / (float)width, 1.0f / (float)height);
    gl.BindTexture(GL_TEXTURE_2D, glssao_map(effect, GLSSAO_MAP_RANDOM_VECTOR, NULL, NULL));
    gl.DrawArrays(GL_TRIANGLES, 0, 6);
    float *vectors = fixture_read_texture(target.texture, width, height, 3);
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.DeleteVertexArrays(1, &array);
    gl.DeleteProgram(program);
    return vectors;
}

/* How far the driver's linear filter puts a sample off, in texels: hardware keeps as few as 8 bits of the place between
 * two texels. Measured along two texels that hold 0 and 1. */
static double measured_filter_error(void)
{
    enum { COUNT = 4096 };
    static const float zero_and_one[] = {0.0f, 1.0f};
    const GLuint program = fixture_program(
        "#version 330\nvoid main() {\n"
        "gl_Position = vec4(vec2[3](vec2(-1, -1), vec2(3, -1), vec2(-1, 3))[gl_VertexID], 0.0, 1.0); }\n",
        "#version 330\nuniform sampler2D u_map;\nout vec4 o_color;\n"
        "void main() { o_color = texture(u_map, vec2(0.25 + 0.5 * gl_FragCoord.x / 4096.0, 0.5)); }\n");
    SCOPED(texture) const GLuint two = fixture_texture(GL_R32F, GL_RED, GL_FLOAT, 2, 1, zero_and_one);
    SCOPED(target) const fixture_target target = fixture_make_target(GL_R32F, COUNT, 1);
    GLuint array;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.Viewport(0, 0, COUNT, 1);
    gl.UseProgram(program);
    gl.BindTexture(GL_TEXTURE_2D, two);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    SCOPED(memory) float *seen = fixture_read_texture(target.texture, COUNT, 1, 1);
    double worst = 0.0;
    for (int i = 0; i < COUNT; ++i)
        worst = fmax(worst, fabs((double)seen[i] - (i + 0.5) / COUNT));
    print_message("linear filter: off by up to %.2g texels\n", worst);
    assert_true(worst < 0.005); /* as 8 bits allow */
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.DeleteVertexArrays(1, &array);
    gl.DeleteProgram(program);
    return worst;
}

static double linear_filter_error(void)
{
    static double error = -1.0; /* the same for all tests: measured once */
    if (error < 0.0)
        error = measured_filter_error();
    return error;
}

typedef struct setup {
    glssao_effect *effect;
    glssao_frame frame;
    glssao_settings settings;
    model_input input;
    float *depth, *normals, *random_vectors;
    float kernel[64][4], rotations[16][4];
} setup;

typedef struct setup_options {
    analytic_projection projection;
    GLenum depth_format;
    int width, height;
    double scale;
    bool half;
} setup_options;

static void set_up(setup *s, fixture *f, const setup_options *o)
{
    memset(s, 0, sizeof *s);
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, o->scale);
    analytic_view view = analytic_make_view(o->projection, (double)o->width / o->height, 0.5, 40.0, o->scale);
    float *depth;
    analytic_render(&view, room, ANALYTIC_ROOM_SHAPES, o->width, o->height, &depth, &s->normals);
    s->effect = fixture_effect(f, o->width, o->height);
    s->frame = fixture_maps_frame(&view, o->width, o->height, o->depth_format, depth, s->normals);
    free(depth);
    s->depth = fixture_read_depth(s->frame.depth_texture, o->width, o->height); /* as the format rounds it */

    s->settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH);
    float scale = (float)o->scale;
    s->settings.radius *= scale;
    s->settings.fade_start *= scale;
    s->settings.fade_end *= scale;
    s->settings.surface_epsilon *= scale;
    s->settings.blur_depth_threshold *= scale;
    s->settings.half_resolution = o->half;
    s->input = (model_input){
        .width = o->width,
        .height = o->height,
        .ambient_width = o->half ? (o->width + 1) / 2 : o->width,
        .ambient_height = o->half ? (o->height + 1) / 2 : o->height,
        .depth = s->depth,
        .normals = s->normals,
        .frame = &s->frame,
        .settings = &s->settings,
        .constants = glssao_get_constants(s->effect),
        .filter_error = linear_filter_error(),
    };
    s->random_vectors = sampled_random_vectors(s->effect, s->input.ambient_width, s->input.ambient_height);
    s->input.random_vectors = s->random_vectors;
}

static void tear_down(setup *s)
{
    fixture_delete_frame(&s->frame);
    glssao_destroy(s->effect);
    free(s->depth);
    free(s->normals);
    free(s->random_vectors);
}
#define test_end_setup tear_down /* for SCOPED */

static void check_estimate(setup *s, const char *what)
{
    s->settings.blur = GLSSAO_BLUR_NONE;
    int width, height;
    SCOPED(memory) float *got = fixture_compute(s->effect, &s->frame, &s->settings, &width, &height);
    s->input.depth_step = depth_step_of(s->effect);
    assert_int_equal(width, s->input.ambient_width);
    assert_int_equal(height, s->input.ambient_height);
    double tolerance = 1.5 * R16_STEP + 2e-5 * fmax(1.0, (double)s->settings.power);
    double worst = 0.0, mean = 0.0;
    int wide = 0, occluded = 0, wrong = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double low, high, value = (double)got[y * width + x];
            if (s->settings.technique == GLSSAO_CLASSIC)
                model_classic(&s->input, x, y, &low, &high);
            else
                model_hemisphere(&s->input, x, y, &low, &high);
            double outside = fmax(low - value, value - high);
            worst = fmax(worst, outside);
            if (!(outside <= tolerance) && wrong++ == 0)
                print_error("%s: pixel %d, %d: got %.6f, model %.6f to %.6f\n", what, x, y, value, low, high);
            mean += value / (width * height);
            wide += high - low > 0.01;
            occluded += high < 0.97;
        }
    print_message("%s: worst outside interval %.2e, mean %.4f, occluded %.1f %%, wide %.2f %%\n", what, worst, mean,
                  100.0 * occluded / (width * height), 100.0 * wide / (width * height));
    /* A filter of few bits may put a random vector or a texel's border a step off, and no model sees which. */
    const bool is_exact = s->input.filter_error < 1e-5;
    assert_true(wrong * 500 <= (is_exact ? 0 : width * height));
    assert_true(wide * (is_exact ? 20 : 12) < width * height); /* less than 5 or 8 % of pixels are undecided */
    assert_true(occluded * 200 > width * height);              /* more than 0.5 % of pixels are occluded */
}

/* `least_change`: the least that the blur must change somewhere, so that a blur that does nothing fails. */
static void check_blur(setup *s, const char *what, double least_change)
{
    s->settings.blur_rounds = 0;
    int width, height;
    SCOPED(memory) float *raw = fixture_compute(s->effect, &s->frame, &s->settings, &width, &height);
    s->settings.blur_rounds = 1;
    SCOPED(memory) float *blurred = fixture_compute(s->effect, &s->frame, &s->settings, &width, &height);
    uint32_t other = glssao_map(s->effect, GLSSAO_MAP_AMBIENT_OTHER, NULL, NULL);
    SCOPED(memory) float *horizontal = fixture_read_texture(other, width, height, 1);
    int wrong = 0, undecided = 0;
    double changed = 0.0;
    for (int pass = 0; pass < 2; ++pass)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                double want, value = (double)(pass == 0 ? horizontal : blurred)[y * width + x];
                bool decided = model_blur(&s->input, pass == 0 ? raw : horizontal, pass == 0, x, y, &want);
                undecided += !decided;
                changed = fmax(changed, fabs(value - (double)raw[y * width + x]));
                if (decided && !(fabs(value - want) <= 1.5 * R16_STEP) && wrong++ == 0)
                    print_error("%s: pass %d, pixel %d, %d: got %.6f, model %.6f\n", what, pass, x, y, value, want);
            }
    assert_int_equal(wrong, 0);
    assert_true(undecided * 100 < 2 * width * height); /* less than 1 % of the pixels of both passes */
    assert_true(changed > least_change);
}

TEST_GL(estimate_agrees_for_unnormalised_and_unsigned_normals)
{
    SCOPED(setup) setup s;
    set_up(&s, f, &(setup_options){PERSPECTIVE, GL_DEPTH_COMPONENT32F, 100, 80, 1.0, false});
    size_t count = (size_t)3 * 100 * 80;
    SCOPED(memory) float *stored = malloc(count * sizeof *stored);
    for (int kind = 0; kind < 2; ++kind) {
        for (size_t i = 0; i < count; ++i)
            stored[i] = kind == 0 ? 37.5f * s.normals[i] : 0.5f * s.normals[i] + 0.5f;
        GLuint original = s.frame.normal_texture;
        s.frame.normal_texture = fixture_normal_texture(100, 80, stored);
        s.frame.normal_kind = kind == 0 ? GLSSAO_NORMAL_SIGNED : GLSSAO_NORMAL_UNSIGNED;
        check_estimate(&s, kind == 0 ? "long normals" : "unsigned normals");
        gl.DeleteTextures(1, &s.frame.normal_texture);
        s.frame.normal_texture = original;
    }
}

/* The room as distances, in a red map or in the normal map's alpha, with sky stored as each value that means sky. */
static void store_distances(setup *s, glssao_depth kind)
{
    static const float skies[] = {INFINITY, NAN, 1e30f, 0.0f};
    int count = s->input.width * s->input.height;
    SCOPED(memory) float *rgba = malloc((size_t)count * 4 * sizeof *rgba);
    const float *p = s->frame.projection;
    for (int i = 0; i < count; ++i) {
        double ndc = 2.0 * (double)s->depth[i] - 1.0;
        double distance = ((double)p[14] - ndc * (double)p[15]) / ((double)p[10] - ndc * (double)p[11]);
        s->depth[i] = s->depth[i] == 1.0f ? skies[i % 4] : (float)distance;
        for (int k = 0; k < 3; ++k)
            rgba[4 * i + k] = s->normals[3 * i + k];
        rgba[4 * i + 3] = s->depth[i];
    }
    gl.DeleteTextures(1, &s->frame.depth_texture);
    s->frame.depth_texture = 0;
    s->frame.depth_kind = kind;
    bool alpha = kind == GLSSAO_DEPTH_NORMAL_ALPHA;
    GLuint *texture = alpha ? &s->frame.normal_texture : &s->frame.depth_texture;
    gl.DeleteTextures(1, texture);
    *texture = fixture_texture(alpha ? GL_RGBA32F : GL_R32F, alpha ? GL_RGBA : GL_RED, GL_FLOAT, s->input.width,
                               s->input.height, alpha ? rgba : s->depth);
}

TEST_GL(estimates_agree_for_stored_distances)
{
    static const glssao_depth kinds[] = {GLSSAO_DEPTH_VIEW_DISTANCE, GLSSAO_DEPTH_NORMAL_ALPHA};
    for (int kind = 0; kind < 2; ++kind)
        for (int orthographic = 0; orthographic < 2; ++orthographic) {
            SCOPED(setup) setup s;
            analytic_projection projection = orthographic ? ORTHOGRAPHIC : PERSPECTIVE;
            set_up(&s, f, &(setup_options){projection, GL_DEPTH_COMPONENT32F, 160, 100, 1.0, true});
            store_distances(&s, kinds[kind]);
            check_estimate(&s, kind == 0 ? "distance in red" : "distance in alpha");
            s.settings.blur = GLSSAO_BLUR_BILATERAL;
            check_blur(&s, "blur over distances", 0.005);
        }
}

static void use_hemisphere(setup *s, int sample_count)
{
    s->settings = glssao_default_settings(GLSSAO_HEMISPHERE, GLSSAO_HIGH);
    s->settings.sample_count = sample_count;
    kernel_of_seed(1, sample_count, s->kernel, s->rotations); /* fixture_config's seed */
    s->input.kernel = (const float(*)[4])s->kernel;
    s->input.rotations = (const float(*)[4])s->rotations;
}

#define CHANGE(name, statements)                                                                                       \
    static void name(glssao_settings *s)                                                                               \
    {                                                                                                                  \
        statements;                                                                                                    \
    }
CHANGE(nothing, (void)s)
CHANGE(few_samples, s->power = 1.0f; s->sample_count = 5)
CHANGE(fades_meet, s->radius = 1.5f; s->fade_start = s->fade_end = 0.7f; s->surface_epsilon = 0.0f)
CHANGE(any_angle, s->no_angle_weight = true)
CHANGE(wide, s->radius = 1.0f)
CHANGE(plain, s->radius = 0.5f; s->power = 1.0f)
/* Samples off the screen and behind the camera. */
CHANGE(far_samples, s->radius = 3.0f; s->power = 2.0f)
/* Steps of depth must not occlude, even though no other bias hides them. */
CHANGE(no_bias, s->surface_epsilon = 0.0f; s->power = 1.0f)
/* A single sample at any angle: if it is hidden, accessibility is 0, which a small power raises visibly. */
CHANGE(nothing_left, s->sample_count = 1; s->no_angle_weight = true; s->power = 0.01f)
/* The radius exceeds the distance of everything visible. Samples behind the camera must be neither mirrored into the
 * picture nor counted. */
CHANGE(behind_the_camera, s->radius = 20.0f; s->fade_end = 10.0f; s->power = 1.0f)

static const struct row {
    const char *what;
    int samples; /* of the hemisphere technique; 0: classic */
    setup_options options;
    void (*change)(glssao_settings *s);
} rows[] = {
    {"half size", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 200, 120, 1.0, true}, nothing},
    {"half of an odd size", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 201, 121, 1.0, true}, nothing},
    {"half of a tall size", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 67, 254, 1.0, true}, nothing},
    {"24 bits", 0, {PERSPECTIVE, GL_DEPTH24_STENCIL8, 200, 120, 1.0, true}, nothing},
    {"16 bits", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT16, 151, 100, 1.0, false}, no_bias},
    {"5 samples, power 1", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 200, 120, 1.0, false}, few_samples},
    {"equal fade bounds, no epsilon", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 200, 120, 1.0, false}, fades_meet},
    {"no angle weight", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 200, 120, 1.0, false}, any_angle},
    {"nothing left", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 151, 100, 1.0, false}, nothing_left},
    {"behind the camera", 0, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 151, 100, 1.0, false}, behind_the_camera},
    {"hemisphere, 1 sample", 1, {PERSPECTIVE, GL_DEPTH_COMPONENT24, 151, 100, 1.0, false}, plain},
    {"hemisphere, 7 samples, half size", 7, {PERSPECTIVE, GL_DEPTH_COMPONENT24, 151, 100, 1.0, true}, plain},
    {"hemisphere, 64 samples", 64, {PERSPECTIVE, GL_DEPTH_COMPONENT24, 151, 100, 1.0, false}, far_samples},
    {"hemisphere, 16 bits", 16, {PERSPECTIVE, GL_DEPTH_COMPONENT16, 151, 100, 1.0, false}, no_bias},
    {"hemisphere, nothing left", 1, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 151, 100, 1.0, false}, nothing_left},
    {"hemisphere, behind", 16, {PERSPECTIVE, GL_DEPTH_COMPONENT32F, 151, 100, 1.0, false}, behind_the_camera},
};

static void check_row(fixture *f, const struct row *row)
{
    SCOPED(setup) setup s;
    set_up(&s, f, &row->options);
    if (row->samples)
        use_hemisphere(&s, row->samples);
    s.settings.half_resolution = row->options.half;
    row->change(&s.settings);
    check_estimate(&s, row->what);
}

TEST_GL(estimates_agree_with_their_models)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        check_row(f, &rows[i]);
}

TEST_GL(estimates_agree_for_every_projection)
{
    for (int p = 0; p < PROJECTION_COUNT; ++p) {
        char what[48];
        snprintf(what, sizeof what, "projection %d", p);
        const setup_options o = {(analytic_projection)p, GL_DEPTH_COMPONENT32F, 200, 120, 1.0, false};
        check_row(f, &(struct row){what, 0, o, nothing});
        check_row(f, &(struct row){what, 16, o, wide});
    }
}

/* The picture's middle is about 5 units away. */
TEST_GL(estimates_agree_for_far_fade_and_radius_in_pixels)
{
    static const float fades[][2] = {{4.0f, 9.0f}, {8.6f, 8.6f}};
    for (int i = 0; i < 8; ++i) {
        const bool hemisphere = i & 1, orthographic = i & 2, pixels = i & 4;
        SCOPED(setup) setup s;
        set_up(
            &s, f,
            &(setup_options){orthographic ? ORTHOGRAPHIC : PERSPECTIVE, GL_DEPTH_COMPONENT32F, 151, 100, 1.0, i == 4});
        if (hemisphere)
            use_hemisphere(&s, 16);
        s.settings.power = 1.0f;
        s.settings.fade_far_start = pixels ? 0.0f : fades[orthographic][0];
        s.settings.fade_far_end = pixels ? 0.0f : fades[orthographic][1];
        s.settings.radius = pixels ? 11.5f : 1.0f;
        s.settings.radius_in_pixels = pixels;
        check_estimate(&s, pixels ? "radius in pixels" : "far fade");
    }
}

/* Normals parallel to the tile's own rotation vectors, with which they span no plane. */
TEST_GL(hemisphere_agrees_for_normals_along_the_noise)
{
    SCOPED(setup) setup s;
    set_up(&s, f, &(setup_options){PERSPECTIVE, GL_DEPTH_COMPONENT32F, 151, 100, 1.0, false});
    use_hemisphere(&s, 16);
    s.settings.radius = 1.0f;
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 151; ++x)
            memcpy(s.normals + 3 * (y * 151 + x), s.rotations[y % 4 * 4 + x % 4], 3 * sizeof(float));
    gl.DeleteTextures(1, &s.frame.normal_texture);
    s.frame.normal_texture = fixture_normal_texture(151, 100, s.normals);
    check_estimate(&s, "normals along the noise");
}

/* Octahedral encoding of a unit vector, from its definition: project onto |x| + |y| + |z| = 1, fold the lower half. */
static void octahedral(const float n[3], float out[2])
{
    double sum = fabs((double)n[0]) + fabs((double)n[1]) + fabs((double)n[2]);
    double x = (double)n[0] / sum, y = (double)n[1] / sum;
    if (n[2] < 0.0f) {
        double fold_x = (1.0 - fabs(y)) * (x >= 0.0 ? 1.0 : -1.0), fold_y = (1.0 - fabs(x)) * (y >= 0.0 ? 1.0 : -1.0);
        x = fold_x;
        y = fold_y;
    }
    out[0] = (float)x;
    out[1] = (float)y;
}

TEST_GL(octahedral_normals_shade_like_plain_ones)
{
    for (int hemisphere = 0; hemisphere < 2; ++hemisphere) {
        SCOPED(setup) setup s;
        set_up(&s, f, &(setup_options){PERSPECTIVE, GL_DEPTH_COMPONENT32F, 150, 100, 1.0, false});
        int count = 150 * 100, flipped = 0;
        SCOPED(memory) float *encoded = malloc((size_t)count * 2 * sizeof *encoded);
        for (int i = 0; i < count; ++i) {
            flipped += i % 5 == 0;
            for (int k = 0; k < 3 && i % 5 == 0; ++k) /* some face away, so the folded half is decoded too */
                s.normals[3 * i + k] = -s.normals[3 * i + k];
            octahedral(s.normals + 3 * i, encoded + 2 * i);
        }
        assert_true(flipped > 1000);
        gl.BindTexture(GL_TEXTURE_2D, s.frame.normal_texture);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, 150, 100, 0, GL_RG, GL_FLOAT, encoded);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        s.frame.normal_kind = GLSSAO_NORMAL_OCTAHEDRAL;
        if (hemisphere)
            use_hemisphere(&s, 16);
        check_estimate(&s, "octahedral");
    }
}

TEST_GL(blur_agrees)
{
    static const glssao_blur kinds[] = {GLSSAO_BLUR_BILATERAL, GLSSAO_BLUR_GAUSSIAN, GLSSAO_BLUR_BOX};
    static const char *const names[] = {"bilateral", "gaussian", "box"};
    for (int kind = 0; kind < 3; ++kind)
        for (int half = 0; half < 2; ++half) {
            SCOPED(setup) setup s;
            set_up(&s, f, &(setup_options){PERSPECTIVE, GL_DEPTH_COMPONENT32F, 201, 120, 1.0, half == 1});
            s.settings.blur = kinds[kind];
            check_blur(&s, names[kind], 0.05);
            s.settings.blur_sigma = 1.2f;
            check_blur(&s, names[kind], 0.05);
        }
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
