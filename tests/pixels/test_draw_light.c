/* SPDX-License-Identifier: MIT
 *
 * Light on a surface: the environment, reflections compared with a plain C model, punctual lights.
 */
#define _POSIX_C_SOURCE 200809L
#include "camera.h"
#include "draw.h"
#include "draw_frame.h"
#include "fixture.h"
#include "open_light.h"
#include "small_scene.h"

#include <unistd.h>

static const double pi = 3.14159265358979;

static void set_normals(small_scene *s, double x, double y, double z)
{
    for (int i = 0; i < 4; i++) {
        const float normal[3] = {(float)x, (float)y, (float)z};
        memcpy(s->vertices[i].normal, normal, sizeof normal);
    }
}

/* Linear colour at the middle of the quad; 8 bits resolve about 0.01 of it. */
static void middle_color(small_scene *s, const scene_lighting *lighting, double out[3])
{
    SCOPED(drawn) frame f = frame_draw_with(s, &frame_front, lighting, &(scene_draw_options){0}, 0);
    for (int i = 0; i < 3; i++) {
        const double c = f.color[FRAME_MIDDLE][i] / 255.0;
        out[i] = c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
    }
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

TEST_GL(gradient_lights_as_its_integral_says)
{
    const scene_lighting lighting = {
        .ambient = {0.5f, 0.3f, 0.4f}, .ambient_tilt = {0.3f, -0.2f, 0}, .direction_world = {0, -1, 0}};
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
    for (double up = -1; up <= 1; up += 0.25) {
        double got[3];
        set_normals(s, 0, up, sqrt(1 - up * up));
        middle_color(s, &lighting, got);
        assert_near(got[0], gradient_irradiance(0.5, 0.3, up), 0.006, "red");
        assert_near(got[1], gradient_irradiance(0.3, -0.2, up), 0.006, "green");
        assert_near(got[2], 0.4, 0.006, "blue");
    }
}

/* glTF 2.0, appendix B, in double precision. */
static double reflection_model(double base, double metallic, double roughness, double cos_eye, double angle)
{
    /* Eye along z. The normal is turned from it by acos(cos_eye) towards x, and the light by `angle` the same way. */
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

TEST_GL(reflection_is_that_of_the_model)
{
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
        SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
        set_normals(s, sqrt(1 - cos_eye * cos_eye), 0, cos_eye);
        for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
            const float e = (float)irradiance;
            const scene_lighting lighting = {.direction_world = {(float)-sin(angles[i]), 0, (float)-cos(angles[i])},
                                             .directional = {e, e, e}};
            double got[3];
            const double wanted = irradiance * reflection_model(base, (double)material.metallic,
                                                                (double)material.roughness, cos_eye, angles[i]);
            middle_color(s, &lighting, got);
            if (wanted < 0.98) { /* the frame stores at most 1 */
                compared++;
                assert_near(got[0], wanted, 0.005 + 0.01 * wanted, "reflected");
            }
        }
    }
    assert_true(compared > 60);
}

/* In uniform light from all directions, no surface sends out more than it receives. */
/* Linear colour in the middle with a map of bent normals that holds one value. */
static void bent_color(small_scene *s, const scene_lighting *lighting, const double bent[3], double accessibility,
                       double left_out, double out[3])
{
    SCOPED(texture) GLuint map = 0;
    const float texel[4] = {(float)bent[0], (float)bent[1], (float)bent[2], (float)accessibility};
    const scene_draw_options options = {.bent = true, .left_out = (float)left_out};
    gl.GenTextures(1, &map);
    gl.BindTexture(GL_TEXTURE_2D, map);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 1, 1, 0, GL_RGBA, GL_FLOAT, texel);
    SCOPED(drawn) frame f = frame_draw_with(s, &frame_front, lighting, &options, map);
    for (int i = 0; i < 3; i++) {
        const double c = f.color[FRAME_MIDDLE][i] / 255.0;
        out[i] = c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
    }
}

/* Matte light of the gradient, whose first harmonic is all that is not even; and the cones of a metal, whose share
 * shows against the same surface in the open. */
