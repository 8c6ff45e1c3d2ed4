/* SPDX-License-Identifier: MIT
 *
 * Draws what other scenes do not have: primitives without normals, lines and points, and four uv sets.
 */
#include "draw.h"
#include "draw_frame.h"
#include "fixture.h"
#include "small_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A quad, turned, seen without perspective, and a second one mirrored and double-sided. Each has its plane's normals.
 */
static small_scene *turned_quads(bool flat)
{
    float place[16];
    small_scene *s = small_scene_create();
    for (int i = 0; i < 2; i++) {
        scene_material material = small_scene_material();
        material.double_sided = i == 1;
        small_scene_turned_and_scaled(i == 1 ? -1.3f : 1.1f, 0.9f, 1, place);
        place[12] = i == 1 ? -0.6f : 0.5f;
        frame_add_quad(s, material, place);
    }
    for (uint32_t i = 0; flat && i < s->scene.primitive_count; i++)
        s->primitives[i].flat = true;
    for (uint32_t i = 0; flat && i < s->scene.vertex_count; i++)
        memcpy(s->vertices[i].normal, (float[3]){0, 1, 0}, sizeof s->vertices[i].normal); /* not to be used */
    return s;
}

static void flat_primitives_take_the_normal_of_their_triangles(void **state)
{
    (void)state;
    const scene_lighting lighting = scene_default_lighting();
    small_scene *scenes[2] = {turned_quads(false), turned_quads(true)};
    frame frames[2];
    for (int i = 0; i < 2; i++)
        frames[i] = frame_draw(scenes[i], &frame_front, &lighting, 0);
    const int drawn = frame_count_drawn(&frames[0], FRAME_SIZE * FRAME_SIZE);
    assert_true(drawn > FRAME_SIZE * FRAME_SIZE / 8);
    for (int i = 0; i < FRAME_SIZE * FRAME_SIZE; i++) {
        assert_int_equal(frame_is_drawn(&frames[0], i), frame_is_drawn(&frames[1], i));
        for (int c = 0; c < 3; c++) {
            assert_float_equal(frames[0].normals[4 * i + c], frames[1].normals[4 * i + c], 1e-4f);
            assert_true(abs(frames[0].color[i][c] - frames[1].color[i][c]) <= 1);
        }
    }
    for (int i = 0; i < 2; i++) {
        frame_free(&frames[i]);
        free(scenes[i]);
    }
}

/* A red quad at z = 0, and a primitive of that topology with two vertices at x = -0.4 and 0.4, y = 1/64, in blue. */
static small_scene *with_thin(scene_topology topology, float z)
{
    scene_material red = small_scene_material(), blue = small_scene_material();
    red.unlit = blue.unlit = true;
    memcpy(red.base_color, (float[4]){1, 0, 0, 1}, sizeof red.base_color);
    memcpy(blue.base_color, (float[4]){0, 0, 1, 1}, sizeof blue.base_color);
    small_scene *s = frame_one_quad(red, NULL);
    small_scene_begin_mesh(s, small_scene_add_material(s, blue));
    scene_primitive *p = &s->primitives[s->scene.primitive_count - 1];
    p->topology = topology;
    p->index_count = 2;
    for (uint32_t i = 0; i < 2; i++) {
        scene_vertex *v = &s->vertices[s->scene.vertex_count];
        *v = (scene_vertex){.position = {i ? 0.4f : -0.4f, 1.0f / 64, z}, .normal = {0, 0, 1}, .color = {1, 1, 1, 1}};
        for (int axis = 0; axis < 3; axis++) {
            p->bounds_min[axis] = fminf(p->bounds_min[axis], v->position[axis]);
            p->bounds_max[axis] = fmaxf(p->bounds_max[axis], v->position[axis]);
        }
        s->indices[s->scene.index_count++] = s->scene.vertex_count++;
    }
    small_scene_add_instance(s, NULL);
    return s;
}

static int count_blue(const frame *f)
{
    int count = 0;
    for (int i = 0; i < FRAME_SIZE * FRAME_SIZE; i++)
        count += f->color[i][2] == 255 && f->color[i][0] == 0;
    return count;
}

static void lines_and_points_are_drawn_over_what_is_behind_them(void **state)
{
    (void)state;
    const scene_lighting lighting = {.direction_world = {0, -1, 0}};
    static const struct {
        scene_topology topology;
        float z;
        int least, most;
    } cases[] = {{SCENE_LINES, 0.5f, 24, 27},
                 {SCENE_LINES, -0.5f, 0, 0},
                 {SCENE_POINTS, 0.5f, 2, 2},
                 {SCENE_POINTS, -0.5f, 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        small_scene *s = with_thin(cases[i].topology, cases[i].z);
        frame f = frame_draw(s, &frame_front, &lighting, 0);
        const int blue = count_blue(&f);
        if (blue < cases[i].least || blue > cases[i].most)
            fail_msg("case %zu: %d blue pixels", i, blue);
        /* Not in the pre-pass, so that they receive no occlusion and cast none. */
        assert_int_equal(frame_count_drawn(&f, FRAME_SIZE * FRAME_SIZE), FRAME_SIZE * FRAME_SIZE / 4);
        assert_int_equal(f.counts.normals, 1);
        assert_int_equal(f.counts.main, 2);
        frame_free(&f);
        free(s);
    }
}

/* Emission reads a uv set of its own: the texture's left half is black, its right half white. */
static void each_map_reads_its_uv_set(void **state)
{
    (void)state;
    static const uint8_t halves[2 * 4] = {0, 0, 0, 255, 255, 255, 255, 255};
    const scene_lighting lighting = {.direction_world = {0, -1, 0}};
    float more_uvs[4][2][2];
    for (int slot = 0; slot < 4; slot++) {
        scene_material material = small_scene_material();
        memcpy(material.base_color, (float[4]){0, 0, 0, 1}, sizeof material.base_color);
        material.emissive[0] = material.emissive[1] = material.emissive[2] = 1;
        material.emissive_map = (scene_map){.used = true, .uv = slot, .uv_from_uv = {1, 0, 0, 0, 1, 0}};
        for (int white = 0; white < 2; white++) {
            small_scene *s = frame_one_quad(material, NULL);
            small_scene_add_texture(s, 2, 1, halves);
            for (int i = 0; i < 4; i++)
                for (int set = 0; set < 4; set++) {
                    /* The slot read points to one half, all others to the other. */
                    float *uv = set < 2 ? s->vertices[i].uv[set] : more_uvs[i][set - 2];
                    uv[0] = (set == slot) == (white == 1) ? 0.75f : 0.25f;
                    uv[1] = 0.5f;
                }
            s->scene.more_uvs = more_uvs;
            frame f = frame_draw(s, &frame_front, &lighting, 0);
            assert_int_equal(f.color[FRAME_MIDDLE][0], white ? 255 : 0);
            frame_free(&f);
            free(s);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_primitives_take_the_normal_of_their_triangles),
        cmocka_unit_test(lines_and_points_are_drawn_over_what_is_behind_them),
        cmocka_unit_test(each_map_reads_its_uv_set),
    };
    return cmocka_run_group_tests(tests, fixture_setup, fixture_teardown);
}
