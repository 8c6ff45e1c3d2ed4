/* SPDX-License-Identifier: MIT
 *
 * The host's rays: alone, denoised, and as a correction of another technique. Each pass is compared with a model in
 * double precision, from the maps that it reads; and what must hold whatever the passes are: rays that say nothing
 * change nothing, rays that all say the same win.
 */
#include "analytic.h"
#include "fixture.h"
#include "horizon_internals.h"
#include "horizon_passes.h"

static const double PAIRED = 0x1p-14 + 1e-6, RESULT = 1.5 / 65535.0;

typedef struct setup {
    glssao_effect *effect;
    glssao_frame frame;
    glssao_settings settings;
    int width, height; /* full size */
    float *depth;
    float sky;
} setup;

static setup set_up(fixture *f, analytic_projection projection, const analytic_shape *shapes, int shape_count,
                    int width, int height)
{
    const analytic_view view = analytic_make_view(projection, (double)width / height, 0.5, 40.0, 1.0);
    float *normals;
    setup s = {.width = width, .height = height};
    analytic_render(&view, shapes, shape_count, width, height, &s.depth, &normals);
    s.effect = fixture_drawn_effect(f, width, height);
    s.frame = fixture_maps_frame(&view, width, height, GL_DEPTH_COMPONENT32F, s.depth, normals);
    s.sky = view.clip_zero_to_one ? 0.0f : 1.0f;
    s.settings = glssao_default_settings(GLSSAO_RAYS, GLSSAO_HIGH);
    s.settings.radius = 0.8f;
    free(normals);
    return s;
}

static setup set_up_room(fixture *f, analytic_projection projection, int width, int height)
{
    return set_up(f, projection, analytic_unit_room, ANALYTIC_ROOM_SHAPES, width, height);
}

static void tear_down(setup *s)
{
    fixture_delete_frame(&s->frame);
    glssao_destroy(s->effect);
    free(s->depth);
}
#define test_end_setup tear_down /* for SCOPED */

/* Replaces the rays of the frame; half: of half size. */
static void bring(setup *s, GLenum format, bool half, const float *values)
{
    const int width = half ? (s->width + 1) / 2 : s->width, height = half ? (s->height + 1) / 2 : s->height;
    gl.DeleteTextures(1, &s->frame.rays_texture);
    s->frame.rays_texture = fixture_texture(format, GL_RED, GL_FLOAT, width, height, values);
}

static void bring_constant(setup *s, GLenum format, bool half, float value)
{
    const int count = s->width * s->height;
    SCOPED(memory) float *values = malloc((size_t)count * sizeof *values);
    for (int i = 0; i < count; ++i)
        values[i] = value;
    bring(s, format, half, values);
}

/* As two rays a pixel would say, at a known seed; one pixel in eight has none. */
static float *bring_noise(setup *s, bool half)
{
    const int count = s->width * s->height;
    float *values = malloc((size_t)count * sizeof *values);
    uint32_t random = 12345;
    for (int i = 0; i < count; ++i) {
        random = random * 1664525u + 1013904223u;
        const int roll = (int)(random >> 29);
        values[i] = roll == 0 ? -1.0f : 0.5f * (float)(roll % 3);
    }
    bring(s, GL_R32F, half, values);
    return values;
}

static float *compute(const setup *s, int *out_count)
{
    int width, height;
    float *result = fixture_compute(s->effect, &s->frame, &s->settings, &width, &height);
    *out_count = width * height;
    return result;
}

static paired_map read_paired(const setup *s, uint32_t texture)
{
    const int divisor = s->settings.half_resolution ? 2 : 1;
    paired_map map = {.width = (s->width + divisor - 1) / divisor, .height = (s->height + divisor - 1) / divisor};
    map.texels = fixture_read_texture(texture, map.width, map.height, 3);
    return map;
}

