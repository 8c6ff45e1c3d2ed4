/* SPDX-License-Identifier: MIT
 *
 * Arrays in, an array out: the result is the effect's own, agrees with closed forms, and wrong input gives one line.
 */
#include "analytic.h"
#include "fixture.h"
#include "occlude.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 64, COUNT = WIDTH * HEIGHT };
static const double R16_STEP = 1.0 / 65535.0;

static occlude *shared; /* opened once: its shaders compile once */
static char error[512];

static void turn_over(float *values, int width, int height, int channels)
{
    const size_t row = (size_t)width * (size_t)channels;
    for (int y = 0; y < height / 2; ++y)
        for (size_t x = 0; x < row; ++x) {
            float *a = values + (size_t)y * row + x, *b = values + (size_t)(height - 1 - y) * row + x;
            const float kept = *a;
            *a = *b;
            *b = kept;
        }
}

/* Shapes as a caller would hand them over; free_picture frees the arrays. */
typedef struct picture {
    analytic_view view;
    float *window_depth, *distance, *normals; /* rows from the top */
} picture;

static picture make_picture(const analytic_shape *shapes, int count, analytic_projection projection)
{
    picture p = {.view = analytic_make_view(projection, (double)WIDTH / HEIGHT, 0.5, 40.0, 1.0)};
    analytic_render_distance(&p.view, shapes, count, WIDTH, HEIGHT, &p.window_depth, &p.normals, &p.distance);
    turn_over(p.window_depth, WIDTH, HEIGHT, 1);
    turn_over(p.distance, WIDTH, HEIGHT, 1);
    turn_over(p.normals, WIDTH, HEIGHT, 3);
    return p;
}

static void free_picture(picture *p)
{
    free(p->window_depth);
    free(p->distance);
    free(p->normals);
}

static occlude_input input_of(const picture *p, bool window_depth)
{
    occlude_input input = {.width = WIDTH,
                           .height = HEIGHT,
                           .depth = window_depth ? p->window_depth : p->distance,
                           .normals = p->normals,
                           .window_depth = window_depth,
                           .clip_zero_to_one = p->view.clip_zero_to_one};
    memcpy(input.projection, p->view.projection, sizeof input.projection);
    return input;
}

static glssao_settings settings_of(float radius)
{
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_ULTRA);
    settings.radius = radius;
    return settings;
}

static void compute(const occlude_input *input, const glssao_settings *settings, float *out)
{
    if (!occlude_compute(shared, input, settings, out, error, sizeof error))
        fail_msg("%s", error);
}

/* Refused with exactly this line, and the result is not written to. */
static void refuse(const occlude_input *input, const glssao_settings *settings, const char *line)
{
    float *out =
        calloc((size_t)(input->width > 0 && input->height > 0 ? input->width * input->height : 1), sizeof *out);
    error[0] = '\0';
    assert_false(occlude_compute(shared, input, settings, out, error, sizeof error));
    assert_string_equal(error, line);
    assert_true(out[0] == 0.0f);
    free(out);
}

static void test_result_is_the_effects_own(void **state)
{
    fixture *f = *state;
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, 1.0);
    picture p = make_picture(room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
    const glssao_settings settings = settings_of(1.0f);
    float *got = malloc(COUNT * sizeof *got);
    const occlude_input input = input_of(&p, true);
    compute(&input, &settings, got);

    glssao_frame frame = fixture_frame(&p.view, room, ANALYTIC_ROOM_SHAPES, WIDTH, HEIGHT);
    glssao_effect *effect = fixture_shared_effect(f, WIDTH, HEIGHT);
    int width, height;
    float *wanted = fixture_compute(effect, &frame, &settings, &width, &height);
    turn_over(wanted, WIDTH, HEIGHT, 1);
    assert_memory_equal(got, wanted, COUNT * sizeof *got);

    fixture_delete_frame(&frame);
    free(wanted);
    free(got);
    free_picture(&p);
}

