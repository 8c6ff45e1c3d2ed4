/* SPDX-License-Identifier: MIT
 *
 * The hard cases of docs/stability.md: whatever camera and depth buffer a host hands over, the result is finite,
 * within 0..1, and open where nothing occludes. test_hard_cases [STRIDE [CASE]]: one configuration in STRIDE; only the
 * case of that name.
 */
#include "hard_case.h"

static int stride = 1, pictures;
static const char *only; /* the name of the only case; NULL: all */

/* ---- faults put into maps and settings ---- */

static size_t count_of(const subject *s)
{
    return (size_t)s->width * (size_t)s->height;
}

static void depth_at_near_plane(subject *s)
{
    for (size_t i = 0; i < count_of(s); ++i)
        s->depth[i] = 1.0f - s->view.sky_depth;
}

/* Every fifth texel, in turn: NaN, infinite, behind the camera, too large to square, too small to divide by. */
static void distances_that_are_none(subject *s)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, -3.0f, 3e38f, 1e-40f, 0.0f};
    for (size_t i = 0; i < count_of(s); i += 5)
        s->distance[i] = bad[i / 5 % 7];
}

/* Some texels become a value that means that nothing was drawn. */
static void holes(subject *s)
{
    static const float none[] = {NAN, INFINITY, -INFINITY, 0.0f};
    for (size_t i = 0; i < count_of(s); i += 37)
        s->distance[i] = none[i / 37 % 4];
}

static void normals_that_are_none(subject *s)
{
    static const float bad[] = {0.0f, NAN, INFINITY, -INFINITY, 1e30f, 1e-30f};
    for (size_t i = 0; i < 3 * count_of(s); i += 2)
        s->normals[i] = bad[i / 2 % 6];
}

/* Not a normal; stored in the map of the result, which has no such number, it would become black. */
static void no_normal_here_and_there(subject *s)
{
    static const float bad[] = {0.0f, NAN, INFINITY, -INFINITY, 1e30f, 1e-30f};
    for (size_t i = 0; i < count_of(s); i += 5)
        for (size_t axis = 0; axis < 3; ++axis)
            s->normals[3 * i + axis] = bad[i / 5 % 6];
}

static void normals_of_any_length(subject *s)
{
    for (size_t i = 0; i < 3 * count_of(s); ++i)
        s->normals[i] *= i / 3 % 2 ? 1e-6f : 1e6f;
}

static void normals_away_from_the_eye(subject *s)
{
    for (size_t i = 0; i < 3 * count_of(s); ++i)
        s->normals[i] = -s->normals[i];
}

/* Above the largest half float. */
static void distance_1e6(subject *s)
{
    for (size_t i = 0; i < count_of(s); ++i)
        s->distance[i] *= 1e6f;
}

#define CHANGE(name, statements)                                                                                       \
    static void name(glssao_settings *s)                                                                               \
    {                                                                                                                  \
        statements;                                                                                                    \
    }
CHANGE(fades_meet, s->fade_start = s->fade_end)
CHANGE(fades_meet_at_0, s->fade_start = s->fade_end = s->surface_epsilon = 1e-30f)
CHANGE(no_epsilon, s->surface_epsilon = 0.0f)
CHANGE(power_0, s->power = 0.0f)
CHANGE(power_64, s->power = 64.0f)
CHANGE(thinnest, s->thickness = 1e-3f)
CHANGE(thickest, s->thickness = 1e3f)
CHANGE(pixel_radius, s->radius = 20.0f; s->radius_in_pixels = true)
CHANGE(many_pixels_radius, s->radius = 1e12f; s->radius_in_pixels = true)
CHANGE(few_pixels_radius, s->radius = 1e-6f; s->radius_in_pixels = true)
/* Everything lies beyond it, or in the middle of it. */
CHANGE(fades_at_once, s->fade_far_end = 1e-30f)
CHANGE(fades_at_a_step, s->fade_far_start = s->fade_far_end = 5.0f)
CHANGE(fades_at_the_end, s->fade_far_end = 1e12f)
CHANGE(least_lengths, *s = settings_scaled(s, 1e-9))
CHANGE(most_lengths, *s = settings_scaled(s, 1e11))
CHANGE(many_rounds, s->blur_rounds = 16; s->blur_normal_threshold = 1.0f; s->blur_depth_threshold = 0.0f)

#define OPEN                                                                                                           \
    {                                                                                                                  \
        0.97, 0.97, 0.97                                                                                               \
    }
