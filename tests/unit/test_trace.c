/* SPDX-License-Identifier: MIT
 *
 * The ray tracer: what must not change its result, and what rays hit.
 */
#include "small_scene.h"
#include "testing.h"
#include "trace_shot.h"

enum { ERROR_LENGTH = 512 };

static double mean(const trace_shot *p)
{
    double sum = 0;
    for (int i = 0; i < TRACE_SHOT_PIXELS; i++)
        sum += (double)p->accessibility[i];
    return sum / TRACE_SHOT_PIXELS;
}

static void multiply_point(const float m[16], const float p[3], float w, float out[3])
{
    for (int r = 0; r < 3; r++)
        out[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r] * w;
}

/* A corner of three walls with a sphere in it. Placed under the transform's inverse if `inverse` is given. */
static void add_hollow(small_scene *s, const float *inverse, const float *inverse_transpose, bool mirrored)
{
    const uint32_t first = s->scene.vertex_count, first_index = s->scene.index_count;
    small_scene_add_sphere(s);
    small_scene_add_quad(s, (float[3]){-2, -1, -2}, (float[3]){0, 0, 4}, (float[3]){4, 0, 0});
    small_scene_add_quad(s, (float[3]){-1.2f, -1, -2}, (float[3]){0, 3, 0}, (float[3]){0, 0, 4});
    small_scene_add_quad(s, (float[3]){-2, -1, -1.1f}, (float[3]){4, 0, 0}, (float[3]){0, 3, 0});
    for (uint32_t i = first; inverse && i < s->scene.vertex_count; i++) {
        float position[3], normal[3];
        multiply_point(inverse, s->vertices[i].position, 1, position);
        multiply_point(inverse_transpose, s->vertices[i].normal, 0, normal);
        const float length = sqrtf(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        for (int k = 0; k < 3; k++) {
            s->vertices[i].position[k] = position[k];
            s->vertices[i].normal[k] = normal[k] / length;
        }
    }
    for (uint32_t i = first_index; mirrored && i < s->scene.index_count; i += 3) {
        const uint32_t swapped = s->indices[i + 1];
        s->indices[i + 1] = s->indices[i + 2];
        s->indices[i + 2] = swapped;
    }
}

/* A rotation about y, then a scale along each axis; its inverse, and its transpose. */
static void make_transform(float angle, const float scale[3], float out[16], float inverse[16], float transpose[16])
{
    const float c = cosf(angle), s = sinf(angle);
    const float rotation[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}}; /* columns */
    memset(out, 0, 16 * sizeof *out);
    memset(inverse, 0, 16 * sizeof *out);
    memset(transpose, 0, 16 * sizeof *out);
    for (int col = 0; col < 3; col++)
        for (int row = 0; row < 3; row++) {
            out[4 * col + row] = rotation[col][row] * scale[col];
            inverse[4 * row + col] = rotation[col][row] / scale[col];
            transpose[4 * row + col] = rotation[col][row] * scale[col];
        }
    out[15] = inverse[15] = transpose[15] = 1;
}

TEST(nodes_may_turn_mirror_and_stretch)
{
    const trace_options options = {.radius = 1.5f, .samples = 256};
    const scene_view view = trace_shot_view((float[3]){3, 2.5f, 4}, (float[3]){0, -0.2f, 0}, 1);
    SCOPED(memory) small_scene *plain = small_scene_create();
    small_scene_begin_mesh(plain, small_scene_add_material(plain, small_scene_material()));
    add_hollow(plain, NULL, NULL, false);
    small_scene_add_instance(plain, NULL);
    const trace_shot truth = trace_shot_take(&plain->scene, &view, options);
    assert_true(trace_shot_foreground(&truth) > TRACE_SHOT_PIXELS / 2);

    const float scales[][3] = {{1, 1, 1}, {-1, 1, 1}, {0.3f, 4, 1}, {5, -0.2f, 2}, {-1, -1, -1}, {1e3f, 1, 1e-3f}};
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        float out[16], inverse[16], transpose[16], elsewhere[16];
        make_transform(0.7f + (float)i, scales[i], out, inverse, transpose);
        memcpy(elsewhere, out, sizeof elsewhere);
        elsewhere[13] = -1000;
        for (int instances = 1; instances <= 2; instances++) { /* two: an Embree instance */
            SCOPED(memory) small_scene *s = small_scene_create();
            small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
            add_hollow(s, inverse, transpose, scales[i][0] * scales[i][1] * scales[i][2] < 0);
            small_scene_add_instance(s, out);
            if (instances == 2)
                small_scene_add_instance(s, elsewhere);
            const trace_shot p = trace_shot_take(&s->scene, &view, options);
            assert_in_range(trace_shot_foreground(&p), trace_shot_foreground(&truth) - 2,
                            trace_shot_foreground(&truth) + 2);
            /* Each pixel agrees to noise, since a normal's last bit may turn the directions. The mean of all agrees
             * much closer. */
            const double noise = trace_shot_difference(&p, &truth), bias = mean(&p) - mean(&truth);
            if (!(noise < 0.01 && fabs(bias) < 5e-4))
                fail_msg("scale %zu, %d instances: differs by %g, in the mean by %g", i, instances, noise, bias);
        }
    }
}

