/* SPDX-License-Identifier: MIT
 *
 * Cameras: what they see, at every scale and aspect, and which ones are refused.
 */
#include "camera.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static scene_instance one_instance;

static scene box(float x0, float y0, float z0, float x1, float y1, float z1)
{
    return (scene){
        .instances = &one_instance, .instance_count = 1, .bounds_min = {x0, y0, z0}, .bounds_max = {x1, y1, z1}};
}

static scene scaled(scene s, float scale)
{
    for (int i = 0; i < 3; i++) {
        s.bounds_min[i] *= scale;
        s.bounds_max[i] *= scale;
    }
    return s;
}

static void transform(const float m[16], const double v[4], double out[4])
{
    for (int r = 0; r < 4; r++)
        out[r] = (double)m[r] * v[0] + (double)m[4 + r] * v[1] + (double)m[8 + r] * v[2] + (double)m[12 + r] * v[3];
}

/* The largest |x|, |y| and |z| of the bounds' corners in normalised device coordinates; infinite if one is behind. */
static void bounds_ndc(const scene *s, const scene_view *view, double out[3])
{
    out[0] = out[1] = out[2] = 0;
    for (int k = 0; k < 8; k++) {
        double world[4] = {0, 0, 0, 1}, in_view[4], clip[4];
        for (int i = 0; i < 3; i++)
            world[i] = (k >> i) & 1 ? s->bounds_max[i] : s->bounds_min[i];
        transform(view->view_from_world, world, in_view);
        transform(view->clip_from_view, in_view, clip);
        for (int i = 0; i < 3; i++)
            out[i] = fmax(out[i], clip[3] > 0 ? fabs(clip[i] / clip[3]) : INFINITY);
    }
}

static scene shapes(int i)
{
    switch (i) {
    case 0:
        return box(-1, -1, -1, 1, 1, 1);
    case 1:
        return box(-339, 0, -339, 339, 13, 339);
    case 2:
        return box(0.1f, 0, 0, 0.2f, 9, 0.3f);
    case 3:
        return box(0, 0, -50, 0, 0, 50);
    case 4:
        return box(100, 200, 300, 101, 200, 301);
    default:
        return box(-10, 5, 5, 10, 5, 5);
    }
}

static void frame_sees_the_whole_bounds(void **state)
{
    (void)state;
    const float aspects[] = {1, 16.0f / 9, 9.0f / 16, 20, 0.05f};
    for (int shape = 0; shape < 6; shape++) {
        for (int power = -4; power <= 4; power += 4) {
            for (size_t a = 0; a < sizeof aspects / sizeof aspects[0]; a++) {
                const scene s = scaled(shapes(shape), powf(10, (float)power));
                const camera c = camera_frame_scene(&s, aspects[a]);
                char error[200] = "";
                if (!camera_check(&c, error, sizeof error))
                    fail_msg("shape %d, scale 1e%d: %s", shape, power, error);
                const scene_view view = camera_view(&c, (int)(2000 * aspects[a]), 2000);
                double ndc[3];
                bounds_ndc(&s, &view, ndc);
                if (!(ndc[0] < 0.96 && ndc[1] < 0.96 && ndc[2] < 1))
                    fail_msg("shape %d, scale 1e%d, aspect %g: corners at %g %g %g", shape, power, (double)aspects[a],
                             ndc[0], ndc[1], ndc[2]);
            }
        }
    }
}

static void frame_fills_the_picture(void **state)
{
    (void)state;
    for (int shape = 0; shape < 3; shape++) {
        const scene s = shapes(shape);
        const camera c = camera_frame_scene(&s, 1.5f);
        const scene_view view = camera_view(&c, 1500, 1000);
        double ndc[3];
        bounds_ndc(&s, &view, ndc);
        assert_true(fmax(ndc[0], ndc[1]) > 0.94);
    }
}

