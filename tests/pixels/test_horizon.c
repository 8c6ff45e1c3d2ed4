/* SPDX-License-Identifier: MIT
 *
 * The horizon technique against an answer that is known: what a wall takes from a floor beside it.
 */
#include "analytic.h"
#include "fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* Accessibility of a point on a plane at distance d (in radii) from a wall that stands on it at a right angle: a
 * direction is blocked where it meets the wall within the radius, that is, where its component towards the wall is at
 * least d. Cosine-weighted directions are uniform over the unit disc below, and those are a segment of it. */
static double beside_a_wall(double d)
{
    return 1.0 - (acos(d) - d * sqrt(1.0 - d * d)) / PI;
}

/* A floor and a wall 6 units away, seen from above and in front; the floor's middle column is compared. */
static void floor_beside_a_wall(fixture *f, glssao_quality quality, double *out_rms, double *out_worst)
{
    enum { W = 400, H = 400 };
    const double radius = 1.0, distance = 6.0;
    /* View space turned down by 45 degrees: the floor's normal and the wall's are both in the y-z plane. */
    const double s = sqrt(0.5);
    analytic_shape shapes[2] = {{ANALYTIC_PLANE, {0.0, 0.0, -distance}, {0.0, s, s}},
                                {ANALYTIC_PLANE, {0.0, 0.0, -distance}, {0.0, -s, s}}};
    analytic_view view = analytic_make_view(PERSPECTIVE, 1.0, 0.5, 40.0, 1.0);
    float *depth, *normals;
    analytic_render(&view, shapes, 2, W, H, &depth, &normals);
    glssao_effect *effect = fixture_effect(f, W, H);
    glssao_frame frame = {.depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT32F, W, H, depth),
                          .normal_texture = fixture_normal_texture(W, H, normals)};
    memcpy(frame.projection, view.projection, sizeof frame.projection);
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, quality);
    settings.radius = (float)radius;
    int w, h;
    float *got = fixture_compute(effect, &frame, &settings, &w, &h);
    assert_true(w == W && h == H);
    double sum = 0.0;
    int count = 0;
    *out_worst = 0.0;
    for (int y = 0; y < H; ++y)
        for (int x = W / 2 - 8; x < W / 2 + 8; ++x) {
            const float *n = normals + 3 * (y * W + x);
            if (n[1] < 0.0f)
                continue; /* the wall */
            double ndc = 2.0 * (double)depth[y * W + x] - 1.0, p10 = (double)view.projection[10],
                   p14 = (double)view.projection[14];
            double t = p14 / (p10 + ndc), v = (2.0 * (y + 0.5) / H - 1.0) * t / (double)view.projection[5];
            double to_wall =
                s * (-v) + s * (distance - t); /* along the floor, from the crease; the wall's normal points back */
            double d = fabs(to_wall) / radius;
            if (d > 1.2)
                continue;
            double difference = (double)got[y * W + x] - (d >= 1.0 ? 1.0 : beside_a_wall(d));
            sum += difference * difference;
            *out_worst = fmax(*out_worst, fabs(difference));
            ++count;
        }
    assert_true(count > 200);
    *out_rms = sqrt(sum / count);
    free(got);
    free(depth);
    free(normals);
    gl.DeleteTextures(1, &frame.depth_texture);
    gl.DeleteTextures(1, &frame.normal_texture);
    glssao_destroy(effect);
}

static void floor_beside_a_wall_is_near_the_integral(void **state)
{
        for (int quality = GLSSAO_LOW; quality <= GLSSAO_ULTRA; ++quality) {
        double rms, worst;
        floor_beside_a_wall(*state, (glssao_quality)quality, &rms, &worst);
        print_message("quality %d: rms %.4f, worst %.4f\n", quality, rms, worst);
        assert_true(rms < 0.025);
        assert_true(worst < 0.06);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(floor_beside_a_wall_is_near_the_integral, NULL, fixture_no_gl_error),
    };
    return cmocka_run_group_tests(tests, fixture_setup, fixture_teardown);
}
