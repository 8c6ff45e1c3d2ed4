/* SPDX-License-Identifier: MIT
 *
 * test_case_shading FOLDER: scenes on which the horizon technique once failed, measured against ray-traced truth at
 * each quality level: a wall behind an object, the floor beside a tall block, a bowl, and radii beyond all bounds.
 */
#include "effects.h"
#include "fixture.h"
#include "views.h"

enum { LEVELS = GLSSAO_ULTRA + 1 };

typedef struct shot {
    bench_view view;
    effects effects;
    map_reader reader;
    float *picture;
    int width, height, count;
} shot;

static const char *folder;
static char error[1024];

/* One of the files; `from` NULL frames the scene. */
static shot take(fixture *f, const char *name, const camera *from, float radius, int width, int height, int rays)
{
    shot s = {.width = width, .height = height, .count = width * height};
    s.effects = (effects){.context = f->context, .width = width, .height = height};
    bench_scene b = {.given = from != NULL, .radius = radius};
    if (from)
        b.camera = *from;
    snprintf(b.name, sizeof b.name, "%s", name);
    snprintf(b.path, sizeof b.path, "%s/%s.glb", folder, name);
    const options o = {.size = {width, height}, .rays = rays};
    if (!bench_view_create(&s.view, &b, &o, FAULT(error)) || !map_reader_create(&s.reader, width, height, FAULT(error)))
        fail_msg("%s", error);
    s.picture = malloc((size_t)s.count * sizeof *s.picture);
    assert_non_null(s.picture);
    return s;
}

static void destroy(shot *s)
{
    effects_destroy(&s->effects);
    map_reader_destroy(&s->reader);
    bench_view_destroy(&s->view);
    free(s->picture);
}

/* Accessibility at that level into s->picture. */
static void shade(shot *s, int level, float radius, bool two_layers)
{
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)level);
    const effect_job job = {
        .gbuffer = two_layers ? &s->view.beyond : &s->view.gbuffer, .settings = &settings, .radius = radius};
    if (!effects_run(&s->effects, &s->reader, &job, s->picture, FAULT(error)))
        fail_msg("%s", error);
}

/* The wall is two radii behind everything, so nothing occludes it. */
TEST_GL(a_wall_has_no_aura_of_what_is_in_front)
{
    const float in_front = 4;
    const camera from = {.target = {0, 0, -3}, .up = {0, 1, 0}, .fov_y_rad = 50 * 3.14159265f / 180};
    shot s = take(f, "aura", &from, 0.5f, 960, 540, 1);
    for (int level = 0; level < LEVELS; ++level) {
        float wall = 1, object = 1;
        shade(&s, level, 0.5f, false);
        for (int i = 0; i < s.count; ++i) {
            const bool is_object = s.view.distance[i] < in_front;
            float *least = is_object ? &object : &wall;
            *least = fminf(*least, s.picture[i]);
        }
        print_message("level %d: the wall down to %g, the object to %g\n", level, (double)wall, (double)object);
        assert_true(wall >= 0.97f && object < 0.5f);
    }
    destroy(&s);
}

/* A block two radii high seen straight from above, so that its sides are not in the picture. Its floor had 0.92. */
TEST_GL(the_floor_beside_a_block_is_shaded)
{
    const camera from = {.eye = {0, 20, 0}, .up = {0, 0, -1}, .half_height = 4, .fov_y_rad = 1};
    shot s = take(f, "block-straight-down", &from, 1, 640, 360, 64);
    for (int level = 0; level < LEVELS; ++level) {
        double errors[2]; /* of the whole picture, with one layer and with two */
        for (int layers = 0; layers < 2; ++layers) {
            double shaded = 0, truth = 0, count = 0, sum = 0;
            shade(&s, level, 1, layers);
            for (int i = 0; i < s.count; ++i) {
                const double x = fabs(8 * (i % s.width + 0.5 - s.width / 2.0) / s.height);
                const double y = fabs(8 * (i / s.width + 0.5 - s.height / 2.0) / s.height);
                sum += pow((double)(s.picture[i] - s.view.truth.accessibility[i]), 2);
                if (x < 1.5 || x > 1.75 || y > 1.25)
                    continue;
                shaded += (double)s.picture[i];
                truth += (double)s.view.truth.accessibility[i];
                ++count;
            }
            errors[layers] = sqrt(sum / s.count);
            print_message("level %d, %d layers: %g beside the block, truth %g; RMSE %g\n", level, layers + 1,
                          shaded / count, truth / count, errors[layers]);
            assert_true(fabs(shaded - truth) / count < 0.05);
        }
        assert_true(errors[1] < errors[0] && errors[0] < 0.04);
    }
    destroy(&s);
}

/* Grain is looked for where the truth is smooth and something occludes; a quarter of an 8-bit step is not seen. */
TEST_GL(a_bowl_has_no_grain_and_less_error_with_quality)
{
    double last = 1;
    shot s = take(f, "bowl", NULL, 0, 1280, 720, 32);
    grain_places places;
    for (int i = 0; i < s.count; ++i)
        if (s.view.truth.accessibility[i] > 0.98f)
            s.view.classes[i] = PIXEL_NONE;
    assert_true(grain_create(&places, s.view.truth.accessibility, s.view.classes, s.width, s.height));
    for (int level = 0; level < LEVELS; ++level) {
        shade(&s, level, s.view.radius, false);
        const double grain = grain_measure(&places, s.picture);
        const error_measure e = measure_error(s.picture, s.view.truth.accessibility, s.view.classes, (size_t)s.count);
        print_message("level %d: grain %g, RMSE %g\n", level, grain, e.rmse);
        assert_true(grain > 0 && grain < 0.25 / 255);
        assert_true(e.rmse < last);
        last = e.rmse;
    }
    grain_destroy(&places);
    destroy(&s);
}

/* From 100 to a million times the distance of what is seen: beyond the scene's size nothing changes. */
TEST_GL(a_huge_radius_does_not_brighten)
{
    const float size = 20;
    shot s = take(f, "radius-huge", NULL, size, 320, 180, 64);
    for (int level = 0; level < LEVELS; ++level) {
        double last = 1, reference = 0;
        for (int decade = 1; decade <= 6; ++decade) {
            double mean = 0;
            shade(&s, level, decade == 1 ? size : powf(10, (float)decade) * s.view.median_distance, false);
            for (int i = 0; i < s.count; ++i)
                mean += (double)s.picture[i] / s.count;
            const error_measure e =
                measure_error(s.picture, s.view.truth.accessibility, s.view.classes, (size_t)s.count);
            print_message("level %d, decade %d: mean %g, RMSE %g\n", level, decade, mean, e.rmse);
            reference = decade == 1 ? e.rmse : reference;
            assert_true(e.rmse < 1.05 * reference);
            assert_true(decade <= 2 || mean <= last);
            last = mean;
        }
    }
    destroy(&s);
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    folder = argv[1];
    return test_run(NULL, fixture_setup, fixture_teardown);
}