/* Root mean square of the difference over the picture. */
static double rms_difference(const trace_shot *a, const trace_shot *b)
{
    double sum = 0;
    for (int i = 0; i < TRACE_SHOT_PIXELS; i++) {
        const double d = (double)a->accessibility[i] - (double)b->accessibility[i];
        sum += d * d;
    }
    return sqrt(sum / TRACE_SHOT_PIXELS);
}

static small_scene *make_hollow(scene_view *out_view, float scale)
{
    small_scene *s = small_scene_create();
    small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
    add_hollow(s, NULL, NULL, false);
    for (uint32_t i = 0; i < s->scene.vertex_count; i++)
        for (int k = 0; k < 3; k++)
            s->vertices[i].position[k] *= scale;
    small_scene_add_instance(s, NULL);
    *out_view = trace_shot_view((float[3]){3, 2.5f, 4}, (float[3]){0, -0.2f, 0}, scale);
    return s;
}

TEST(error_falls_with_the_root_of_the_rays)
{
    scene_view view;
    SCOPED(memory) small_scene *s = make_hollow(&view, 1);
    const trace_shot truth =
        trace_shot_take(&s->scene, &view, (trace_options){.radius = 1.5f, .samples = 1 << 14, .seed = 99});
    double before = 0;
    for (int samples = 16; samples <= 1024; samples *= 4) {
        const trace_shot p = trace_shot_take(&s->scene, &view, (trace_options){.radius = 1.5f, .samples = samples});
        const double error = rms_difference(&p, &truth);
        /* At most the error of independent samples of the worst variance, and at least halved each time. */
        assert_true(error <= 0.5 / sqrt(samples));
        if (before > 0 && !(error <= before / 2))
            fail_msg("%d rays: error %g after %g", samples, error, before);
        before = error;
    }
}

TEST(same_seed_gives_same_bits)
{
    scene_view view;
    SCOPED(memory) small_scene *s = make_hollow(&view, 1);
    const trace_options options = {.radius = 1.5f, .samples = 37, .seed = 5, .threads = 1};
    const trace_shot one = trace_shot_take(&s->scene, &view, options);
    for (int threads = 0; threads < 6; threads++) {
        trace_options other = options;
        other.threads = threads;
        const trace_shot p = trace_shot_take(&s->scene, &view, other);
        assert_memory_equal(p.accessibility, one.accessibility, sizeof one.accessibility);
        assert_memory_equal(p.foreground, one.foreground, sizeof one.foreground);
        assert_true(p.stats.rays == (uint64_t)trace_shot_foreground(&one) * 37);
    }
    trace_options other = options;
    other.seed = 6;
    const trace_shot p = trace_shot_take(&s->scene, &view, other);
    assert_memory_not_equal(p.accessibility, one.accessibility, sizeof one.accessibility);
    assert_true(trace_shot_difference(&p, &one) < 0.1);
}

TEST(scale_does_not_matter)
{
    scene_view view;
    SCOPED(memory) small_scene *s = make_hollow(&view, 1);
    const trace_shot truth = trace_shot_take(&s->scene, &view, (trace_options){.radius = 1.5f, .samples = 256});
    const float scales[] = {1e-4f, 1e4f};
    for (int i = 0; i < 2; i++) {
        scene_view scaled_view;
        SCOPED(memory) small_scene *scaled = make_hollow(&scaled_view, scales[i]);
        const trace_shot p =
            trace_shot_take(&scaled->scene, &scaled_view, (trace_options){.radius = 1.5f * scales[i], .samples = 256});
        assert_in_range(trace_shot_foreground(&p), trace_shot_foreground(&truth) - 2,
                        trace_shot_foreground(&truth) + 2);
        assert_true(trace_shot_difference(&p, &truth) < 1e-3);
    }
}

