/* SPDX-License-Identifier: MIT
 *
 * A few rays from depth and normals: they agree with the tracer that casts primary rays, whatever the projection; no
 * surface blocks its own rays; neither threads nor strips change a bit.
 */
#include "trace_internal.h" /* first: its parameters have names of types that the others declare */

#include "camera.h"
#include "gbuffer.h"
#include "rays.h"
#include "small_scene.h"

#include "fixture.h"

enum { W = 150, H = 90, ERROR_LENGTH = 512 };

typedef struct setup {
    scene *scene; /* NULL: not ours */
    trace_scene *traced;
    scene_renderer *renderer;
    gbuffer gbuffer;
    rays rays;
    float radius;
} setup;

static void set_up_scene(setup *t, const scene *s, const camera *c, float radius)
{
    char error[ERROR_LENGTH];
    const scene_view view = camera_view(c, W, H);
    t->radius = radius;
    if (!(t->traced = trace_scene_create(s, FAULT(error))) || !(t->renderer = scene_renderer_create(s, FAULT(error))) ||
        !gbuffer_draw(&t->gbuffer, s, &view, 0, FAULT(error)))
        fail_msg("%s", error);
}

static setup set_up(const char *name, bool orthographic)
{
    char error[ERROR_LENGTH];
    setup t = {.scene = scene_make(name, FAULT(error))};
    camera c = camera_frame_scene(t.scene, (float)W / H);
    if (orthographic)
        c.half_height = 2;
    camera_fit_planes(&c, t.scene);
    set_up_scene(&t, t.scene, &c, 0.5f);
    return t;
}

static void tear_down(setup *t)
{
    rays_close(&t->rays);
    gbuffer_destroy(&t->gbuffer);
    scene_renderer_destroy(t->renderer);
    trace_scene_destroy(t->traced);
    scene_destroy(t->scene);
}
#define test_end_setup tear_down /* for SCOPED */

static const float *trace_by(setup *t, const trace_options *options, int step)
{
    char error[ERROR_LENGTH] = "";
    failure why = {.text = error, .size = sizeof error};
    const rays_job job = {.renderer = t->renderer,
                          .depth = t->gbuffer.depth,
                          .normals = t->gbuffer.normals,
                          .view = &t->gbuffer.view,
                          .step = step,
                          .options = *options};
    if (!rays_trace(&t->rays, t->traced, &job, &why))
        fail_msg("%s", error);
    return t->rays.accessibility;
}

/* Accessibility of each texel; the rays' own memory. */
static const float *trace(setup *t, int samples, int step, int threads, uint32_t seed)
{
    const trace_options options = {.radius = t->radius, .samples = samples, .threads = threads, .seed = seed};
    return trace_by(t, &options, step);
}

static void truth_of(const setup *t, float truth[W * H], uint8_t seen[W * H])
{
    char error[ERROR_LENGTH] = "";
    const trace_options options = {.radius = t->radius, .samples = 256};
    if (!trace_accessibility(t->traced, &t->gbuffer.view, &options, truth, seen, NULL, FAULT(error)))
        fail_msg("%s", error);
}

/* Pixels at a triangle's edge may show another surface to the rasteriser. The noise of 64 stratified rays is below that
 * of 64 independent ones, 1/16 at most. */
static void assert_near_truth(setup *t, const char *what)
{
    static float truth[W * H];
    static uint8_t seen[W * H];
    truth_of(t, truth, seen);
    const float *got = trace(t, 64, 1, 0, 1);
    int count = 0, far = 0, elsewhere = 0;
    double bias = 0;
    for (int i = 0; i < W * H; i++) {
        elsewhere += (got[i] >= 0) != seen[i];
        if (got[i] < 0 || !seen[i])
            continue;
        bias += (double)got[i] - (double)truth[i];
        far += fabs((double)got[i] - (double)truth[i]) > 3.0 / 16;
        count++;
    }
    print_message("%s: bias %+.4f, %d of %d pixels far off, %d seen by one alone\n", what, bias / count, far, count,
                  elsewhere);
    assert_true(count > W * H / 8);
    assert_true(fabs(bias / count) < 0.004);
    assert_true(far * 200 < count);
    assert_true(elsewhere * 100 < W * H);
}

