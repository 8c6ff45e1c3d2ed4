/* SPDX-License-Identifier: MIT
 *
 * Relations between two pictures that hold without knowing the right one: scale, direction of depth, tiles, quarter
 * turns, radius, power, repetition, and normals that look away.
 */
#include "techniques.h"

#include <math.h>

static int stride = 1;

enum { W = 96, H = 96 };

static double mean_apart(const picture *a, const picture *b)
{
    double sum = 0.0;
    assert_true(a->width == b->width && a->height == b->height);
    for (int i = 0; i < a->width * a->height; ++i)
        sum += fabs((double)a->values[i] - (double)b->values[i]);
    return sum / (a->width * a->height);
}

static bool same_bits(const picture *a, const picture *b)
{
    return a->width == b->width && a->height == b->height &&
           memcmp(a->values, b->values, (size_t)a->width * (size_t)a->height * sizeof *a->values) == 0;
}

/* What is done to the room: nothing; a quarter turn about the view axis; all normals turned the other way. */
typedef enum change { AS_IT_IS, TURNED, LOOKING_AWAY } change;

static picture shade_room(fixture *f, const analytic_view *view, int width, int height, double scale, change how,
                          const glssao_settings *settings)
{
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, scale);
    for (int i = 0; i < ANALYTIC_ROOM_SHAPES && how == TURNED; ++i) {
        const analytic_shape s = room[i];
        const bool plane = s.kind == ANALYTIC_PLANE;
        room[i].center[0] = -s.center[1];
        room[i].center[1] = s.center[0];
        if (s.kind == ANALYTIC_SPHERE)
            continue;
        room[i].size[0] = plane ? -s.size[1] : s.size[1];
        room[i].size[1] = s.size[0];
    }
    subject s = subject_of(view, room, ANALYTIC_ROOM_SHAPES, width, height);
    for (int i = 0; i < 3 * width * height && how == LOOKING_AWAY; ++i)
        s.normals[i] = -s.normals[i];
    SCOPED(frame) glssao_frame frame = subject_frame(&s, DEPTH_32F, NORMAL_32F);
    const glssao_settings scaled = settings_scaled(settings, scale);
    picture p = subject_shade(f, width, height, &frame, &scaled);
    assert_true(picture_is_sound(&p));
    subject_free(&s);
    return p;
}

static picture plain(fixture *f, const glssao_settings *settings)
{
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    return shade_room(f, &view, W, H, 1.0, AS_IT_IS, settings);
}

typedef void (*relation)(fixture *f, const configuration *c, const picture *first);

static void for_each_configuration(fixture *f, relation check)
{
    for (int i = 0; i < CONFIGURATIONS; i += stride) {
        const configuration c = configuration_of(i);
        SCOPED(picture) picture first = plain(f, &c.settings);
        assert_true(picture_mean(&first) < 0.995); /* some pixel is occluded */
        check(f, &c, &first);
    }
}

/* A test of each configuration c, with the picture that it gives. */
#define RELATION(name)                                                                                                 \
    static void check_##name(fixture *f, const configuration *c, const picture *first);                                \
    TEST_GL(name)                                                                                                      \
    {                                                                                                                  \
        for_each_configuration(f, check_##name);                                                                       \
    }                                                                                                                  \
    static void check_##name(fixture *f, const configuration *c, const picture *first)

RELATION(runs_repeat)
{
    SCOPED(picture) picture again = plain(f, &c->settings);
    if (!same_bits(first, &again))
        fail_msg("%s: another picture", c->name);
}

RELATION(scale_changes_nothing)
{
    static const double scales[] = {0x1p-13, 0x1p13, 1e-4, 1e4};
    for (int i = 0; i < 4; ++i) {
        const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, scales[i]);
        SCOPED(picture) picture scaled = shade_room(f, &view, W, H, scales[i], AS_IT_IS, &c->settings);
        const double apart = mean_apart(first, &scaled);
        /* Powers of two are exact; other scales flip samples on a threshold. */
        if (i < 2 ? apart > 0.0 : apart > 1e-3)
            fail_msg("%s: scale %g: %g apart", c->name, scales[i], apart);
    }
}

RELATION(depth_directions_agree)
{
    static const analytic_projection others[] = {PERSPECTIVE_INFINITE, PERSPECTIVE_REVERSED_ZERO_TO_ONE,
                                                 PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE};
    for (int i = 0; i < 3; ++i) {
        const analytic_view view = analytic_make_view(others[i], (double)W / H, 0.5, 40.0, 1.0);
        SCOPED(picture) picture other = shade_room(f, &view, W, H, 1.0, AS_IT_IS, &c->settings);
        const double apart = mean_apart(first, &other);
        if (apart > 1.5e-3)
            fail_msg("%s: projection %d: %g apart", c->name, (int)others[i], apart);
    }
}