static pass_constants constants_of(const setup *s, int round, bool corrects)
{
    pass_constants c, upsample;
    horizon_read_pass_constants(&c, &upsample);
    c.tolerance *= (double)s->settings.radius;
    c.near *= (double)s->settings.radius;
    c.apart = 1 << round;
    c.are_rays = true;
    c.alike = round > 0 && !corrects ? horizon_rays_alike() : 0.0;
    c.prior = round == 0 && corrects ? horizon_correction_prior() : 0.0;
    horizon_depth_step(s->effect, c.depth_step);
    return c;
}

/* One pass of the blur; `got` has `stride` floats a texel, 1 where it is the result, in which nothing is missing. Few
 * pixels may be open, where rounding decides whether a tap counts. */
static void check_blur(const setup *s, const paired_map *from, bool horizontal, int round, bool corrects,
                       const float *got, int stride)
{
    const pass_constants c = constants_of(s, round, corrects);
    const bool orthographic = s->frame.projection[11] == 0.0f;
    int wrong = 0, open = 0, changed = 0, count = from->width * from->height;
    for (int i = 0; i < count; ++i) {
        double low, high;
        planar_blur_model(from, horizontal, orthographic, &c, i % from->width, i / from->width, &low, &high);
        const double value = stride == 1 ? (double)got[i] : paired_accessibility(got[stride * i]);
        if (stride == 1 && low < 0.0)
            low = high = 1.0;
        const double tolerance = stride == 1 ? RESULT : PAIRED;
        wrong += !(value >= low - tolerance && value <= high + tolerance);
        open += high - low > 0.01;
        changed += fabs(value - paired_accessibility(from->texels[3 * i])) > 0.01;
    }
    print_message("round %d %s: open %.2f %%, changed %.0f %%\n", round, horizontal ? "horizontal" : "vertical",
                  100.0 * open / count, 100.0 * changed / count);
    assert_int_equal(wrong, 0);
    assert_true(open * 50 < count);
    assert_true(changed * 20 > count);
}

/* ---- models ---- */

TEST_GL(rays_are_read_as_they_are)
{
    SCOPED(setup) setup s = set_up_room(f, PERSPECTIVE, 121, 91);
    for (int half = 0; half < 2; ++half) {
        SCOPED(memory) float *values = bring_noise(&s, half);
        int count;
        s.settings.blur_rounds = 1;
        free(compute(&s, &count));
        SCOPED(paired) paired_map map = read_paired(&s, horizon_paired_map(s.effect, 0));
        for (int y = 0; y < s.height; ++y)
            for (int x = 0; x < s.width; ++x) {
                const float *own = half ? &values[y / 2 * ((s.width + 1) / 2) + x / 2] : &values[y * s.width + x];
                const bool is_there = !half || (x % 2 == 0 && y % 2 == 0);
                const bool sky = s.depth[y * s.width + x] == s.sky;
                const double wanted = sky ? 1.0 : is_there ? (double)*own : -1.0;
                const double got = paired_accessibility(map.texels[3 * (y * s.width + x)]);
                assert_true(wanted < 0.0 ? got == -1.0 : fabs(got - wanted) <= PAIRED + 2e-6);
            }
    }
}

static void check_rounds(fixture *f, analytic_projection projection, int width, int height)
{
    int count;
    SCOPED(setup) setup s = set_up_room(f, projection, width, height);
    free(bring_noise(&s, false));
    s.settings.blur_rounds = 1;
    float *result = compute(&s, &count);
    SCOPED(paired) paired_map estimate = read_paired(&s, horizon_paired_map(s.effect, 0));
    SCOPED(paired) paired_map across = read_paired(&s, horizon_paired_map(s.effect, 1));
    check_blur(&s, &estimate, true, 0, false, across.texels, 3);
    check_blur(&s, &across, false, 0, false, result, 1);
    free(result);
    s.settings.blur_rounds = 2;
    result = compute(&s, &count);
    SCOPED(paired) paired_map first = read_paired(&s, horizon_paired_map(s.effect, 0));
    SCOPED(paired) paired_map second = read_paired(&s, horizon_paired_map(s.effect, 1));
    check_blur(&s, &across, false, 0, false, first.texels, 3);
    check_blur(&s, &first, true, 1, false, second.texels, 3);
    check_blur(&s, &second, false, 1, false, result, 1);
    free(result);
}

