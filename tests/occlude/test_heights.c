/* SPDX-License-Identifier: MIT
 *
 * Height maps: the foot of a cliff, and holes.
 */
#include "occlude_fixture.h"

/* A cliff in a height map, of height 6. Far more of it than the radius is in the picture. */
static double worst_at_cliff(float radius, bool solid, float out[COUNT])
{
    const float spacing = 0.5f, cliff = 6.0f;
    float heights[COUNT], depth[COUNT];
    for (int i = 0; i < COUNT; ++i)
        heights[i] = 800.0f + (i % WIDTH < WIDTH / 2 ? cliff : 0.0f);
    occlude_input input = {.width = WIDTH, .height = HEIGHT, .depth = depth, .estimates = 64, .solid = solid};
    assert_true(occlude_look_down(heights, WIDTH, HEIGHT, spacing, depth, input.projection, error, sizeof error));
    const glssao_settings settings = settings_of(radius);
    compute(&input, &settings, out);
    const analytic_shape block = {ANALYTIC_BOX, {-100.0, 0.0, 3.0}, {100.0, 100.0, 3.0}};
    double worst = 0.0;
    for (int x = WIDTH / 2; x < WIDTH; ++x) {
        const double foot[3] = {(x + 0.5 - WIDTH / 2.0) * (double)spacing, 0.0, 0.0}, up[3] = {0.0, 0.0, 1.0};
        const double wanted = analytic_accessibility(&block, 1, foot, up, (double)radius, 4096);
        worst = fmax(worst, fabs((double)out[HEIGHT / 2 * WIDTH + x] - wanted));
    }
    return worst;
}

TEST_GL(test_cliff_of_a_height_map_agrees_with_traced_rays)
{
    float out[COUNT];
    /* A cliff of four radii: a slab of guessed thickness lets light through below. */
    assert_true(worst_at_cliff(1.5f, false, out) > 0.15);
    assert_true(worst_at_cliff(1.5f, true, out) < 0.07);
    assert_true(worst_at_cliff(6.0f, true, out) < 0.025);
    for (int x = 0; x < WIDTH / 2 - 1; ++x)
        assert_true(out[HEIGHT / 2 * WIDTH + x] > 0.995f); /* the top */

    /* Near the foot of a cliff of height h the radius cuts nothing off, and the form factor of an endless strip holds:
     * (1 - d / sqrt(d^2 + h^2)) / 2 of the directions are blocked at distance d, weighted by their cosine. */
    assert_true(worst_at_cliff(12.0f, true, out) < 0.03);
    for (int x = WIDTH / 2; x < WIDTH / 2 + 4; ++x) {
        const double d = (x + 0.5 - WIDTH / 2.0) * 0.5;
        const double wanted = 1.0 - 0.5 * (1.0 - d / sqrt(d * d + 36.0));
        assert_true(fabs((double)out[HEIGHT / 2 * WIDTH + x] - wanted) < 0.03);
    }
}

/* Beyond the map's size there is nothing to find, and an estimate's few samples must not spread over it. The cliff is
 * as long as the map is high, so that a point at distance d sees a strip of half length l: the form factor of a
 * rectangle with an edge in the point's plane. */
TEST_GL(test_large_radius_brightens_nothing)
{
    static const float radii[] = {6.0f, 12.0f, 24.0f, 48.0f, 96.0f, 1e3f, 1e6f};
    float out[COUNT], beyond[COUNT];
    double before = 1.0;
    for (size_t r = 0; r < sizeof radii / sizeof *radii; ++r) {
        worst_at_cliff(radii[r], true, out);
        double mean = 0.0;
        for (int i = 0; i < COUNT; ++i)
            mean += (double)out[i] / COUNT;
        assert_true(mean < before + 1e-3);
        before = mean;
        for (int x = WIDTH / 2; x < WIDTH / 2 + 8 && radii[r] >= 12.0f; ++x) {
            const double d = (x + 0.5 - WIDTH / 2.0) * 0.5, h = 6.0, l = 0.5 * HEIGHT * 0.5;
            const double blocked = (atan(l / d) - d / hypot(d, h) * atan(l / hypot(d, h))) / acos(-1.0);
            assert_true(fabs((double)out[HEIGHT / 2 * WIDTH + x] - (1.0 - blocked)) < 0.05);
        }
    }
    worst_at_cliff(1e3f, true, beyond);
    assert_memory_equal(out, beyond, sizeof out); /* either is cut to the map's extent */
}

/* The box around what is seen, whatever the projection and the kind of depth. */
TEST_GL(test_extent_is_that_of_the_surfaces)
{
    for (int projection = 0; projection < PROJECTION_COUNT; ++projection) {
        const analytic_shape wall = {ANALYTIC_PLANE, {0.0, 0.0, -6.0}, {0.0, 0.0, 1.0}};
        SCOPED(picture) picture p = make_picture(&wall, 1, (analytic_projection)projection);
        const float *m = p.view.projection;
        const double w = fabs((double)m[11] * -6.0 + (double)m[15]);
        const double wanted = hypot(2.0 * w / fabs((double)m[0]) * (WIDTH - 1) / WIDTH,
                                    2.0 * w / fabs((double)m[5]) * (HEIGHT - 1) / HEIGHT);
        for (int kind = 0; kind < 2; ++kind) {
            occlude_input input = input_of(&p, kind == 1);
            assert_true(fabs((double)occlude_extent(&input) - wanted) < 1e-3 * wanted);
        }
        p.distance[5] = INFINITY;
        p.distance[6] = NAN;
        p.distance[7] = 0.0f;
        occlude_input input = input_of(&p, false);
        assert_true(fabs((double)occlude_extent(&input) - wanted) < 1e-3 * wanted);
        for (int i = 0; i < COUNT; ++i)
            p.distance[i] = 0.0f;
        assert_true(occlude_extent(&input) == 0.0f);
    }
}

TEST_GL(test_holes_and_flat_height_maps)
{
    float heights[] = {NAN, 7.0f, INFINITY, 7.0f}, depth[4], out[4];
    occlude_input input = {.width = 2, .height = 2, .depth = depth};
    assert_true(occlude_look_down(heights, 2, 2, 0.25f, depth, input.projection, error, sizeof error));
    const float wanted[] = {0.0f, 0.25f, 0.0f, 0.25f};
    assert_memory_equal(depth, wanted, sizeof wanted);
    const glssao_settings settings = settings_of(1.0f);
    compute(&input, &settings, out);
    for (int i = 0; i < 4; ++i)
        assert_true(out[i] > 0.99f);

    heights[1] = heights[3] = -INFINITY;
    assert_false(occlude_look_down(heights, 2, 2, 0.25f, depth, input.projection, error, sizeof error));
    assert_string_equal(error, "no height is a finite number");
    assert_false(occlude_look_down(heights, 2, 2, NAN, depth, input.projection, error, sizeof error));
    assert_string_equal(error, "spacing = nan: want a positive number");
    assert_false(occlude_look_down(heights, 0, 2, 1.0f, depth, input.projection, error, sizeof error));
    assert_string_equal(error, "the height map is 0 x 2: want 1 x 1 or more");
}

TEST_MAIN(NULL, occlude_setup, occlude_teardown)