/* The lower left part of the picture, by an off-centre projection. It must equal the crop, except for a margin on its
 * right and above, where the picture continues. The classic technique's random vectors stretch over the target, so its
 * noise differs. */
RELATION(tiles_are_crops)
{
    enum { TILE = 72, MARGIN = 28 };
    analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    const double stretch = (double)W / TILE;
    for (int axis = 0; axis < 2; ++axis) { /* ndc' = stretch (ndc + 1) - 1, with w of -z */
        view.projection[5 * axis] *= (float)stretch;
        view.projection[8 + axis] = (float)(1.0 - stretch);
    }
    picture tile = shade_room(f, &view, TILE, TILE, 1.0, AS_IT_IS, &c->settings);
    double sum = 0.0, bias = 0.0;
    int count = 0;
    for (int y = 0; y < TILE - MARGIN; ++y)
        for (int x = 0; x < TILE - MARGIN; ++x) {
            const double apart = (double)tile.values[y * TILE + x] - (double)first->values[y * W + x];
            sum += fabs(apart);
            bias += apart;
            ++count;
        }
    if (sum / count > (c->settings.technique == GLSSAO_CLASSIC ? 8e-3 : 1e-3) || fabs(bias) / count > 2e-3)
        fail_msg("%s: a tile is %g apart, bias %g", c->name, sum / count, bias / count);
    free(tile.values);
}

/* Noise, sample positions and the texel that stands for four at half size do not turn along. */
RELATION(quarter_turns_turn_the_picture)
{
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    SCOPED(picture) picture turned = shade_room(f, &view, W, H, 1.0, TURNED, &c->settings);
    double sum = 0.0, bias = 0.0;
    for (int y = 0; y < H; ++y)
        for (int x = 0; x < W; ++x) {
            const double apart = (double)turned.values[x * W + (W - 1 - y)] - (double)first->values[y * W + x];
            sum += fabs(apart);
            bias += apart;
        }
    if (sum / (W * H) > 0.02 || fabs(bias) / (W * H) > 0.004)
        fail_msg("%s: a quarter turn: %g apart, bias %g", c->name, sum / (W * H), bias / (W * H));
}

/* The filters compare stored normals, which project to a plane that has no place for those straight away from the eye.
 */
RELATION(normals_may_look_away)
{
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    SCOPED(picture) picture away = shade_room(f, &view, W, H, 1.0, LOOKING_AWAY, &c->settings);
    const double apart = mean_apart(first, &away);
    if (apart > 0.003)
        fail_msg("%s: normals that look away: %g apart", c->name, apart);
}

RELATION(greater_radius_never_brightens_the_mean)
{
    (void)first;
    /* The last is a million times the distance of what is farthest. */
    static const float radii[] = {0.0625f, 0.125f, 0.25f, 0.5f, 1.0f, 4.0f, 1e2f, 1e3f, 1e4f, 1e7f};
    /* Samples of the others spread over more than the picture shows. */
    const int count = c->settings.technique == GLSSAO_HORIZON ? 10 : 5;
    double before = 2.0;
    for (int i = 0; i < count; ++i) {
        const float radius = radii[i];
        glssao_settings s = c->settings;
        s.radius = radius;
        s.surface_epsilon = 0.01f; /* the same for all */
        SCOPED(picture) picture p = plain(f, &s);
        const double mean = picture_mean(&p);
        if (mean > before + 1e-3)
            fail_msg("%s: radius %g brightens the mean from %g to %g", c->name, (double)radius, before, mean);
        before = mean;
    }
}

/* Later rounds of the planar blur weigh neighbours by likeness, which a power changes: each by less than half the
 * difference at which a neighbour counts no more (BLUR_ALIKE), and never in the mean. */
RELATION(greater_power_never_brightens)
{
    picture before = *first, after;
    const bool weighs = c->settings.blur == GLSSAO_BLUR_PLANAR && c->settings.blur_rounds > 1;
    const float a_round = 0.5f * 0.2f / sqrtf((float)c->settings.sample_count);
    const float most = weighs ? (float)(c->settings.blur_rounds - 1) * a_round : 1.01f / 65535.0f;
    for (float power = 2.0f; power <= 64.0f; power *= 4.0f) {
        glssao_settings s = c->settings;
        s.power = power;
        after = plain(f, &s);
        for (int i = 0; i < W * H; ++i)
            if (after.values[i] > before.values[i] + most)
                fail_msg("%s: power %g brightens pixel %d from %g to %g", c->name, (double)power, i,
                         (double)before.values[i], (double)after.values[i]);
        assert_true(picture_mean(&after) <= picture_mean(&before) + 1e-6);
        if (before.values != first->values)
            free(before.values);
        before = after;
    }
    free(before.values);
}

int main(int argc, char **argv)
{
    stride = configuration_stride(argc, argv);
    return test_run(NULL, fixture_setup, fixture_teardown);
}