TEST_GL(bent_normals_light_as_their_cones_say)
{
    const scene_lighting lighting = {
        .ambient = {0.5f, 0.3f, 0.4f}, .ambient_tilt = {0.3f, -0.2f, 0}, .direction_world = {0, -1, 0}};
    const double n[3] = {0, 0, 1}, open[3] = {0, 0, 1};
    int darkened = 0;
    for (int k = 0; k < 24; k++) {
        const double turn = 0.3 * (k % 8), accessibility = 0.15 + 0.35 * (k / 8);
        const double bent[3] = {0, sin(turn - 1), cos(turn - 1)};
        double got[3], even[3], wanted;
        small_scene *s = frame_one_quad(small_scene_material(), NULL);
        const double linear = open_light_linear(accessibility);
        bent_color(s, &lighting, bent, accessibility, 0, got);
        wanted = accessibility * (0.5 + 0.3 * 2 / 3 * linear * bent[1]);
        assert_near(got[0], wanted, 0.006, "matte, red");
        wanted = accessibility * (0.3 - 0.2 * 2 / 3 * linear * bent[1]);
        assert_near(got[1], wanted, 0.006, "matte, green");
        bent_color(s, &lighting, bent, accessibility, 1, got); /* no occlusion is shown */
        assert_near(got[0], 0.5, 0.006, "matte, left out");
        free(s);

        scene_material metal = small_scene_material();
        metal.metallic_roughness = true;
        metal.metallic = 1;
        metal.roughness = 0.2f + 0.3f * (float)(k % 3);
        s = frame_one_quad(metal, NULL);
        bent_color(s, &lighting, open, 1, 0, even);
        bent_color(s, &lighting, bent, accessibility, 0, got);
        const double share = open_light_cone(bent, accessibility, open, n, (double)metal.roughness);
        assert_near(got[0], even[0] * share, 0.008, "metal");
        darkened += share < 0.9 && share > 0.1;
        free(s);
    }
    assert_true(darkened > 4);
}

TEST_GL(nothing_is_brighter_than_its_surroundings)
{
    const scene_lighting lighting = {.ambient = {0.8f, 0.8f, 0.8f}, .direction_world = {0, -1, 0}};
    for (int k = 0; k < 20; k++) {
        scene_material material = small_scene_material();
        material.metallic_roughness = true;
        material.metallic = k % 2 ? 1.0f : 0.0f;
        material.roughness = 0.25f * (float)(k / 2 % 5);
        SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
        const double cos_eye = k < 10 ? 1 : 0.3;
        set_normals(s, sqrt(1 - cos_eye * cos_eye), 0, cos_eye);
        double got[3];
        middle_color(s, &lighting, got);
        /* A matte white surface with a clear coat gains the coat's share, where glTF's mix would remove it. */
        const double most = material.metallic > 0 ? 0.8 : 0.8 * 1.25;
        if (!(got[0] < most + 0.02 && got[0] > 0.45 * 0.8))
            fail_msg("metallic %g, roughness %g, cosine %g: %g of 0.8", (double)material.metallic,
                     (double)material.roughness, cos_eye, got[0]);
    }
}

TEST_GL(punctual_lights_fall_off_as_the_extension_says)
{
    const float candela = 2;
    const struct {
        scene_light light;
        double wanted; /* irradiance / pi at the middle of the quad, which faces +z */
        const char *what;
    } cases[] = {
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, 1}}, 2 / pi, "point"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, 2}}, 2 / pi / 4, "twice as far"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {1, 0, 1}}, 2 / pi / 2 * sqrt(0.5), "aslant"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, -1}}, 0, "behind"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, 1}, .range = 2}, 2 / pi * (1 - 1 / 16.0), "range"},
        {{.kind = SCENE_LIGHT_POINT, .position_world = {0, 0, 1}, .range = 0.9f}, 0, "out of range"},
        {{.kind = SCENE_LIGHT_DIRECTIONAL, .direction_world = {0, 0, -1}}, 2 / pi, "directional"},
        {{.kind = SCENE_LIGHT_SPOT,
          .position_world = {0, 0, 1},
          .direction_world = {0, 0, -1},
          .inner_cos = 0.9f,
          .outer_cos = 0.8f},
         2 / pi,
         "in the cone"},
        {{.kind = SCENE_LIGHT_SPOT,
          .position_world = {0, 0, 1},
          .direction_world = {0.6f, 0, -0.8f},
          .inner_cos = 0.9f,
          .outer_cos = 0.7f},
         0.1896,
         "half way out of it"}, /* 0.1592 at the exact middle, 1/64 away */
        {{.kind = SCENE_LIGHT_SPOT,
          .position_world = {0, 0, 1},
          .direction_world = {0.8f, 0, -0.6f},
          .inner_cos = 0.9f,
          .outer_cos = 0.7f},
         0,
         "out of the cone"},
    };
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        scene_light light = cases[i].light;
        light.color[0] = light.color[1] = light.color[2] = candela;
        const scene_lighting lighting = {.direction_world = {0, -1, 0}, .lights = &light, .light_count = 1};
        double got[3];
        middle_color(s, &lighting, got);
        assert_near(got[0], cases[i].wanted, 0.012, cases[i].what); /* the middle pixel lies beside the exact middle */
    }
}

