/* SPDX-License-Identifier: MIT
 *
 * The benchmark's measures on constructed pictures whose right value is known in closed form.
 */
#include "filter.h"
#include "measure.h"
#include "perception.h"
#include "sequence.h"
#include "structure.h"
#include "testing.h"

enum { WIDTH = 64, HEIGHT = 48, COUNT = WIDTH * HEIGHT };
static const double pi = 3.14159265358979323846;

static float picture[COUNT], truth[COUNT];
static uint8_t classes[COUNT];

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.9g, expected %.9g within %g", value, expected, tolerance);
}

static void fill(float *out, float value)
{
    for (int i = 0; i < COUNT; i++)
        out[i] = value;
}

static int reset(void **state)
{
    (void)state;
    fill(picture, 0.5f);
    fill(truth, 0.5f);
    memset(classes, PIXEL_SMOOTH, sizeof classes);
    return 0;
}

static double ssim(void)
{
    perception p;
    assert_true(perception_create(&p, truth, classes, WIDTH, HEIGHT));
    const double value = perception_ssim(&p, picture);
    perception_destroy(&p);
    return value;
}

static double flip(void)
{
    perception p;
    assert_true(perception_create(&p, truth, classes, WIDTH, HEIGHT));
    const double value = perception_flip(&p, picture);
    perception_destroy(&p);
    return value;
}

static double grain(void)
{
    grain_places g;
    assert_true(grain_create(&g, truth, classes, WIDTH, HEIGHT));
    const double value = grain_measure(&g, picture);
    grain_destroy(&g);
    return value;
}

TEST_WITH(filters_see_zeros_or_the_nearest_pixel_outside, reset)
{
    static float out[COUNT], scratch[COUNT];
    const kernel box = {.radius = 1, .taps = {1.0f / 3, 1.0f / 3, 1.0f / 3}};
    fill(picture, 1);
    filter_picture(picture, WIDTH, HEIGHT, &box, &box, FILTER_ZERO, scratch, out);
    assert_near((double)out[0], 4.0 / 9, 1e-6);
    assert_near((double)out[WIDTH - 2], 6.0 / 9, 1e-6);
    assert_near((double)out[WIDTH], 6.0 / 9, 1e-6);
    assert_near((double)out[WIDTH + 1], 1, 1e-6);
    assert_near((double)out[COUNT - 1], 4.0 / 9, 1e-6);
    filter_picture(picture, WIDTH, HEIGHT, &box, &box, FILTER_REPLICATE, scratch, out);
    for (int i = 0; i < COUNT; i++)
        assert_near((double)out[i], 1, 1e-6);
}

/* 3 % of the pixels are off by 0.25, the others by -0.0625. */
TEST_WITH(error_figures_follow_from_their_definitions, reset)
{
    const double far_share = 0.03;
    const int far_count = (int)(far_share * COUNT);
    for (int i = 0; i < COUNT; i++) {
        picture[i] += i < far_count ? 0.25f : -0.0625f;
        classes[i] = i % 2 ? PIXEL_SMOOTH : PIXEL_EDGE;
    }
    const error_measure m = measure_error(picture, truth, classes, COUNT);
    const double share = (double)far_count / COUNT, square = share * 0.0625 + (1 - share) * 0.00390625;
    assert_near(m.rmse, sqrt(square), 1e-9);
    assert_near(m.mean, share * 0.25 - (1 - share) * 0.0625, 1e-9);
    assert_near(m.p95, 0.0625, 1.0 / MEASURE_BINS);
    assert_near(m.p99, 0.25, 1.0 / MEASURE_BINS);
    assert_near(m.off_share, share, 1e-12);
    assert_near(m.smooth_rmse, sqrt(square), 1e-9);
    assert_near(m.edge_rmse, sqrt(square), 1e-9);
    assert_near(m.nonfinite_share, 0, 0);
}

TEST_WITH(nonfinite_pixels_are_counted_and_left_out, reset)
{
    picture[0] = NAN;
    picture[1] = INFINITY;
    classes[2] = PIXEL_NONE;
    picture[2] = NAN;
    const error_measure m = measure_error(picture, truth, classes, COUNT);
    assert_near(m.nonfinite_share, 2.0 / (COUNT - 1), 1e-12);
    assert_near(m.rmse, 0, 0);
}

