/* SPDX-License-Identifier: MIT
 *
 * Properties of any picture, without a model: planes and sky are open, values are finite, runs repeat, any size works,
 * normals can be drawn or rebuilt. tests/stability/test_relations.c compares scales and directions of depth.
 */
#include "analytic.h"
#include "fixture.h"

static glssao_technique technique; /* all tests run once for each */
static glssao_quality quality = GLSSAO_HIGH;

static glssao_settings settings_at_scale(float scale)
{
    glssao_settings s = glssao_default_settings(technique, quality);
    s.radius *= scale;
    s.fade_start *= scale;
    s.fade_end *= scale;
    s.surface_epsilon *= scale;
    s.blur_depth_threshold *= scale;
    return s;
}

typedef struct picture {
    float *values;
    int width, height;
} picture;

static void test_end_picture(const picture *p) /* for SCOPED */
{
    free(p->values);
}

static float least(const picture *p)
{
    float value = 1.0f;
    for (int i = 0; i < p->width * p->height; ++i) {
        assert_true(p->values[i] >= 0.0f && p->values[i] <= 1.0f); /* false for NaN too */
        value = fminf(value, p->values[i]);
    }
    return value;
}

static double mean_difference(const picture *a, const picture *b)
{
    double sum = 0.0;
    assert_true(a->width == b->width && a->height == b->height);
    for (int i = 0; i < a->width * a->height; ++i)
        sum += fabs((double)a->values[i] - (double)b->values[i]);
    return sum / (a->width * a->height);
}

/* Shapes in, accessibility out. normals NULL: rebuilt from depth. */
static picture shade(fixture *f, const analytic_view *view, const analytic_shape *shapes, int count, int width,
                     int height, bool bring_normals, const glssao_settings *settings)
{
    SCOPED(frame) const glssao_frame all = fixture_frame(view, shapes, count, width, height);
    glssao_frame frame = all;
    if (!bring_normals)
        frame.normal_texture = 0;
    picture p;
    p.values = fixture_compute(fixture_shared_effect(f, width, height), &frame, settings, &p.width, &p.height);
    return p;
}

static picture shade_room(fixture *f, analytic_projection projection, double scale, bool bring_normals)
{
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, scale);
    analytic_view view = analytic_make_view(projection, 1.5, 0.5, 40.0, scale);
    glssao_settings settings = settings_at_scale((float)scale);
    return shade(f, &view, room, ANALYTIC_ROOM_SHAPES, 150, 100, bring_normals, &settings);
}

TEST_GL(plane_is_open_at_any_angle_and_scale)
{
    static const double degrees[] = {0.0, 30.0, 60.0, 80.0, 88.0, 89.9};
    static const double scales[] = {1e-4, 1.0, 1e4};
    for (int projection = 0; projection < PROJECTION_COUNT; ++projection)
        for (int i = 0; i < 6; ++i)
            for (int bring = 0; bring < 2; ++bring) {
                const double angle = degrees[i] * 3.14159265358979323846 / 180.0, scale = scales[(projection + i) % 3];
                const analytic_shape plane = {
                    ANALYTIC_PLANE, {0.0, -1.0 * scale, -3.0 * scale}, {0.0, sin(angle), cos(angle)}};
                const analytic_view view = analytic_make_view((analytic_projection)projection, 1.5, 0.5, 40.0, scale);
                const glssao_settings settings = settings_at_scale((float)scale);
                picture p = shade(f, &view, &plane, 1, 90, 60, bring == 1, &settings);
                const float value = least(&p);
                if (value < 0.999f)
                    fail_msg("projection %d, %g degrees, scale %g, %s normals: %g", projection, degrees[i], scale,
                             bring ? "brought" : "rebuilt", (double)value);
                free(p.values);
            }
}

