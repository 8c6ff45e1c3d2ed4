/* SPDX-License-Identifier: MIT
 *
 * The scene's draw passes, pixel by pixel: normals of every kind of instance, which triangles are visible, and that
 * the main pass covers exactly what the pre-pass covered.
 */
#include "camera.h"
#include "draw.h"
#include "draw_frame.h"
#include "fixture.h"
#include "small_scene.h"

/* ---- normals -------------------------------------------------------------------------------------------- */

TEST_GL(normals_are_in_view_space)
{
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
    /* From the right and above, so that the quad's +z is no axis of view space. */
    camera c = {.eye = {2, 1, 2}, .up = {0, 1, 0}, .fov_y_rad = 0.6f, .near_plane = 1, .far_plane = 9};
    const scene_view view = camera_view(&c, FRAME_SIZE, FRAME_SIZE);
    const scene_lighting lighting = scene_default_lighting();
    SCOPED(drawn) frame drawn = frame_draw(s, &view, &lighting, 0);
    assert_true(frame_is_drawn(&drawn, FRAME_MIDDLE));
    for (int i = 0; i < 3; i++)
        assert_float_equal(drawn.normals[4 * FRAME_MIDDLE + i], view.view_from_world[8 + i], 1e-5f);
    assert_float_equal(drawn.normals[4 * FRAME_MIDDLE + 3], 0, 0);
    assert_float_equal(drawn.normals[4 * FRAME_MIDDLE + 0], -0.70711f, 1e-4f);
    assert_float_equal(drawn.normals[4 * FRAME_MIDDLE + 1], -0.23570f, 1e-4f);
    assert_float_equal(drawn.normals[4 * FRAME_MIDDLE + 2], 0.66667f, 1e-4f);
}

TEST_GL(instances_have_the_normals_of_baked_triangles)
{
    const float scales[][3] = {{1, 1, 1},  {-1, 1, 1},     {-1, -1, -1},          {1, 3, 0.3f},
                               {2, 1, -4}, {5, 1, 0.005f}, {1e-4f, 1e-4f, 1e-4f}, {1e4f, -1e4f, 2e4f}};
    const scene_lighting lighting = scene_default_lighting();
    for (size_t k = 0; k < sizeof scales / sizeof scales[0]; k++) {
        float m[16];
        small_scene_turned_and_scaled(scales[k][0], scales[k][1], scales[k][2], m);
        SCOPED(memory) small_scene *s = small_scene_create();
        small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
        small_scene_add_sphere(s);
        small_scene_add_instance(s, m);
        SCOPED(memory) small_scene *b = small_scene_baked(s);
        const camera c = camera_frame_scene(&s->scene, 1);
        const scene_view view = camera_view(&c, FRAME_SIZE, FRAME_SIZE);
        SCOPED(drawn) frame drawn = frame_draw(s, &view, &lighting, 0), g = frame_draw(b, &view, &lighting, 0);
        int compared = 0, differently_covered = 0;
        double worst = 0;
        for (int i = 0; i < FRAME_SIZE * FRAME_SIZE; i++) {
            differently_covered += frame_is_drawn(&drawn, i) != frame_is_drawn(&g, i);
            if (!frame_is_drawn(&drawn, i) || !frame_is_drawn(&g, i))
                continue;
            compared++;
            for (int a = 0; a < 3; a++)
                worst = fmax(worst, fabs((double)drawn.normals[4 * i + a] - g.normals[4 * i + a]));
        }
        if (compared < 100 || differently_covered > 2 || !(worst < 1e-3))
            fail_msg("scale %zu: %d pixels compared, %d covered by one alone, normals differ by up to %g", k, compared,
                     differently_covered, worst);
    }
}

TEST_GL(normals_of_zero_length_face_the_viewer)
{
    SCOPED(memory) small_scene *s = frame_one_quad(small_scene_material(), NULL);
    for (int i = 0; i < 4; i++)
        memset(s->vertices[i].normal, 0, sizeof s->vertices[i].normal);
    const scene_lighting lighting = scene_default_lighting();
    SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
    const float facing[4] = {0, 0, 1, 0};
    assert_memory_equal(drawn.normals + 4 * FRAME_MIDDLE, facing, sizeof facing);
}

/* ---- which triangles are visible ------------------------------------------------------------------------ */

static const float mirrored[16] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
static const float turned_round[16] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
static const float mirrored_and_turned[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};

TEST_GL(fronts_are_drawn_and_backs_culled)
{
    const int quarter = FRAME_SIZE * FRAME_SIZE / 4;
    assert_int_equal(frame_count_drawn_by(frame_one_quad(small_scene_material(), NULL)), quarter);
    assert_int_equal(frame_count_drawn_by(frame_one_quad(small_scene_material(), turned_round)), 0);
}

