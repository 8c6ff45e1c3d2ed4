/* SPDX-License-Identifier: MIT
 *
 * The examples' full-screen passes: view distance from window depth for every kind of projection, and the display of
 * maps.
 */
#include "draw.h"
#include "fixture.h"
#include "small_scene.h"

enum { COUNT = 64 }; /* pixels in a row */

typedef struct passes {
    small_scene *scene;
    scene_renderer *renderer;
    fixture_target map; /* RGBA32F, of COUNT x 1 */
} passes;

static passes make_passes(void)
{
    char error[512];
    passes p = {.scene = small_scene_create()};
    p.renderer = scene_renderer_create(&p.scene->scene, FAULT(error));
    assert_non_null(p.renderer);
    p.map = fixture_make_target(GL_RGBA32F, COUNT, 1);
    return p;
}

static void free_passes(passes *p)
{
    fixture_delete_target(&p->map);
    scene_renderer_destroy(p->renderer);
    free(p->scene);
}

/* Rows z and w of a projection: ndc_z = (a z + b) / (c z + e). */
typedef struct projection {
    const char *name;
    double a, b, c, e;
    double nearest, farthest; /* distances tried */
} projection;

static double depth_at(const projection *p, double distance)
{
    const double z = -distance;
    return 0.5 + 0.5 * (p->a * z + p->b) / (p->c * z + p->e);
}

TEST_GL(view_distance_is_the_analytic_one)
{
    const double n = 0.25, far = 64;
    const projection projections[] = {
        {"perspective", -(far + n) / (far - n), -2 * far * n / (far - n), -1, 0, n, 0.99 * far},
        {"infinite", -1, -2 * n, -1, 0, n, 500},
        {"reversed", (far + n) / (far - n), 2 * far * n / (far - n), -1, 0, n, 0.99 * far},
        {"reversed infinite", 1, 2 * n, -1, 0, n, 500},
        {"orthographic", -2 / (far - n), -(far + n) / (far - n), 0, 1, n, 0.99 * far},
        {"reversed orthographic", 2 / (far - n), (far + n) / (far - n), 0, 1, n, 0.99 * far},
        /* Planes on both sides of the eye; those behind it have a negative distance. */
        {"orthographic from behind", -2 / (far + 100), -(far - 100) / (far + 100), 0, 1, -99, 0.99 * far},
        {"tiny perspective", -(far + n) / (far - n), -2e-4 * far * n / (far - n), -1, 0, 1e-4 * n, 0.99e-4 * far},
    };
    passes p = make_passes();
    for (size_t k = 0; k < sizeof projections / sizeof projections[0]; k++) {
        const projection *q = &projections[k];
        float depth[COUNT];
        double distance[COUNT];
        for (int i = 0; i < COUNT - 1; i++) {
            /* Even steps in the quantity that depth is linear in, so that rounding of the depth map does not matter. */
            const double t = (i + 0.5) / (COUNT - 1);
            distance[i] =
                q->c != 0 ? 1 / ((1 - t) / q->nearest + t / q->farthest) : (1 - t) * q->nearest + t * q->farthest;
            depth[i] = (float)depth_at(q, distance[i]);
        }
        const bool reversed = depth_at(q, q->nearest) > depth_at(q, q->farthest);
        depth[COUNT - 1] = reversed ? 0 : 1;
        SCOPED(texture) GLuint depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT32F, COUNT, 1, depth);
        const scene_view view = {.clip_from_view = {1.5f, 0, 0, 0, 0, 2, 0, 0, 0.25f, -0.5f, (float)q->a, (float)q->c,
                                                    0, 0, (float)q->b, (float)q->e},
                                 .width = COUNT,
                                 .height = 1};
        scene_draw_view_distance(p.renderer, &view, depth_texture);
        SCOPED(memory) float *got = fixture_read_texture(p.map.texture, COUNT, 1, 1);
        for (int i = 0; i < COUNT - 1; i++)
            if (!(fabs((double)got[i] - distance[i]) <= 1e-4 * fmax(fabs(distance[i]), q->c != 0 ? 0 : 1)))
                fail_msg("%s: distance %g, not %g", q->name, (double)got[i], distance[i]);
        if (got[COUNT - 1] != 0)
            fail_msg("%s: the sky's distance is %g, not 0", q->name, (double)got[COUNT - 1]);
    }
    free_passes(&p);
}

