/* SPDX-License-Identifier: MIT
 *
 * The planar blur and upsampling compared with their double-precision models, pixel by pixel, from the maps that they
 * read.
 *
 * Tolerance: half a step of the 13 bits of accessibility between passes, and 1.5 steps of R16 where a pass writes the
 * result.
 */
#include "analytic.h"
#include "fixture.h"
#include "horizon_internals.h"
#include "horizon_passes.h"

static const double PAIRED = 0x1p-14 + 1e-6, RESULT = 1.5 / 65535.0;

typedef struct setup {
    glssao_effect *effect;
    glssao_frame frame;
    glssao_settings settings;
    int width, height; /* full size */
    bool orthographic;
    float *depth, *normals;
    pass_constants blur, upsample;
    int most_open; /* per cent of pixels */
} setup;

/* `bits`: of the depth format, 16 or 32 (floats). */
static setup set_up(fixture *f, analytic_projection projection, int bits, int width, int height)
{
    /* With a near plane this close, a step of 16 bits exceeds the tolerance from 5 units on. */
    const double near = bits == 16 ? 0.02 : 0.5;
    const analytic_view view = analytic_make_view(projection, (double)width / height, near, 40.0, 1.0);
    setup s = {.width = width, .height = height, .most_open = bits == 16 ? 2 : 1};
    analytic_render(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, width, height, &s.depth, &s.normals);
    for (int i = 0; bits == 16 && i < width * height; ++i)
        s.depth[i] = roundf(s.depth[i] * 65535.0f) / 65535.0f;
    s.effect = fixture_drawn_effect(f, width, height);
    s.frame = fixture_maps_frame(&view, width, height, bits == 16 ? GL_DEPTH_COMPONENT16 : GL_DEPTH_COMPONENT32F,
                                 s.depth, s.normals);
    s.orthographic = view.projection[11] == 0.0f;
    s.settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    s.settings.upsample = true;
    s.settings.blur_rounds = 1;
    s.settings.radius = 0.8f;
    horizon_read_pass_constants(&s.blur, &s.upsample);
    s.blur.wide_alike /= sqrt(s.settings.sample_count);
    pass_constants *in_radius[] = {&s.blur, &s.upsample};
    for (int i = 0; i < 2; ++i) {
        in_radius[i]->tolerance *= (double)s.settings.radius;
        in_radius[i]->near *= (double)s.settings.radius;
        in_radius[i]->hollow *= (double)s.settings.radius;
    }
    int w, h;
    free(fixture_compute(s.effect, &s.frame, &s.settings, &w, &h));
    for (int i = 0; i < 2; ++i)
        horizon_depth_step(s.effect, in_radius[i]->depth_step);
    return s;
}

static void tear_down(setup *s)
{
    fixture_delete_frame(&s->frame);
    glssao_destroy(s->effect);
    free(s->depth);
    free(s->normals);
}
#define test_end_setup tear_down /* for SCOPED */

static paired_map read_paired(const setup *s, int number)
{
    const int divisor = s->settings.half_resolution ? 2 : 1;
    paired_map map = {.width = (s->width + divisor - 1) / divisor, .height = (s->height + divisor - 1) / divisor};
    map.texels = fixture_read_texture(horizon_paired_map(s->effect, number), map.width, map.height, 3);
    return map;
}

/* The outcome of one pass. */
typedef struct tally {
    const char *what;
    double worst;
    double least_change; /* the change from which a pixel counts as changed */
    int most_open;       /* per cent */
    int count, open, wrong, changed;
} tally;

static void add(tally *t, double got, double before, double low, double high, double tolerance)
{
    const double outside = fmax(low - got, got - high);
    t->worst = fmax(t->worst, outside);
    t->wrong += !(outside <= tolerance);
    t->open += high - low > 0.01;
    t->changed += fabs(got - before) > t->least_change;
    ++t->count;
}

/* Some pixels must change, or the pass might do nothing. Few may be open: those midway between two neighbours across a
 * crease, equally near (measured: 0.45 %), and with 16 bits bends of exactly a step (1.38 %). */
static void finish(const tally *t)
{
    print_message("%s: worst outside %.1e, open %.2f %%, changed %.0f %%\n", t->what, t->worst,
                  100.0 * t->open / t->count, 100.0 * t->changed / t->count);
    assert_int_equal(t->wrong, 0);
    assert_true(t->open * 100 < t->most_open * t->count);
    assert_true(t->changed * 200 > t->count);
}

