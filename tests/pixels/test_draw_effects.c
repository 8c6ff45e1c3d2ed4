/* SPDX-License-Identifier: MIT
 *
 * Shadows, normal maps and the sky, and that each runs only if the scene needs it.
 */
#include "camera.h"
#include "draw.h"
#include "draw_frame.h"
#include "fixture.h"
#include "small_scene.h"

static const scene_draw_options shadowed = {.shadows = true, .shadow_size = 512};

static int pixel_at(double x, double y) /* of frame_front */
{
    return (int)((y + 1) / 2 * FRAME_SIZE) * FRAME_SIZE + (int)((x + 1) / 2 * FRAME_SIZE);
}

/* A floor of side 2 facing the viewer, and a square of side 0.5 at height 0.5 above its middle. */
static small_scene *floor_and_roof(scene_material roof)
{
    const float floor[16] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const float above[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1, 0, 0, 0, 0.5f, 1};
    roof.double_sided = true;
    small_scene *s = frame_one_quad(small_scene_material(), floor);
    frame_add_quad(s, roof, above);
    return s;
}

/* Light that travels as far right as it goes down: the roof's shadow lies 0.5 to the right. */
static const scene_lighting aslant = {
    .ambient = {0.25f, 0.25f, 0.25f}, .direction_world = {0.70710678f, 0, -0.70710678f}, .directional = {2, 2, 2}};

TEST_GL(shadow_takes_direct_light_and_leaves_ambient)
{
    const double lit = 0.25 + 2 / 3.14159265 * 0.70710678;
    SCOPED(memory) small_scene *s = floor_and_roof(small_scene_material());
    frame drawn = frame_draw_with(s, &frame_front, &aslant, &shadowed, 0);
    frame_assert_color(drawn.color[pixel_at(0.5, 0)], 0.25, 0.25, 0.25);
    frame_assert_color(drawn.color[pixel_at(0.35, 0.15)], 0.25, 0.25, 0.25);
    frame_assert_color(drawn.color[pixel_at(0.9, 0)], lit, lit, lit);
    frame_assert_color(drawn.color[pixel_at(0.5, 0.4)], lit, lit, lit);
    frame_assert_color(drawn.color[pixel_at(-0.5, 0)], lit, lit, lit);
    frame_assert_color(drawn.color[pixel_at(0, 0)], lit, lit, lit); /* the roof itself */
    assert_int_equal(drawn.counts.shadow, 2);
    frame_free(&drawn);
    drawn = frame_draw_with(s, &frame_front, &aslant, &(scene_draw_options){0}, 0);
    frame_assert_color(drawn.color[pixel_at(0.5, 0)], lit, lit, lit);
    assert_int_equal(drawn.counts.shadow, 0);
    frame_free(&drawn);
}

/* Ambient light loses the share that is not left out; direct light none. */
TEST_GL(occlusion_is_left_out_by_its_share)
{
    const scene_lighting lighting = {
        .ambient = {0.5f, 0.5f, 0.5f}, .direction_world = {0, 0, -1}, .directional = {0.3f, 0.3f, 0.3f}};
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
    const float access = 0.25f;
    GLuint map;
    gl.GenTextures(1, &map);
    gl.BindTexture(GL_TEXTURE_2D, map);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, 1, 1, 0, GL_RED, GL_FLOAT, &access);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    for (int i = 0; i <= 4; i++) {
        const scene_draw_options options = {.left_out = (float)i / 4};
        const double open = 1 - (1 - i / 4.0) * 0.75, color = 0.5 * open + 0.3 / 3.14159265;
        SCOPED(drawn) frame drawn = frame_draw_with(s, &frame_front, &lighting, &options, map);
        frame_assert_color(drawn.color[FRAME_MIDDLE], color, color, color);
    }
    gl.DeleteTextures(1, &map);
}

TEST_GL(holes_and_blended_cast_no_shadow)
{
    static const uint8_t clear[4] = {255, 255, 255, 0};
    const double lit = 0.25 + 2 / 3.14159265 * 0.70710678;
    for (int blended = 0; blended < 2; blended++) {
        scene_material roof = small_scene_material();
        roof.alpha = blended ? SCENE_ALPHA_BLEND : SCENE_ALPHA_MASK;
        roof.base_color_texture = 0;
        SCOPED(memory) small_scene *s = floor_and_roof(roof);
        small_scene_add_texture(s, 1, 1, clear);
        SCOPED(drawn) frame drawn = frame_draw_with(s, &frame_front, &aslant, &shadowed, 0);
        frame_assert_color(drawn.color[pixel_at(0.5, 0)], lit, lit, lit);
    }
}

