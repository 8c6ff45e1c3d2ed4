/* SPDX-License-Identifier: MIT
 *
 * How each kind of material changes colour, normals and depth.
 */
#include "draw.h"
#include "draw_frame.h"
#include "fixture.h"
#include "small_scene.h"

TEST_GL(mask_draws_where_alpha_reaches_the_cutoff)
{
    static const uint8_t halves[2 * 1 * 4] = {255, 255, 255, 51, 255, 255, 255, 204};
    scene_material material = small_scene_material();
    material.alpha = SCENE_ALPHA_MASK;
    material.base_color[3] = 0.5f;
    assert_int_equal(frame_count_drawn_by(frame_one_quad(material, NULL)), FRAME_SIZE * FRAME_SIZE / 4);
    material.alpha_cutoff = 0.51f;
    assert_int_equal(frame_count_drawn_by(frame_one_quad(material, NULL)), 0);

    material.base_color[3] = 1;
    material.base_color_texture = 0;
    small_scene *s = frame_one_quad(material, NULL);
    small_scene_add_texture(s, 2, 1, halves);
    assert_int_equal(frame_count_drawn_by(s), FRAME_SIZE * FRAME_SIZE / 8);

    material.alpha = SCENE_ALPHA_OPAQUE;
    s = frame_one_quad(material, NULL);
    small_scene_add_texture(s, 2, 1, halves);
    assert_int_equal(frame_count_drawn_by(s), FRAME_SIZE * FRAME_SIZE / 4);
}

TEST_GL(blended_adds_colour_but_no_depth_and_no_normal)
{
    scene_material material = small_scene_material();
    material.alpha = SCENE_ALPHA_BLEND;
    material.unlit = true;
    memcpy(material.base_color, (float[4]){0.8f, 0.2f, 0, 0.25f}, sizeof material.base_color);
    SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
    scene_lighting lighting = {.direction_world = {0, -1, 0}, .sky = {0.1f, 0.5f, 0.9f}};
    SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
    assert_int_equal(frame_count_drawn(&drawn, FRAME_SIZE * FRAME_SIZE), 0);
    assert_float_equal(drawn.depth[FRAME_MIDDLE], 1, 0);
    frame_assert_color(drawn.color[0], 0.1, 0.5, 0.9);
    frame_assert_color(drawn.color[FRAME_MIDDLE], 0.25 * 0.8 + 0.75 * 0.1, 0.25 * 0.2 + 0.75 * 0.5, 0.75 * 0.9);
}

TEST_GL(blended_is_drawn_back_to_front)
{
    scene_lighting lighting = {.direction_world = {0, -1, 0}};
    for (int red_first = 0; red_first < 2; red_first++) {
        SCOPED(memory) small_scene *s = small_scene_create();
        for (int k = 0; k < 2; k++) {
            const bool red = k != red_first;
            const float place[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, red ? 0.5f : -0.5f, 1};
            scene_material material = small_scene_material();
            material.alpha = SCENE_ALPHA_BLEND;
            material.unlit = true;
            memcpy(material.base_color, red ? (float[4]){1, 0, 0, 0.5f} : (float[4]){0, 1, 0, 0.5f},
                   sizeof material.base_color);
            frame_add_quad(s, material, place);
        }
        SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
        frame_assert_color(drawn.color[FRAME_MIDDLE], 0.5, 0.25, 0);
    }
}

TEST_GL(blended_is_hidden_by_opaque_in_front)
{
    scene_material opaque = small_scene_material(), blended = small_scene_material();
    opaque.unlit = blended.unlit = true;
    blended.alpha = SCENE_ALPHA_BLEND;
    memcpy(blended.base_color, (float[4]){1, 0, 0, 0.5f}, sizeof blended.base_color);
    const float behind[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -0.5f, 1};
    SCOPED(memory) small_scene *s = frame_one_quad(opaque, NULL);
    frame_add_quad(s, blended, behind);
    scene_lighting lighting = {.direction_world = {0, -1, 0}};
    SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
    frame_assert_color(drawn.color[FRAME_MIDDLE], 1, 1, 1);
}