static void frame_of_an_empty_scene_is_at_one_on_z(void **state)
{
    (void)state;
    const scene s = {0};
    const camera c = camera_frame_scene(&s, 1);
    const float eye[3] = {0, 0, 1};
    char error[200];
    assert_memory_equal(c.eye, eye, sizeof eye);
    assert_true(camera_check(&c, error, sizeof error));
}

static void frame_scales_with_the_scene(void **state)
{
    (void)state;
    const scene s = box(-1, 0, -2, 3, 4, 1), large = scaled(s, 8192);
    const camera c = camera_frame_scene(&s, 1.5f), d = camera_frame_scene(&large, 1.5f);
    for (int i = 0; i < 3; i++)
        assert_float_equal(d.eye[i], 8192 * c.eye[i], 8192 * 1e-5f);
    assert_float_equal(d.near_plane, 8192 * c.near_plane, 8192 * c.near_plane * 1e-5f);
    assert_float_equal(d.far_plane, 8192 * c.far_plane, 8192 * c.far_plane * 1e-5f);
}

static camera from(float x, float y, float z)
{
    return (camera){.eye = {x, y, z}, .target = {x, y, z - 1}, .up = {0, 1, 0}, .fov_y_rad = 1};
}

static void planes_hug_bounds_in_front(void **state)
{
    (void)state;
    const scene s = box(-1, -1, -1, 1, 1, 1);
    camera c = from(0, 0, 11);
    camera_fit_planes(&c, &s);
    assert_true(c.near_plane < 10 && c.near_plane > 9.9f);
    assert_true(c.far_plane > 12 && c.far_plane < 12.1f);
}

static void planes_inside_the_bounds_keep_their_ratio(void **state)
{
    (void)state;
    const scene s = box(-1, -1, -1, 1, 1, 1);
    camera c = from(0, 0, 0);
    camera_fit_planes(&c, &s);
    assert_true(c.far_plane > 1 && c.far_plane < 1.1f);
    assert_float_equal(c.far_plane / c.near_plane, 20000, 1);
}

static void planes_are_valid_with_everything_behind(void **state)
{
    (void)state;
    const scene behind = box(-1, -1, -1, 1, 1, 1), point = box(0, 0, 0, 0, 0, 0);
    char error[200];
    camera c = from(0, 0, -5);
    camera_fit_planes(&c, &behind);
    assert_true(camera_check(&c, error, sizeof error));
    camera_fit_planes(&c, &point);
    assert_true(camera_check(&c, error, sizeof error));
}

static void planes_of_a_flat_scene_leave_room(void **state)
{
    (void)state;
    const scene s = box(-1, -1, 0, 1, 1, 0);
    camera c = from(0, 0, 1000);
    camera_fit_planes(&c, &s);
    assert_true(c.near_plane < 999.9f && c.far_plane > 1000.1f);
}

static void turned_keeps_the_distance_and_the_height(void **state)
{
    (void)state;
    const camera c = {.eye = {3, 4, 5}, .target = {1, 1, 1}, .up = {0, 1, 0}, .fov_y_rad = 1};
    const camera d = camera_turned(&c, 1.2f);
    double before = 0, after = 0;
    for (int i = 0; i < 3; i++) {
        before += pow((double)c.eye[i] - c.target[i], 2);
        after += pow((double)d.eye[i] - d.target[i], 2);
    }
    assert_true(fabs(before - after) < 1e-5 * before);
    assert_float_equal(d.eye[1], 4, 1e-6f);
    assert_memory_equal(d.target, c.target, sizeof c.target);
    assert_memory_equal(d.up, c.up, sizeof c.up);
}

static void turned_a_quarter_goes_from_front_to_right(void **state)
{
    (void)state;
    const camera c = {.eye = {0, 0, 2}, .up = {0, 0.5f, 0.5f}};
    const camera d = camera_turned(&c, 1.57079633f);
    assert_float_equal(d.eye[0], 2, 1e-6f);
    assert_float_equal(d.eye[2], 0, 1e-6f);
    assert_float_equal(d.up[0], 0.5f, 1e-6f);
    assert_float_equal(d.up[1], 0.5f, 1e-6f);
}