/* A quad that faces +z, seen from either side, and one that rays from both sides may hit. */
TEST(back_faces_are_unseen_but_block)
{
    for (int double_sided = 0; double_sided < 2; double_sided++) {
        SCOPED(memory) small_scene *s = small_scene_create();
        scene_material m = small_scene_material();
        m.double_sided = double_sided;
        small_scene_begin_mesh(s, small_scene_add_material(s, m));
        small_scene_add_quad(s, (float[3]){-9, -9, 0}, (float[3]){18, 0, 0}, (float[3]){0, 18, 0});
        small_scene_add_instance(s, NULL);
        const scene_view front = trace_shot_view((float[3]){0, 0, 5}, (float[3]){0, 0, 0}, 1);
        const scene_view behind = trace_shot_view((float[3]){0, 0, -5}, (float[3]){0, 0, 0}, 1);
        const trace_options options = {.radius = 1, .samples = 16};
        const trace_shot from_front = trace_shot_take(&s->scene, &front, options);
        const trace_shot from_behind = trace_shot_take(&s->scene, &behind, options);
        assert_int_equal(trace_shot_foreground(&from_front), TRACE_SHOT_PIXELS);
        assert_int_equal(trace_shot_foreground(&from_behind), double_sided ? TRACE_SHOT_PIXELS : 0);
        for (int i = 0; i < TRACE_SHOT_PIXELS; i++)
            assert_true(from_front.accessibility[i] == 1 && from_behind.accessibility[i] == 1);
    }
    for (int facing_down = 0; facing_down < 2; facing_down++) {
        const float wide[3] = {1000, 0, 0}, deep[3] = {0, 0, 1000};
        SCOPED(memory) small_scene *s = small_scene_create();
        small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
        small_scene_add_quad(s, (float[3]){-500, 1, -500}, facing_down ? wide : deep, facing_down ? deep : wide);
        small_scene_add_instance(s, NULL);
        SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
        assert_true(trace_shot_point(t, 0, 0, 0, INFINITY, 64) < 0.02);
    }
}

TEST(projections_agree)
{
    scene_view view;
    SCOPED(memory) small_scene *s = make_hollow(&view, 1);
    const trace_options options = {.radius = 1.5f, .samples = 32};
    const trace_shot usual = trace_shot_take(&s->scene, &view, options);
    const float near_plane = 0.1f, far_plane = 100;
    scene_view infinite = view, reversed = view, infinite_reversed = view;
    infinite.clip_from_view[10] = -1;
    infinite.clip_from_view[14] = -2 * near_plane;
    reversed.clip_from_view[10] *= -1;
    reversed.clip_from_view[14] *= -1;
    infinite_reversed.clip_from_view[10] = 1;
    infinite_reversed.clip_from_view[14] = 2 * near_plane;
    const scene_view *const others[] = {&infinite, &reversed, &infinite_reversed};
    for (int i = 0; i < 3; i++) {
        const trace_shot p = trace_shot_take(&s->scene, others[i], options);
        assert_int_equal(trace_shot_foreground(&p), trace_shot_foreground(&usual));
        assert_true(trace_shot_difference(&p, &usual) < 1e-3);
    }

    /* Off-centre: shifted by exactly half a picture, the right half shows what the left one did. */
    scene_view off_centre = view;
    off_centre.clip_from_view[8] -= 1;
    const trace_shot moved = trace_shot_take(&s->scene, &off_centre, options);
    for (int y = 0; y < TRACE_SHOT_SIDE; y++)
        for (int x = TRACE_SHOT_SIDE / 2; x < TRACE_SHOT_SIDE; x++)
            assert_int_equal(moved.foreground[y * TRACE_SHOT_SIDE + x],
                             usual.foreground[y * TRACE_SHOT_SIDE + x - TRACE_SHOT_SIDE / 2]);

    /* Orthographic, forwards and reversed: a quad two of 32 pixels wide, cut by the near and far planes when it leaves
     * them. */
    SCOPED(memory) small_scene *quad = small_scene_create();
    small_scene_begin_mesh(quad, small_scene_add_material(quad, small_scene_material()));
    small_scene_add_quad(quad, (float[3]){0, 0, -50}, (float[3]){0.125f, 0, 0}, (float[3]){0, 0.125f, 0});
    small_scene_add_instance(quad, NULL);
    for (int i = 0; i < 4; i++) {
        const bool backwards = i & 1;
        const float far_end = i < 2 ? far_plane : 40;
        scene_view parallel = {.width = TRACE_SHOT_SIDE, .height = TRACE_SHOT_SIDE};
        for (int k = 0; k < 16; k += 5)
            parallel.view_from_world[k] = parallel.clip_from_view[k] = 1;
        parallel.clip_from_view[10] = (backwards ? 2 : -2) / (far_end - near_plane);
        parallel.clip_from_view[14] = (backwards ? 1 : -1) * (far_end + near_plane) / (far_end - near_plane);
        const trace_shot p = trace_shot_take(&quad->scene, &parallel, options);
        assert_int_equal(trace_shot_foreground(&p), i < 2 ? 4 : 0);
        assert_int_equal(p.foreground[(TRACE_SHOT_SIDE / 2 + 1) * TRACE_SHOT_SIDE + TRACE_SHOT_SIDE / 2 + 1], i < 2);
    }
}