TEST_GL(rounds_agree_with_their_model)
{
    check_rounds(f, PERSPECTIVE, 120, 90);
    check_rounds(f, PERSPECTIVE_REVERSED_ZERO_TO_ONE, 121, 91);
    check_rounds(f, ORTHOGRAPHIC, 91, 121);
}

/* What the first pass of a correction writes: the estimate's map with half the difference plus a half as values. */
static paired_map differences(const setup *s, const paired_map *estimate, const float *rays)
{
    const size_t count = (size_t)estimate->width * (size_t)estimate->height;
    paired_map map = {malloc(3 * count * sizeof *map.texels), estimate->width, estimate->height};
    memcpy(map.texels, estimate->texels, 3 * count * sizeof *map.texels);
    for (size_t i = 0; i < count; ++i) {
        const double own = pow(paired_accessibility(map.texels[3 * i]), 1.0 / (double)s->settings.power);
        const size_t at = 2 * (i / (size_t)map.width) * (size_t)s->width + 2 * (i % (size_t)map.width);
        const bool is_missing = rays[i] < 0.0f || s->depth[at] == s->sky;
        paired_set(&map.texels[3 * i], is_missing ? -1.0 : 0.5 + 0.5 * ((double)rays[i] - own));
    }
    return map;
}

/* The first round, whose passes leave only their result. Where normals or lines are too close to call, so are pixels
 * beside. */
static void check_first_round(const setup *s, const paired_map *start, const paired_map *got)
{
    const pass_constants c = constants_of(s, 0, true);
    const bool orthographic = s->frame.projection[11] == 0.0f;
    const int width = got->width, height = got->height;
    SCOPED(paired) paired_map across = {malloc(3 * (size_t)(width * height) * sizeof *across.texels), width, height};
    memcpy(across.texels, start->texels, 3 * (size_t)(width * height) * sizeof *across.texels);
    SCOPED(memory) bool *open = calloc((size_t)(width * height), sizeof *open);
    int checked = 0, wrong = 0, told = 0;
    for (int i = 0; i < width * height; ++i) {
        double low, high;
        planar_blur_model(start, true, orthographic, &c, i % width, i / width, &low, &high);
        open[i] = high - low > 1e-6;
        paired_set(&across.texels[3 * i], low);
    }
    for (int i = 0; i < width * height; ++i) {
        double low, high;
        bool is_open = false;
        for (int k = -2; k <= 2; ++k)
            is_open |= i + k * width >= 0 && i + k * width < width * height && open[i + k * width];
        planar_blur_model(&across, false, orthographic, &c, i % width, i / width, &low, &high);
        if (is_open || high - low > 1e-6)
            continue;
        checked++;
        wrong += !(fabs(paired_accessibility(got->texels[3 * i]) - low) <= 3 * PAIRED);
        told += low > 0.0;
    }
    assert_int_equal(wrong, 0);
    assert_true(checked * 10 > width * height * 9 && told * 6 > checked);
}

