/* SPDX-License-Identifier: MIT
 *
 * Specks: pixels that are darker by more than 0.5 than all of the 3 x 3 pixels of the truth about them, in 100 random
 * scenes of thin ribs and limbs before a wall.
 */
#include "analytic.h"
#include "fixture.h"

enum {
    SCENES = 100,
    W = 160,
    H = 120,
    RIBS = 12,
    LIMBS = 3,
    JOINTS = 4,
    SHAPES = 2 + RIBS + LIMBS * JOINTS,
    RAYS = 128
};

static const char *const level_names[] = {"low", "medium", "high", "ultra"};

static double next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) * 0x1p-24;
}

static double between(uint32_t *state, double low, double high)
{
    return low + (high - low) * next_random(state);
}

/* Limbs are rows of balls. Ribs are boxes of one or two pixels, upright or lying. */
static void make_scene(uint32_t seed, analytic_shape shapes[SHAPES])
{
    uint32_t random = seed * 2654435761u;
    (void)next_random(&random);
    int n = 0;
    shapes[n++] = (analytic_shape){ANALYTIC_PLANE, {0.0, -1.2, 0.0}, {0.0, 1.0, 0.0}};
    shapes[n++] = (analytic_shape){ANALYTIC_PLANE, {0.0, 0.0, -7.0}, {0.0, 0.0, 1.0}};
    for (int i = 0; i < RIBS; ++i) {
        const double thin = between(&random, 0.01, 0.04), length = between(&random, 0.3, 1.0);
        const bool upright = next_random(&random) < 0.5;
        shapes[n++] =
            (analytic_shape){ANALYTIC_BOX,
                             {between(&random, -2.0, 2.0), between(&random, -1.2, 1.2), between(&random, -6.9, -4.0)},
                             {upright ? thin : length, upright ? length : thin, between(&random, 0.01, 0.3)}};
    }
    for (int i = 0; i < LIMBS; ++i) {
        double at[3] = {between(&random, -1.5, 1.5), between(&random, -1.0, 1.0), between(&random, -6.0, -4.5)};
        for (int k = 0; k < JOINTS; ++k) {
            const double size = between(&random, 0.08, 0.3);
            shapes[n++] = (analytic_shape){ANALYTIC_SPHERE, {at[0], at[1], at[2]}, {size, 0.0, 0.0}};
            for (int axis = 0; axis < 3; ++axis)
                at[axis] += between(&random, -size, size);
        }
    }
}

typedef struct shot {
    analytic_shape shapes[SHAPES];
    analytic_view view;
    float *depth, *normals, *truth; /* truth: below 0 where it is not known yet */
} shot;

static double truth_at(const shot *s, int x, int y)
{
    const size_t i = (size_t)(y * W + x);
    if (s->truth[i] >= 0.0f)
        return (double)s->truth[i];
    const float *m = s->view.projection, *n = s->normals + 3 * i;
    const double ndc = 2.0 * (double)s->depth[i] - 1.0, t = (double)m[14] / ((double)m[10] + ndc);
    const double at[] = {(2.0 * (x + 0.5) / W - 1.0) * t / (double)m[0], (2.0 * (y + 0.5) / H - 1.0) * t / (double)m[5],
                         -t};
    const double normal[] = {(double)n[0], (double)n[1], (double)n[2]};
    s->truth[i] = (float)analytic_accessibility(s->shapes, SHAPES, at, normal, 1.0, RAYS);
    return (double)s->truth[i];
}

/* Whether each pixel of the truth in the 3 x 3 about it is brighter by more than 0.5. */
static bool is_speck(const shot *s, const float *got, int x, int y)
{
    const double value = (double)got[y * W + x];
    for (int j = y - 1; j <= y + 1; ++j)
        for (int i = x - 1; i <= x + 1; ++i)
            if (i >= 0 && j >= 0 && i < W && j < H && !(value < truth_at(s, i, j) - 0.5))
                return false;
    return true;
}

static int count_specks(fixture *f, const shot *s, const glssao_frame *frame, int level)
{
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)level);
    settings.radius = 1.0f;
    settings.upsample = true;
    int width, height, count = 0;
    SCOPED(memory) float *got = fixture_compute(fixture_shared_effect(f, W, H), frame, &settings, &width, &height);
    assert_true(width == W && height == H);
    for (int k = 0; k < W * H; ++k)
        count += got[k] < 0.5f && is_speck(s, got, k % W, k / W);
    return count;
}

/* Measured: low 12, medium 11, high 5, ultra 25 of 1,920,000 pixels each. Without BLUR_ALONE: 45, 43, 43, 45. What is
 * left are ribs of one pixel, as dark all along by their few samples, and pixels that a single neighbour joins. */
TEST_GL(random_scenes_have_few_specks)
{
    static const int most[] = {15, 14, 8, 30};
    int counts[4] = {0};
    for (uint32_t seed = 1; seed <= SCENES; ++seed) {
        shot s = {.view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0)};
        make_scene(seed, s.shapes);
        analytic_render(&s.view, s.shapes, SHAPES, W, H, &s.depth, &s.normals);
        s.truth = malloc(sizeof *s.truth * W * H);
        for (int i = 0; i < W * H; ++i)
            s.truth[i] = -1.0f;
        SCOPED(frame)
        glssao_frame frame = {.depth_texture = fixture_depth_texture(GL_DEPTH_COMPONENT32F, W, H, s.depth),
                              .normal_texture = fixture_normal_texture(W, H, s.normals)};
        memcpy(frame.projection, s.view.projection, sizeof frame.projection);
        for (int level = 0; level < 4; ++level) {
            const int count = count_specks(f, &s, &frame, level);
            if (count > 0)
                print_message("seed %u, %s: %d\n", (unsigned)seed, level_names[level], count);
            counts[level] += count;
        }
        free(s.depth);
        free(s.normals);
        free(s.truth);
    }
    print_message("low %d, medium %d, high %d, ultra %d\n", counts[0], counts[1], counts[2], counts[3]);
    for (int level = 0; level < 4; ++level)
        assert_true(counts[level] <= most[level]);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