TEST_GL(lights_of_the_scene_take_the_suns_place)
{
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
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
    assert_float_equal(l.directional[0], (float)pi, 1e-5); /* dimmed from 100; the others by the same factor */
    assert_float_equal(l.directional[1], (float)pi / 2, 1e-5);
    assert_float_equal(l.lights[1].color[0], (float)pi / 100, 1e-5);
    lights[1].color[0] = lights[1].color[1] = 2; /* none is too bright, so none changes */
    l = scene_lighting_of(&s->scene, rest);
    assert_float_equal(l.directional[0], 2, 0);
    assert_float_equal(l.lights[1].color[0], 1, 0);
}

/* A picture whose channels are gradients along the world's axes: 0.5 + 0.4 x, and so on; or black. */
static scene_environment *load_gradients(bool black)
{
    enum { WIDTH = 256, HEIGHT = WIDTH / 2 };
    char path[64], error[256];
    snprintf(path, sizeof path, "test_draw_light-%ld.hdr",
             (long)getpid()); /* the test of the other context runs at the same time */
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", HEIGHT, WIDTH);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const double turn = 2 * pi * ((x + 0.5) / WIDTH - 0.5), down = pi * (y + 0.5) / HEIGHT;
            const double direction[3] = {sin(down) * sin(turn), cos(down), -sin(down) * cos(turn)};
            for (int k = 0; k < 3; k++) /* the exponent makes 256 represent 1 */
                fputc((int)(256 * (0.5 + 0.4 * direction[k]) + 0.5), file);
            fputc(black ? 0 : 128, file);
        }
    assert_int_equal(fclose(file), 0);
    scene_environment *e = scene_environment_load(path, FAULT(error));
    remove(path);
    if (!e)
        fail_msg("%s", error);
    return e;
}

static void assert_gradients(const uint8_t color[4], const double direction[3], double share, double scale,
                             const char *what)
{
    for (int k = 0; k < 3; k++) {
        const double c = color[k] / 255.0, linear = c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
        assert_near(linear, scale * (0.5 + 0.4 * share * direction[k]), 0.015, what);
    }
}

/* Seen from several sides, sky, matte surface and mirror show directions of the world, not of the view. */
TEST_GL(a_picture_surrounds_the_scene)
{
    /* What remains of a gradient, and Karis's fit for metal, which is 1 head-on at roughness 0 and the same in all
     * directions at 1; see main.frag. test_environment.c computes what a lobe of roughness 1 leaves. */
    static const struct {
        const char *what;
        bool metal;
        float roughness;
        double share, scale;
    } surfaces[] = {{"matte", false, 1, 2.0 / 3, 1}, {"mirror", true, 0, 1, 1}, {"rough", true, 1, 2.0 / 3, 0.45}};
    scene_environment *e = load_gradients(false);
    scene_lighting lighting = scene_default_lighting();
    const double n[3] = {0.36, 0.48, 0.8};
    for (size_t i = 0; i < sizeof surfaces / sizeof surfaces[0]; i++) {
        scene_material material = small_scene_material();
        material.metallic_roughness = surfaces[i].metal;
        material.metallic = 1;
        material.roughness = surfaces[i].roughness;
        SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
        scene_lighting_surround(&lighting, &s->scene, e);
        assert_true(lighting.directional[0] == 0 && scene_lighting_has_ambient(&lighting));
        set_normals(s, n[0], n[1], n[2]);
        for (double angle = -1; angle <= 1; angle += 0.5) {
            const double eye[3] = {2 * sin(angle), 1, 2 * cos(angle)}, away = sqrt(5);
            const camera c = {.eye = {(float)eye[0], (float)eye[1], (float)eye[2]},
                              .up = {0, 1, 0},
                              .fov_y_rad = 1.5707963f,
                              .near_plane = 0.1f,
                              .far_plane = 9};
            const scene_view view = camera_view(&c, FRAME_SIZE, FRAME_SIZE);
            SCOPED(drawn) frame drawn = frame_draw_with(s, &view, &lighting, &(scene_draw_options){0}, 0);
            double seen[3], mirrored[3];
            const double facing = (n[0] * eye[0] + n[1] * eye[1] + n[2] * eye[2]) / away;
            for (int k = 0; k < 3; k++)
                mirrored[k] = 2 * facing * n[k] - eye[k] / away;
            assert_gradients(drawn.color[FRAME_MIDDLE], surfaces[i].metal ? mirrored : n, surfaces[i].share,
                             surfaces[i].scale, surfaces[i].what);
            /* The direction of the lower left corner in view space, (-side, -side, -1), rotated to the world. */
            const float *m = view.view_from_world;
            const double side = 1 - 1.0 / FRAME_SIZE, length = sqrt(2 * side * side + 1);
            for (int k = 0; k < 3; k++)
                seen[k] = (-side * (double)m[4 * k] - side * (double)m[4 * k + 1] - (double)m[4 * k + 2]) / length;
            assert_gradients(drawn.color[0], seen, 1, 1, "sky");
            assert_int_equal(drawn.counts.sky, 1);
        }
    }
    scene_environment_destroy(e);
    e = load_gradients(true);
    lighting.environment = e;
    assert_false(scene_lighting_has_ambient(&lighting));
    scene_environment_destroy(e);
}