/* The first round, and the last pass, which adds the difference to the estimate. */
TEST_GL(corrections_agree_with_their_model)
{
    static const float powers[] = {1.0f, 3.0f};
    for (int i = 0; i < 2; ++i) {
        int count;
        SCOPED(setup) setup s = set_up_room(f, i ? ORTHOGRAPHIC : PERSPECTIVE, 120, 90);
        SCOPED(memory) float *rays = bring_noise(&s, true);
        s.settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
        s.settings.upsample = false;
        s.settings.radius = 0.8f;
        s.settings.power = powers[i];
        s.settings.blur_rounds = 1;
        SCOPED(memory) float *result = compute(&s, &count);
        SCOPED(paired) paired_map estimate = read_paired(&s, horizon_paired_map(s.effect, 0));
        SCOPED(paired) paired_map first = read_paired(&s, horizon_rays_map(s.effect, 0));
        SCOPED(paired) paired_map before = read_paired(&s, horizon_rays_map(s.effect, 1));
        SCOPED(paired) paired_map start = differences(&s, &estimate, rays);
        check_first_round(&s, &start, &first);
        check_blur(&s, &first, true, 1, true, before.texels, 3);
        assert_int_equal(count, estimate.width * estimate.height);
        const pass_constants c = constants_of(&s, 1, true);
        int moved = 0;
        for (int k = 0; k < count; ++k) {
            double bounds[2];
            planar_blur_model(&before, false, i != 0, &c, k % before.width, k / before.width, &bounds[0], &bounds[1]);
            const double own = paired_accessibility(estimate.texels[3 * k]), power = (double)powers[i];
            for (int side = 0; side < 2; ++side) {
                const double difference = bounds[side] < 0.0 ? 0.0 : 2.0 * bounds[side] - 1.0;
                bounds[side] = pow(fmin(fmax(pow(own, 1.0 / power) + difference, 0.0), 1.0), power);
            }
            assert_true((double)result[k] >= bounds[0] - RESULT && (double)result[k] <= bounds[1] + RESULT);
            moved += fabs((double)result[k] - own) > 0.05;
        }
        assert_true(moved * 50 > count);
    }
}

/* ---- properties ---- */

static const GLenum formats[] = {GL_R8, GL_R16, GL_R16F, GL_R32F};

/* Rays that all say the same are the result where they see a surface, with any technique before them; as far from the
 * border as a correction's blur reaches, since it trusts windows less that the border cuts. */
TEST_GL(agreeing_rays_win)
{
    const analytic_shape wall = {ANALYTIC_PLANE, {0.0, 0.0, -4.0}, {0.3, 0.2, 0.9}};
    int count;
    SCOPED(setup) setup s = set_up(f, PERSPECTIVE, &wall, 1, 65, 47);
    for (int technique = GLSSAO_CLASSIC; technique <= GLSSAO_RAYS; ++technique)
        for (int i = 0; i < 16; ++i) {
            s.settings = glssao_default_settings((glssao_technique)technique, i & 1 ? GLSSAO_HIGH : GLSSAO_LOW);
            s.settings.half_resolution = i & 2;
            s.settings.upsample = i & 1;
            s.settings.power = 1.0f;
            bring_constant(&s, formats[i / 4], i & 1, 0.625f);
            SCOPED(memory) float *result = compute(&s, &count);
            const int width = s.settings.half_resolution && !s.settings.upsample ? 33 : 65, height = count / width;
            const int border = technique == GLSSAO_RAYS ? 0 : s.settings.half_resolution && width == 33 ? 6 : 14;
            for (int k = 0; k < count; ++k)
                if (k % width >= border && k % width < width - border && k / width >= border &&
                    k / width < height - border)
                    assert_true(fabs((double)result[k] - 0.625) < 0.002); /* a half step of R8 */
        }
}

/* No rays anywhere, as hosts may say it. */
TEST_GL(missing_rays_change_nothing)
{
    static const float nothing[] = {-1.0f, -1e-6f, NAN, -INFINITY};
    int count;
    SCOPED(setup) setup s = set_up_room(f, PERSPECTIVE, 97, 63);
    for (int technique = GLSSAO_CLASSIC; technique <= GLSSAO_RAYS; ++technique)
        for (int i = 0; i < 4; ++i) {
            s.settings = glssao_default_settings((glssao_technique)technique, i & 1 ? GLSSAO_HIGH : GLSSAO_ULTRA);
            float *before = NULL;
            s.settings.blur_rounds = 1; /* corrections take the place of later rounds */
            gl.DeleteTextures(1, &s.frame.rays_texture);
            s.frame.rays_texture = 0;
            if (technique != GLSSAO_RAYS)
                before = compute(&s, &count);
            bring_constant(&s, i == 1 ? GL_R16F : GL_R32F, i & 2, nothing[i]);
            SCOPED(memory) float *result = compute(&s, &count);
            /* The estimate is rounded to 13 bits on its way, and in the correction distances come from another map:
             * where a neighbour is barely on a plane, that decides. */
            int off = 0;
            for (int k = 0; k < count; ++k)
                off += !(fabsf(result[k] - (before ? before[k] : 1.0f)) < 2e-4f);
            assert_true(off * 500 < count);
            free(before);
        }
}