TEST_GL(sky_alone_is_open)
{
    for (int projection = 0; projection < PROJECTION_COUNT; ++projection) {
        analytic_view view = analytic_make_view((analytic_projection)projection, 1.5, 0.5, 40.0, 1.0);
        glssao_settings settings = settings_at_scale(1.0f);
        for (int bring = 0; bring < 2; ++bring) {
            SCOPED(picture) picture p = shade(f, &view, NULL, 0, 33, 21, bring == 1, &settings);
            assert_true(least(&p) == 1.0f);
        }
    }
}

TEST_GL(runs_are_bit_equal_and_seeds_differ)
{
    float *pictures[3];
    const glssao_settings settings = settings_at_scale(1.0f);
    int width, height;
    for (int i = 0; i < 3; ++i) {
        glssao_config config = fixture_config(f, 150, 100);
        config.seed = i < 2 ? 7u : 8u;
        SCOPED(effect) glssao_effect *effect = fixture_effect_of(f, &config);
        SCOPED(frame) const glssao_frame frame = fixture_room(PERSPECTIVE, 150, 100);
        pictures[i] = fixture_compute(effect, &frame, &settings, &width, &height);
    }
    size_t bytes = (size_t)width * (size_t)height * sizeof(float);
    assert_memory_equal(pictures[0], pictures[1], bytes);
    /* The horizon technique has an ordered tile instead of random inputs. */
    assert_true((memcmp(pictures[0], pictures[2], bytes) != 0) == (technique != GLSSAO_HORIZON));
    for (int i = 0; i < 3; ++i)
        free(pictures[i]);
}

/* The last sizes resize one effect, so stale maps would show. */
TEST_GL(resizes_through_odd_sizes_down_to_one_pixel)
{
    static const int sizes[][2] = {{66, 46}, {63, 47}, {640, 3}, {3, 640}, {2, 2}, {1, 9}, {9, 1}, {1, 1}, {66, 46}};
    glssao_effect *effect = fixture_shared_effect(f, 128, 128);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
        for (int bring = 0; bring < 2; ++bring) {
            int w = sizes[i][0], h = sizes[i][1];
            assert_int_equal(glssao_resize(effect, w, h), GLSSAO_OK);
            SCOPED(frame) const glssao_frame all = fixture_room(PERSPECTIVE, w, h);
            glssao_frame frame = all;
            if (!bring)
                frame.normal_texture = 0;
            for (int half = 0; half < 2; ++half) {
                glssao_settings settings = settings_at_scale(1.0f);
                settings.half_resolution = half == 1;
                SCOPED(picture) picture p = {0};
                p.values = fixture_compute(effect, &frame, &settings, &p.width, &p.height);
                bool small = half && !settings.upsample;
                assert_int_equal(p.width, small ? (w + 1) / 2 : w);
                assert_int_equal(p.height, small ? (h + 1) / 2 : h);
                (void)least(&p);
            }
        }
}

TEST_GL(rebuilt_normals_shade_like_brought_ones)
{
    SCOPED(picture)
    picture brought = shade_room(f, PERSPECTIVE, 1.0, true), rebuilt = shade_room(f, PERSPECTIVE, 1.0, false);
    const double mean = mean_difference(&brought, &rebuilt);
    print_message("mean difference %.4f\n", mean);
    assert_true(mean < 0.01);
}

