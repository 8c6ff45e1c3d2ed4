/* SPDX-License-Identifier: MIT
 *
 * Light on a surface: the environment, reflections against a plain C model, punctual lights.
 */
#include "draw.h"
#include "draw_frame.h"
#include "fixture.h"
#include "small_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979;

static void set_normals(small_scene *s, double x, double y, double z)
{
    for (int i = 0; i < 4; i++) {
        const float normal[3] = {(float)x, (float)y, (float)z};
        memcpy(s->vertices[i].normal, normal, sizeof normal);
    }
}

/* Colour of the middle of the quad, linear; the frame's 8 bits resolve about 0.01 of it. */
static void middle_color(small_scene *s, const scene_lighting *lighting, double out[3])
{
    frame f = frame_draw_with(s, &frame_front, lighting, &(scene_draw_options){0}, 0);
    for (int i = 0; i < 3; i++) {
        const double c = f.color[FRAME_MIDDLE][i] / 255.0;
        out[i] = c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
    }
    frame_free(&f);
}

static void assert_near(double got, double wanted, double tolerance, const char *what)
{
    if (!(fabs(got - wanted) <= tolerance))
        fail_msg("%s: %g, not %g", what, got, wanted);
}

/* Irradiance / pi of the gradient by summing over the hemisphere. */
static double gradient_irradiance(double level, double tilt, double cos_up)
{
    enum { STEPS = 200 };
    const double sin_up = sqrt(1 - cos_up * cos_up);
    double sum = 0;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < STEPS; k++) {
            const double cosine2 = (i + 0.5) / STEPS, turn = 2 * pi * (k + 0.5) / STEPS; /* cosine-weighted */
            sum += level + tilt * (sqrt(cosine2) * cos_up + sqrt(1 - cosine2) * cos(turn) * sin_up);
        }
    return sum / (STEPS * STEPS);
}

static void gradient_lights_as_its_integral_says(void **state)
{
    (void)state;
    const scene_lighting lighting = {
        .ambient = {0.5f, 0.3f, 0.4f}, .ambient_tilt = {0.3f, -0.2f, 0}, .direction_world = {0, -1, 0}};
    small_scene *s = frame_one_quad(small_scene_material(), NULL);
    for (double up = -1; up <= 1; up += 0.25) {
        double got[3];
        set_normals(s, 0, up, sqrt(1 - up * up));
        middle_color(s, &lighting, got);
        assert_near(got[0], gradient_irradiance(0.5, 0.3, up), 0.006, "red");
        assert_near(got[1], gradient_irradiance(0.3, -0.2, up), 0.006, "green");
        assert_near(got[2], 0.4, 0.006, "blue");
    }
    free(s);
}

/* glTF 2.0, appendix B, in double precision. */
static double reflection_model(double base, double metallic, double roughness, double cos_eye, double angle)
{
    /* Eye along z; normal turned from it by acos(cos_eye) towards x, light by `angle` from the eye the same way. */
    const double n[2] = {sqrt(1 - cos_eye * cos_eye), cos_eye}, l[2] = {sin(angle), cos(angle)};
    const double h_length = hypot(l[0], l[1] + 1), h[2] = {l[0] / h_length, (l[1] + 1) / h_length};
    const double nl = n[0] * l[0] + n[1] * l[1], nh = n[0] * h[0] + n[1] * h[1], vh = h[1];
    const double a2 = pow(roughness, 4), f0 = 0.04 + (base - 0.04) * metallic;
    if (nl <= 0)
        return 0;
    const double d = a2 / (pi * pow(nh * nh * (a2 - 1) + 1, 2));
    const double v = 0.5 / (nl * sqrt(cos_eye * cos_eye * (1 - a2) + a2) + cos_eye * sqrt(nl * nl * (1 - a2) + a2));
    const double f = f0 + (1 - f0) * pow(1 - vh, 5);
    return (base * (1 - metallic) / pi + d * v * f) * nl;
}

static void reflection_is_that_of_the_model(void **state)
{
    (void)state;
    static const double angles[] = {-0.6, 0, 0.3, 0.9, 1.3};
    int compared = 0;
    for (int k = 0; k < 16; k++) {
        scene_material material = small_scene_material();
        material.metallic_roughness = true;
        material.metallic = k % 2 ? 1.0f : 0.0f;
        material.roughness = 0.3f + 0.2f * (float)(k / 2 % 4);
        const double cos_eye = k < 8 ? 1 : 0.8, base = 0.6, irradiance = 0.5;
        for (int c = 0; c < 3; c++)
            material.base_color[c] = (float)base;
        small_scene *s = frame_one_quad(material, NULL);
        set_normals(s, sqrt(1 - cos_eye * cos_eye), 0, cos_eye);
        for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
            const float e = (float)irradiance;
            const scene_lighting lighting = {
                .direction_world = {(float)-sin(angles[i]), 0, (float)-cos(angles[i])}, .directional = {e, e, e}};
            double got[3];
            const double wanted = irradiance * reflection_model(base, (double)material.metallic,
                                                                (double)material.roughness, cos_eye, angles[i]);
            middle_color(s, &lighting, got);
            if (wanted < 0.98) { /* the frame holds no more than 1 */
                compared++;
                assert_near(got[0], wanted, 0.005 + 0.01 * wanted, "reflected");
            }
        }
        free(s);
    }
    assert_true(compared > 60);
}

