/* SPDX-License-Identifier: MIT
 *
 * Forms that the judging scenes have little of, each beside traced rays: grooves, parallel plates, strands of one to
 * two pixels, and a wall's foot at 20 angles of roll. Prints what docs/accuracy-causes.md quotes.
 */
#include "analytic_shot.h"

static const double PI = 3.14159265358979323846;
static const char *const level_names[] = {"low", "medium", "high", "ultra"};
enum { LEVELS = 4, RAYS = 1024, INDICES = 8 };

/* Which pixels of a shot are compared: those of the first `shapes` shapes that lie this near to a point. */
typedef struct region {
    double center[3], reach;
    int stride; /* one of so many pixels, since truth takes time */
} region;

typedef struct errors {
    double sum, square, truth;
    int count;
} errors;

static glssao_settings level_settings(int level, double radius)
{
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)level);
    s.radius = (float)radius;
    return s;
}

/* Adds the errors of a picture where the truth is known. */
static void compare(const analytic_shot *s, const float *got, const double *truth, errors *e)
{
    for (int i = 0; i < s->width * s->height; ++i) {
        if (truth[i] < 0.0)
            continue;
        const double error = (double)got[i] - truth[i];
        e->sum += error;
        e->square += error * error;
        e->truth += truth[i];
        e->count++;
    }
}

/* Accessibility of the pixels of a region; -1 elsewhere. The caller frees it. */
static double *trace(const analytic_shot *s, const region *r, double radius)
{
    const int count = s->width * s->height;
    double *truth = malloc((size_t)count * sizeof *truth);
    assert_non_null(truth);
    for (int i = 0, seen = 0; i < count; ++i) {
        double at[3], square = 0.0, normal[3];
        analytic_position(s, i % s->width, i / s->width, at);
        for (int axis = 0; axis < 3; ++axis) {
            square += (at[axis] - r->center[axis]) * (at[axis] - r->center[axis]);
            normal[axis] = (double)s->normals[3 * i + axis];
        }
        const bool compared = s->depth[i] < 1.0f && square < r->reach * r->reach && seen++ % r->stride == 0;
        truth[i] = compared ? analytic_accessibility(s->shapes, s->shape_count, at, normal, radius, RAYS) : -1.0;
    }
    return truth;
}

static float *shade(fixture *f, const analytic_shot *s, const glssao_settings *settings)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, s->width, s->height);
    int width, height;
    float *got = fixture_compute(effect, &s->frame, settings, &width, &height);
    assert_true(width == s->width && height == s->height);
    return got;
}

static void assert_form(fixture *f, const char *name, const analytic_shape *shapes, int shape_count, double radius,
                        const region *r, const double most[LEVELS])
{
    SCOPED(shot) analytic_shot s = analytic_take(shapes, shape_count, PERSPECTIVE, 180, 120);
    SCOPED(memory) double *truth = trace(&s, r, radius);
    for (int level = 0; level < LEVELS; ++level) {
        const glssao_settings settings = level_settings(level, radius);
        SCOPED(memory) float *got = shade(f, &s, &settings);
        errors e = {0};
        compare(&s, got, truth, &e);
        assert_true(e.count > 100);
        const double rmse = sqrt(e.square / e.count);
        print_message("%s, %s: truth %.3f, bias %+.3f, RMSE %.3f (%d pixels)\n", name, level_names[level],
                      e.truth / e.count, e.sum / e.count, rmse, e.count);
        assert_true(rmse < most[level]);
    }
}

TEST_GL(grooves_are_near_the_truth)
{
    static const double openings[] = {30.0, 60.0, 90.0};
    static const double most[][LEVELS] = {
        {0.06, 0.06, 0.065, 0.022}, {0.045, 0.045, 0.045, 0.02}, {0.025, 0.025, 0.027, 0.013}};
    for (int i = 0; i < 3; ++i) {
        const double half = openings[i] * PI / 360.0;
        const analytic_shape shapes[] = {{ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, cos(half), sin(half)}},
                                         {ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, -cos(half), sin(half)}}};
        char name[32];
        snprintf(name, sizeof name, "groove of %g degrees", openings[i]);
        assert_form(f, name, shapes, 2, 1.0, &(region){{0.0, 0.0, -6.0}, 1.5, 3}, most[i]);
    }
}