/* At any angle of the light, a lone surface is lit everywhere: no speckles, bands or dark rim. */
TEST_GL(smooth_surfaces_alone_do_not_shadow_themselves)
{
    const float floor[16] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    SCOPED(memory) small_scene *plane = frame_one_quad(small_scene_material(), floor);
    for (int k = 0; k < 24; k++) {
        const double slope = k % 8 * 0.19, turn = 0.3 + k / 8 * 0.7; /* up to 76 degrees */
        scene_lighting lighting = {
            .direction_world = {(float)(sin(slope) * cos(turn)), (float)(sin(slope) * sin(turn)), (float)-cos(slope)},
            .directional = {3, 3, 3}};
        SCOPED(drawn) frame with = frame_draw_with(plane, &frame_front, &lighting, &shadowed, 0);
        SCOPED(drawn) frame without = frame_draw_with(plane, &frame_front, &lighting, &(scene_draw_options){0}, 0);
        int darker = 0;
        for (int i = 0; i < FRAME_SIZE * FRAME_SIZE; i++)
            darker += without.color[i][0] - with.color[i][0] > 2;
        if (darker)
            fail_msg("light %g degrees off: %d pixels are darker", slope * 57.3, darker);
    }
}

TEST_GL(normal_map_bends_normals_in_the_tangent_frame)
{
    /* (0.48, 0.36, 0.8) in 0..1 */
    static const uint8_t texel[4] = {189, 173, 230, 255};
    const double mapped[3] = {189 / 127.5 - 1, 173 / 127.5 - 1, 230 / 127.5 - 1};
    const float placements[3][16] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                     {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},  /* mirrored */
                                     {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}; /* turned */
    for (int k = 0; k < 6; k++) {
        const float *m = placements[k % 3];
        const double sign = k < 3 ? 1 : -1;
        float tangents[4][4] = {{0}};
        scene_material material = small_scene_material();
        material.normal_map = (scene_map){.used = true, .uv_from_uv = {1, 0, 0, 0, 1, 0}};
        material.normal_scale = 1;
        SCOPED(memory) small_scene *s = frame_one_quad(material, m);
        small_scene_add_texture(s, 1, 1, texel);
        for (int i = 0; i < 4; i++) {
            tangents[i][0] = 1;
            tangents[i][3] = (float)sign;
        }
        s->scene.tangents = tangents;
        const scene_lighting lighting = scene_default_lighting();
        frame drawn = frame_draw_with(s, &frame_front, &lighting, &(scene_draw_options){.mapped_normals = true}, 0);
        for (int i = 0; i < 3; i++) {
            /* tangent m[0..2], bitangent the image of +-y, normal z */
            const double wanted = m[i] * mapped[0] + sign * (double)m[4 + i] * mapped[1] + (i == 2 ? mapped[2] : 0);
            if (!(fabs((double)drawn.normals[4 * FRAME_MIDDLE + i] - wanted) < 0.01))
                fail_msg("case %d: component %d is %g, not %g", k, i, (double)drawn.normals[4 * FRAME_MIDDLE + i],
                         wanted);
        }
        frame_free(&drawn);
        drawn = frame_draw_with(s, &frame_front, &lighting, &(scene_draw_options){0}, 0);
        assert_float_equal(drawn.normals[4 * FRAME_MIDDLE + 2], 1, 1e-6f); /* the mesh's own by default */
        frame_free(&drawn);
    }
}

TEST_GL(normal_map_bends_the_light)
{
    static const uint8_t texel[4] = {204, 128, 230, 255}; /* about (0.6, 0, 0.8) */
    float tangents[4][4] = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
    const scene_lighting lighting = {.direction_world = {-1, 0, 0}, .directional = {3.14159265f, 3.14159265f, 0}};
    scene_material material = small_scene_material();
    material.normal_map = (scene_map){.used = true, .uv_from_uv = {1, 0, 0, 0, 1, 0}};
    for (int scale = 0; scale < 2; scale++) {
        material.normal_scale = (float)scale;
        SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
        small_scene_add_texture(s, 1, 1, texel);
        s->scene.tangents = tangents;
        SCOPED(drawn) frame drawn = frame_draw_with(s, &frame_front, &lighting, &(scene_draw_options){0}, 0);
        frame_assert_color(drawn.color[FRAME_MIDDLE], scale ? 0.6 : 0, scale ? 0.6 : 0, 0);
    }
}

TEST_GL(sky_is_a_gradient_by_height_and_behind_everything)
{
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
    const scene_lighting lighting = {
        .ambient = {1, 1, 1}, .direction_world = {0, -1, 0}, .sky = {0.5f, 0.5f, 0.5f}, .sky_tilt = {0.4f, 0, -0.4f}};
    /* 90 degrees upwards and downwards from the horizon's middle. */
    camera c = {.eye = {0, 0, 1}, .up = {0, 1, 0}, .fov_y_rad = 1.5707963f, .near_plane = 0.1f, .far_plane = 9};
    const scene_view view = camera_view(&c, FRAME_SIZE, FRAME_SIZE);
    SCOPED(drawn) frame drawn = frame_draw(s, &view, &lighting, 0);
    for (int y = 0; y < FRAME_SIZE; y += 7) {
        const double up = 2 * (y + 0.5) / FRAME_SIZE - 1, side = 1 - 1.0 / FRAME_SIZE;
        const double height = up / sqrt(up * up + side * side + 1);
        frame_assert_color(drawn.color[y * FRAME_SIZE], 0.5 + 0.4 * height, 0.5, 0.5 - 0.4 * height);
    }
    frame_assert_color(drawn.color[FRAME_MIDDLE], 1, 1, 1);
    assert_int_equal(drawn.counts.sky, 1);
}