/* A shiny and a matte sphere, for a world with that direction up. */
static frame draw_world(const float up[3], const scene_environment *e)
{
    double turn[3][3];
    camera_find_turn(up, turn);
    SCOPED(memory) small_scene *s = small_scene_create();
    for (int ball = 0; ball < 2; ball++) {
        scene_material material = small_scene_material();
        material.metallic_roughness = ball == 0;
        material.metallic = 1;
        material.roughness = 0.25f;
        small_scene_begin_mesh(s, small_scene_add_material(s, material));
        small_scene_add_sphere(s);
        float m[16] = {[15] = 1};
        for (int i = 0; i < 3; i++) {
            for (int c = 0; c < 3; c++)
                m[4 * c + i] = (float)turn[c][i];
            m[12 + i] = (float)(turn[0][i] * (ball ? 1.2 : -1.2));
        }
        small_scene_add_instance(s, m);
    }
    scene_lighting lighting = scene_default_lighting();
    scene_lighting_surround(&lighting, &s->scene, e);
    scene_lighting_turn(&lighting, &s->scene, up);
    camera_framing how = camera_default_framing(1);
    memcpy(how.up, up, sizeof how.up);
    const camera c = camera_frame(&s->scene, &how);
    const scene_view view = camera_view(&c, FRAME_SIZE, FRAME_SIZE);
    frame f = frame_draw_with(s, &view, &lighting, &(scene_draw_options){.shadows = true, .shadow_size = 512}, 0);
    return f;
}

/* Sun, sky and environment follow the world's up: the picture of a world that stands another way is the same. */
TEST_GL(light_follows_up)
{
    static const float ups[][3] = {{0, 1, 0}, {0, 0, 1}, {0, -2, 0}, {1, 0, 0}, {-1, 2, 0.5f}};
    scene_environment *environments[] = {NULL, load_gradients(false)};
    for (int kind = 0; kind < 2; kind++) {
        SCOPED(drawn) frame wanted = draw_world(ups[0], environments[kind]);
        for (size_t u = 1; u < sizeof ups / sizeof ups[0]; u++) {
            SCOPED(drawn) frame drawn = draw_world(ups[u], environments[kind]);
            int apart = 0;
            for (int i = 0; i < FRAME_SIZE * FRAME_SIZE; i++)
                for (int k = 0; k < 3; k++)
                    apart += abs(drawn.color[i][k] - wanted.color[i][k]) > 2;
            /* Silhouettes, and the shadow map's texels, may round the other way. */
            if (apart > 3 * FRAME_SIZE * FRAME_SIZE / 100)
                fail_msg("up %g, %g, %g: %d values differ", (double)ups[u][0], (double)ups[u][1], (double)ups[u][2],
                         apart);
        }
    }
    scene_environment_destroy(environments[1]);
}

TEST_MAIN("draw light", fixture_setup, fixture_teardown)