TEST_WITH(best_exponent_is_found, reset)
{
    static fit_sum f;
    memset(&f, 0, sizeof f);
    for (int i = 0; i < COUNT; i++) {
        picture[i] = (float)(i % 500 + 250) / 1000;
        truth[i] = powf(picture[i], 1.7f);
    }
    fit_add(&f, picture, truth, classes, COUNT);
    assert_near(fit_exponent(&f), 1.7, 2e-3);
    assert_near(fit_rmse(&f, 1.7), 0, 1e-3);
}

TEST_WITH(ssim_of_constants_is_the_luminance_term, reset)
{
    fill(picture, 0.25f);
    fill(truth, 0.75f);
    assert_near(ssim(), (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-5);
}

/* A window sees as many dark as bright pixels, so means agree and variances are the amplitudes' squares; windows cut
 * off by the picture's border see nearly as many. */
TEST_WITH(ssim_of_checkerboards_is_the_contrast_term, reset)
{
    for (int i = 0; i < COUNT; i++) {
        const float sign = (i % WIDTH + i / WIDTH) % 2 ? 1 : -1;
        picture[i] += 0.1f * sign;
        truth[i] += 0.4f * sign;
    }
    assert_near(ssim(), (2 * 0.1 * 0.4 + 9e-4) / (0.01 + 0.16 + 9e-4), 0.01);
}

TEST_WITH(pixels_without_a_surface_do_not_count, reset)
{
    fill(picture, 0.25f);
    fill(truth, 0.75f);
    const double ssim_before = ssim(), flip_before = flip();
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < 10; x++) {
            classes[y * WIDTH + x] = PIXEL_NONE;
            picture[y * WIDTH + x] = NAN;
            truth[y * WIDTH + x] = 0;
        }
    assert_near(ssim(), ssim_before, 1e-6);
    assert_near(flip(), flip_before, 0.02); /* the eye's filter brings in a little of the background */
}

TEST_WITH(equal_pictures_have_no_difference, reset)
{
    for (int i = 0; i < COUNT; i++)
        picture[i] = truth[i] = (float)(i % 100) / 100;
    assert_near(ssim(), 1, 1e-9);
    assert_near(flip(), 0, 1e-9);
}

/* The values come from an implementation of the paper in NumPy that was written apart from this one, with all three
 * channels, without separating the filters, and in double precision: the square root of an edge that is 0 shows single
 * precision's rounding in evenly coloured pictures. */
TEST_WITH(flip_agrees_with_an_independent_implementation, reset)
{
    for (int i = 0; i < COUNT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        truth[i] = (float)(0.5 + 0.4 * sin(x / 5.0) * cos(y / 7.0));
        picture[i] = (float)(0.9 * (double)truth[i] + 0.05 * ((x * 7 + y * 13) % 11) / 11);
    }
    assert_near(flip(), 0.1103675, 1e-5);
    for (int i = 0; i < COUNT; i++) {
        truth[i] = 0.55f;
        picture[i] = i % WIDTH < WIDTH / 2 ? 0.2f : 0.9f;
    }
    assert_near(flip(), 0.5402078, 1e-4);
    fill(truth, 0.25f);
    fill(picture, 0.75f);
    assert_near(flip(), 0.6554991, 1e-4);
    fill(truth, 1);
    fill(picture, 0);
    assert_near(flip(), 0.9673798, 1e-4);
    fill(picture, 1);
    picture[24 * WIDTH + 32] = 0;
    assert_near(flip(), 0.0009761, 1e-5);
}

/* A wave of amplitude a has the standard deviation a / sqrt(2); the blur that is taken off keeps
 * exp(-2 pi^2 sigma^2 / wavelength^2) of it, which is a half at 8 pixels. */
TEST_WITH(grain_of_a_wave_follows_the_filter, reset)
{
    static const struct {
        double wavelength, left;
    } waves[] = {{3, 0.9928}, {8, 0.5}, {32, 0.0424}};
    for (size_t k = 0; k < sizeof waves / sizeof waves[0]; k++) {
        for (int i = 0; i < COUNT; i++)
            picture[i] = (float)(0.5 + 0.2 * cos(2 * pi * (i % WIDTH) / waves[k].wavelength));
        assert_near(grain(), 0.2 / sqrt(2) * waves[k].left, 0.003);
    }
}

TEST_WITH(a_slope_has_no_grain, reset)
{
    for (int i = 0; i < COUNT; i++)
        picture[i] = truth[i] = 0.2f + 0.009f * (float)(i % WIDTH);
    assert_near(grain(), 0, 1e-5);
}