#define EXACT                                                                                                          \
    {                                                                                                                  \
        1.0, 1.0, 1.0                                                                                                  \
    }

static const hard_case cases[] = {
    /* sky */
    {"nothing but sky", SEE_NOTHING, .depth = DEPTH_32F, .normal = NORMAL_32F, .least = EXACT},
    {"nothing but sky, reversed", SEE_NOTHING, .projection = PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE,
     .depth = DEPTH_32F, .normal = NORMAL_32F, .least = EXACT},
    {"nothing but sky, distances", SEE_NOTHING, .depth = DISTANCE_16F, .normal = NORMAL_32F, .least = EXACT},
    {"a sphere before sky", SEE_SPHERE, .depth = DEPTH_32F, .normal = NORMAL_32F, .least = {0.9, 0.9, 0.9}},
    {"a sphere before sky, reversed", SEE_SPHERE, .projection = PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE,
     .depth = DEPTH_32F, .normal = NORMAL_32F, .least = {0.9, 0.9, 0.9}},
    {"a sphere before sky, distances", SEE_SPHERE, .depth = DISTANCE_32F, .normal = NORMAL_32F,
     .least = {0.9, 0.9, 0.9}},
    /* near and far */
    {"depth at the near plane", SEE_PLANE, .distance = 0.1, .spoil = depth_at_near_plane, .depth = DEPTH_24,
     .normal = NORMAL_32F, .least = OPEN},
    {"a plane nearer than the radius", SEE_PLANE, 60.0, 0.3, .lengths = 20.0, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = OPEN},
    {"samples behind the camera", SEE_PLANE, 85.0, 0.4, .near_plane = 0.01, .lengths = 50.0, .depth = DEPTH_32F,
     .normal = NORMAL_32F, .least = OPEN},
    {"samples off the screen", SEE_PLANE, 45.0, 3.0, .zoom = 8.0, .lengths = 3.0, .depth = DEPTH_24,
     .normal = NORMAL_32F, .least = OPEN},
    {"near : far of 1 : 10^7, near", SEE_PLANE, 60.0, 3.0, .near_plane = 0.1, .far_plane = 1e6, .depth = DEPTH_24,
     .normal = NORMAL_32F, .least = OPEN},
    {"near : far of 1 : 10^7, far", SEE_PLANE, 40.0, 1e4, .near_plane = 0.1, .far_plane = 1e6, .depth = DEPTH_24,
     .normal = NORMAL_32F, .least = OPEN},
    {"near : far of 1 : 10^7, reversed", SEE_PLANE, 40.0, 1e5, .projection = PERSPECTIVE_REVERSED_ZERO_TO_ONE,
     .near_plane = 0.1, .far_plane = 1e6, .depth = DEPTH_32F, .normal = NORMAL_32F, .least = OPEN},
    {"a plane at 89.9 degrees", SEE_PLANE, 89.9, 3.0, .depth = DEPTH_32F, .normal = NORMAL_32F, .least = OPEN},
    {"a plane at 89.9 degrees, distances", SEE_PLANE, 89.9, 3.0, .depth = DISTANCE_32F, .normal = NORMAL_32F,
     .least = {0.97, 0.94, 0.97}}, /* distance is not linear from texel to texel, and hemisphere filters it */
    {"coarse depth far away", SEE_PLANE, 40.0, 300.0, .zoom = 1.2, .depth = DEPTH_16, .normal = NORMAL_32F,
     .lengths = 2.0, .least = {0.95, 0.97, 0.95}},
    {"24 bits far away", SEE_PLANE, 40.0, 1000.0, .near_plane = 0.01, .far_plane = 1e5, .zoom = 4.0, .depth = DEPTH_24,
     .normal = NORMAL_32F, .lengths = 0.5, .least = {0.95, 0.97, 0.95}},
    {"half float distances", SEE_PLANE, 60.0, 30.0, .zoom = 10.0, .depth = DISTANCE_16F, .normal = NORMAL_32F,
     .lengths = 0.3, .least = {0.95, 0.97, 0.95}},
    {"half floats past 65504", SEE_PLANE, .spoil = distance_1e6, .depth = ALPHA_16F, .least = EXACT, .turn = 1},
    {"a radius below a tenth of a pixel", SEE_ROOM, .lengths = 0.006, .depth = DEPTH_32F, .normal = NORMAL_32F,
     .least = {0.9, 0.9, 0.9}},
    {"a scene of 10^-10", SEE_PLANE, 60.0, 3e-10, .near_plane = 1e-11, .far_plane = 1e-7, .depth = DEPTH_32F,
     .normal = NORMAL_32F, .least = OPEN},
    {"a scene of 10^-22", SEE_PLANE, 60.0, 3e-22, .near_plane = 1e-23, .far_plane = 1e-19, .depth = DEPTH_32F,
     .normal = NORMAL_32F, .least = OPEN},
    {"a scene of 10^11", SEE_PLANE, 60.0, 3e11, .near_plane = 1e10, .far_plane = 1e14, .depth = DEPTH_32F,
     .normal = NORMAL_32F, .least = OPEN},
    /* lenses */
    {"a lens of 0.1 degrees", SEE_PLANE, 60.0, 30.0, .zoom = 660.0, .lengths = 0.002, .depth = DEPTH_32F,
     .projection = PERSPECTIVE_REVERSED_ZERO_TO_ONE, .normal = NORMAL_32F, .least = OPEN},
    {"a lens of 179 degrees", SEE_PLANE, 30.0, 3.0, .zoom = 0.005, .depth = DEPTH_32F, .normal = NORMAL_32F,
     .least = {0.95, 0.95, 0.95}},
    {"mirrored", SEE_ROOM, .flip = 1.0, .depth = DEPTH_24, .normal = NORMAL_32F},
    /* bad numbers */
    {"normals of no length and none", SEE_ROOM, .spoil = normals_that_are_none, .depth = DEPTH_24,
     .normal = NORMAL_32F},
    {"no normal here and there", SEE_PLANE, 60.0, .spoil = no_normal_here_and_there, .depth = DEPTH_24,
     .normal = NORMAL_32F, .least = OPEN},
    {"normals of any length", SEE_PLANE, 60.0, .spoil = normals_of_any_length, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = OPEN},
    {"normals away from the eye", SEE_ROOM, .spoil = normals_away_from_the_eye, .depth = DEPTH_24,
     .normal = NORMAL_32F},
    {"normals straight away from the eye", SEE_PLANE, .projection = ORTHOGRAPHIC, .spoil = normals_away_from_the_eye,
     .depth = DEPTH_32F, .normal = NORMAL_32F, .least = OPEN},
    {"a plane whose normals look away", SEE_PLANE, 70.0, .spoil = normals_away_from_the_eye, .depth = DEPTH_24,
     .normal = NORMAL_32F, .least = OPEN},
    {"distances that are none", SEE_ROOM, .spoil = distances_that_are_none, .depth = DISTANCE_32F,
     .normal = NORMAL_32F},
    {"distances that are none, in alpha", SEE_ROOM, .spoil = distances_that_are_none, .depth = ALPHA_32F, .turn = 2},
    {"holes in a plane", SEE_PLANE, 40.0, .spoil = holes, .depth = DISTANCE_32F, .normal = NORMAL_32F,
     .least = {0.85, 0.85, 0.85}},
    /* settings */
    {"fades that meet", SEE_ROOM, .change = fades_meet, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"fades that meet at 0", SEE_ROOM, .change = fades_meet_at_0, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"an occluder at the point itself", SEE_PLANE, 0.0, .change = no_epsilon, .depth = DEPTH_32F, .normal = NORMAL_32F,
     .least = OPEN},
    {"no epsilon on a slope", SEE_PLANE, 60.0, .change = no_epsilon, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = OPEN},
    {"power 0", SEE_ROOM, .change = power_0, .depth = DEPTH_24, .normal = NORMAL_32F, .least = EXACT},
    {"power 64", SEE_ROOM, .change = power_64, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"power 64 in a corner", SEE_WALL, .change = power_64, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"a thickness of next to nothing", SEE_ROOM, .change = thinnest, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"a plane of any thickness", SEE_PLANE, 60.0, .change = thickest, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = OPEN},
    {"a radius in pixels", SEE_ROOM, .change = pixel_radius, .depth = DEPTH_24, .normal = NORMAL_32F, .turn = 1},
    {"a plane and a radius in pixels", SEE_PLANE, 60.0, .change = pixel_radius, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = OPEN, .turn = 2},
    {"a plane far away and a radius in pixels", SEE_PLANE, 60.0, 500.0, .near_plane = 5.0, .far_plane = 5000.0,
     .change = pixel_radius, .depth = DEPTH_32F, .normal = NORMAL_32F, .least = OPEN, .turn = 3},
    {"a plane and a radius of 10^12 pixels", SEE_PLANE, 60.0, .change = many_pixels_radius, .depth = DEPTH_32F,
     .normal = NORMAL_32F, .turn = 4},
    {"a radius of a millionth of a pixel", SEE_ROOM, .change = few_pixels_radius, .depth = DEPTH_32F,
     .normal = NORMAL_32F, .least = {0.99, 0.99, 0.99}, .turn = 5},
    {"a far fade before everything", SEE_ROOM, .change = fades_at_once, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = {1.0, 1.0, 1.0}},
    {"a far fade that is a step", SEE_ROOM, .change = fades_at_a_step, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"a far fade of 10^12 units", SEE_ROOM, .change = fades_at_the_end, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"lengths of next to nothing", SEE_ROOM, .change = least_lengths, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"lengths beyond the scene", SEE_ROOM, .change = most_lengths, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"a plane and lengths beyond it", SEE_PLANE, 60.0, .change = most_lengths, .depth = DEPTH_32F, .normal = NORMAL_32F,
     .least = OPEN},
    {"thresholds that no tap meets", SEE_ROOM, .change = many_rounds, .depth = DEPTH_24, .normal = NORMAL_32F},
    /* sizes; a map one pixel wide has no slope that way, and hemisphere samples across it */
    {"one pixel", SEE_PLANE, 60.0, .turn = 3, .width = 1, .height = 1, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = {0.9, 0.85, 0.97}},
    {"one column", SEE_PLANE, 60.0, .turn = 4, .width = 1, .height = 97, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = {0.9, 0.85, 0.97}},
    {"one row", SEE_PLANE, 60.0, .turn = 5, .width = 97, .height = 1, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = {0.9, 0.85, 0.97}},
    {"odd sizes", SEE_PLANE, 60.0, .width = 63, .height = 47, .depth = DEPTH_24, .normal = NORMAL_32F, .least = OPEN},
    {"three pixels high", SEE_ROOM, .turn = 5, .width = 61, .height = 3, .depth = DEPTH_24, .normal = NORMAL_32F},
    {"16384 wide", SEE_PLANE, 60.0, .turn = 3, .width = 16384, .height = 2, .depth = DEPTH_24, .normal = NORMAL_32F,
     .least = OPEN},
};