/* Rays that say what the technique says leave it as it is. */
TEST_GL(rays_that_agree_with_the_estimate_keep_it)
{
    int count;
    SCOPED(setup) setup s = set_up_room(f, PERSPECTIVE, 96, 64);
    for (int technique = GLSSAO_CLASSIC; technique < GLSSAO_RAYS; ++technique) {
        s.settings = glssao_default_settings((glssao_technique)technique, GLSSAO_HIGH);
        s.settings.half_resolution = false;
        s.settings.blur_rounds = 1; /* corrections take the place of later rounds */
        s.settings.power = 2.0f;
        s.frame.rays_texture = 0;
        float *before = compute(&s, &count), *linear = malloc((size_t)count * sizeof *linear);
        for (int i = 0; i < count; ++i)
            linear[i] = sqrtf(before[i]);
        bring(&s, GL_R32F, false, linear);
        SCOPED(memory) float *result = compute(&s, &count);
        for (int i = 0; i < count; ++i)
            assert_true(fabsf(result[i] - before[i]) < 1e-3f);
        gl.DeleteTextures(1, &s.frame.rays_texture);
        free(before);
        free(linear);
        s.frame.rays_texture = 0;
    }
}

/* Rays see what darkens a tile that nothing in the picture does: with and without tiles the result is the same. */
TEST_GL(corrections_reach_open_tiles)
{
    const analytic_shape shapes[] = {{ANALYTIC_PLANE, {0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}},
                                     {ANALYTIC_SPHERE, {-1.5, -1.0, -3.7}, {0.3, 0.0, 0.0}}};
    SCOPED(setup) setup s = set_up(f, PERSPECTIVE, shapes, 2, 320, 240);
    bring_constant(&s, GL_R8, true, 0.5f);
    s.settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    for (int i = 0; i < 2; ++i) {
        int counts[2];
        float *results[2];
        for (int tiles = 0; tiles < 2; ++tiles) {
            s.settings.tiles = tiles ? GLSSAO_TILES_ON : GLSSAO_TILES_OFF;
            results[tiles] = compute(&s, &counts[tiles]);
            const glssao_plan plan = glssao_plan_frame(s.effect, &s.frame, &s.settings);
            assert_true(plan.passes[GLSSAO_PASS_TILES].run == (tiles == 1));
        }
        assert_int_equal(counts[0], counts[1]);
        for (int k = 0; k < counts[0]; ++k)
            assert_true(fabsf(results[0][k] - results[1][k]) < 1e-3f);
        assert_true(fabsf(results[1][counts[1] - 40 * 320 / (1 + 3 * i) - 40] - 0.5f) < 0.01f); /* an open tile */
        free(results[0]);
        free(results[1]);
        s.settings.upsample = false;
    }
}

/* Rays of which all are open but a few in some tiles, near their middles or borders, and some are missing. Returns for
 * each tile of 16 x 16 pixels of the estimate whether one of its rays is blocked. */
static bool *bring_few_blocked(setup *s, bool half, int factor, int out_tiles[2])
{
    const int width = half ? (s->width + 1) / 2 : s->width, height = half ? (s->height + 1) / 2 : s->height;
    const int step = half ? 1 : factor, pixels = 16 * (half ? 1 : factor);
    SCOPED(memory) float *values = malloc((size_t)(width * height) * sizeof *values);
    out_tiles[0] = (width + pixels - 1) / pixels;
    out_tiles[1] = (height + pixels - 1) / pixels;
    bool *blocked = calloc((size_t)(out_tiles[0] * out_tiles[1]), sizeof *blocked);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int tile = y / pixels * out_tiles[0] + x / pixels, dx = x - (30 + 97 * (x / 97)), dy = y - 37;
            float *value = &values[y * width + x];
            *value = (x * 7 + y * 5) % 11 == 0 ? -1.0f : 1.0f;
            if (dx * dx + dy * dy < 10)
                *value = 0.25f * (float)((x + y) % 4);
            if (*value >= 0.0f && *value < 1.0f && x % step == 0 && y % step == 0)
                blocked[tile] = true;
        }
    bring(s, GL_R32F, half, values);
    return blocked;
}

