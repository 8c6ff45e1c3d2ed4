/* SPDX-License-Identifier: MIT
 *
 * test_random [--cases N] [--seed S]: random cameras, depth formats, sizes, radii, normals, settings and noise in the
 * maps. A failing case prints its seed; --cases 1 --seed S repeats that case alone.
 */
#include "techniques.h"

/* Consecutive cases with the same shaders, since compiling them is most of the work. Technique, quality and formats
 * follow from the seed divided by this. */
enum { ALIKE = 100 };

static uint64_t first_seed = 1;
static int cases = 200;

/* SplitMix64 (Steele, Lea, Flood 2014). */
static uint64_t next(uint64_t *s)
{
    uint64_t z = *s += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

static int below(uint64_t *s, int count)
{
    return (int)(next(s) % (uint64_t)count);
}

static double between(uint64_t *s, double low, double high)
{
    return low + (high - low) * (double)(next(s) >> 11) / 9007199254740992.0;
}

/* Uniform over all magnitudes. */
static double magnitude(uint64_t *s, double low, double high)
{
    return exp(between(s, log(low), log(high)));
}

static analytic_view random_view(uint64_t *s, int width, int height, double scale)
{
    const double near_plane = magnitude(s, 1e-3, 1.0), far_plane = 20.0 * magnitude(s, 1.0, 1e4);
    analytic_view view = analytic_make_view((analytic_projection)below(s, PROJECTION_COUNT), (double)width / height,
                                            near_plane, far_plane, scale);
    const double zoom = magnitude(s, 0.3, 4.0);
    for (int axis = 0; axis < 2; ++axis) {
        view.projection[5 * axis] *= (float)(below(s, 8) ? zoom : -zoom);
        if (below(s, 4) == 0 && view.projection[11] != 0.0f)
            view.projection[8 + axis] = (float)between(s, -1.5, 1.5);
    }
    /* In clip space only ratios matter. */
    const float any = below(s, 3) ? 1.0f : (float)magnitude(s, 0.01, 100.0);
    for (int i = 0; i < 16; ++i)
        view.projection[i] *= any;
    return view;
}

static int random_shapes(uint64_t *s, analytic_shape shapes[ANALYTIC_ROOM_SHAPES], double scale)
{
    if (below(s, 3)) {
        analytic_room(shapes, scale);
        return ANALYTIC_ROOM_SHAPES;
    }
    const double angle = between(s, 0.0, 1.57), turn = between(s, 0.0, 6.28);
    shapes[0] = (analytic_shape){ANALYTIC_PLANE,
                                 {0.0, 0.0, -magnitude(s, 0.3, 30.0) * scale},
                                 {sin(angle) * cos(turn), sin(angle) * sin(turn), cos(angle)}};
    return below(s, 4) ? 1 : 0;
}

static glssao_settings random_settings(uint64_t *alike, uint64_t *s, double scale)
{
    configuration c = configuration_of(below(alike, CONFIGURATIONS));
    glssao_settings settings = settings_scaled(&c.settings, scale * magnitude(s, 0.01, 100.0));
    settings.power = below(s, 3) ? 1.0f : (float)between(s, 0.0, 64.0);
    if (below(alike, 3) == 0)
        settings.blur = (glssao_blur)below(alike, GLSSAO_BLUR_PLANAR + 1);
    settings.blur_rounds = below(s, 4);
    settings.blur_sigma = (float)between(s, 0.1, 2.5);
    settings.upsample = below(s, 2) == 1;
    if (below(s, 4) == 0)
        settings.surface_epsilon = 0.0f;
    if (below(s, 4) == 0)
        settings.fade_start = settings.fade_end;
    return settings;
}

/* Some texels get random bits. */
static void spoil(uint64_t *s, float *values, size_t count, bool to_one)
{
    for (size_t i = (size_t)below(s, 9); i < count; i += (size_t)(1 + below(s, 31))) {
        const uint32_t bits = (uint32_t)next(s);
        memcpy(&values[i], &bits, sizeof bits);
        if (to_one)
            values[i] = (float)between(s, 0.0, 1.0);
    }
}

/* Frames from random places, each with what the last one left: whatever the views say, the pictures are sound. */
static void random_walk(fixture *f, uint64_t *s, const glssao_frame *start, const glssao_settings *settings, int width,
                        int height, double scale, uint64_t seed)
{
    glssao_frame frame = *start;
    glssao_settings with_history = *settings;
    with_history.history = 1 + below(s, 63);
    for (int i = 0; i < 4; ++i) {
        const double angle = between(s, 0.0, below(s, 2) ? 0.1 : 6.28), far = magnitude(s, 1e-3, 1e3) * scale;
        memset(frame.view, 0, sizeof frame.view);
        frame.view[0] = frame.view[10] = (float)cos(angle);
        frame.view[8] = (float)sin(angle);
        frame.view[2] = -frame.view[8];
        frame.view[5] = frame.view[15] = 1.0f;
        for (int k = 0; k < 3; ++k)
            frame.view[12 + k] = (float)between(s, -far, far);
        SCOPED(picture) picture p = subject_shade(f, width, height, &frame, &with_history);
        if (!picture_is_sound(&p))
            fail_msg("seed %llu, frame %d: not sound", (unsigned long long)seed, i);
    }
}

static void random_case(fixture *f, uint64_t seed)
{
    uint64_t s = seed * UINT64_C(0xD1342543DE82EF95), alike = seed / ALIKE;
    const int width = 1 + below(&s, 80), height = 1 + below(&s, 60);
    const double scale = below(&s, 2) ? 1.0 : magnitude(&s, 1e-4, 1e4);
    const analytic_view view = random_view(&s, width, height, scale);
    analytic_shape shapes[ANALYTIC_ROOM_SHAPES];
    const int count = random_shapes(&s, shapes, scale);
    SCOPED(subject) subject seen = subject_of(&view, shapes, count, width, height);
    const size_t texels = (size_t)width * (size_t)height;
    if (below(&s, 4) == 0)
        spoil(&s, seen.depth, texels, true);
    if (below(&s, 4) == 0)
        spoil(&s, seen.distance, texels, false);
    if (below(&s, 4) == 0)
        spoil(&s, seen.normals, 3 * texels, false);
    const glssao_settings settings = random_settings(&alike, &s, scale);
    const depth_store depth = (depth_store)below(&alike, DEPTH_STORES);
    SCOPED(frame) glssao_frame frame = subject_frame(&seen, depth, (normal_store)below(&alike, NORMAL_STORES));
    const int most = (width < height ? width : height) / 2 - 1;
    frame.margin = most > 1 && below(&s, 4) == 0 ? below(&s, most) / 2 * 2 : 0;

    picture first = subject_shade(f, width, height, &frame, &settings);
    if (!picture_is_sound(&first))
        fail_msg("seed %llu: not sound", (unsigned long long)seed);
    picture again = subject_shade(f, width, height, &frame, &settings);
    if (memcmp(first.values, again.values, (size_t)first.width * (size_t)first.height * sizeof(float)) != 0)
        fail_msg("seed %llu: two runs differ", (unsigned long long)seed);
    free(first.values);
    free(again.values);
    if (below(&s, 3) == 0)
        random_walk(f, &s, &frame, &settings, width, height, scale, seed);
}

TEST_GL(random_cases)
{
    print_message("%d cases from seed %llu\n", cases, (unsigned long long)first_seed);
    for (int i = 0; i < cases; ++i)
        random_case(f, first_seed + (uint64_t)i);
}

int main(int argc, char **argv)
{
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--cases"))
            cases = atoi(argv[i + 1]);
        else if (!strcmp(argv[i], "--seed"))
            first_seed = strtoull(argv[i + 1], NULL, 10);
    }
    return test_run(NULL, fixture_setup, fixture_teardown);
}
