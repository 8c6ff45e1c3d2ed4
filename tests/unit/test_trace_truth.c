/* SPDX-License-Identifier: MIT
 *
 * The ray tracer where the answer is known in closed form or by integration in double precision.
 */
#include "scene_builder.h"
#include "shapes.h"
#include "small_scene.h"
#include "testing.h"
#include "trace_shot.h"

enum { ERROR_LENGTH = 512 };

static const double pi = 3.14159265358979323846;

static void assert_near_truth(double measured, double truth, int samples)
{
    /* The binomial deviation bounds that of the stratified samples; 1e-4 covers the offset and the tessellation. */
    const double tolerance = 3 * sqrt(truth * (1 - truth) / samples) + 1e-4;
    if (!(fabs(measured - truth) <= tolerance))
        fail_msg("%.6f instead of %.6f, tolerance %.6f", measured, truth, tolerance);
}

/* A floor at y = 0, and walls at x = 0 and z = 0 if wanted, all far larger than the radii here. */
static small_scene *make_room(int walls)
{
    const float size = 100;
    small_scene *s = small_scene_create();
    small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
    const float depth[3] = {0, 0, size}, width[3] = {size, 0, 0}, height[3] = {0, size, 0}, corner[3] = {0, 0, 0};
    small_scene_add_quad(s, corner, depth, width);
    if (walls > 0)
        small_scene_add_quad(s, (float[3]){0, 0, 0}, height, depth);
    if (walls > 1)
        small_scene_add_quad(s, corner, width, height);
    small_scene_add_instance(s, NULL);
    return s;
}

TEST(empty_plane_is_fully_accessible)
{
    SCOPED(memory) small_scene *s = make_room(0);
    for (int step = 0; step < 8; step++) {
        const float height = 0.02f + 0.7f * (float)step;
        const scene_view view = trace_shot_view((float[3]){50, height, 50}, (float[3]){55, 0, 52}, 1);
        const trace_shot p = trace_shot_take(&s->scene, &view, (trace_options){.radius = 3, .samples = 64});
        assert_true(trace_shot_foreground(&p) > TRACE_SHOT_PIXELS / 8);
        for (int i = 0; i < TRACE_SHOT_PIXELS; i++)
            assert_true(p.accessibility[i] == 1);
    }
}

/* Cosine-weighted directions are a uniform disk seen from above. A wall at distance d blocks those within the radius R
 * whose x is at least d / R: a segment of the disk. */
static double segment(double c)
{
    return c >= 1 ? 0 : (acos(c) - c * sqrt(1 - c * c)) / pi;
}

TEST(wall_blocks_a_segment_of_the_disk)
{
    enum { SAMPLES = 1 << 14 };
    SCOPED(memory) small_scene *s = make_room(1);
    SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
    const float distances[] = {0.01f, 0.2f, 0.5f, 0.9f, 0.99f, 1.01f};
    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        const double measured = trace_shot_point(t, distances[i], 0, 50, 1, SAMPLES);
        assert_near_truth(measured, 1 - segment((double)distances[i]), SAMPLES);
    }
}

/* The mean open direction where floor and wall meet, at that distance from the other one and with a radius of 1. The
 * other one takes the directions of its segment of the disk: the integrals of x and of sqrt(1 - x^2 - z^2), over pi. */
static void mean_beside_a_wall(double distance, double *out_away, double *out_normal)
{
    const double d = fmin(distance, 1);
    *out_away = 2 / (3 * pi) * pow(1 - d * d, 1.5);
    *out_normal = 2.0 / 3 - 0.5 * (2.0 / 3 - d + d * d * d / 3);
}