TEST_GL(map_keeps_its_orientation_and_values)
{
    passes p = make_passes();
    SCOPED(texture) GLuint map = 0;
    float texels[COUNT * 3];
    for (int i = 0; i < COUNT * 3; i++)
        texels[i] = (float)i;
    gl.GenTextures(1, &map);
    gl.BindTexture(GL_TEXTURE_2D, map);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, COUNT, 1, 0, GL_RGB, GL_FLOAT, texels);
    for (int red_only = 0; red_only < 2; red_only++) {
        scene_draw_map(p.renderer, map, COUNT, 1, red_only, 2, 0.5f);
        SCOPED(memory) float *got = fixture_read_texture(p.map.texture, COUNT, 1, 4);
        for (int i = 0; i < COUNT; i++) {
            for (int c = 0; c < 3; c++)
                assert_float_equal(got[4 * i + c], 2 * texels[3 * i + (red_only ? 0 : c)] + 0.5f, 0.05f);
            assert_float_equal(got[4 * i + 3], 1, 0);
        }
    }
    free_passes(&p);
}

TEST_GL(small_map_is_spread_linearly_and_upright)
{
    const float texels[2 * 2] = {0, 1, 2, 3}; /* lower left, lower right, upper left, upper right */
    passes p = make_passes();
    SCOPED(texture) GLuint map = 0;
    gl.GenTextures(1, &map);
    gl.BindTexture(GL_TEXTURE_2D, map);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, 2, 2, 0, GL_RED, GL_FLOAT, texels);
    gl.BindTexture(GL_TEXTURE_2D, p.map.texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 4, 4, 0, GL_RGBA, GL_FLOAT, NULL);
    scene_draw_map(p.renderer, map, 4, 4, true, 1, 0);
    SCOPED(memory) float *got = fixture_read_texture(p.map.texture, 4, 4, 1);
    const float weight[4] = {0, 0.25f, 0.75f, 1}; /* of the second texel, at each pixel's centre */
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 4; x++)
            assert_float_equal(got[4 * y + x], weight[x] + 2 * weight[y], 0.01f);
    free_passes(&p);
}

TEST_GL(passes_leave_the_defaults)
{
    passes p = make_passes();
    const scene_view view = {.width = COUNT, .height = 1};
    const scene_lighting lighting = scene_default_lighting();
    const scene_draw_options options = {.motion = true};
    char error[512];
    assert_true(scene_renderer_configure(p.renderer, &lighting, &options, FAULT(error)));
    for (int k = 0; k < 5; k++) {
        /* Whatever state a pass finds, it draws the same and restores the state. */
        gl.Enable(GL_BLEND);
        gl.Enable(GL_CULL_FACE);
        gl.DepthFunc(GL_NEVER);
        gl.DepthMask(GL_FALSE);
        gl.ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
        gl.FrontFace(GL_CW);
        if (k == 0)
            scene_draw_normals(p.renderer, &view);
        else if (k == 1)
            scene_draw_main(p.renderer, &view, &lighting, 0);
        else if (k == 2)
            scene_draw_map(p.renderer, 0, COUNT, 1, false, 1, 0);
        else if (k == 3)
            scene_draw_view_distance(p.renderer, &view, 0);
        else
            scene_draw_motion(p.renderer, &view, &view);
        const GLenum disabled[] = {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_FRAMEBUFFER_SRGB};
        const GLenum zero[] = {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_ARRAY_BUFFER_BINDING,
                               GL_TEXTURE_BINDING_2D, GL_SAMPLER_BINDING};
        GLint value = -1;
        GLboolean mask[4];
        for (size_t i = 0; i < sizeof disabled / sizeof disabled[0]; i++)
            assert_false(gl.IsEnabled(disabled[i]));
        for (size_t i = 0; i < sizeof zero / sizeof zero[0]; i++) {
            gl.GetIntegerv(zero[i], &value);
            assert_int_equal(value, 0);
        }
        gl.GetIntegerv(GL_DEPTH_FUNC, &value);
        assert_int_equal(value, GL_LESS);
        gl.GetIntegerv(GL_FRONT_FACE, &value);
        assert_int_equal(value, GL_CCW);
        gl.GetBooleanv(GL_DEPTH_WRITEMASK, mask);
        assert_true(mask[0]);
        gl.GetBooleanv(GL_COLOR_WRITEMASK, mask);
        assert_true(mask[0] && mask[1] && mask[2] && mask[3]);
    }
    free_passes(&p);
}