typedef enum blur_pass { HORIZONTAL, VERTICAL, LATER_ROUND } blur_pass;

/* `got` is the first channel of a float map, or the result. */
static void check_blur(const setup *s, const paired_map *from, blur_pass pass, const float *got, int stride,
                       double tolerance)
{
    static const char *const names[] = {"horizontal blur", "vertical blur", "later round"};
    /* A later round has little left to change. */
    tally t = {.what = names[pass], .least_change = pass == LATER_ROUND ? 0.002 : 0.01, .most_open = s->most_open};
    for (int y = 0; y < from->height; ++y)
        for (int x = 0; x < from->width; ++x) {
            double low, high;
            const size_t at = (size_t)y * (size_t)from->width + (size_t)x;
            if (pass == LATER_ROUND)
                wide_blur_model(from, s->orthographic, &s->blur, x, y, &low, &high);
            else
                planar_blur_model(from, pass == HORIZONTAL, s->orthographic, &s->blur, x, y, &low, &high);
            add(&t, stride == 1 ? (double)got[at] : paired_accessibility(got[(size_t)stride * at]),
                paired_accessibility(from->texels[3 * at]), low, high, tolerance);
        }
    finish(&t);
}

/* Beyond the picture its edge repeats. */
static double view_distance(const setup *s, int x, int y)
{
    x = x < 0 ? 0 : x < s->width ? x : s->width - 1;
    y = y < 0 ? 0 : y < s->height ? y : s->height - 1;
    const float *p = s->frame.projection;
    const double d = (double)s->depth[y * s->width + x], ndc = s->frame.clip_zero_to_one ? d : 2.0 * d - 1.0;
    return ((double)p[14] - ndc * (double)p[15]) / ((double)p[10] - ndc * (double)p[11]);
}

static double linear_at(const setup *s, int x, int y)
{
    const double distance = view_distance(s, x, y);
    return s->orthographic ? distance : 1.0 / distance;
}

static void check_upsampling(const setup *s, const paired_map *half, const float *got)
{
    tally t = {.what = "upsampling", .least_change = 0.01, .most_open = s->most_open};
    const float sky = s->frame.clip_zero_to_one ? 0.0f : 1.0f;
    for (int y = 0; y < s->height; ++y)
        for (int x = 0; x < s->width; ++x) {
            const size_t at = (size_t)y * (size_t)s->width + (size_t)x;
            const size_t half_at = (size_t)(y / 2) * (size_t)half->width + (size_t)(x / 2);
            const float *n = s->normals + 3 * at;
            const double normal[3] = {(double)n[0], (double)n[1], (double)n[2]};
            full_pixel own = {.linear = linear_at(s, x, y), .normal = s->frame.normal_texture ? normal : NULL};
            for (int i = 0; i < 4; ++i)
                own.beyond[i] = linear_at(s, x + 2 * (i % 2 ? 1 : -1) * (x % 2), y + 2 * (i / 2 ? 1 : -1) * (y % 2));
            double low = 1.0, high = 1.0;
            if (s->depth[at] != sky)
                upsample_model(half, s->orthographic, &s->upsample, &own, x, y, &low, &high);
            /* The result has no sign. */
            add(&t, (double)got[at], paired_accessibility(half->texels[3 * half_at]), fmax(low, 0.0), fmax(high, 0.0),
                RESULT);
        }
    finish(&t);
}

/* The estimate writes the linear quantity beside accessibility. */
static void check_linear(const setup *s, const paired_map *map)
{
    const int factor = s->settings.half_resolution ? 2 : 1;
    int seen = 0;
    for (int y = 0; y < map->height; ++y)
        for (int x = 0; x < map->width; ++x) {
            const double got = (double)map->texels[3 * (y * map->width + x) + 1];
            const double distance = view_distance(s, x * factor, y * factor);
            if (!(distance < 39.0))
                continue; /* sky */
            const double want = s->orthographic ? distance : 1.0 / distance;
            assert_true(fabs(got - want) < 1e-5 * want);
            ++seen;
        }
    assert_true(seen * 20 > map->width * map->height);
}