TEST(open_directions_have_their_closed_form_beside_a_wall)
{
    enum { SIDE = TRACE_SHOT_SIDE };
    static float got[TRACE_SHOT_PIXELS][3];
    char error[ERROR_LENGTH];
    SCOPED(memory) small_scene *s = make_room(1);
    SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
    const float eye[3] = {2.5f, 2, 50};
    const scene_view view = trace_shot_view(eye, (float[3]){0, 0.2f, 49}, 1);
    const trace_options options = {.radius = 1, .samples = 4096};
    assert_true(trace_open_directions(t, &view, &options, got, NULL, FAULT(error)));
    int floors = 0, walls = 0;
    for (int i = 0; i < TRACE_SHOT_PIXELS; i++) {
        const float *m = view.view_from_world, *p = view.clip_from_view;
        const double x = (2 * (i % SIDE + 0.5) / SIDE - 1) / (double)p[0];
        const double y = (2 * (i / SIDE + 0.5) / SIDE - 1) / (double)p[5];
        double way[3], wanted[3] = {0, 0, 0};
        for (int k = 0; k < 3; k++)
            way[k] = x * (double)m[4 * k] + y * (double)m[4 * k + 1] - (double)m[4 * k + 2];
        const double to_floor = way[1] < 0 ? -(double)eye[1] / way[1] : INFINITY, to_wall = -(double)eye[0] / way[0];
        const bool is_floor = to_floor < to_wall;
        if (way[0] >= 0 || (!is_floor && (double)eye[1] + to_wall * way[1] < 1e-3))
            continue;
        mean_beside_a_wall(is_floor ? (double)eye[0] + to_floor * way[0] : (double)eye[1] + to_wall * way[1],
                           &wanted[!is_floor], &wanted[is_floor]);
        for (int k = 0; k < 3; k++) {
            const double in_view =
                wanted[0] * (double)m[k] + wanted[1] * (double)m[4 + k] + wanted[2] * (double)m[8 + k];
            if (!(fabs((double)got[i][k] - in_view) < 3e-3))
                fail_msg("pixel %d, axis %d: %.4f instead of %.4f", i, k, (double)got[i][k], in_view);
        }
        floors += is_floor;
        walls += !is_floor;
    }
    assert_true(floors > TRACE_SHOT_PIXELS / 8 && walls > TRACE_SHOT_PIXELS / 8);
}

/* The share of the disk with both x >= a and y >= b. */
static double disk_corner(double a, double b)
{
    enum { STEPS = 100000 };
    const double end = sqrt(fmax(1 - b * b, 0));
    double sum = 0;
    for (int i = 0; i < STEPS && end > a; i++) {
        const double x = a + (end - a) * (i + 0.5) / STEPS;
        sum += (sqrt(1 - x * x) - b) * (end - a) / STEPS;
    }
    return sum / pi;
}

TEST(corner_of_a_box_blocks_two_segments)
{
    enum { SAMPLES = 1 << 14 };
    SCOPED(memory) small_scene *s = make_room(2);
    SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
    const float at[][2] = {{0.001f, 0.001f}, {0.1f, 0.3f}, {0.5f, 0.5f}, {0.8f, 0.7f}, {0.3f, 1.2f}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        const double a = (double)at[i][0], b = (double)at[i][1];
        const double truth = 1 - segment(a) - segment(b) + disk_corner(a, b);
        assert_near_truth(trace_shot_point(t, at[i][0], 0, at[i][1], 1, SAMPLES), truth, SAMPLES);
    }
}

/* A sphere of radius 1 that touches the plane y = 0 at the origin. */
static scene *make_resting_sphere(void)
{
    char error[ERROR_LENGTH];
    failure fault = {.file = "sphere", .text = error, .size = sizeof error};
    scene_builder b;
    const scene_material matte = scene_default_material();
    float lifted[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1};
    assert_true(scene_builder_begin(&b, "sphere", &fault));
    assert_true(scene_builder_add_material(&b, &matte) == 0 && scene_builder_add_mesh(&b) == 0);
    assert_true(shape_sphere(&b, 1, 512, 256) && scene_builder_add_primitive(&b, 0, 0));
    assert_true(scene_builder_add_instance(&b, 0, lifted));
    scene *s = scene_builder_finish(&b);
    assert_non_null(s);
    return s;
}

/* The blocked share of the disk of directions at distance d from the sphere's contact point, within the radius. */
static double blocked_by_sphere(double d, double radius)
{
    enum { STEPS = 1500 };
    int blocked = 0, total = 0;
    for (int j = 0; j < STEPS; j++)
        for (int i = 0; i < STEPS; i++) {
            const double x = 2 * (i + 0.5) / STEPS - 1, z = 2 * (j + 0.5) / STEPS - 1, square = x * x + z * z;
            if (square >= 1)
                continue;
            total++;
            /* |t w - c| = 1 with the centre c = (-d, 1, 0) from the point: t^2 - 2 t (w . c) + d^2 = 0. */
            const double along = sqrt(1 - square) - x * d, under_root = along * along - d * d;
            blocked += along > 0 && under_root >= 0 && along - sqrt(under_root) <= radius;
        }
    return (double)blocked / total;
}

TEST(sphere_on_a_plane_blocks_its_form_factor)
{
    enum { SAMPLES = 1 << 14 };
    SCOPED(scene) scene *s = make_resting_sphere();
    SCOPED(traced) trace_scene *t = trace_shot_open(s);
    const float distances[] = {0.2f, 0.5f, 1, 2, 5};
    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        const double d = (double)distances[i];
        /* The cone to the sphere touches the horizon: sin^2 of its half angle times the cosine of its axis. */
        assert_near_truth(trace_shot_point(t, distances[i], 0, 0, INFINITY, SAMPLES), 1 - pow(1 + d * d, -1.5),
                          SAMPLES);
        assert_near_truth(trace_shot_point(t, distances[i], 0, 0, 0.8f, SAMPLES), 1 - blocked_by_sphere(d, 0.8),
                          SAMPLES);
    }
}