TEST_GL(rays_agree_with_the_truth)
{
    static const char *const names[] = {"steps", "columns", "cornell"};
    for (int i = 0; i < 6; i++) {
        SCOPED(setup) setup t = set_up(names[i / 2], i % 2);
        assert_near_truth(&t, names[i / 2]);
    }
}

/* An open plane, seen ever more from the side and from ever farther, blocks none of its rays. */
TEST_GL(no_surface_blocks_its_own_rays)
{
    for (int i = 0; i < 12; i++) {
        const float distance = powf(10, (float)(i / 4)), height = distance * powf(0.25f, (float)(i % 4));
        SCOPED(memory) small_scene *s = small_scene_create();
        small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
        small_scene_add_quad(s, (float[3]){-500, 0, -500}, (float[3]){0, 0, 1000}, (float[3]){1000, 0, 0});
        small_scene_add_instance(s, NULL);
        const camera c = {
            .eye = {3, height, distance}, .up = {0, 1, 0}, .fov_y_rad = 0.8f, .near_plane = 0.1f, .far_plane = 1000};
        SCOPED(setup) setup t = {.traced = NULL};
        set_up_scene(&t, &s->scene, &c, 2);
        const float *got = trace(&t, 4, 1, 0, 0);
        int seen = 0, blocked = 0;
        for (int k = 0; k < W * H; k++) {
            seen += got[k] >= 0;
            blocked += got[k] >= 0 && got[k] < 1;
        }
        assert_true(seen > W * H / 20);
        if (blocked > 0)
            fail_msg("from %g, %g up: %d of %d pixels are blocked", (double)distance, (double)height, blocked, seen);
    }
}

/* Holes that an alpha test cuts are holes for rays, too: a roof whose texels are all holes darkens nothing. */
TEST_GL(alpha_tests_let_rays_through)
{
    for (int hole = 0; hole < 2; hole++) {
        SCOPED(memory) small_scene *s = small_scene_create();
        scene_material roof = small_scene_material();
        roof.alpha = SCENE_ALPHA_MASK;
        roof.alpha_cutoff = 0.5f;
        roof.base_color[3] = hole ? 0.25f : 0.75f;
        small_scene_begin_mesh(s, small_scene_add_material(s, small_scene_material()));
        small_scene_add_quad(s, (float[3]){-4, 0, -4}, (float[3]){0, 0, 8}, (float[3]){8, 0, 0});
        small_scene_add_instance(s, NULL);
        small_scene_begin_mesh(s, small_scene_add_material(s, roof));
        small_scene_add_quad(s, (float[3]){-1, 1, -1}, (float[3]){0, 0, 2}, (float[3]){2, 0, 0});
        small_scene_add_instance(s, NULL);
        const camera c = {
            .eye = {0, 0.6f, 5}, .up = {0, 1, 0}, .fov_y_rad = 0.8f, .near_plane = 0.1f, .far_plane = 100};
        SCOPED(setup) setup t = {.traced = NULL};
        set_up_scene(&t, &s->scene, &c, 3);
        const float *got = trace(&t, 16, 1, 0, 0);
        float least = 1;
        for (int k = 0; k < W * H; k++)
            least = got[k] >= 0 && got[k] < least ? got[k] : least;
        assert_true(hole ? least == 1 : least < 0.5f);
    }
}

TEST_GL(threads_change_nothing)
{
    SCOPED(setup) setup t = set_up("steps", false);
    SCOPED(memory) float *alone = malloc(sizeof(float) * W * H);
    memcpy(alone, trace(&t, 3, 1, 1, 7), sizeof(float) * W * H);
    assert_memory_equal(alone, trace(&t, 3, 1, 5, 7), sizeof(float) * W * H);
    assert_int_not_equal(memcmp(alone, trace(&t, 3, 1, 5, 8), sizeof(float) * W * H), 0);
}