static void run(fixture *f, const hard_case *c)
{
    if (!only || strcmp(c->name, only) == 0)
        pictures += hard_case_run(f, c, c->width > 1000 ? 8 * stride + 1 : stride);
}

TEST_GL(hard_cases)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
        run(f, &cases[i]);
}

/* A plane in every projection, upright and mirrored. */
TEST_GL(projections)
{
    for (int projection = 0; projection < PROJECTION_COUNT; ++projection)
        for (int flip = 0; flip < 2; ++flip) {
            char name[64];
            snprintf(name, sizeof name, "projection %d%s", projection, flip ? ", mirrored" : "");
            const hard_case c = {name,
                                 SEE_PLANE,
                                 60.0,
                                 .projection = (analytic_projection)projection,
                                 .flip = flip,
                                 .depth = DEPTH_32F,
                                 .normal = NORMAL_32F,
                                 .least = {0.999, 0.999, 0.999}};
            run(f, &c);
        }
}

/* A plane with every way to store depth and normals, near and far. Normals of 8 bits are off by half a degree. */
TEST_GL(stores)
{
    for (int depth = 0; depth < DEPTH_STORES; ++depth)
        for (int far = 0; far < 2; ++far) {
            const hard_case c = {subject_depth_name((depth_store)depth),
                                 SEE_PLANE,
                                 50.0,
                                 far ? 60.0 : 3.0,
                                 .depth = (depth_store)depth,
                                 .normal = (normal_store)(1 + depth % (NORMAL_STORES - 1)),
                                 .projection = far ? ORTHOGRAPHIC : PERSPECTIVE,
                                 .zoom = far ? 0.1 : 1.0,
                                 .least = OPEN,
                                 .turn = 1 + depth};
            run(f, &c);
        }
}

TEST_GL(picture_count)
{
    print_message("%d pictures\n", pictures);
    assert_true(pictures > (only ? 0 : 2000 / stride));
}

int main(int argc, char **argv)
{
    stride = configuration_stride(argc, argv);
    only = argc > 2 ? argv[2] : NULL;
    return test_run(NULL, fixture_setup, fixture_teardown);
}