/* In a groove, one slice alone hides more than all, so that an estimate is below 0 in many pixels. Each way on from
 * there keeps a number, and a bent normal's accessibility is none below 0. */
TEST_GL(estimates_below_0_stay_numbers)
{
    const double half = PI / 12.0;
    const analytic_shape shapes[] = {{ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, cos(half), sin(half)}},
                                     {ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, -cos(half), sin(half)}}};
    enum { WIDTH = 180, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };
    analytic_shot s = analytic_take(shapes, 2, PERSPECTIVE, WIDTH, HEIGHT);
    glssao_settings settings = level_settings(GLSSAO_MEDIUM, 1.0);
    settings.half_resolution = false;
    settings.blur = GLSSAO_BLUR_NONE;
    settings.power = 2.0f;
    SCOPED(memory) float *alone = shade(f, &s, &settings);
    int closed = 0;
    for (int i = 0; i < PIXELS; ++i)
        closed += alone[i] == 0.0f;
    assert_true(closed > PIXELS / 100);

    /* Rays say that all is open, so a correction only brightens. */
    SCOPED(memory) float *rays = malloc(PIXELS * sizeof *rays);
    assert_non_null(rays);
    for (int i = 0; i < PIXELS; ++i)
        rays[i] = 1.0f;
    s.frame.rays_texture = fixture_texture(GL_R32F, GL_RED, GL_FLOAT, WIDTH, HEIGHT, rays);
    SCOPED(memory) float *corrected = shade(f, &s, &settings);
    for (int i = 0; i < PIXELS; ++i)
        assert_true(alone[i] == 0.0f ? corrected[i] > 0.0f : corrected[i] >= alone[i] - 1e-3f);
    gl.DeleteTextures(1, &s.frame.rays_texture);
    s.frame.rays_texture = 0;

    /* So small a power leaves 1. */
    settings.power = 1e-4f;
    SCOPED(memory) float *open = shade(f, &s, &settings);
    for (int i = 0; i < PIXELS; ++i)
        assert_true(open[i] > 0.99f);

    settings.power = 2.0f;
    settings.bent_normals = true;
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, WIDTH, HEIGHT);
    for (int accumulated = 0; accumulated < 2; ++accumulated) {
        assert_int_equal((accumulated ? glssao_accumulate : glssao_compute)(effect, &s.frame, &settings), GLSSAO_OK);
        SCOPED(memory)
        float *bent = fixture_read_texture(glssao_map(effect, GLSSAO_MAP_BENT_NORMAL, NULL, NULL), WIDTH, HEIGHT, 4);
        for (int i = 0; i < PIXELS; ++i)
            assert_true(bent[4 * i + 3] >= 0.0f);
    }

    /* A mean of one estimate that the blur spreads. */
    settings.bent_normals = false;
    settings.blur = GLSSAO_BLUR_PLANAR;
    SCOPED(memory) float *blurred = shade(f, &s, &settings);
    assert_int_equal(glssao_accumulate(effect, &s.frame, &settings), GLSSAO_OK);
    SCOPED(memory)
    float *mean = fixture_read_texture(glssao_map(effect, GLSSAO_MAP_AMBIENT, NULL, NULL), WIDTH, HEIGHT, 1);
    for (int i = 0; i < PIXELS; ++i)
        assert_true(mean[i] > 0.3f * blurred[i] - 0.05f);
    analytic_free_shot(&s);
}

/* Seen along the gap. Half of what hides a point faces away from the eye or lies outside the picture. */
TEST_GL(parallel_plates_are_near_the_truth)
{
    const analytic_shape shapes[] = {{ANALYTIC_PLANE, {0.0, -0.5, 0.0}, {0.0, 1.0, 0.0}},
                                     {ANALYTIC_PLANE, {0.0, 0.5, 0.0}, {0.0, -1.0, 0.0}}};
    static const double most[LEVELS] = {0.36, 0.16, 0.08, 0.01};
    assert_form(f, "parallel plates", shapes, 2, 2.0, &(region){{0.0, 0.0, -4.0}, 1.0, 3}, most);
}