static void test_view_distance_and_window_depth_agree(void **state)
{
    (void)state;
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, 1.0);
    const glssao_settings settings = settings_of(1.0f);
    float *by_window = malloc(COUNT * sizeof *by_window), *by_distance = malloc(COUNT * sizeof *by_distance);
    for (int projection = 0; projection < PROJECTION_COUNT; ++projection) {
        picture p = make_picture(room, ANALYTIC_ROOM_SHAPES, (analytic_projection)projection);
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
        free_picture(&p);
    }
    free(by_distance);
    free(by_window);
}

static void test_plane_and_sky_are_open(void **state)
{
    (void)state;
    const analytic_shape floor = {ANALYTIC_PLANE, {0.0, -1.5, 0.0}, {0.0, 1.0, 0.0}};
    picture p = make_picture(&floor, 1, PERSPECTIVE); /* the upper half is sky: infinite */
    float *out = malloc(COUNT * sizeof *out);
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
    free(out);
    free_picture(&p);
}

/* Floor and wall far larger than the radius: half of the directions over the floor's point in the corner are blocked.
 */
static void test_corner_agrees_with_traced_rays(void **state)
{
    (void)state;
    const analytic_shape corner[] = {{ANALYTIC_PLANE, {0.0, -1.5, 0.0}, {0.0, 1.0, 0.0}},
                                     {ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, 0.0, 1.0}}};
    picture p = make_picture(corner, 2, PERSPECTIVE);
    float *out = malloc(COUNT * sizeof *out);
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
    free(out);
    free_picture(&p);
}

/* A cliff in a height map, of height 6. Far more of it than the radius is in the picture. */
static double worst_at_cliff(float radius, bool solid, float out[COUNT])
{
    const float spacing = 0.5f, cliff = 6.0f;
    float heights[COUNT], depth[COUNT];
    for (int i = 0; i < COUNT; ++i)
        heights[i] = 800.0f + (i % WIDTH < WIDTH / 2 ? cliff : 0.0f);
    occlude_input input = {.width = WIDTH, .height = HEIGHT, .depth = depth, .estimates = 64, .solid = solid};
    assert_true(occlude_look_down(heights, WIDTH, HEIGHT, spacing, depth, input.projection, error, sizeof error));
    const glssao_settings settings = settings_of(radius);
    compute(&input, &settings, out);
    const analytic_shape block = {ANALYTIC_BOX, {-100.0, 0.0, 3.0}, {100.0, 100.0, 3.0}};
    double worst = 0.0;
    for (int x = WIDTH / 2; x < WIDTH; ++x) {
        const double foot[3] = {(x + 0.5 - WIDTH / 2.0) * (double)spacing, 0.0, 0.0}, up[3] = {0.0, 0.0, 1.0};
        const double wanted = analytic_accessibility(&block, 1, foot, up, (double)radius, 4096);
        worst = fmax(worst, fabs((double)out[HEIGHT / 2 * WIDTH + x] - wanted));
    }
    return worst;
}

static void test_cliff_of_a_height_map_agrees_with_traced_rays(void **state)
{
    (void)state;
    float out[COUNT];
    assert_true(worst_at_cliff(6.0f, false, out) > 0.04); /* a slab of guessed thickness lets light through below */
    assert_true(worst_at_cliff(6.0f, true, out) < 0.025);
    for (int x = 0; x < WIDTH / 2 - 1; ++x)
        assert_true(out[HEIGHT / 2 * WIDTH + x] > 0.995f); /* the top */

    /* Near the foot of a cliff of height h the radius cuts nothing off, and the form factor of an endless strip holds:
     * (1 - d / sqrt(d^2 + h^2)) / 2 of the directions are blocked at distance d, weighted by their cosine. */
    assert_true(worst_at_cliff(12.0f, true, out) < 0.03);
    for (int x = WIDTH / 2; x < WIDTH / 2 + 4; ++x) {
        const double d = (x + 0.5 - WIDTH / 2.0) * 0.5;
        const double wanted = 1.0 - 0.5 * (1.0 - d / sqrt(d * d + 36.0));
        assert_true(fabs((double)out[HEIGHT / 2 * WIDTH + x] - wanted) < 0.03);
    }
}