/* The estimate upsampled alone, then after one round of blur, then after two. */
static void check_half_size(fixture *f, analytic_projection projection, int bits, bool has_normals, int width,
                            int height)
{
    SCOPED(setup) setup s = set_up(f, projection, bits, width, height);
    const uint32_t normals = s.frame.normal_texture;
    s.frame.normal_texture = has_normals ? normals : 0;
    int w, h;
    s.settings.blur = GLSSAO_BLUR_NONE;
    float *result = fixture_compute(s.effect, &s.frame, &s.settings, &w, &h);
    assert_true(w == width && h == height);
    SCOPED(paired) paired_map estimate = read_paired(&s, 0);
    check_linear(&s, &estimate);
    check_upsampling(&s, &estimate, result);
    free(result);
    s.settings.blur = GLSSAO_BLUR_PLANAR;
    result = fixture_compute(s.effect, &s.frame, &s.settings, &w, &h);
    SCOPED(paired) paired_map horizontal = read_paired(&s, 1), vertical = read_paired(&s, 0);
    check_blur(&s, &estimate, HORIZONTAL, horizontal.texels, 3, PAIRED);
    check_blur(&s, &horizontal, VERTICAL, vertical.texels, 3, PAIRED);
    check_upsampling(&s, &vertical, result);
    free(result);
    s.settings.blur_rounds = 2;
    result = fixture_compute(s.effect, &s.frame, &s.settings, &w, &h);
    SCOPED(paired) paired_map later = read_paired(&s, 1);
    check_blur(&s, &vertical, LATER_ROUND, later.texels, 3, PAIRED);
    check_upsampling(&s, &later, result);
    free(result);
    s.frame.normal_texture = normals;
}

/* The vertical blur is the last pass and writes the result. */
static void check_full_size(fixture *f, analytic_projection projection, int width, int height)
{
    SCOPED(setup) setup s = set_up(f, projection, 32, width, height);
    s.settings.half_resolution = false;
    int w, h;
    SCOPED(memory) float *result = fixture_compute(s.effect, &s.frame, &s.settings, &w, &h);
    assert_true(w == width && h == height);
    SCOPED(paired) paired_map estimate = read_paired(&s, 0), horizontal = read_paired(&s, 1);
    check_linear(&s, &estimate);
    check_blur(&s, &estimate, HORIZONTAL, horizontal.texels, 3, PAIRED);
    check_blur(&s, &horizontal, VERTICAL, result, 1, RESULT);
}

TEST_GL(passes_agree_at_half_size)
{
    for (int normals = 0; normals < 2; ++normals) {
        check_half_size(f, PERSPECTIVE, 32, normals, 160, 120);
        check_half_size(f, PERSPECTIVE_REVERSED_ZERO_TO_ONE, 32, normals, 161, 121);
        check_half_size(f, ORTHOGRAPHIC, 32, normals, 121, 160);
        check_half_size(f, PERSPECTIVE, 16, normals, 160, 120);
    }
}

TEST_GL(passes_agree_at_full_size)
{
    check_full_size(f, PERSPECTIVE, 120, 90);
    check_full_size(f, ORTHOGRAPHIC, 121, 91);
}

/* Without a normal, or with one facing straight away from the eye, where the projection ends, the code stays within its
 * ten bits, beside an accessibility of -0.6 (one slice alone) to 1. */
TEST_GL(every_normal_has_a_code)
{
    static const float normals[5][3] = {
        {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}, {0.1f, 0.0f, -1.0f}, {-0.1f, 0.0f, -1.0f}, {0.0f, -0.1f, -1.0f}};
    static const uint32_t codes[5][2] = {{15, 15}, {15, 15}, {31, 15}, {0, 15}, {15, 0}};
    SCOPED(setup) setup s = set_up(f, PERSPECTIVE, 32, 40, 30);
    for (int i = 0; i < 40 * 30; ++i)
        memcpy(s.normals + 3 * i, normals[i / 2 % 5], sizeof normals[0]);
    gl.DeleteTextures(1, &s.frame.normal_texture);
    s.frame.normal_texture = fixture_normal_texture(40, 30, s.normals);
    int width, height;
    s.settings.blur = GLSSAO_BLUR_NONE;
    free(fixture_compute(s.effect, &s.frame, &s.settings, &width, &height));
    SCOPED(paired) paired_map estimate = read_paired(&s, 0);
    for (int i = 0; i < estimate.width * estimate.height; ++i) {
        uint32_t bits;
        memcpy(&bits, &estimate.texels[3 * i], sizeof bits);
        const uint32_t *code = codes[i % estimate.width % 5];
        assert_int_equal(bits & 1023u, code[0] << 5 | code[1]);
        const double accessibility = paired_accessibility(estimate.texels[3 * i]);
        assert_true(accessibility > -0.6 && accessibility < 1.001);
    }
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
