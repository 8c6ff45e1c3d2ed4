/* SPDX-License-Identifier: MIT
 *
 * Arrays in, an array out: the result is the effect's own and agrees with closed forms.
 */
#include "occlude_fixture.h"

static const double R16_STEP = 1.0 / 65535.0;

TEST_GL(test_result_is_the_effects_own)
{
    SCOPED(picture) picture p = make_picture(analytic_unit_room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
    const glssao_settings settings = settings_of(1.0f);
    SCOPED(memory) float *got = malloc(COUNT * sizeof *got);
    const occlude_input input = input_of(&p, true);
    compute(&input, &settings, got);

    SCOPED(frame) glssao_frame frame = fixture_frame(&p.view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, WIDTH, HEIGHT);
    glssao_effect *effect = fixture_shared_effect(f, WIDTH, HEIGHT);
    int width, height;
    SCOPED(memory) float *wanted = fixture_compute(effect, &frame, &settings, &width, &height);
    turn_over(wanted, WIDTH, HEIGHT, 1);
    assert_memory_equal(got, wanted, COUNT * sizeof *got);
}

TEST_GL(test_view_distance_and_window_depth_agree)
{
    const glssao_settings settings = settings_of(1.0f);
    SCOPED(memory)
    float *by_window = malloc(COUNT * sizeof *by_window), *by_distance = malloc(COUNT * sizeof *by_distance);
    for (int projection = 0; projection < PROJECTION_COUNT; ++projection) {
        SCOPED(picture)
        picture p = make_picture(analytic_unit_room, ANALYTIC_ROOM_SHAPES, (analytic_projection)projection);
        const occlude_input window = input_of(&p, true), distance = input_of(&p, false);
        compute(&window, &settings, by_window);
        compute(&distance, &settings, by_distance);
        double sum = 0.0, darkest = 1.0;
        for (int i = 0; i < COUNT; ++i) {
            sum += fabs((double)by_window[i] - (double)by_distance[i]);
            darkest = fmin(darkest, (double)by_distance[i]);
        }
        assert_true(sum / COUNT < 1e-3);
        assert_true(darkest < 0.75); /* it is not open everywhere */
    }
}

TEST_GL(test_plane_and_sky_are_open)
{
    const analytic_shape floor = {ANALYTIC_PLANE, {0.0, -1.5, 0.0}, {0.0, 1.0, 0.0}};
    SCOPED(picture) picture p = make_picture(&floor, 1, PERSPECTIVE); /* the upper half is sky: infinite */
    SCOPED(memory) float *out = malloc(COUNT * sizeof *out);
    occlude_input input = input_of(&p, false);
    const glssao_settings settings = settings_of(1.0f);
    for (int with_holes = 0; with_holes < 2; ++with_holes) {
        input.normals = with_holes ? p.normals : NULL; /* beside a hole, those at the horizon can't be rebuilt */
        compute(&input, &settings, out);
        for (int i = 0; i < COUNT; ++i)
            assert_true(fabs((double)out[i] - 1.0) <= 2.0 * R16_STEP);
        for (int i = 0; i < COUNT; i += 7)
            p.distance[i] = i % 2 ? NAN : 0.0f; /* no surface either way */
    }
}

/* Floor and wall far larger than the radius: half of the directions over the floor's point in the corner are blocked.
 */
TEST_GL(test_corner_agrees_with_traced_rays)
{
    const analytic_shape corner[] = {{ANALYTIC_PLANE, {0.0, -1.5, 0.0}, {0.0, 1.0, 0.0}},
                                     {ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, 0.0, 1.0}}};
    SCOPED(picture) picture p = make_picture(corner, 2, PERSPECTIVE);
    SCOPED(memory) float *out = malloc(COUNT * sizeof *out);
    const occlude_input input = input_of(&p, false);
    const double radius = 2.0;
    const glssao_settings settings = settings_of((float)radius);
    compute(&input, &settings, out);
    int compared = 0;
    for (int y = 0; y < HEIGHT; ++y) {
        const size_t at = (size_t)y * WIDTH + WIDTH / 2;
        if (p.normals[3 * at + 1] < 0.5f || p.distance[at] > 5.5f) /* the floor, two pixels off the edge */
            continue;
        const double point[3] = {0.0, -1.5, -(double)p.distance[at]}, normal[3] = {0.0, 1.0, 0.0};
        const double wanted = analytic_accessibility(corner, 2, point, normal, radius, 4096);
        assert_true(fabs((double)out[at] - wanted) < 0.025);
        ++compared;
    }
    assert_true(compared > 10);
}