/* Alone, tiles are drawn exactly where a ray is blocked and as far as the blur carries it. */
static void check_drawn_tiles(const setup *s, const bool *blocked, const int tiles[2])
{
    int width, height, open = 0;
    const uint32_t map = glssao_map(s->effect, GLSSAO_MAP_TILES, &width, &height);
    SCOPED(memory) float *rings = fixture_read_texture(map, width, height, 1);
    assert_true(width == tiles[0] && height == tiles[1]);
    for (int i = 0; i < width * height; ++i) {
        assert_true((rings[i] == 0.0f) == blocked[i]);
        open += rings[i] * 16.0f > 2.5f;
    }
    assert_true(open > 0);
}

/* Leaving out tiles whose rays are open, and whose estimate is where they correct one, changes no pixel. */
TEST_GL(tiles_of_open_rays_are_left_out)
{
    SCOPED(setup) setup s = set_up_room(f, PERSPECTIVE, 449, 322);
    for (int i = 0; i < 12; ++i) {
        const glssao_technique technique = i % 4 < 2 ? GLSSAO_RAYS : i % 4 == 2 ? GLSSAO_HORIZON : GLSSAO_CLASSIC;
        const int factor = i % 3 == 0 ? 1 : 2;
        int tiles[2], counts[2];
        float *results[2];
        s.settings = glssao_default_settings(technique, GLSSAO_HIGH);
        s.settings.radius = 0.2f;
        s.settings.half_resolution = factor == 2;
        s.settings.upsample = i % 3 == 1;
        s.settings.blur_rounds = i == 4 ? 0 : 1 + i / 4; /* 1 to 3 */
        s.settings.power = i == 7 ? 2.0f : 1.0f;
        s.frame.margin = i >= 10 ? 16 : 0;
        SCOPED(memory) bool *blocked = bring_few_blocked(&s, factor == 2 && i % 2 == 0, factor, tiles);
        for (int on = 0; on < 2; ++on) {
            s.settings.tiles = on ? GLSSAO_TILES_ON : GLSSAO_TILES_OFF;
            results[on] = compute(&s, &counts[on]);
        }
        if (technique == GLSSAO_RAYS)
            check_drawn_tiles(&s, blocked, tiles);
        assert_int_equal(counts[0], counts[1]);
        for (int k = 0; k < counts[0]; ++k)
            if (!(fabsf(results[0][k] - results[1][k]) <= 1.01f / 65535.0f))
                fail_msg("case %d: pixel %d is %g with tiles, %g without", i, k, (double)results[1][k],
                         (double)results[0][k]);
        free(results[0]);
        free(results[1]);
    }
}

/* Infinite and huge values count as open. Sky is open, whatever its rays say. */
TEST_GL(odd_values_stay_in_range)
{
    static const float odd[] = {INFINITY, 1e30f, 7.0f, 0.0f, NAN, -1.0f, 0.25f};
    const analytic_shape ball = {ANALYTIC_SPHERE, {0.0, 0.0, -3.0}, {1.0, 0.0, 0.0}};
    int count;
    SCOPED(setup) setup s = set_up(f, PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE, &ball, 1, 63, 49);
    SCOPED(memory) float *values = malloc((size_t)(63 * 49) * sizeof *values);
    for (int i = 0; i < 63 * 49; ++i)
        values[i] = odd[i % 7];
    bring(&s, GL_R32F, false, values);
    for (int technique = GLSSAO_CLASSIC; technique <= GLSSAO_RAYS; ++technique) {
        s.settings = glssao_default_settings((glssao_technique)technique, GLSSAO_ULTRA);
        s.settings.half_resolution = false;
        SCOPED(memory) float *result = compute(&s, &count);
        for (int i = 0; i < count; ++i) {
            assert_true(result[i] >= 0.0f && result[i] <= 1.0f);
            assert_true(s.depth[i] != s.sky || result[i] == 1.0f);
        }
    }
}