TEST_WITH(grain_is_not_looked_for_near_edges_or_where_truth_is_steep, reset)
{
    for (int i = 0; i < COUNT; i++)
        picture[i] = i % 2 ? 0.4f : 0.6f;
    assert_near(grain(), 0.1, 0.002);
    memset(classes, PIXEL_EDGE, sizeof classes);
    assert_near(grain(), 0, 0);
    memset(classes, PIXEL_SMOOTH, sizeof classes);
    for (int i = 0; i < COUNT; i++)
        truth[i] = 0.02f * (float)(i / WIDTH);
    assert_near(grain(), 0, 0);
}

TEST_WITH(specks_are_what_the_truth_around_does_not_explain, reset)
{
    enum { AT = 20 * WIDTH + 30 };
    fill(truth, 0.9f);
    fill(picture, 0.9f);
    picture[AT] = 0.41f;
    assert_int_equal(count_specks(picture, truth, classes, WIDTH, HEIGHT), 0);
    picture[AT] = 0.39f;
    assert_int_equal(count_specks(picture, truth, classes, WIDTH, HEIGHT), 1);
    truth[AT + WIDTH + 1] = 0.7f;
    assert_int_equal(count_specks(picture, truth, classes, WIDTH, HEIGHT), 0);
    classes[AT + WIDTH + 1] = PIXEL_NONE; /* a place without a surface explains nothing */
    assert_int_equal(count_specks(picture, truth, classes, WIDTH, HEIGHT), 1);
    picture[0] = picture[COUNT - 1] = 0;
    assert_int_equal(count_specks(picture, truth, classes, WIDTH, HEIGHT), 3);
}

/* A camera that looks at a wall 4 away and moves by `pixels` of its picture. */
static sequence_frame wall_frame(double pixels, const float *distance, const float *result)
{
    sequence_frame f = {.view = {.width = WIDTH, .height = HEIGHT}, .distance = distance, .result = result};
    for (int i = 0; i < 16; i += 5)
        f.view.view_from_world[i] = 1;
    f.view.view_from_world[12] = -(float)(pixels * 4 * 2 / WIDTH);
    f.view.clip_from_view[0] = 1;
    f.view.clip_from_view[5] = (float)WIDTH / HEIGHT;
    f.view.clip_from_view[10] = f.view.clip_from_view[11] = -1;
    f.view.clip_from_view[14] = -0.2f;
    return f;
}

static double change(double pixels, const float *before, const float *now, double *out_pixels)
{
    static float distance[COUNT];
    fill(distance, 4);
    const sequence_frame a = wall_frame(0, distance, before), b = wall_frame(pixels, distance, now);
    frame_change c = {0, 0};
    sequence_compare(&c, &a, &b);
    *out_pixels = c.pixels;
    return sqrt(c.sum2 / c.pixels);
}

TEST_WITH(a_pattern_that_stays_on_its_surface_does_not_change, reset)
{
    double pixels;
    for (int i = 0; i < COUNT; i++) {
        truth[i] = 0.2f + 0.01f * (float)(i % WIDTH);
        picture[i] = 0.2f + 0.01f * ((float)(i % WIDTH) + 2.5f);
    }
    assert_near(change(2.5, truth, picture, &pixels), 0, 1e-5);
    assert_near(pixels, (WIDTH - 3) * (HEIGHT - 1), WIDTH + HEIGHT); /* what comes into the picture is left out */
}

TEST_WITH(a_pattern_that_stays_on_the_screen_changes, reset)
{
    double pixels;
    for (int i = 0; i < COUNT; i++)
        picture[i] = 0.2f + 0.01f * (float)(i % WIDTH);
    assert_near(change(2.5, picture, picture, &pixels), 0.025, 1e-5);
    for (int i = 0; i < COUNT; i++)
        truth[i] = picture[i] + 0.125f;
    assert_near(change(0, picture, truth, &pixels), 0.125, 1e-5);
}

TEST_WITH(points_that_were_hidden_are_left_out, reset)
{
    static float near_distance[COUNT], distance[COUNT];
    fill(distance, 4);
    fill(near_distance, 4);
    for (int i = 0; i < COUNT; i++) {
        if (i % WIDTH < WIDTH / 2)
            near_distance[i] = 2; /* something stood there in the frame before */
        picture[i] = i % WIDTH < WIDTH / 2 ? 0 : 0.5f;
    }
    const sequence_frame a = wall_frame(0, near_distance, truth), b = wall_frame(0, distance, picture);
    frame_change c = {0, 0};
    sequence_compare(&c, &a, &b);
    assert_near(c.sum2, 0, 1e-12);
    assert_true(c.pixels > 0.4 * COUNT && c.pixels <= 0.5 * COUNT);
}

TEST_MAIN(NULL, reset, NULL)