TEST_GL(test_any_size_and_any_quality)
{
    static const int sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {2, 3}, {33, 17}};
    float depth[33 * 17], out[33 * 17];
    for (int i = 0; i < 33 * 17; ++i)
        depth[i] = 4.0f;
    SCOPED(picture) picture p = make_picture(NULL, 0, PERSPECTIVE);
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s)
        for (int technique = GLSSAO_CLASSIC; technique <= GLSSAO_HORIZON; ++technique)
            for (int radius = 0; radius < 2; ++radius) {
                occlude_input input = input_of(&p, false);
                input.width = sizes[s][0];
                input.height = sizes[s][1];
                input.depth = depth;
                input.normals = NULL;
                glssao_settings settings = glssao_default_settings((glssao_technique)technique, GLSSAO_LOW);
                settings.radius = (float)radius; /* 0: nothing is computed */
                memset(out, 0, sizeof out);
                compute(&input, &settings, out);
                for (int i = 0; i < input.width * input.height; ++i)
                    assert_true(out[i] >= 0.99f && out[i] <= 1.0f);
            }
}

TEST_GL(test_hostile_normals_give_finite_results)
{
    SCOPED(picture) picture p = make_picture(analytic_unit_room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
    static const float hostile[] = {NAN, INFINITY, -INFINITY, 0.0f, 1e30f, -1e-30f};
    for (int i = 0; i < 3 * COUNT; ++i)
        p.normals[i] = hostile[(i + i / 7) % 6];
    SCOPED(memory) float *out = malloc(COUNT * sizeof *out);
    const occlude_input input = input_of(&p, false);
    const glssao_settings settings = settings_of(1.0f);
    compute(&input, &settings, out);
    for (int i = 0; i < COUNT; ++i)
        assert_true(out[i] >= 0.0f && out[i] <= 1.0f);
}

TEST_GL(test_more_estimates_bring_less_noise)
{
    SCOPED(picture) picture p = make_picture(analytic_unit_room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
    glssao_settings settings = settings_of(1.0f);
    settings.blur = GLSSAO_BLUR_NONE;
    settings.sample_count = 12;
    static const int counts[] = {512, 1, 16, 64};
    float *out[4];
    double errors[4];
    for (int i = 0; i < 4; ++i) {
        occlude_input input = input_of(&p, false);
        input.estimates = counts[i];
        out[i] = malloc(COUNT * sizeof *out[i]);
        compute(&input, &settings, out[i]);
        double sum = 0.0;
        for (int k = 0; k < COUNT; ++k)
            sum += pow((double)out[i][k] - (double)out[0][k], 2.0);
        errors[i] = sqrt(sum / COUNT);
    }
    assert_true(errors[2] < 0.4 * errors[1] && errors[3] < 0.6 * errors[2]);
    for (int i = 0; i < 4; ++i)
        free(out[i]);
}

/* A bound on the error ends the estimates early: the result is that of as many estimates as it took. */
TEST_GL(test_error_ends_the_estimates)
{
    SCOPED(picture) picture p = make_picture(analytic_unit_room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
    const glssao_settings settings = settings_of(1.0f);
    static const struct {
        int estimates;
        float error;
    } cases[] = {{64, 0.0f}, {64, 1e-9f}, {64, 1.0f}, {2, 0.0f}};
    float *out[4];
    for (int i = 0; i < 4; ++i) {
        occlude_input input = input_of(&p, false);
        input.estimates = cases[i].estimates;
        input.error = cases[i].error;
        out[i] = malloc(COUNT * sizeof *out[i]);
        compute(&input, &settings, out[i]);
    }
    assert_memory_equal(out[0], out[1], COUNT * sizeof *out[0]); /* out of reach */
    assert_memory_equal(out[2], out[3], COUNT * sizeof *out[0]); /* reached as soon as it is known, after the second */
    assert_memory_not_equal(out[0], out[2], COUNT * sizeof *out[0]);
    for (int i = 0; i < 4; ++i)
        free(out[i]);
}

TEST_MAIN(NULL, occlude_setup, occlude_teardown)