/* In light that comes evenly from everywhere, no surface sends out more than it gets. */
static void nothing_is_brighter_than_its_surroundings(void **state)
{
    (void)state;
    const scene_lighting lighting = {.ambient = {0.8f, 0.8f, 0.8f}, .direction_world = {0, -1, 0}};
    for (int k = 0; k < 20; k++) {
        scene_material material = small_scene_material();
        material.metallic_roughness = true;
        material.metallic = k % 2 ? 1.0f : 0.0f;
        material.roughness = 0.25f * (float)(k / 2 % 5);
        small_scene *s = frame_one_quad(material, NULL);
        const double cos_eye = k < 10 ? 1 : 0.3;
        set_normals(s, sqrt(1 - cos_eye * cos_eye), 0, cos_eye);
        double got[3];
        middle_color(s, &lighting, got);
        /* A matte white with a clear coat adds the coat's share, as glTF's mix would take it away. */
        const double most = material.metallic > 0 ? 0.8 : 0.8 * 1.25;
        if (!(got[0] < most + 0.02 && got[0] > 0.45 * 0.8))
            fail_msg("metallic %g, roughness %g, cosine %g: %g of 0.8", (double)material.metallic,
                     (double)material.roughness, cos_eye, got[0]);
        free(s);
    }
}

static void punctual_lights_fall_off_as_the_extension_says(void **state)
{
    (void)state;
    const float candela = 2;
    const struct {
        scene_light light;
        double wanted; /* irradiance / pi on the middle of the quad, which faces +z */
        const char *what;
    } cases[] = {
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, 1}}, 2 / pi, "point"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, 2}}, 2 / pi / 4, "twice as far"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {1, 0, 1}}, 2 / pi / 2 * sqrt(0.5), "aslant"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, -1}}, 0, "behind"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, 1}, .range = 2}, 2 / pi * (1 - 1 / 16.0), "range"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, 1}, .range = 0.9f}, 0, "out of range"},
        {{.kind = SCENE_LIGHT_DIRECTIONAL, .direction_world = {0, 0, -1}}, 2 / pi, "directional"},
        {{.kind = SCENE_LIGHT_SPOT, .position_world = {0, 0, 1}, .direction_world = {0, 0, -1}, .inner_cos = 0.9f,
          .outer_cos = 0.8f}, 2 / pi, "in the cone"},
        {{.kind = SCENE_LIGHT_SPOT, .position_world = {0, 0, 1}, .direction_world = {0.6f, 0, -0.8f},
          .inner_cos = 0.9f, .outer_cos = 0.7f}, 0.1896, "half way out of it"}, /* 0.1592 in the very middle, 1/64 away */
        {{.kind = SCENE_LIGHT_SPOT, .position_world = {0, 0, 1}, .direction_world = {0.8f, 0, -0.6f},
          .inner_cos = 0.9f, .outer_cos = 0.7f}, 0, "out of the cone"},
    };
    small_scene *s = frame_one_quad(small_scene_material(), NULL);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        scene_light light = cases[i].light;
        light.color[0] = light.color[1] = light.color[2] = candela;
        const scene_lighting lighting = {.direction_world = {0, -1, 0}, .lights = &light, .light_count = 1};
        double got[3];
        middle_color(s, &lighting, got);
        assert_near(got[0], cases[i].wanted, 0.012, cases[i].what); /* the middle pixel is beside the very middle */
    }
    free(s);
}

static void lights_of_the_scene_take_the_suns_place(void **state)
{
    (void)state;
    small_scene *s = frame_one_quad(small_scene_material(), NULL);
    scene_light lights[3] = {
        {.kind = SCENE_LIGHT_POINT, .color = {1, 1, 1}, .position_world = {0, 0, 30}},
        {.kind = SCENE_LIGHT_DIRECTIONAL, .color = {100, 50, 0}, .direction_world = {1, 0, 0}},
        {.kind = SCENE_LIGHT_DIRECTIONAL, .color = {1, 1, 1}, .direction_world = {0, 0, 1}},
    };
    scene_light rest[3];
    scene_lighting l = scene_lighting_of(&s->scene, rest);
    assert_float_equal(l.directional[0], scene_default_lighting().directional[0], 0);
    s->scene.lights = lights;
    s->scene.light_count = 3;
    l = scene_lighting_of(&s->scene, rest);
    assert_int_equal(l.light_count, 2);
    assert_float_equal(l.direction_world[0], 1, 0);
    assert_float_equal(l.directional[0], pi, 1e-5); /* dimmed from 100, and the rest alike */
    assert_float_equal(l.directional[1], pi / 2, 1e-5);
    assert_float_equal(l.lights[1].color[0], pi / 100, 1e-5);
    lights[1].color[0] = lights[1].color[1] = 2; /* none too bright: as they are */
    l = scene_lighting_of(&s->scene, rest);
    assert_float_equal(l.directional[0], 2, 0);
    assert_float_equal(l.lights[1].color[0], 1, 0);
    free(s);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, fixture_no_gl_error)
    const struct CMUnitTest tests[] = {
        TEST(gradient_lights_as_its_integral_says),
        TEST(reflection_is_that_of_the_model),
        TEST(nothing_is_brighter_than_its_surroundings),
        TEST(punctual_lights_fall_off_as_the_extension_says),
        TEST(lights_of_the_scene_take_the_suns_place),
    };
#undef TEST
    return cmocka_run_group_tests_name("draw light", tests, fixture_setup, fixture_teardown);
}