/* 120 strands of one to two pixels over a floor: one frame, and the mean of several noise indices, as a host's TAA and
 * the history take it. */
TEST_GL(strands_calm_down_over_frames)
{
    enum { STRANDS = 120 };
    static const double most[LEVELS] = {0.16, 0.17, 0.15, 0.11}, part[LEVELS] = {0.92, 0.9, 1.01, 1.01};
    analytic_shape shapes[STRANDS + 1];
    uint32_t random = 1;
    for (int i = 0; i < STRANDS; ++i) {
        double u[3];
        for (int k = 0; k < 3; ++k) {
            random = random * 1664525u + 1013904223u;
            u[k] = (random >> 8) / 16777216.0;
        }
        shapes[i] = (analytic_shape){ANALYTIC_BOX,
                                     {2.4 * u[0] - 1.2, -0.6 + 0.15 * u[2], -3.6 + u[1]},
                                     {0.008 + 0.008 * u[2], 0.4 + 0.15 * u[2], 0.003}};
    }
    shapes[STRANDS] = (analytic_shape){ANALYTIC_PLANE, {0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}};
    SCOPED(shot) analytic_shot s = analytic_take(shapes, STRANDS + 1, PERSPECTIVE, 180, 120);
    const region r = {{0.0, -0.5, -3.1}, 1.2, 9};
    SCOPED(memory) double *truth = trace(&s, &r, 0.3);
    for (int level = 0; level < LEVELS; ++level) {
        glssao_settings settings = level_settings(level, 0.3);
        SCOPED(memory) float *mean = shade(f, &s, &settings);
        errors one = {0}, all = {0};
        compare(&s, mean, truth, &one);
        for (uint32_t k = 1; k < INDICES; ++k) {
            settings.noise_index = k;
            SCOPED(memory) float *got = shade(f, &s, &settings);
            for (int i = 0; i < s.width * s.height; ++i)
                mean[i] += (got[i] - mean[i]) / (float)(k + 1);
        }
        compare(&s, mean, truth, &all);
        const double single = sqrt(one.square / one.count), calm = sqrt(all.square / all.count);
        print_message("strands, %s: RMSE %.3f, of the mean of %d frames %.3f (%d pixels)\n", level_names[level], single,
                      INDICES, calm, one.count);
        assert_true(single < most[level] && calm < part[level] * single);
    }
}

/* How much the mean error at a wall's foot changes as the camera rolls. */
TEST_GL(roll_changes_little)
{
    enum { ANGLES = 20 };
    static const double most[LEVELS] = {0.018, 0.016, 0.0075, 0.005};
    double low[LEVELS], high[LEVELS];
    for (int a = 0; a < ANGLES; ++a) {
        const double roll = 2.0 * PI * a / ANGLES, k = sqrt(0.5);
        const analytic_shape shapes[] = {{ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {-k * sin(roll), k * cos(roll), k}},
                                         {ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {k * sin(roll), -k * cos(roll), k}}};
        const region r = {{0.0, 0.0, -6.0}, 0.8, 5};
        SCOPED(shot) analytic_shot s = analytic_take(shapes, 2, PERSPECTIVE, 180, 120);
        SCOPED(memory) double *truth = trace(&s, &r, 1.0);
        for (int level = 0; level < LEVELS; ++level) {
            const glssao_settings settings = level_settings(level, 1.0);
            SCOPED(memory) float *got = shade(f, &s, &settings);
            errors e = {0};
            compare(&s, got, truth, &e);
            const double error = e.sum / e.count;
            low[level] = a ? fmin(low[level], error) : error;
            high[level] = a ? fmax(high[level], error) : error;
        }
    }
    for (int level = 0; level < LEVELS; ++level) {
        print_message("roll, %s: mean error from %+.4f to %+.4f\n", level_names[level], low[level], high[level]);
        assert_true(high[level] - low[level] < most[level]);
    }
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