/* At half size a texel stands for the lower left of four pixels. */
TEST_GL(half_size_takes_every_other_surface)
{
    SCOPED(setup) setup t = set_up("steps", false);
    SCOPED(memory) uint8_t *full = malloc(W * H);
    const float *got = trace(&t, 1, 1, 0, 0);
    for (int i = 0; i < W * H; i++)
        full[i] = got[i] >= 0;
    got = trace(&t, 1, 2, 0, 0);
    assert_int_equal(t.rays.width, (W + 1) / 2);
    for (int y = 0; y < (H + 1) / 2; y++)
        for (int x = 0; x < (W + 1) / 2; x++)
            assert_int_equal(got[y * ((W + 1) / 2) + x] >= 0, full[2 * y * W + 2 * x]);
}

/* Counts of 0 to N, fed by and by: texels without rays are negative, and the others unbiased whatever their count. */
TEST_GL(counts_are_kept)
{
    SCOPED(setup) setup t = set_up("columns", false);
    static float truth[W * H], out[W * H], (*texels)[4];
    static uint8_t seen[W * H], counts[W * H];
    static const float(*rows[H])[4];
    char error[ERROR_LENGTH] = "";
    truth_of(&t, truth, seen);
    SCOPED(memory) float *distance = NULL, *normals = NULL;
    gbuffer_read(&t.gbuffer, &distance, &normals);
    texels = malloc(sizeof *texels * W * H);
    for (int i = 0; i < W * H; i++) {
        memcpy(texels[i], normals + 3 * i, 3 * sizeof(float));
        texels[i][3] = distance[i];
        counts[i] = (uint8_t)(i % 5);
    }
    for (int y = 0; y < H; y++)
        rows[y] = (const float(*)[4])(texels + y * W);
    const trace_seen surfaces = {.rows = rows, .step = 1, .depth_step = 0x1p-24};
    double bias[5] = {0};
    int number[5] = {0};
    for (uint32_t seed = 0; seed < 8; seed++) {
        const trace_options options = {.radius = t.radius, .samples = 4, .seed = seed, .threads = 2};
        trace_picture *p =
            trace_picture_begin(t.traced, &t.gbuffer.view, &surfaces, counts, &options, out, FAULT(error));
        trace_stats stats;
        for (int y = 0; p && y <= H; y += 7)
            trace_picture_feed(p, y + 7 <= H ? y : H);
        assert_true(p && trace_picture_end(p, &stats));
        uint64_t wanted = 0;
        for (int i = 0; i < W * H; i++) {
            assert_true((out[i] >= 0) == (counts[i] > 0 && distance[i] > 0));
            if (out[i] < 0 || !seen[i])
                continue;
            bias[counts[i]] += (double)out[i] - (double)truth[i];
            number[counts[i]]++;
        }
        for (int i = 0; i < W * H; i++)
            wanted += distance[i] > 0 ? counts[i] : 0;
        assert_int_equal(stats.rays, wanted);
    }
    for (int k = 1; k < 5; k++)
        assert_true(fabs(bias[k] / number[k]) < 0.006);
    free(texels);
}

typedef struct mean_error {
    double bias, rmse, rays;
} mean_error;

/* Of means over 4 x 4 pixels, as a blur takes them; rays a run. */
static mean_error measure_means(setup *t, bool adaptive, const float truth[W * H], const uint8_t seen[W * H])
{
    enum { RUNS = 8 };
    mean_error e = {0, 0, 0};
    double pixels = 0, means = 0;
    t->rays.stats.rays = 0;
    for (uint32_t seed = 0; seed < RUNS; seed++) {
        const trace_options options = {.radius = t->radius, .samples = 4, .adaptive = adaptive, .seed = seed};
        const float *got = trace_by(t, &options, 1);
        for (int y = 0; y + 4 <= H; y += 4)
            for (int x = 0; x + 4 <= W; x += 4) {
                double sum = 0, count = 0;
                for (int i = 0; i < 16; i++) {
                    const int at = (y + i / 4) * W + x + i % 4;
                    sum += got[at] >= 0 && seen[at] ? (double)got[at] - (double)truth[at] : 0;
                    count += got[at] >= 0 && seen[at];
                }
                e.bias += sum;
                pixels += count;
                e.rmse += count > 0 ? sum * sum / count / count : 0;
                means += count > 0;
            }
    }
    return (mean_error){e.bias / pixels, sqrt(e.rmse / means), (double)t->rays.stats.rays / RUNS};
}

/* Fewer rays than a fixed count's, no more error of what a blur makes of them, no bias, and the same bits by any
 * threads. */