static void view_looks_down_minus_z(void **state)
{
    (void)state;
    const camera c = {
        .eye = {1, 2, 3}, .target = {1, 2, -7}, .up = {0, 3, 0}, .fov_y_rad = 1, .near_plane = 1, .far_plane = 10};
    const scene_view view = camera_view(&c, 640, 480);
    const double world[4] = {2, 4, 0, 1};
    double in_view[4];
    transform(view.view_from_world, world, in_view);
    assert_true(in_view[0] == 1 && in_view[1] == 2 && in_view[2] == -3 && in_view[3] == 1);
    assert_int_equal(view.width, 640);
    assert_int_equal(view.height, 480);
}

static void check_names_the_field(void **state)
{
    (void)state;
    const camera good = {.eye = {1, 2, 3}, .up = {0, 1, 0}, .fov_y_rad = 1, .near_plane = 1, .far_plane = 2};
    camera bad[9];
    const char *named[9] = {"eye", "target", "target", "up", "up", "fov", "near", "far", "far"};
    for (int i = 0; i < 9; i++)
        bad[i] = good;
    bad[0].eye[1] = NAN;
    bad[1].target[2] = INFINITY;
    memcpy(bad[2].target, good.eye, sizeof good.eye);
    memset(bad[3].up, 0, sizeof bad[3].up);
    memcpy(bad[4].up, good.eye, sizeof good.eye);
    bad[5].fov_y_rad = 3.2f;
    bad[6].near_plane = 0;
    bad[7].far_plane = 1;
    bad[8].far_plane = INFINITY;
    char error[200];
    assert_true(camera_check(&good, error, sizeof error));
    for (int i = 0; i < 9; i++) {
        error[0] = '\0';
        assert_false(camera_check(&bad[i], error, sizeof error));
        if (!strstr(error, named[i]) || strchr(error, '\n'))
            fail_msg("\"%s\" does not name \"%s\"", error, named[i]);
    }
}

static void check_takes_tiny_and_huge_cameras(void **state)
{
    (void)state;
    char error[200];
    for (float scale = 1e-6f; scale < 1e7f; scale *= 1e3f) {
        const camera c = {
            .eye = {0, 0, scale}, .up = {0, scale, 0}, .fov_y_rad = 1, .near_plane = 0.1f * scale, .far_plane = scale};
        assert_true(camera_check(&c, error, sizeof error));
    }
}

static void suggested_radius_follows_the_diagonal(void **state)
{
    (void)state;
    const scene s = box(0, 0, 0, 1, 2, 2), empty = {0};
    assert_float_equal(camera_suggest_radius(&s), 3.0f / 20, 1e-6f);
    assert_float_equal(camera_suggest_radius(&empty), 0.5f, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frame_sees_the_whole_bounds),
        cmocka_unit_test(frame_fills_the_picture),
        cmocka_unit_test(frame_of_an_empty_scene_is_at_one_on_z),
        cmocka_unit_test(frame_scales_with_the_scene),
        cmocka_unit_test(planes_hug_bounds_in_front),
        cmocka_unit_test(planes_inside_the_bounds_keep_their_ratio),
        cmocka_unit_test(planes_are_valid_with_everything_behind),
        cmocka_unit_test(planes_of_a_flat_scene_leave_room),
        cmocka_unit_test(turned_keeps_the_distance_and_the_height),
        cmocka_unit_test(turned_a_quarter_goes_from_front_to_right),
        cmocka_unit_test(view_looks_down_minus_z),
        cmocka_unit_test(check_names_the_field),
        cmocka_unit_test(check_takes_tiny_and_huge_cameras),
        cmocka_unit_test(suggested_radius_follows_the_diagonal),
    };
    return cmocka_run_group_tests_name("camera", tests, NULL, NULL);
}