TEST(flat_instances_are_seen)
{
    const float flat[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    SCOPED(memory) small_scene *s = small_scene_create();
    scene_material m = small_scene_material();
    m.double_sided = true;
    small_scene_begin_mesh(s, small_scene_add_material(s, m));
    small_scene_add_sphere(s);
    small_scene_add_instance(s, flat);
    small_scene_add_instance(s, (float[16]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 50, 0, 0, 1});
    const scene_view view = trace_shot_view((float[3]){0, 0, 4}, (float[3]){0, 0, 0}, 1);
    const trace_shot p = trace_shot_take(&s->scene, &view, (trace_options){.radius = 1, .samples = 16});
    assert_true(trace_shot_foreground(&p) > TRACE_SHOT_PIXELS / 4);
    for (int i = 0; i < TRACE_SHOT_PIXELS; i++)
        assert_true(p.accessibility[i] >= 0 && p.accessibility[i] <= 1);
}

TEST(nothing_is_fully_accessible)
{
    SCOPED(memory) small_scene *s = small_scene_create();
    small_scene_add_material(s, small_scene_material());
    const scene_view view = trace_shot_view((float[3]){0, 0, 4}, (float[3]){0, 0, 0}, 1);
    const trace_shot p = trace_shot_take(&s->scene, &view, (trace_options){.radius = 1, .samples = 16});
    assert_int_equal(trace_shot_foreground(&p), 0);
    for (int i = 0; i < TRACE_SHOT_PIXELS; i++)
        assert_true(p.accessibility[i] == 1);
}

TEST(wrong_arguments_are_named)
{
    char error[ERROR_LENGTH] = "";
    scene_view view;
    SCOPED(memory) small_scene *s = make_hollow(&view, 1);
    SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
    static float out[TRACE_SHOT_PIXELS];
    const trace_options no_rays = {.radius = 1}, not_a_radius = {.radius = NAN, .samples = 1};
    assert_false(trace_accessibility(t, &view, &no_rays, out, NULL, NULL, FAULT(error)));
    assert_non_null(strstr(error, "0 rays"));
    assert_false(trace_accessibility(t, &view, &not_a_radius, out, NULL, NULL, FAULT(error)));
    assert_non_null(strstr(error, "nan"));
    memset(view.clip_from_view, 0, sizeof view.clip_from_view);
    const trace_options fine = {.radius = 1, .samples = 1};
    assert_false(trace_accessibility(t, &view, &fine, out, NULL, NULL, FAULT(error)));
    assert_non_null(strstr(error, "inverse"));
    trace_scene_destroy(NULL);
}

static bool is_stopped(void *user)
{
    ++*(int *)user;
    return true;
}

TEST(tracing_ends_when_told_to)
{
    char error[ERROR_LENGTH] = "";
    scene_view view;
    int asked = 0;
    SCOPED(memory) small_scene *s = make_hollow(&view, 1);
    SCOPED(traced) trace_scene *t = trace_shot_open(&s->scene);
    static float out[TRACE_SHOT_PIXELS];
    trace_stats stats;
    const trace_options options = {
        .radius = 1, .samples = 64, .threads = 1, .stopped = is_stopped, .stopped_user = &asked};
    assert_false(trace_accessibility(t, &view, &options, out, NULL, &stats, FAULT(error)));
    assert_string_equal(error, "stopped");
    assert_true(asked > 0);
    assert_int_equal(stats.rays, 0);
}

TEST_MAIN(NULL, NULL, NULL)