/* With a margin the result is what the middle of the whole picture has. */
TEST_GL(margins_cut_the_same_picture)
{
    const int width = 92, height = 68, margin = 12;
    for (int half = 0; half < 2; ++half)
        for (int technique = GLSSAO_HORIZON; technique <= GLSSAO_RAYS; ++technique) {
            int count;
            SCOPED(setup) setup s = set_up_room(f, PERSPECTIVE, width, height);
            free(bring_noise(&s, half));
            s.settings = glssao_default_settings((glssao_technique)technique, half ? GLSSAO_HIGH : GLSSAO_ULTRA);
            s.settings.half_resolution = half;
            s.settings.upsample = true;
            s.settings.radius = 0.3f;
            SCOPED(memory) float *whole = compute(&s, &count);
            s.frame.margin = margin;
            SCOPED(memory) float *inner = compute(&s, &count);
            const int across = width - 2 * margin;
            assert_int_equal(count, across * (height - 2 * margin));
            for (int i = 0; i < count; ++i) {
                const int x = i % across + margin, y = i / across + margin;
                assert_true(fabsf(inner[i] - whole[y * width + x]) < 1e-4f);
            }
        }
}

/* Depth and normals may lie in a part of larger textures; rays are a picture of their own. */
TEST_GL(viewports_do_not_move_rays)
{
    const int width = 60, height = 40, left = 7, bottom = 3;
    int count;
    SCOPED(setup) setup s = set_up_room(f, PERSPECTIVE, width, height);
    SCOPED(setup) setup large = set_up_room(f, PERSPECTIVE, width + 20, height + 10);
    s.settings.blur_rounds = 1;
    free(bring_noise(&s, false));
    for (int y = 0; y < height; ++y) /* the picture of `s` within */
        memcpy(large.depth + (y + bottom) * large.width + left, s.depth + y * width, (size_t)width * sizeof *s.depth);
    gl.DeleteTextures(1, &large.frame.depth_texture);
    large.frame.depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT32F, large.width, large.height, large.depth);
    large.frame.normal_texture = 0;
    s.frame.normal_texture = 0;
    SCOPED(memory) float *wanted = compute(&s, &count);
    memcpy(large.frame.projection, s.frame.projection, sizeof s.frame.projection);
    memcpy(large.frame.viewport, (const int[4]){left, bottom, width, height}, sizeof large.frame.viewport);
    large.frame.rays_texture = s.frame.rays_texture;
    assert_int_equal(glssao_resize(large.effect, width, height), GLSSAO_OK);
    SCOPED(memory)
    float *got = compute(&(setup){.effect = large.effect, .frame = large.frame, .settings = s.settings}, &count);
    for (int i = 0; i < count; ++i)
        assert_true(fabsf(got[i] - wanted[i]) < 1e-4f);
    large.frame.rays_texture = 0;
}

TEST_GL(every_size_is_taken)
{
    static const int sizes[][2] = {{1, 1}, {2, 1}, {1, 7}, {3, 3}, {5, 2}, {33, 17}};
    for (int i = 0; i < 6; ++i)
        for (int technique = GLSSAO_CLASSIC; technique <= GLSSAO_RAYS; ++technique)
            for (int k = 0; k < 4; ++k) {
                int count;
                SCOPED(setup) setup s = set_up_room(f, k & 1 ? ORTHOGRAPHIC : PERSPECTIVE, sizes[i][0], sizes[i][1]);
                s.settings = glssao_default_settings((glssao_technique)technique, GLSSAO_HIGH);
                s.settings.half_resolution = k & 1;
                s.settings.upsample = true;
                free(bring_noise(&s, k & 2));
                SCOPED(memory) float *result = compute(&s, &count);
                assert_int_equal(count, sizes[i][0] * sizes[i][1]);
                for (int j = 0; j < count; ++j)
                    assert_true(result[j] >= 0.0f && result[j] <= 1.0f);
            }
}