TEST_GL(outside_the_view_nothing_is_drawn)
{
    SCOPED(memory) small_scene *s = small_scene_create();
    for (int k = 0; k < 9; k++) { /* the middle one is inside the picture; its two neighbours reach in by a corner */
        const float m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.4f * (float)(k - 4), 0, 0, 1};
        frame_add_quad(s, small_scene_material(), m);
    }
    /* All its corners are outside the picture, and it fills the picture. */
    const float large[16] = {10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 1, 0, 0, 0, -0.5f, 1};
    frame_add_quad(s, small_scene_material(), large);
    const scene_lighting lighting = scene_default_lighting();
    SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
    assert_int_equal(frame_count_drawn(&drawn, FRAME_SIZE * FRAME_SIZE), FRAME_SIZE * FRAME_SIZE);
    assert_int_equal(drawn.counts.main, 4);
    assert_int_equal(drawn.counts.normals, 4);
    assert_int_equal(drawn.counts.culled, 6);
}

static bool uses(const scene_effect *effects, const char *name)
{
    for (int i = 0; i < SCENE_EFFECT_COUNT; i++)
        if (!strcmp(effects[i].name, name))
            return effects[i].used;
    fail_msg("no effect called %s", name);
    return false;
}

TEST_GL(effects_are_there_only_where_called_for)
{
    static const char *const names[] = {"shadow map", "normal maps", "reflections", "alpha test",
                                        "instances",  "blending",    "lights",      "sky"};
    char error[512];
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
    scene_renderer *r = scene_renderer_create(&s->scene, FAULT(error));
    scene_lighting lighting = {.ambient = {1, 1, 1}, .direction_world = {0, -1, 0}};
    scene_effect effects[SCENE_EFFECT_COUNT];
    assert_true(scene_renderer_configure(r, &lighting, &shadowed, FAULT(error))); /* no light casts a shadow */
    scene_renderer_effects(r, &lighting, effects);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        assert_false(uses(effects, names[i]));
    assert_int_equal(scene_shadow_map(r, NULL), 0);
    lighting.directional[1] = lighting.sky_tilt[0] = 1;
    assert_true(scene_renderer_configure(r, &lighting, &shadowed, FAULT(error)));
    scene_renderer_effects(r, &lighting, effects);
    assert_true(uses(effects, "shadow map") && uses(effects, "sky"));
    int size = 0;
    assert_int_not_equal(scene_shadow_map(r, &size), 0);
    assert_int_equal(size, 512);
    scene_renderer_destroy(r);

    /* All unlit: nothing receives shadows. */
    s->materials[0].unlit = true;
    r = scene_renderer_create(&s->scene, FAULT(error));
    assert_true(scene_renderer_configure(r, &lighting, &shadowed, FAULT(error)));
    assert_int_equal(scene_shadow_map(r, NULL), 0);
    scene_renderer_destroy(r);
}

/* An effect that the scene does not need changes no pixel: a renderer with every effect on takes longer and draws the
 * same picture. */
TEST_GL(everything_on_shows_the_same)
{
    static const uint8_t texel[4] = {255, 128, 255, 255};
    SCOPED(memory) small_scene *s = small_scene_create();
    for (int k = 0; k < 3; k++) { /* plain, textured, and out of sight */
        scene_material material = small_scene_material();
        material.metallic_roughness = true;
        material.roughness = 0.5f;
        material.base_color_texture = k == 1 ? small_scene_add_texture(s, 1, 1, texel) : -1;
        material.base_color[3] = 0.2f; /* below the cut-off of an alpha test */
        const float m[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, k == 2 ? 9 : 0.6f * (float)k, 0, 0, 1};
        frame_add_quad(s, material, m);
    }
    scene_lighting lighting = scene_default_lighting();
    memset(lighting.sky_tilt, 0, sizeof lighting.sky_tilt);
    scene_draw_options options = {.shadows = true, .shadow_size = 64, .specular_occlusion = true, .multi_bounce = true};
    SCOPED(drawn) frame planned = frame_draw_with(s, &frame_front, &lighting, &options, 0);
    options.everything = true;
    SCOPED(drawn) frame drawn = frame_draw_with(s, &frame_front, &lighting, &options, 0);
    for (int i = 0; i < FRAME_SIZE * FRAME_SIZE; i++)
        for (int k = 0; k < 3; k++)
            assert_in_range(drawn.color[i][k] - planned.color[i][k] + 1, 0, 2);
    assert_int_equal(planned.counts.main, 2);
    assert_int_equal(planned.counts.sky, 0);
    assert_int_equal(drawn.counts.main, 3);
    assert_int_equal(drawn.counts.normals, 3);
    assert_int_equal(drawn.counts.sky, 1);
}

TEST_MAIN("draw effects", fixture_setup, fixture_teardown)