/* A quad that faces the eye 3 units away and is moved: its mesh along x, its instance along y and z. */
static small_scene *make_moving_quad(float mesh_x, float instance_y, float instance_z, int quads)
{
    small_scene *s = small_scene_create();
    const float world_from_mesh[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, instance_y, instance_z, 1};
    const int material = small_scene_add_material(s, small_scene_material());
    for (int i = 0; i < quads; i++) {
        small_scene_begin_mesh(s, material);
        (void)small_scene_add_quad(s, (float[3]){mesh_x - 1, -1, -3.0f - (float)i}, (float[3]){2, 0, 0},
                                   (float[3]){0, 2, 0});
        small_scene_add_instance(s, world_from_mesh);
    }
    return s;
}

/* Each pixel's motion is its uv minus that of its point in the last view and pose. */
TEST_GL(motion_tells_where_points_were)
{
    enum { SIDE = 48 };
    char error[512];
    const double moved[3] = {0.25, -0.125, 0.5}, eye_moved = 0.0625, z = -3 + moved[2];
    SCOPED(memory) small_scene *first = make_moving_quad(0, 0, 0, 1), *other = make_moving_quad(0, 0, 0, 2);
    SCOPED(memory) small_scene *then = make_moving_quad(0.25f, -0.125f, 0.5f, 1);
    SCOPED(renderer) scene_renderer *r = scene_renderer_create(&first->scene, FAULT(error));
    assert_non_null(r);
    const scene_lighting none = {0};
    assert_true(
        scene_renderer_configure(r, &none, &(scene_draw_options){.no_picture = true, .motion = true}, FAULT(error)));
    scene_view view = {.view_from_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                       .clip_from_view = {1.5f, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, -1, -1, 0, 0, -0.5f, 0},
                       .width = SIDE,
                       .height = SIDE};
    scene_view last = view;
    last.view_from_world[12] = (float)-eye_moved;
    assert_true(scene_renderer_pose(r, &then->scene));
    assert_false(scene_renderer_pose(r, &other->scene)); /* has more triangles; changes nothing */
    SCOPED(texture) const GLuint depth = fixture_depth_texture(GL_DEPTH_COMPONENT24, SIDE, SIDE, NULL);
    SCOPED(target) const fixture_target target = fixture_make_target(GL_RGBA32F, SIDE, SIDE);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    scene_draw_normals(r, &view);
    scene_draw_motion(r, &view, &last);
    SCOPED(memory) float *got = fixture_read_texture(target.texture, SIDE, SIDE, 4);
    int seen = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double uv[2] = {(i % SIDE + 0.5) / SIDE, (i / SIDE + 0.5) / SIDE};
        double world[2], expected[2] = {1e4, 1e4};
        for (int k = 0; k < 2; k++)
            world[k] = (2 * uv[k] - 1) / 1.5 * -z;
        if (fabs(world[0] - moved[0]) < 1 && fabs(world[1] - moved[1]) < 1) {
            expected[0] = uv[0] - 0.5 - 0.5 * 1.5 * (world[0] - moved[0] - eye_moved) / -(z - moved[2]);
            expected[1] = uv[1] - 0.5 - 0.5 * 1.5 * (world[1] - moved[1]) / -(z - moved[2]);
            seen++;
        }
        for (int k = 0; k < 2; k++)
            assert_true(fabs((double)got[4 * i + k] - expected[k]) < 1e-5);
    }
    assert_true(seen > SIDE * SIDE / 4 && seen < SIDE * SIDE);
}

TEST_MAIN("draw maps", fixture_setup, fixture_teardown)
