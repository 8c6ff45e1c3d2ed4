/* SPDX-License-Identifier: MIT
 *
 * The built-in scenes.
 */
#include "scene_scopes.h"
#include "scene_validity.h"

static const char *const names[] = {"columns", "cornell", "steps", "plane"};

TEST(built_in_scenes_are_valid_and_suggest_a_camera)
{
    for (int i = 0; i < 4; ++i) {
        char error[256] = "";
        SCOPED(scene) scene *s = scene_make(names[i], FAULT(error));
        assert_non_null(s);
        assert_null(scene_find_flaw(s));
        assert_string_equal(s->name, names[i]);
        assert_int_equal(s->camera_count, 1);
        assert_true(scene_count_triangles(s) > 100);
    }
}

/* Triangles face along their normals, as back-face culling requires. */
TEST(built_in_scenes_wind_counter_clockwise)
{
    for (int i = 0; i < 4; ++i) {
        scene *s = scene_make(names[i], &(failure){0});
        assert_non_null(s);
        for (uint32_t k = 0; k < s->index_count; k += 3) {
            const scene_vertex *v[3];
            float face = 0;
            for (uint32_t j = 0; j < 3; ++j)
                v[j] = &s->vertices[s->indices[k + j]];
            for (int x = 0; x < 3; ++x) {
                const int y = (x + 1) % 3, z = (x + 2) % 3;
                const float cross = (v[1]->position[y] - v[0]->position[y]) * (v[2]->position[z] - v[0]->position[z]) -
                                    (v[1]->position[z] - v[0]->position[z]) * (v[2]->position[y] - v[0]->position[y]);
                face += cross * (v[0]->normal[x] + v[1]->normal[x] + v[2]->normal[x]);
            }
            assert_true(face > 0);
        }
        scene_destroy(s);
    }
}

TEST(columns_stand_in_two_rows)
{
    SCOPED(scene) scene *s = scene_make("columns", &(failure){0});
    assert_memory_equal(s->bounds_min, ((float[3]){-10, 0, -15}), 3 * sizeof(float));
    assert_memory_equal(s->bounds_max, ((float[3]){10, 4, 15}), 3 * sizeof(float));
    assert_int_equal(s->instance_count, 22);
}

TEST(an_unknown_name_is_an_error)
{
    char error[256] = "";
    assert_null(scene_make("sponza", FAULT(error)));
    assert_non_null(strstr(error, "sponza"));
    assert_null(scene_make("", &(failure){0}));
    scene_destroy(NULL);
}

TEST_MAIN(NULL, NULL, NULL)