static void test_holes_and_flat_height_maps(void **state)
{
    (void)state;
    float heights[] = {NAN, 7.0f, INFINITY, 7.0f}, depth[4], out[4];
    occlude_input input = {.width = 2, .height = 2, .depth = depth};
    assert_true(occlude_look_down(heights, 2, 2, 0.25f, depth, input.projection, error, sizeof error));
    const float wanted[] = {0.0f, 0.25f, 0.0f, 0.25f};
    assert_memory_equal(depth, wanted, sizeof wanted);
    const glssao_settings settings = settings_of(1.0f);
    compute(&input, &settings, out);
    for (int i = 0; i < 4; ++i)
        assert_true(out[i] > 0.99f);

    heights[1] = heights[3] = -INFINITY;
    assert_false(occlude_look_down(heights, 2, 2, 0.25f, depth, input.projection, error, sizeof error));
    assert_string_equal(error, "no height is a finite number");
    assert_false(occlude_look_down(heights, 2, 2, NAN, depth, input.projection, error, sizeof error));
    assert_string_equal(error, "spacing = nan: want a positive number");
    assert_false(occlude_look_down(heights, 0, 2, 1.0f, depth, input.projection, error, sizeof error));
    assert_string_equal(error, "the height map is 0 x 2: want 1 x 1 or more");
}

static void test_any_size_and_any_quality(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {2, 3}, {33, 17}};
    float depth[33 * 17], out[33 * 17];
    for (int i = 0; i < 33 * 17; ++i)
        depth[i] = 4.0f;
    picture p = make_picture(NULL, 0, PERSPECTIVE);
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
    free_picture(&p);
}

static void test_hostile_normals_give_finite_results(void **state)
{
    (void)state;
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, 1.0);
    picture p = make_picture(room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
    static const float hostile[] = {NAN, INFINITY, -INFINITY, 0.0f, 1e30f, -1e-30f};
    for (int i = 0; i < 3 * COUNT; ++i)
        p.normals[i] = hostile[(i + i / 7) % 6];
    float *out = malloc(COUNT * sizeof *out);
    const occlude_input input = input_of(&p, false);
    const glssao_settings settings = settings_of(1.0f);
    compute(&input, &settings, out);
    for (int i = 0; i < COUNT; ++i)
        assert_true(out[i] >= 0.0f && out[i] <= 1.0f);
    free(out);
    free_picture(&p);
}

static void test_wrong_input_gives_one_line(void **state)
{
    (void)state;
    picture p = make_picture(NULL, 0, PERSPECTIVE);
    const glssao_settings settings = settings_of(1.0f);
    const occlude_input good = input_of(&p, false);
    occlude_input input = good;
    p.distance[5 * WIDTH + 3] = -2.0f;
    refuse(&input, &settings, "depth[5, 3] = -2: view distance is positive; no surface is 0, infinity or NaN");
    p.distance[5 * WIDTH + 3] = -INFINITY;
    refuse(&input, &settings, "depth[5, 3] = -inf: view distance is positive; no surface is 0, infinity or NaN");
    p.distance[5 * WIDTH + 3] = 2.0f;
    input = input_of(&p, true);
    p.window_depth[WIDTH] = 1.5f;
    refuse(&input, &settings, "depth[1, 0] = 1.5: window depth is 0 to 1");
    p.window_depth[WIDTH] = NAN;
    refuse(&input, &settings, "depth[1, 0] = nan: window depth is 0 to 1");
    input = good;
    input.depth = NULL;
    refuse(&input, &settings, "input.depth is NULL");
    input = good;
    input.width = -3;
    refuse(&input, &settings, "the depth map is -3 x 64 pixels: want 1 x 1 or more");
    input = input_of(&p, true);
    input.solid = true;
    p.window_depth[WIDTH] = 1.0f;
    refuse(&input, &settings, "input.solid needs view distance, not window depth");
    input = good;
    input.estimates = -1;
    refuse(&input, &settings, "estimates = -1: want 0 to 65536");
    input = good;
    input.projection[5] = NAN;
    refuse(&input, &settings, "frame.projection[5] = nan: not finite");
    glssao_settings wrong = settings;
    wrong.radius = -1.0f;
    refuse(&good, &wrong, "settings.radius = -1: want 0 to 1e+12");
    refuse(&good, NULL, "settings is NULL");

    float *out = malloc(COUNT * sizeof *out);
    compute(&good, &settings, out); /* all of that left it usable */
    free(out);
    free_picture(&p);
}