TEST_GL(adaptive_counts_pay)
{
    static float truth[W * H], first[W * H];
    static uint8_t seen[W * H];
    SCOPED(setup) setup t = set_up("columns", false);
    truth_of(&t, truth, seen);
    const mean_error fixed = measure_means(&t, false, truth, seen), adaptive = measure_means(&t, true, truth, seen);
    print_message("fixed: %.0f rays, RMSE %.4f; adaptive: %.0f rays, bias %+.4f, RMSE %.4f\n", fixed.rays, fixed.rmse,
                  adaptive.rays, adaptive.bias, adaptive.rmse);
    assert_true(adaptive.rays < 0.9 * fixed.rays);
    assert_true(adaptive.rmse <= fixed.rmse);
    assert_true(fabs(adaptive.bias) < 0.004);
    for (int threads = 1; threads <= 3; threads += 2) {
        const trace_options options = {.radius = t.radius, .samples = 2, .adaptive = true, .threads = threads};
        const float *got = trace_by(&t, &options, 1);
        if (threads == 1)
            memcpy(first, got, sizeof first);
        assert_memory_equal(first, got, sizeof first);
    }
    SCOPED(setup) setup plane = set_up("plane", false); /* nothing is occluded */
    const float *open = trace_by(&plane, &(trace_options){.radius = plane.radius, .samples = 12, .adaptive = true}, 1);
    int surfaces = 0;
    for (int i = 0; i < W * H; i++) {
        surfaces += open[i] >= 0;
        assert_true(open[i] < 0 || open[i] > 0.999f);
    }
    assert_true(plane.rays.stats.rays < 5 * (uint64_t)surfaces); /* 3 where 16 x 16 agree */
}

/* Where a direction lies in the square that the concentric map (Shirley and Chiu 1997) comes from. */
static void find_in_square(const float d[3], double out[2])
{
    const double pi = 3.14159265358979, size = hypot((double)d[0], (double)d[1]);
    double angle = atan2((double)d[1], (double)d[0]) + (atan2((double)d[1], (double)d[0]) < -pi / 4 ? 2 * pi : 0);
    const int side = (int)floor((angle + pi / 4) / (pi / 2));
    const double sign = side < 2 ? 1 : -1, along = (angle - side * pi / 2) / (pi / 4) * size;
    out[0] = side % 2 ? -sign * along : sign * size;
    out[1] = side % 2 ? sign * size : sign * along;
}

/* The first of 4 rays of 16 x 16 pixels: as many in each of the 64 cells of the square, so that what they all say holds
 * for the whole hemisphere. */
TEST(first_rays_reach_everywhere)
{
    trace_pattern p;
    int cells[64] = {0};
    assert_true(trace_pattern_open(&p, 4, 7));
    for (int i = 0; i < 256; i++) {
        double at[2];
        find_in_square(p.directions[(i / 16 * p.side + i % 16) * 4], at);
        cells[(int)(4 * (at[0] + 1)) + 8 * (int)(4 * (at[1] + 1))]++;
    }
    for (int i = 0; i < 64; i++)
        assert_int_equal(cells[i], 4);
    trace_pattern_close(&p);
}

TEST_GL(wrong_arguments_are_named)
{
    char error[ERROR_LENGTH] = "";
    failure why = {.text = error, .size = sizeof error};
    SCOPED(setup) setup t = set_up("plane", false);
    rays_job job = {.renderer = t.renderer,
                    .depth = t.gbuffer.depth,
                    .normals = t.gbuffer.normals,
                    .view = &t.gbuffer.view,
                    .step = 1,
                    .options = {.radius = 1, .samples = 65}};
    assert_false(rays_trace(&t.rays, t.traced, &job, &why));
    assert_string_equal(error, "65 rays within a radius of 1: out of range");
    job.options.samples = 0;
    assert_false(rays_trace(&t.rays, t.traced, &job, &why));
    job.options = (trace_options){.radius = 1, .samples = 17, .adaptive = true};
    assert_false(rays_trace(&t.rays, t.traced, &job, &why));
    job.options.samples = 1;
    assert_true(rays_trace(&t.rays, t.traced, &job, &why));
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
