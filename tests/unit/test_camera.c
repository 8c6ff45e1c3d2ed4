/* SPDX-License-Identifier: MIT
 *
 * Cameras: what they see, at every scale and aspect, and which ones are refused.
 */
#include "camera.h"
#include "testing.h"

static const float pi = 3.14159265f;

/* Scenes of points: one mesh of up to 64 vertices, in the world as it is. */
typedef struct cloud {
    scene_vertex vertices[64];
    uint32_t indices[64];
    scene_primitive primitive;
    scene_mesh mesh;
    scene_instance instance;
} cloud;

static scene make(cloud *c, const float (*points)[3], uint32_t count)
{
    *c = (cloud){.primitive = {.index_count = count},
                 .mesh = {.primitive_count = 1, .instance_count = 1},
                 .instance = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
    scene s = {.vertices = c->vertices,
               .vertex_count = count,
               .indices = c->indices,
               .index_count = count,
               .primitives = &c->primitive,
               .primitive_count = 1,
               .meshes = &c->mesh,
               .mesh_count = 1,
               .instances = &c->instance,
               .instance_count = 1,
               .bounds_min = {INFINITY, INFINITY, INFINITY},
               .bounds_max = {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < count; i++) {
        c->indices[i] = i;
        for (int k = 0; k < 3; k++) {
            c->vertices[i].position[k] = points[i][k];
            s.bounds_min[k] = fminf(s.bounds_min[k], points[i][k]);
            s.bounds_max[k] = fmaxf(s.bounds_max[k], points[i][k]);
        }
    }
    return s;
}

/* A box of eight vertices. Its arrays live until the next call. */
static scene box(float x0, float y0, float z0, float x1, float y1, float z1)
{
    static cloud c;
    float corners[8][3];
    for (int k = 0; k < 8; k++) {
        corners[k][0] = k & 1 ? x1 : x0;
        corners[k][1] = k & 2 ? y1 : y0;
        corners[k][2] = k & 4 ? z1 : z0;
    }
    return make(&c, (const float(*)[3])corners, 8);
}

/* Changes the vertices that the scene shares with the box it comes from. */
static scene scaled(scene s, float scale)
{
    for (uint32_t i = 0; i < s.vertex_count; i++)
        for (int k = 0; k < 3; k++)
            s.vertices[i].position[k] *= scale;
    for (int i = 0; i < 3; i++) {
        s.bounds_min[i] *= scale;
        s.bounds_max[i] *= scale;
    }
    return s;
}

static void transform(const float m[16], const double v[4], double out[4])
{
    for (int r = 0; r < 4; r++)
        out[r] = (double)m[r] * v[0] + (double)m[4 + r] * v[1] + (double)m[8 + r] * v[2] + (double)m[12 + r] * v[3];
}

/* The largest |x|, |y| and |z| of the bounds' corners in normalised device coordinates; infinite if one is behind. */
static void bounds_ndc(const scene *s, const scene_view *view, double out[3])
{
    out[0] = out[1] = out[2] = 0;
    for (int k = 0; k < 8; k++) {
        double world[4] = {0, 0, 0, 1}, in_view[4], clip[4];
        for (int i = 0; i < 3; i++)
            world[i] = (k >> i) & 1 ? s->bounds_max[i] : s->bounds_min[i];
        transform(view->view_from_world, world, in_view);
        transform(view->clip_from_view, in_view, clip);
        for (int i = 0; i < 3; i++)
            out[i] = fmax(out[i], clip[3] > 0 ? fabs(clip[i] / clip[3]) : INFINITY);
    }
}

static scene shapes(int i)
{
    switch (i) {
    case 0:
        return box(-1, -1, -1, 1, 1, 1);
    case 1:
        return box(-339, 0, -339, 339, 13, 339);
    case 2:
        return box(0.1f, 0, 0, 0.2f, 9, 0.3f);
    case 3:
        return box(0, 0, -50, 0, 0, 50);
    case 4:
        return box(100, 200, 300, 101, 200, 301);
    default:
        return box(-10, 5, 5, 10, 5, 5);
    }
}

TEST(frame_sees_the_whole_bounds)
{
    const float aspects[] = {1, 16.0f / 9, 9.0f / 16, 20, 0.05f};
    for (int shape = 0; shape < 6; shape++) {
        for (int power = -4; power <= 4; power += 4)
            for (size_t a = 0; a < sizeof aspects / sizeof aspects[0]; a++) {
                const scene s = scaled(shapes(shape), powf(10, (float)power));
                const camera c = camera_frame_scene(&s, aspects[a]);
                char error[200] = "";
                if (!camera_check(&c, FAULT(error)))
                    fail_msg("shape %d, scale 1e%d: %s", shape, power, error);
                const scene_view view = camera_view(&c, (int)(2000 * aspects[a]), 2000);
                double ndc[3];
                bounds_ndc(&s, &view, ndc);
                if (!(ndc[0] < 0.96 && ndc[1] < 0.96 && ndc[2] < 1))
                    fail_msg("shape %d, scale 1e%d, aspect %g: corners at %g %g %g", shape, power, (double)aspects[a],
                             ndc[0], ndc[1], ndc[2]);
            }
    }
}

TEST(frame_fills_the_picture)
{
    for (int shape = 0; shape < 3; shape++) {
        const scene s = shapes(shape);
        const camera c = camera_frame_scene(&s, 1.5f);
        const scene_view view = camera_view(&c, 1500, 1000);
        double ndc[3];
        bounds_ndc(&s, &view, ndc);
        assert_true(fmax(ndc[0], ndc[1]) > 0.94);
    }
}

/* Left, right, bottom and top of the vertices in normalised device coordinates. */
static void edges(const scene *s, const camera *c, float aspect, double out[4])
{
    const scene_view view = camera_view(c, (int)(1000 * aspect), 1000);
    out[0] = out[2] = INFINITY;
    out[1] = out[3] = -INFINITY;
    for (uint32_t k = 0; k < s->vertex_count; k++) {
        const float *v = s->vertices[k].position;
        const double world[4] = {(double)v[0], (double)v[1], (double)v[2], 1};
        double in_view[4], clip[4];
        transform(view.view_from_world, world, in_view);
        transform(view.clip_from_view, in_view, clip);
        assert_true(clip[3] > 0);
        for (int i = 0; i < 2; i++) {
            out[2 * i] = fmin(out[2 * i], clip[i] / clip[3]);
            out[2 * i + 1] = fmax(out[2 * i + 1], clip[i] / clip[3]);
        }
    }
}

static const float skewed[][3] = {{0, 0, 0}, {9, 0, 1}, {9, 0.2f, -3}, {1, 4, -2}, {0, 1, 2}, {8, 0, 3}};

/* Opposite margins differ by less than 2 % of the picture, and the narrower pair is the one asked for. */
static void check_margins(const scene *s, const camera_framing *how, const char *what)
{
    const camera c = camera_frame(s, how);
    char error[200];
    if (!camera_check(&c, FAULT(error)))
        fail_msg("%s: %s", what, error);
    double at[4];
    edges(s, &c, how->aspect, at);
    const double left = at[0] - (2 * (double)how->free_left - 1), right = 2 * (double)how->free_right - 1 - at[1];
    const double bottom = at[2] + 1, top = 1 - at[3];
    if (!(fabs(left - right) < 0.04 && fabs(bottom - top) < 0.04))
        fail_msg("%s: margins %g %g, %g %g", what, left, right, bottom, top);
    const double share = (double)how->free_right - (double)how->free_left;
    if (!(fmin(left / share, bottom) > 0.049 && fmin(left / share, bottom) < 0.06))
        fail_msg("%s: the narrower margins are %g, %g", what, left / share, bottom);
}

TEST(opposite_margins_are_equal)
{
    const float aspects[] = {1, 16.0f / 9, 0.3f};
    const float ups[][3] = {{0, 1, 0}, {0, 0, 1}, {0, 0, -2}, {0, -1, 0}, {1, 0, 0}, {0.3f, 0.5f, -0.2f}};
    const float angles[][2] = {{0.30f, 0.35f}, {0, 0}, {2, -0.7f}, {0, pi / 2}, {1, -pi / 2}};
    for (size_t a = 0; a < sizeof aspects / sizeof aspects[0]; a++)
        for (size_t u = 0; u < sizeof ups / sizeof ups[0]; u++)
            for (size_t d = 0; d < 2 * sizeof angles / sizeof angles[0]; d++) {
                cloud c;
                const scene s = make(&c, skewed, sizeof skewed / sizeof skewed[0]);
                camera_framing how = camera_default_framing(aspects[a]);
                memcpy(how.up, ups[u], sizeof how.up);
                how.azimuth_rad = angles[d / 2][0];
                how.elevation_rad = angles[d / 2][1];
                how.orthographic = d % 2;
                char what[64];
                snprintf(what, sizeof what, "aspect %zu, up %zu, direction %zu", a, u, d);
                check_margins(&s, &how, what);
            }
}

TEST(scene_stays_in_the_free_part)
{
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        cloud c;
        const scene s = make(&c, skewed, sizeof skewed / sizeof skewed[0]);
        camera_framing how = camera_default_framing(16.0f / 9);
        how.free_left = 0.3f;
        how.orthographic = orthographic;
        check_margins(&s, &how, "free part");
    }
}

/* The scene turned so that its +y becomes +z looks the same with that up. */
TEST(another_up_gives_the_same_picture)
{
    cloud c, d;
    float turned[6][3];
    for (int i = 0; i < 6; i++) {
        turned[i][0] = skewed[i][0];
        turned[i][1] = -skewed[i][2];
        turned[i][2] = skewed[i][1];
    }
    const scene y_up = make(&c, skewed, 6), z_up = make(&d, (const float(*)[3])turned, 6);
    camera_framing how = camera_default_framing(1.5f);
    const camera of_y = camera_frame(&y_up, &how);
    how.up[1] = 0;
    how.up[2] = 7;
    const camera of_z = camera_frame(&z_up, &how);
    const float want[3] = {of_y.eye[0], -of_y.eye[2], of_y.eye[1]};
    for (int i = 0; i < 3; i++)
        assert_float_equal(of_z.eye[i], want[i], 1e-4f);
}

/* A row far longer than it is deep, which a camera that fits its front alone cuts when it turns. */
TEST(scene_stays_in_the_picture_while_it_turns)
{
    cloud c;
    const float row[][3] = {{-10, 0, 0}, {10, 0, 0}, {10, 3, 1}, {-10, 3, 1}};
    const scene s = make(&c, row, 4);
    camera_framing how = camera_default_framing(1.5f);
    how.turns = true;
    how.up[0] = 0.5f;
    const float up[3] = {0.4472136f, 0.8944272f, 0}, middle[3] = {0, 1.5f, 0.5f};
    const camera first = camera_frame(&s, &how);
    double most = 0;
    for (int i = 0; i < 36; i++) {
        const camera turned = camera_turned(&first, middle, up, pi / 18 * (float)i);
        double at[4];
        edges(&s, &turned, 1.5f, at);
        for (int k = 0; k < 4; k++)
            most = fmax(most, fabs(at[k]));
    }
    assert_true(most > 0.9 && most < 0.96);
}

TEST(a_turn_is_about_the_axis_given)
{
    const camera c = {.eye = {3, 1, 1}, .target = {1, 1, 1}, .up = {0, 0, 1}};
    const camera d = camera_turned(&c, (float[]){1, 0, 5}, (float[]){0, 0, 1}, pi / 2);
    const float eye[3] = {0, 2, 1}, up[3] = {0, 0, 1};
    for (int i = 0; i < 3; i++) {
        assert_float_equal(d.eye[i], eye[i], 1e-6f);
        assert_float_equal(d.up[i], up[i], 1e-6f);
    }
}

TEST(frame_of_an_empty_scene_is_at_distance_one)
{
    const scene s = {0};
    const camera c = camera_frame_scene(&s, 1);
    char error[200];
    assert_float_equal(hypot(hypot((double)c.eye[0], (double)c.eye[1]), (double)c.eye[2]), 1, 1e-6f);
    assert_true(camera_check(&c, FAULT(error)));
}

TEST(frame_scales_with_the_scene)
{
    const scene s = box(-1, 0, -2, 3, 4, 1);
    const camera c = camera_frame_scene(&s, 1.5f);
    const scene large = scaled(s, 8192);
    const camera d = camera_frame_scene(&large, 1.5f);
    for (int i = 0; i < 3; i++)
        assert_float_equal(d.eye[i], 8192 * c.eye[i], 8192 * 1e-5f);
    assert_float_equal(d.near_plane, 8192 * c.near_plane, 8192 * c.near_plane * 1e-5f);
    assert_float_equal(d.far_plane, 8192 * c.far_plane, 8192 * c.far_plane * 1e-5f);
}

static camera from(float x, float y, float z)
{
    return (camera){.eye = {x, y, z}, .target = {x, y, z - 1}, .up = {0, 1, 0}, .fov_y_rad = 1};
}

TEST(planes_hug_bounds_in_front)
{
    const scene s = box(-1, -1, -1, 1, 1, 1);
    camera c = from(0, 0, 11);
    camera_fit_planes(&c, &s);
    assert_true(c.near_plane < 10 && c.near_plane > 9.9f);
    assert_true(c.far_plane > 12 && c.far_plane < 12.1f);
}

TEST(planes_inside_the_bounds_keep_their_ratio)
{
    const scene s = box(-1, -1, -1, 1, 1, 1);
    camera c = from(0, 0, 0);
    camera_fit_planes(&c, &s);
    assert_true(c.far_plane > 1 && c.far_plane < 1.1f);
    assert_float_equal(c.far_plane / c.near_plane, 20000, 1);
}

TEST(planes_are_valid_with_everything_behind)
{
    const scene behind = box(-1, -1, -1, 1, 1, 1), point = box(0, 0, 0, 0, 0, 0);
    char error[200];
    camera c = from(0, 0, -5);
    camera_fit_planes(&c, &behind);
    assert_true(camera_check(&c, FAULT(error)));
    camera_fit_planes(&c, &point);
    assert_true(camera_check(&c, FAULT(error)));
}

TEST(planes_of_a_flat_scene_leave_room)
{
    const scene s = box(-1, -1, 0, 1, 1, 0);
    camera c = from(0, 0, 1000);
    camera_fit_planes(&c, &s);
    assert_true(c.near_plane < 999.9f && c.far_plane > 1000.1f);
}

TEST(turned_keeps_the_distance_and_the_height)
{
    const camera c = {.eye = {3, 4, 5}, .target = {1, 1, 1}, .up = {0, 1, 0}, .fov_y_rad = 1};
    const camera d = camera_turned(&c, c.target, (float[]){0, 1, 0}, 1.2f);
    double before = 0, after = 0;
    for (int i = 0; i < 3; i++) {
        before += pow((double)c.eye[i] - c.target[i], 2);
        after += pow((double)d.eye[i] - d.target[i], 2);
    }
    assert_true(fabs(before - after) < 1e-5 * before);
    assert_float_equal(d.eye[1], 4, 1e-6f);
    assert_memory_equal(d.target, c.target, sizeof c.target);
    assert_memory_equal(d.up, c.up, sizeof c.up);
}

TEST(turned_a_quarter_goes_from_front_to_right)
{
    const camera c = {.eye = {0, 0, 2}, .up = {0, 0.5f, 0.5f}};
    const camera d = camera_turned(&c, c.target, (float[]){0, 1, 0}, pi / 2);
    assert_float_equal(d.eye[0], 2, 1e-6f);
    assert_float_equal(d.eye[2], 0, 1e-6f);
    assert_float_equal(d.up[0], 0.5f, 1e-6f);
    assert_float_equal(d.up[1], 0.5f, 1e-6f);
}

TEST(view_looks_down_minus_z)
{
    const camera c = {
        .eye = {1, 2, 3}, .target = {1, 2, -7}, .up = {0, 3, 0}, .fov_y_rad = 1, .near_plane = 1, .far_plane = 10};
    const scene_view view = camera_view(&c, 640, 480);
    const double world[4] = {2, 4, 0, 1};
    double in_view[4];
    transform(view.view_from_world, world, in_view);
    assert_true(in_view[0] == 1 && in_view[1] == 2 && in_view[2] == -3 && in_view[3] == 1);
    assert_int_equal(view.width, 640);
    assert_int_equal(view.height, 480);
}

TEST(check_names_the_field)
{
    const camera good = {.eye = {1, 2, 3}, .up = {0, 1, 0}, .fov_y_rad = 1, .near_plane = 1, .far_plane = 2};
    camera bad[9];
    const char *named[9] = {"eye", "target", "target", "up", "up", "fov", "near", "far", "far"};
    for (int i = 0; i < 9; i++)
        bad[i] = good;
    bad[0].eye[1] = NAN;
    bad[1].target[2] = INFINITY;
    memcpy(bad[2].target, good.eye, sizeof good.eye);
    memset(bad[3].up, 0, sizeof bad[3].up);
    memcpy(bad[4].up, good.eye, sizeof good.eye);
    bad[5].fov_y_rad = 3.2f;
    bad[6].near_plane = 0;
    bad[7].far_plane = 1;
    bad[8].far_plane = INFINITY;
    char error[200];
    assert_true(camera_check(&good, FAULT(error)));
    for (int i = 0; i < 9; i++) {
        error[0] = '\0';
        assert_false(camera_check(&bad[i], FAULT(error)));
        if (!strstr(error, named[i]) || strchr(error, '\n'))
            fail_msg("\"%s\" does not name \"%s\"", error, named[i]);
    }
}

TEST(check_takes_tiny_and_huge_cameras)
{
    char error[200];
    for (float scale = 1e-6f; scale < 1e7f; scale *= 1e3f) {
        const camera c = {
            .eye = {0, 0, scale}, .up = {0, scale, 0}, .fov_y_rad = 1, .near_plane = 0.1f * scale, .far_plane = scale};
        assert_true(camera_check(&c, FAULT(error)));
    }
}

TEST(suggested_radius_follows_the_diagonal)
{
    const scene s = box(0, 0, 0, 1, 2, 2), empty = {0};
    assert_float_equal(camera_suggest_radius(&s), 3.0f / 20, 1e-6f);
    assert_float_equal(camera_suggest_radius(&empty), 0.5f, 0);
}

TEST_MAIN("camera", NULL, NULL)
