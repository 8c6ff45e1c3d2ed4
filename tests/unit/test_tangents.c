/* SPDX-License-Identifier: MIT
 *
 * Tangents for normal maps: known ones, seams, surfaces whose uvs say nothing, and those that another MikkTSpace wrote
 * into a file.
 */
#include "fixture.h"
#include "small_scene.h"
#include "tangent_space.h"

static float (*make(const small_scene *s))[4]
{
    float(*out)[4] = malloc(s->scene.index_count * sizeof *out);
    assert_true(tangent_space_make(s->vertices, 0, s->indices, s->scene.index_count, out));
    return out;
}

static small_scene *quad(void)
{
    static const float corner[3] = {-1, -1, 0}, u[3] = {2, 0, 0}, v[3] = {0, 2, 0};
    small_scene *s = small_scene_create();
    small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
    small_scene_add_quad(s, corner, u, v);
    return s;
}

/* Green of a normal map points to where its rows begin, against v: up on this quad. */
TEST(quad_has_its_us_direction_and_a_bitangent_against_v)
{
    for (int k = 0; k < 12; k++) {
        const bool mirrored = k % 2;
        const double angle = 0.5 * (k / 2);
        SCOPED(memory) small_scene *s = quad();
        for (int i = 0; i < 4; i++) {
            float *uv = s->vertices[i].uv[0];
            const double x = (double)uv[0] - 0.5, y = 0.5 - (double)uv[1];
            uv[0] = (float)((mirrored ? -1 : 1) * (cos(angle) * x + sin(angle) * y));
            uv[1] = (float)-(-sin(angle) * x + cos(angle) * y);
        }
        float(*t)[4] = make(s);
        for (uint32_t i = 0; i < s->scene.index_count; i++) {
            const double sign = mirrored ? -1 : 1;
            assert_float_equal(t[i][0], (float)(sign * cos(angle)), 1e-5f);
            assert_float_equal(t[i][1], (float)(sign * sin(angle)), 1e-5f);
            assert_float_equal(t[i][2], 0, 1e-5f);
            assert_float_equal(t[i][3], (float)sign, 0);
        }
        free(t);
    }
}

/* Two quads whose uvs mirror each other at their common edge: each keeps its own side's tangent. */
TEST(mirrored_seam_is_not_averaged)
{
    static const float left[3] = {-1, 0, 0}, right[3] = {0, 0, 0}, u[3] = {1, 0, 0}, v[3] = {0, 1, 0};
    SCOPED(memory) small_scene *s = small_scene_create();
    small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
    small_scene_add_quad(s, left, u, v);
    small_scene_add_quad(s, right, u, v);
    for (int i = 4; i < 8; i++)
        s->vertices[i].uv[0][0] = 1 - s->vertices[i].uv[0][0];
    float(*t)[4] = make(s);
    for (uint32_t i = 0; i < s->scene.index_count; i++) {
        const float side = i < s->scene.index_count / 2 ? 1.0f : -1.0f;
        assert_float_equal(t[i][0], side, 1e-5f);
        assert_float_equal(t[i][3], side, 0);
    }
    free(t);
}

/* Equal vertices count as one, with or without an index buffer. */
TEST(split_vertices_give_the_same_as_shared_ones)
{
    SCOPED(memory) small_scene *s = small_scene_create();
    small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
    small_scene_add_sphere(s);
    float(*shared)[4] = make(s);
    SCOPED(memory) small_scene *flat = small_scene_create();
    for (uint32_t i = 0; i < s->scene.index_count; i++) {
        flat->vertices[i] = s->vertices[s->indices[i]];
        flat->indices[i] = i;
    }
    flat->scene.index_count = s->scene.index_count;
    float(*split)[4] = make(flat);
    for (uint32_t i = 0; i < s->scene.index_count; i++)
        for (int k = 0; k < 4; k++)
            assert_float_equal(shared[i][k], split[i][k], 1e-6f);
    free(shared);
    free(split);
}

TEST(uvs_without_direction_give_some_tangent)
{
    for (int k = 0; k < 3; k++) {
        SCOPED(memory) small_scene *s = quad();
        for (int i = 0; i < 4; i++) {
            if (k == 0) /* all at one point; on a line; two corners at one point */
                memset(s->vertices[i].uv, 0, sizeof s->vertices[i].uv);
            else if (k == 1)
                s->vertices[i].uv[0][1] = s->vertices[i].uv[0][0];
            else if (i == 1)
                memcpy(s->vertices[1].position, s->vertices[0].position, sizeof s->vertices[0].position);
        }
        float(*t)[4] = make(s);
        for (uint32_t i = 0; i < s->scene.index_count; i++) {
            assert_float_equal(t[i][0] * t[i][0] + t[i][1] * t[i][1] + t[i][2] * t[i][2], 1, 1e-5f);
            assert_float_equal(t[i][2], 0, 1e-5f);
            assert_true(fabsf(t[i][3]) == 1);
        }
        free(t);
    }
}

/* MikkTSpace made the Flight Helmet's tangents. */
TEST(file_made_by_mikktspace_has_the_same)
{
    char path[4096], error[512];
    const char *folder = getenv("GLSSAO_SHARED_SCENES");
    snprintf(path, sizeof path, "%s/flight-helmet/FlightHelmet.gltf", folder ? folder : "");
    FILE *file = fopen(path, "rb");
    if (!file) {
        print_message("skipped: no %s\n", path);
        skip();
    }
    fclose(file);
    SCOPED(scene) scene *s = scene_load(path, FAULT(error));
    if (!s)
        fail_msg("%s", error);
    assert_non_null(s->tangents);
    uint32_t corners = 0, near = 0;
    for (uint32_t p = 0; p < s->primitive_count; p++) {
        const scene_primitive *primitive = &s->primitives[p];
        if (!s->materials[primitive->material].normal_map.used)
            continue;
        float(*t)[4] = malloc(primitive->index_count * sizeof *t);
        assert_true(tangent_space_make(s->vertices, s->materials[primitive->material].normal_map.uv,
                                       s->indices + primitive->first_index, primitive->index_count, t));
        for (uint32_t i = 0; i < primitive->index_count; i++) {
            const float *f = s->tangents[s->indices[primitive->first_index + i]];
            corners++;
            near += t[i][0] * f[0] + t[i][1] * f[1] + t[i][2] * f[2] > 0.996f && t[i][3] == f[3]; /* 5 degrees */
        }
        free(t);
    }
    print_message("%u of %u corners within 5 degrees\n", near, corners);
    assert_true(corners > 200000 && near > 0.95 * corners);
}

TEST_MAIN("tangents", NULL, NULL)