TEST_GL(rebuilt_normals_are_right_up_to_silhouettes)
{
    enum { W = 150, H = 100 };
    for (int projection = 0; projection < PROJECTION_COUNT; ++projection) {
        analytic_view view = analytic_make_view((analytic_projection)projection, 1.5, 0.5, 40.0, 1.0);
        SCOPED(memory) float *depth = NULL, *normals = NULL;
        analytic_render(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, W, H, &depth, &normals);
        glssao_effect *effect = fixture_shared_effect(f, W, H);
        SCOPED(frame) const glssao_frame frame = fixture_maps_frame(&view, W, H, GL_DEPTH_COMPONENT32F, depth, NULL);
        glssao_settings settings = settings_at_scale(1.0f);
        settings.half_resolution = false;
        int w, h;
        free(fixture_compute(effect, &frame, &settings, &w, &h));
        SCOPED(memory) float *rebuilt = fixture_read_rebuilt(effect, W, H, 1);
        int off = 0;
        for (int i = 0; i < W * H; ++i) {
            float cosine = 0.0f;
            for (int axis = 0; axis < 3; ++axis)
                cosine += rebuilt[3 * i + axis] * normals[3 * i + axis];
            off += !(cosine > 0.97f);
        }
        print_message("projection %d: %.2f %% of normals off by more than 14 degrees\n", projection,
                      100.0 * off / (W * H));
        assert_true(off * 100 < W * H); /* slivers of less than three pixels and the very rims of the spheres remain */
    }
}

/* On one plane there is nothing to choose, so only the rounding of depth is left, at both sizes of the estimate. */
TEST_GL(rebuilt_normals_of_a_plane_are_exact)
{
    enum { W = 61, H = 41 };
    const analytic_shape plane = {ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.36, 0.48, 0.8}};
    for (int i = 0; i < 2 * PROJECTION_COUNT; ++i) {
        const analytic_view view = analytic_make_view((analytic_projection)(i / 2), 1.5, 0.5, 40.0, 1.0);
        glssao_effect *effect = fixture_shared_effect(f, W, H);
        SCOPED(frame) glssao_frame frame = fixture_frame(&view, &plane, 1, W, H);
        SCOPED(memory) float *depth = fixture_read_depth(frame.depth_texture, W, H);
        gl.DeleteTextures(1, &frame.normal_texture);
        frame.normal_texture = 0;
        glssao_settings settings = settings_at_scale(1.0f);
        settings.half_resolution = i % 2;
        int w, h, seen = 0;
        free(fixture_compute(effect, &frame, &settings, &w, &h));
        SCOPED(memory) float *rebuilt = fixture_read_rebuilt(effect, W, H, 1 + i % 2);
        for (int k = 0; k < W * H; ++k) {
            if (depth[k] == view.sky_depth || k / W % 2 == 1 || k % W % 2 == 1)
                continue;
            ++seen;
            for (int axis = 0; axis < 3; ++axis)
                assert_float_equal(rebuilt[3 * k + axis], plane.size[axis], 1e-3);
        }
        assert_true(8 * seen > W * H);
    }
}

TEST_GL(skipped_frame_is_open)
{
    glssao_effect *effect = fixture_shared_effect(f, 90, 60);
    SCOPED(frame) const glssao_frame frame = fixture_room(PERSPECTIVE, 90, 60);
    glssao_settings settings = settings_at_scale(1.0f);
    for (int i = 0; i < 2; ++i) {
        settings.radius = i == 0 ? 0.5f : 0.0f; /* the second frame must not show the first one */
        SCOPED(picture) picture p = {0};
        p.values = fixture_compute(effect, &frame, &settings, &p.width, &p.height);
        assert_true(i == 0 ? least(&p) < 0.9f : least(&p) == 1.0f);
    }
}

int main(void)
{
    static const struct {
        const char *name;
        glssao_technique technique;
        glssao_quality quality;
    } groups[] = {
        {"classic", GLSSAO_CLASSIC, GLSSAO_HIGH},
        {"hemisphere", GLSSAO_HEMISPHERE, GLSSAO_LOW},
        {"horizon at half size", GLSSAO_HORIZON, GLSSAO_LOW},
        {"horizon at full size", GLSSAO_HORIZON, GLSSAO_ULTRA},
    };
    int failed = 0;
    for (size_t i = 0; i < sizeof groups / sizeof *groups; ++i) {
        technique = groups[i].technique;
        quality = groups[i].quality;
        failed += test_run(groups[i].name, fixture_setup, fixture_teardown);
    }
    return failed;
}