static void test_more_estimates_bring_less_noise(void **state)
{
    (void)state;
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, 1.0);
    picture p = make_picture(room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
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
    free_picture(&p);
}

typedef struct caller {
    pthread_t thread;
    occlude *occlude;
    const occlude_input *input;
    const glssao_settings *settings;
    float *out;
    bool ok;
} caller;

static void *call(void *argument)
{
    caller *c = argument;
    char own_error[512] = "";
    occlude *o = c->occlude ? c->occlude : occlude_create(0, own_error, sizeof own_error);
    c->ok = o != NULL;
    for (int i = 0; i < 3 && c->ok; ++i)
        c->ok = occlude_compute(o, c->input, c->settings, c->out, own_error, sizeof own_error);
    if (!c->ok)
        fprintf(stderr, "%s\n", own_error);
    if (!c->occlude)
        occlude_destroy(o);
    return NULL;
}

static void test_threads_get_the_same_bits(void **state)
{
    (void)state;
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, 1.0);
    picture p = make_picture(room, ANALYTIC_ROOM_SHAPES, PERSPECTIVE);
    const occlude_input input = input_of(&p, false);
    const glssao_settings settings = settings_of(1.0f);
    float *wanted = malloc(COUNT * sizeof *wanted);
    compute(&input, &settings, wanted);
    caller callers[4];
    for (int i = 0; i < 4; ++i) { /* two share a context, two have one each */
        callers[i] = (caller){.occlude = i < 2 ? shared : NULL,
                              .input = &input,
                              .settings = &settings,
                              .out = malloc(COUNT * sizeof(float))};
        assert_int_equal(pthread_create(&callers[i].thread, NULL, call, &callers[i]), 0);
    }
    for (int i = 0; i < 4; ++i) {
        pthread_join(callers[i].thread, NULL);
        assert_true(callers[i].ok);
        assert_memory_equal(callers[i].out, wanted, COUNT * sizeof *wanted);
        free(callers[i].out);
    }
    free(wanted);
    free_picture(&p);
}

static void test_callers_context_stays_as_it_is(void **state)
{
    (void)state;
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    picture p = make_picture(NULL, 0, PERSPECTIVE);
    const occlude_input input = input_of(&p, false);
    const glssao_settings settings = settings_of(1.0f);
    float *out = malloc(COUNT * sizeof *out);
    compute(&input, &settings, out);
    GLint bound = 0;
    gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    assert_int_equal(bound, texture);
    gl.DeleteTextures(1, &texture);
    free(out);
    free_picture(&p);
}

static int setup(void **state)
{
    shared = occlude_create(0, error, sizeof error);
    if (!shared)
        fprintf(stderr, "%s\n", error);
    return shared ? fixture_setup(state) : 1;
}

static int teardown(void **state)
{
    occlude_destroy(shared);
    occlude_destroy(NULL);
    return fixture_teardown(state);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, fixture_no_gl_error)
    const struct CMUnitTest tests[] = {
        TEST(test_result_is_the_effects_own),
        TEST(test_view_distance_and_window_depth_agree),
        TEST(test_plane_and_sky_are_open),
        TEST(test_corner_agrees_with_traced_rays),
        TEST(test_cliff_of_a_height_map_agrees_with_traced_rays),
        TEST(test_holes_and_flat_height_maps),
        TEST(test_any_size_and_any_quality),
        TEST(test_hostile_normals_give_finite_results),
        TEST(test_wrong_input_gives_one_line),
        TEST(test_more_estimates_bring_less_noise),
        TEST(test_threads_get_the_same_bits),
        TEST(test_callers_context_stays_as_it_is),
    };
#undef TEST
    return cmocka_run_group_tests(tests, setup, teardown);
}