TEST_GL(mirrored_instances_keep_their_fronts)
{
    const int quarter = FRAME_SIZE * FRAME_SIZE / 4;
    assert_int_equal(frame_count_drawn_by(frame_one_quad(small_scene_material(), mirrored)), quarter);
    assert_int_equal(frame_count_drawn_by(frame_one_quad(small_scene_material(), mirrored_and_turned)), 0);
}

TEST_GL(double_sided_backs_show_normals_that_face_the_viewer)
{
    scene_material material = small_scene_material();
    material.double_sided = true;
    const float *placements[] = {NULL, mirrored, turned_round, mirrored_and_turned};
    const scene_lighting lighting = scene_default_lighting();
    for (int k = 0; k < 4; k++) {
        SCOPED(memory) small_scene *s = frame_one_quad(material, placements[k]);
        SCOPED(drawn) frame drawn = frame_draw(s, &frame_front, &lighting, 0);
        assert_int_equal(frame_count_drawn(&drawn, FRAME_SIZE * FRAME_SIZE), FRAME_SIZE * FRAME_SIZE / 4);
        assert_float_equal(drawn.normals[4 * FRAME_MIDDLE + 2], 1, 1e-6f);
    }
}

TEST_GL(mixed_instances_of_a_mesh_are_all_drawn)
{
    small_scene *s = small_scene_create();
    for (int k = 0; k < 16; k++) {
        float m[16] = {0.125f, 0, 0, 0, 0, 0.125f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        m[0] *= k % 3 ? 1.0f : -1.0f;
        m[12] = (float)(k % 4) * 0.5f - 0.75f;
        m[13] = (float)(k / 4) * 0.5f - 0.75f;
        if (k == 0)
            frame_add_quad(s, small_scene_material(), m);
        else
            small_scene_add_instance(s, m);
    }
    assert_int_equal(frame_count_drawn_by(s), 16 * (FRAME_SIZE / 16) * (FRAME_SIZE / 16));
}

/* Every material variant and instances of all kinds, in perspective: the main pass matches the pre-pass's depth. */
TEST_GL(depth_equal_covers_what_the_prepass_covered)
{
    enum { LARGE = 256 };
    static const uint8_t checker[2 * 2 * 4] = {90, 90, 90, 255, 90, 90, 90, 0, 90, 90, 90, 0, 90, 90, 90, 255};
    SCOPED(memory) small_scene *s = small_scene_create();
    const int texture = small_scene_add_texture(s, 2, 2, checker);
    uint32_t random = 1;
    for (int variant = 0; variant < 32; variant++) {
        scene_material material = small_scene_material();
        material.base_color_texture = variant & 1 ? texture : -1;
        material.alpha = variant & 2 ? SCENE_ALPHA_MASK : SCENE_ALPHA_OPAQUE;
        material.double_sided = variant & 4;
        material.unlit = variant & 8;
        small_scene_begin_mesh(s, small_scene_add_material(s, material));
        const uint32_t first = s->scene.vertex_count;
        small_scene_add_sphere(s);
        for (uint32_t i = first; variant & 16 && i < s->scene.vertex_count; i++)
            s->vertices[i].color[3] = (float)(i % 2);
        for (int k = 0; k < 4; k++) {
            float m[16] = {0}, random_parts[6];
            for (int i = 0; i < 6; i++) {
                random = random * 1664525u + 1013904223u;
                random_parts[i] = (float)(random >> 8) / 16777216.0f - 0.5f;
            }
            small_scene_turned_and_scaled(1 + random_parts[0], k % 2 ? -1.0f : 1.0f, 1 + random_parts[1], m);
            for (int i = 0; i < 3; i++)
                m[12 + i] = 9 * random_parts[2 + i];
            small_scene_add_instance(s, m);
        }
    }
    const camera c = camera_frame_scene(&s->scene, 1);
    const scene_view view = camera_view(&c, LARGE, LARGE);
    const scene_lighting lighting = {.ambient = {0.5f, 0.5f, 0.5f}, .direction_world = {0, -1, 0}, .sky = {1, 0, 1}};
    SCOPED(drawn) frame drawn = frame_draw(s, &view, &lighting, 0);
    int differing = 0;
    for (int i = 0; i < LARGE * LARGE; i++)
        differing += frame_is_drawn(&drawn, i) != (drawn.color[i][1] != 0);
    assert_true(frame_count_drawn(&drawn, LARGE * LARGE) > LARGE * LARGE / 5);
    assert_int_equal(differing, 0);
    /* Without a pre-pass, the main pass finds the same surfaces itself. */
    const scene_draw_options alone = {.no_prepass = true};
    SCOPED(drawn) frame g = frame_draw_with(s, &view, &lighting, &alone, 0);
    assert_memory_equal(drawn.color, g.color, LARGE * LARGE * sizeof *drawn.color);
    assert_memory_equal(drawn.depth, g.depth, LARGE * LARGE * sizeof *drawn.depth);
    assert_int_equal(g.counts.normals, 0);
}

TEST_MAIN("draw", fixture_setup, fixture_teardown)
