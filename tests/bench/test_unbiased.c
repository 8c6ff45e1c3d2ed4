/* SPDX-License-Identifier: MIT
 *
 * The ray tracer and glssao_accumulate estimate a defined integral without bias, and a bias of 1 % would be noticed.
 * All seeds are fixed.
 */
#include "significance.h"

#include "fixture.h"
#include "small_scene.h"
#include "trace_shot.h"

enum { WIDTH = 48, HEIGHT = 32, PIXELS = WIDTH * HEIGHT };
static const double alpha = 0.01; /* of a false alarm */

static double sums[4][PIXELS];

static sample_set begin(int which, size_t pixels)
{
    memset(sums[2 * which], 0, sizeof sums[0]);
    memset(sums[2 * which + 1], 0, sizeof sums[0]);
    return sample_set_begin(pixels, sums[2 * which], sums[2 * which + 1]);
}

TEST(students_distribution_is_known)
{
    /* t(1) is Cauchy's, t(2) has a closed form; the last is the table value of 97.5 % at 10. */
    assert_true(fabs(student_p(1, 1) - 0.5) < 1e-6);
    assert_true(fabs(student_p(2, 2) - (1 - 2 / sqrt(6))) < 1e-6);
    assert_true(fabs(student_p(-2.228139, 10) - 0.05) < 1e-6);
}

/* Points of a floor at growing distances from a wall, whose edge is too far to be seen. A ray of a cosine-weighted
 * hemisphere ends evenly over the unit disc when it is projected along the normal; the wall blocks the part of the disc
 * beyond distance / radius. Under a ceiling, the part within sqrt(1 - (height / radius)^2) is blocked. */
TEST(tracer_is_unbiased)
{
    enum { SEEDS = 32, RAYS = 2048 };
    const float radius = 2;
    small_scene *s = small_scene_create();
    small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
    small_scene_add_quad(s, (float[3]){0, 0, -50}, (float[3]){0, 50, 0}, (float[3]){0, 0, 100});
    small_scene_add_quad(s, (float[3]){100, 1.5f, -50}, (float[3]){50, 0, 0}, (float[3]){0, 0, 100});
    small_scene_add_instance(s, NULL);
    trace_scene *t = trace_shot_open(&s->scene);
    static float positions[PIXELS][3], normals[PIXELS][3], picture[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        const bool wall = i % 2 == 0;
        const double part = (i + 0.5) / PIXELS, h = 1.5 / (double)radius;
        positions[i][0] = wall ? (float)part * radius : 125;
        positions[i][1] = 0;
        positions[i][2] = (float)(i % 17) * 0.3f;
        normals[i][1] = 1;
        const double segment = (acos(part) - part * sqrt(1 - part * part)) / 3.14159265358979323846;
        picture[i] = (float)(wall ? 1 - segment : h * h);
    }
    sample_set exact = begin(0, PIXELS), traced = begin(1, PIXELS);
    sample_set_add(&exact, picture);
    for (int seed = 0; seed < SEEDS; seed++) {
        char error[256] = "";
        const trace_options options = {.radius = radius, .samples = RAYS, .seed = (uint32_t)seed};
        assert_true(trace_points(t, (const float(*)[3])positions, (const float(*)[3])normals, PIXELS, TRACE_COSINE, 0,
                                 &options, picture, NULL, FAULT(error)));
        sample_set_add(&traced, picture);
    }
    trace_scene_destroy(t);
    free(s);
    const double step = 1e-5; /* single precision of the positions */
    const double right = significance(&traced, 1, &exact, step);
    const double high = significance(&traced, 1.01, &exact, step), low = significance(&traced, 0.99, &exact, step);
    print_message("tracer: p = %.3g; with a bias of +1 %%: %.3g, of -1 %%: %.3g\n", right, high, low);
    assert_true(right > alpha);
    assert_true(high < alpha && low < alpha);
}

static void accumulate(fixture *f, const glssao_frame *frame, sample_set *out, int seeds, uint32_t first, int estimates)
{
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.blur = GLSSAO_BLUR_NONE; /* it smooths the mean of few estimates */
    for (int seed = 0; seed < seeds; seed++) {
        glssao_config config = fixture_config(f, WIDTH, HEIGHT);
        glssao_effect *effect;
        int w, h;
        config.seed = first + (uint32_t)seed;
        assert_int_equal(glssao_create(&config, &effect), GLSSAO_OK);
        for (int i = 0; i < estimates; i++)
            assert_int_equal(glssao_accumulate(effect, frame, &settings), GLSSAO_OK);
        float *picture = fixture_read_texture(glssao_map(effect, GLSSAO_MAP_AMBIENT, &w, &h), WIDTH, HEIGHT, 1);
        sample_set_add(out, picture);
        free(picture);
        glssao_destroy(effect);
    }
}

/* The mean of few estimates and the mean of many have the same expectation. */
TEST_GL(accumulation_is_unbiased)
{
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, 1);
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)WIDTH / HEIGHT, 0.5, 40, 1);
    const glssao_frame frame = fixture_frame(&view, room, ANALYTIC_ROOM_SHAPES, WIDTH, HEIGHT);
    sample_set reference = begin(0, PIXELS), few = begin(1, PIXELS);
    accumulate(f, &frame, &reference, 16, 1000, 256);
    accumulate(f, &frame, &few, 32, 0, 16);
    fixture_delete_frame(&frame);
    const double step = 1.0 / 65535; /* of R16 */
    const double right = significance(&few, 1, &reference, step);
    const double high = significance(&few, 1.01, &reference, step), low = significance(&few, 0.99, &reference, step);
    print_message("glssao_accumulate: p = %.3g; with a bias of +1 %%: %.3g, of -1 %%: %.3g\n", right, high, low);
    assert_true(right > alpha);
    assert_true(high < alpha && low < alpha);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