TEST_GL(accessibility_scales_ambient_light_alone)
{
    const float half = 0.5f;
    const float pi = 3.14159265f;
    GLuint map;
    gl.GenTextures(1, &map);
    gl.BindTexture(GL_TEXTURE_2D, map);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R16, 1, 1, 0, GL_RED, GL_FLOAT, &half);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    /* Light at 60 degrees to the quad's normal. */
    const scene_lighting lighting = {.ambient = {0.4f, 0.2f, 0.1f},
                                     .direction_world = {0.8660254f, 0, -0.5f},
                                     .directional = {0.2f * pi, 0.4f * pi, 0.6f * pi}};
    scene_material material = small_scene_material();
    memcpy(material.base_color, (float[4]){0.5f, 1, 0.25f, 1}, sizeof material.base_color);
    for (int mode = 0; mode < 4; mode++) { /* bit 0: with the map, bit 1: unlit */
        const double access = mode & 1 ? 0.5 : 1;
        material.unlit = mode & 2;
        SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
        SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, mode & 1 ? map : 0);
        if (material.unlit)
            frame_assert_color(drawn.color[FRAME_MIDDLE], 0.5, 1, 0.25);
        else
            frame_assert_color(drawn.color[FRAME_MIDDLE], 0.5 * (0.4 * access + 0.1), 0.2 * access + 0.2,
                               0.25 * (0.1 * access + 0.3));
    }
    gl.DeleteTextures(1, &map);
}

/* uv (0, 0) of the quad is its upper left corner, and so is the first texel of the image. */
TEST_GL(texels_are_where_the_uvs_say)
{
    static const uint8_t texels[2 * 2 * 4] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
    static const double colors[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    /* The texels at the upper left, upper right, lower left and lower right of the picture. */
    static const struct {
        int uv_set;
        float transform[6];
        int texels[4];
    } cases[] = {
        {0, {1, 0, 0, 0, 1, 0}, {0, 1, 2, 3}},
        {1, {1, 0, 0, 0, 1, 0}, {0, 2, 1, 3}},    /* the second set has u and v swapped */
        {0, {1, 0, 0.5f, 0, 1, 0}, {1, 0, 3, 2}}, /* shifted by half a picture, wrapping around */
        {0, {0, 1, 0, -1, 0, 1}, {2, 0, 3, 1}},   /* u' = v, v' = 1 - u */
    };
    const int at[4] = {
        FRAME_SIZE * 5 / 8 * FRAME_SIZE + FRAME_SIZE * 3 / 8, FRAME_SIZE * 5 / 8 * FRAME_SIZE + FRAME_SIZE * 5 / 8,
        FRAME_SIZE * 3 / 8 * FRAME_SIZE + FRAME_SIZE * 3 / 8, FRAME_SIZE * 3 / 8 * FRAME_SIZE + FRAME_SIZE * 5 / 8};
    scene_lighting lighting = {.direction_world = {0, -1, 0}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        scene_material material = small_scene_material();
        material.unlit = true;
        material.base_color_texture = 0;
        material.base_color_uv = cases[k].uv_set;
        memcpy(material.base_color_uv_from_uv, cases[k].transform, sizeof material.base_color_uv_from_uv);
        SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
        small_scene_add_texture(s, 2, 2, texels);
        SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
        for (int i = 0; i < 4; i++) {
            const double *color = colors[cases[k].texels[i]];
            frame_assert_color(drawn.color[at[i]], color[0], color[1], color[2]);
        }
    }
}

TEST_GL(vertex_colour_multiplies_base_colour)
{
    scene_material material = small_scene_material();
    material.unlit = true;
    material.base_color[0] = 0.5f;
    SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
    for (int i = 0; i < 4; i++)
        memcpy(s->vertices[i].color, (float[4]){0.5f, 0.25f, 0.75f, 1}, sizeof s->vertices[i].color);
    scene_lighting lighting = {.direction_world = {0, -1, 0}};
    SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
    frame_assert_color(drawn.color[FRAME_MIDDLE], 0.25, 0.25, 0.75);
}

TEST_GL(empty_scene_is_all_sky)
{
    SCOPED(memory) small_scene *s = small_scene_create();
    small_scene_add_material(s, small_scene_material());
    scene_lighting lighting = {.direction_world = {0, -1, 0}, .sky = {0.2f, 0.4f, 0.6f}};
    SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
    assert_int_equal(frame_count_drawn(&drawn, FRAME_SIZE * FRAME_SIZE), 0);
    frame_assert_color(drawn.color[FRAME_MIDDLE], 0.2, 0.4, 0.6);
}

TEST_GL(images_beyond_the_driver_are_refused)
{
    static const uint8_t texel[4];
    scene_material material = small_scene_material();
    material.base_color_texture = 0;
    SCOPED(memory) small_scene *s = frame_one_quad(material, NULL);
    small_scene_add_texture(s, 1 << 20, 1, texel);
    char error[512] = "";
    assert_null(scene_renderer_create(&s->scene, FAULT(error)));
    assert_non_null(strstr(error, "1048576 x 1"));
    /* An unused one does no harm. */
    s->materials[0].base_color_texture = -1;
    SCOPED(renderer) scene_renderer *r = scene_renderer_create(&s->scene, FAULT(error));
    assert_non_null(r);
    scene_renderer_destroy(NULL);
}

TEST_MAIN("draw materials", fixture_setup, fixture_teardown)