/* Values are averaged before the power, as light is. */
TEST_GL(power_comes_last)
{
    const analytic_shape wall = {ANALYTIC_PLANE, {0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}};
    int count;
    SCOPED(setup) setup s = set_up(f, PERSPECTIVE, &wall, 1, 64, 48);
    SCOPED(memory) float *values = malloc((size_t)(64 * 48) * sizeof *values);
    for (int i = 0; i < 64 * 48; ++i)
        values[i] = (float)(i % 2); /* columns by turns */
    bring(&s, GL_R8, false, values);
    s.settings.power = 3.0f;
    s.settings.blur_rounds = 1;
    for (int half = 0; half < 2; ++half) {
        SCOPED(memory) float *result = compute(&s, &count);
        for (int y = 4; y < 44; ++y)
            for (int x = 4; x < 60; ++x) /* 1/2 1 1 1 1/2 of columns by turns: 2 of 4 */
                assert_true(fabs((double)result[y * 64 + x] - (half ? 0.0 : 0.125)) < 1e-3);
        s.settings.half_resolution = true; /* only even columns have a say */
        s.settings.upsample = true;
    }
}

/* ---- refusals ---- */

static void refuse(setup *s, fixture *f, const char *said)
{
    fixture_clear_log(f);
    fixture_refused(f, glssao_compute(s->effect, &s->frame, &s->settings), said);
}

TEST_GL(wrong_rays_are_refused)
{
    const float one = 1.0f;
    SCOPED(setup) setup s = set_up_room(f, PERSPECTIVE, 64, 48);
    refuse(&s, f, "frame.rays_texture = 0: no texture, and the rays technique has no estimate of its own");
    bring_constant(&s, GL_R8, false, 1.0f);
    gl.BindTexture(GL_TEXTURE_2D, s.frame.rays_texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, 1, 1, 0, GL_RED, GL_FLOAT, &one);
    refuse(&s, f, ": 1 x 1, neither of the full size, 64 x 48, nor of half, 32 x 24");
    s.settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    refuse(&s, f, "frame.rays_texture = ");
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8UI, 64, 48, 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, NULL);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    refuse(&s, f, "an integer format");
    bring_constant(&s, GL_R8, false, 1.0f);
    s.settings = glssao_default_settings(GLSSAO_RAYS, GLSSAO_LOW);
    s.settings.blur = GLSSAO_BLUR_BOX;
    refuse(&s, f, "settings.blur = 3: the rays technique takes the planar blur, or none");
    s.settings.blur = GLSSAO_BLUR_PLANAR;
    s.frame.rays_texture = 4711;
    refuse(&s, f, "frame.rays_texture = 4711: no texture of this context");
    s.frame.rays_texture = 0;
}

/* A mean of many estimates is not corrected by a few rays. */
TEST_GL(accumulation_ignores_rays)
{
    int width, height;
    SCOPED(setup) setup s = set_up_room(f, PERSPECTIVE, 64, 48);
    s.settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    float *maps[2];
    for (int i = 0; i < 2; ++i) {
        glssao_restart_accumulation(s.effect);
        if (i)
            bring_constant(&s, GL_R8, false, 0.25f);
        assert_int_equal(glssao_accumulate(s.effect, &s.frame, &s.settings), GLSSAO_OK);
        const GLuint map = glssao_map(s.effect, GLSSAO_MAP_AMBIENT, &width, &height);
        maps[i] = fixture_read_texture(map, width, height, 1);
    }
    assert_memory_equal(maps[0], maps[1], (size_t)(width * height) * sizeof *maps[0]);
    free(maps[0]);
    free(maps[1]);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