/* A ceiling at height 1 above the point at the origin, with the floor's material before it. */
static small_scene *make_ceiling(scene_material material)
{
    small_scene *s = small_scene_create();
    small_scene_begin_mesh(s, small_scene_add_material(s, material));
    small_scene_add_quad(s, (float[3]){-500, 1, -500}, (float[3]){1000, 0, 0}, (float[3]){0, 0, 1000});
    small_scene_add_instance(s, NULL);
    return s;
}

TEST(radius_cuts_hard)
{
    enum { SAMPLES = 1 << 14 };
    SCOPED(memory) small_scene *s = make_ceiling(small_scene_material());
    SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
    assert_true(trace_shot_point(t, 0, 0, 0, 0.999f, 256) == 1);
    assert_true(trace_shot_point(t, 0, 0, 0, 0, 256) == 1);
    for (double radius = 1.25; radius < 20; radius *= 2) {
        /* Blocked where 1 / cos <= R. */
        assert_near_truth(trace_shot_point(t, 0, 0, 0, (float)radius, SAMPLES), 1 / (radius * radius), SAMPLES);
    }
}

TEST(uniform_rays_see_the_solid_angle)
{
    enum { SAMPLES = 1 << 14 };
    char error[ERROR_LENGTH];
    SCOPED(memory) small_scene *s = make_ceiling(small_scene_material());
    SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
    const float position[1][3] = {{0, 0, 0}}, up[1][3] = {{0, 1, 0}};
    const trace_options options = {.radius = 4, .samples = SAMPLES};
    float out = -1;
    assert_true(trace_points(t, position, up, 1, TRACE_UNIFORM, 0, &options, &out, NULL, FAULT(error)));
    assert_near_truth((double)out, 0.25, SAMPLES); /* a cap of the hemisphere: 1 - cos, cos = 1/4 */
}

static double under(scene_material material, const uint8_t *rgba, float vertex_alpha)
{
    SCOPED(memory) small_scene *s = small_scene_create();
    if (rgba)
        material.base_color_texture = small_scene_add_texture(s, 2, 2, rgba);
    small_scene_begin_mesh(s, small_scene_add_material(s, material));
    scene_vertex *v =
        small_scene_add_quad(s, (float[3]){-500, 1, -500}, (float[3]){1000, 0, 0}, (float[3]){0, 0, 1000});
    for (int i = 0; i < 4; i++)
        v[i].color[3] = vertex_alpha;
    small_scene_add_instance(s, NULL);
    SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
    const double out = trace_shot_point(t, 0, 0, 0, INFINITY, 4096);
    return out;
}

TEST(alpha_test_lets_rays_through)
{
    const uint8_t clear[16] = {0}, left_clear[16] = {9, 9, 9, 0, 9, 9, 9, 255, 9, 9, 9, 0, 9, 9, 9, 255};
    const uint8_t top_clear[16] = {9, 9, 9, 0, 9, 9, 9, 0, 9, 9, 9, 255, 9, 9, 9, 255};
    scene_material m = small_scene_material();
    m.alpha = SCENE_ALPHA_MASK;
    assert_true(under(m, NULL, 1) < 0.01);
    assert_true(under(m, clear, 1) == 1);
    assert_near_truth(under(m, left_clear, 1), 0.5, 4096);
    assert_near_truth(under(m, top_clear, 1), 0.5, 4096);
    assert_true(under(m, NULL, 0.499f) == 1);
    assert_true(under(m, NULL, 0.501f) < 0.01);
    m.base_color[3] = 0.4f;
    assert_true(under(m, NULL, 1) == 1);
    m.base_color[3] = 1;
    m.base_color_uv_from_uv[2] = 0.5f;
    m.base_color_uv_from_uv[0] = 0; /* all of it at u = 0.5 */
    assert_true(under(m, left_clear, 1) < 0.01);
    m.base_color_uv_from_uv[2] = -0.25f; /* at -0.25, which repeats to 0.75; then at -0.75, which repeats to 0.25 */
    assert_true(under(m, left_clear, 1) < 0.01);
    m.base_color_uv_from_uv[2] = -0.75f;
    assert_true(under(m, left_clear, 1) == 1);
    m.alpha = SCENE_ALPHA_OPAQUE;
    assert_true(under(m, clear, 1) < 0.01);
    m.alpha = SCENE_ALPHA_BLEND;
    assert_true(under(m, NULL, 1) == 1);
}

TEST_MAIN(NULL, NULL, NULL)
