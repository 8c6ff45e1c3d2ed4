/* SPDX-License-Identifier: MIT
 *
 * Schedules, without OpenGL: which steps each kind of frame has, and rules that hold for all of them.
 */
#include "frame/unroll.h"
#include "schedules.h"
#include "testing.h"

/* "distance estimate! blur": the steps' shaders in order; "!" after a dispatch, "=1" and "=0" for clears. */
static void spell(const glssao__schedule *s, char *out, size_t size)
{
    out[0] = '\0';
    for (int i = 0; i < s->count; ++i) {
        const glssao__step *step = &s->steps[i];
        const size_t length = strlen(out);
        snprintf(out + length, size - length, "%s%s%s", i ? " " : "",
                 step->kind == STEP_CLEAR_TO_OPEN   ? "=1"
                 : step->kind == STEP_CLEAR_TO_ZERO ? "=0"
                                                    : glssao__shader_name(step->shader),
                 step->kind == STEP_DISPATCH ? "!" : "");
    }
}

static void assert_steps(const glssao__request *q, const char *wanted)
{
    glssao__schedule s;
    char steps[1024];
    glssao__schedule_make(&s, q);
    spell(&s, steps, sizeof steps);
    assert_string_equal(steps, wanted);
}

TEST(levels_have_their_steps)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    glssao__request q = schedules_request(&frame, &s, 1280, 720);
    assert_steps(&q, "distance! horizon! planar-tile!");
    s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    assert_steps(&q, "distance! horizon! planar-tile!");
    s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_ULTRA);
    assert_steps(&q, "distance! horizon! planar-tile! planar-tile!");
    q.can.path = GLSSAO_PATH_FRAGMENT;
    assert_steps(&q, "distance horizon planar-blur planar-blur planar-blur planar-blur");
    s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    assert_steps(&q, "distance horizon planar-blur planar-blur planar-blur upsample spread");
    frame.normal_texture = 0;
    assert_steps(&q, "normals distance horizon planar-blur planar-blur planar-blur upsample spread");
    s = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_MEDIUM);
    assert_steps(&q, "normals classic blur blur blur blur");
    s = glssao_default_settings(GLSSAO_HEMISPHERE, GLSSAO_HIGH);
    assert_steps(&q, "normals hemisphere blur blur");
}

TEST(tiles_add_their_steps)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    glssao__request q = schedules_request(&frame, &s, 1280, 720);
    q.can.is_software = true;
    assert_steps(&q,
                 "distance tile-class =0 tile-near tile-rows tile-bounds tile-class tile-rings tile-blocks tile-fill "
                 "tile-fill horizon open planar-blur "
                 "planar-blur planar-blur "
                 "upsample spread");
    s = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_LOW);
    assert_steps(&q, "tile-rows tile-bounds tile-class tile-rings tile-blocks =1 =1 classic blur blur");
    q.size[0] = 160; /* too few tiles to pay */
    q.size[1] = 120;
    assert_steps(&q, "classic blur blur");
}

/* Settings that most frames leave alone run the shaders of before. */
TEST(rare_settings_cost_nothing_unused)
{
    for (int i = 0; i < 8; ++i) {
        glssao_frame frame;
        glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
        glssao__request q = schedules_request(&frame, &s, 1280, 720);
        q.can.path = i & 1 ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
        s.radius_in_pixels = i & 2;
        q.is_orthographic = i & 4; /* whose pixels are as wide everywhere */
        s.thickness = s.radius_in_pixels ? 0.5f : 1.0f;
        s.fade_far_end = s.radius_in_pixels ? 9.0f : 0.0f;
        glssao__schedule schedule;
        glssao__schedule_make(&schedule, &q);
        const bool grows = (i & 6) == 2;
        for (int k = 0; k < schedule.count; ++k) {
            const uint8_t *values = schedule.steps[k].variant.values;
            assert_true(!values[MACRO_TURNED] && !values[MACRO_OBLIQUE]);
            switch (schedule.steps[k].shader) {
            case SHADER_DISTANCE:
            case SHADER_HORIZON:
            case SHADER_PLANAR_BLUR:
            case SHADER_PLANAR_TILE:
            case SHADER_UPSAMPLE:
                assert_true(values[MACRO_RADIUS_GROWS] == grows);
                break;
            default:
                assert_false(values[MACRO_RADIUS_GROWS]);
            }
        }
    }
}

TEST(inputs_are_copied_first)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_ULTRA);
    glssao__request q = schedules_request(&frame, &s, 64, 48);
    frame.multisample = true;
    assert_steps(&q, "input input distance! horizon! planar-tile! planar-tile!");
    frame.multisample = false;
    frame.depth_kind = GLSSAO_DEPTH_LOGARITHMIC;
    assert_steps(&q, "input distance! horizon! planar-tile! planar-tile!");
    q.is_oblique = true; /* the copies are of one pass */
    assert_steps(&q, "input distance! horizon! planar-tile! planar-tile!");
    frame.depth_kind = GLSSAO_DEPTH_WINDOW;
    assert_steps(&q, "input distance! horizon! planar-tile! planar-tile!");
    frame.depth_kind = GLSSAO_DEPTH_VIEW_DISTANCE; /* is distance already */
    assert_steps(&q, "distance! horizon! planar-tile! planar-tile!");
    q.is_oblique = false;
    frame.depth_kind = GLSSAO_DEPTH_WINDOW;
    assert_steps(&q, "distance! horizon! planar-tile! planar-tile!");
    frame.viewport[2] = 64;
    frame.viewport[3] = 48;
    frame.back_texture = frame.second_texture = 9;
    assert_steps(&q, "input input input input distance! horizon! planar-tile! planar-tile!");
}

TEST(rounds_share_dispatches_by_two)
{
    static const char *const wanted[] = {"distance! horizon! planar-tile!",
                                         "distance! horizon! planar-tile!",
                                         "distance! horizon! planar-tile!",
                                         "distance! horizon! planar-tile! planar-tile!",
                                         "distance! horizon! planar-tile! planar-tile!",
                                         "distance! horizon! planar-tile! planar-tile! planar-tile!"};
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    const glssao__request q = schedules_request(&frame, &s, 64, 48);
    for (s.blur_rounds = 0; s.blur_rounds <= 5; ++s.blur_rounds) /* the last two within the upsampling */
        assert_steps(&q, wanted[s.blur_rounds]);
}

TEST(estimates_are_added_and_averaged)
{
    glssao_frame frame;
    const glssao_settings high = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    glssao_settings s = glssao__schedule_accumulated(&high);
    glssao__request q = schedules_request(&frame, &s, 64, 48);
    q.estimates = 1;
    assert_steps(&q, "=0 distance! horizon resolve planar-tile!");
    q.estimates = 2;
    assert_steps(&q, "distance! horizon probe resolve planar-tile!");
    q.estimates = 16; /* smooth by themselves */
    assert_steps(&q, "distance! horizon probe resolve");
}

/* The steps of a frame with bent normals are those of one without. */
TEST(bent_normals_add_no_step)
{
    for (int quality = 0; quality <= GLSSAO_ULTRA; ++quality)
        for (int path = GLSSAO_PATH_FRAGMENT; path <= GLSSAO_PATH_COMPUTE; ++path) {
            glssao_frame frame;
            glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)quality);
            glssao__request q = schedules_request(&frame, &s, 1280, 720);
            glssao__schedule without;
            char steps[1024];
            q.can.path = (glssao_path)path;
            glssao__schedule_make(&without, &q);
            spell(&without, steps, sizeof steps);
            s.bent_normals = true;
            assert_steps(&q, steps);
        }
}

TEST(rays_take_the_place_of_an_estimate)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_RAYS, GLSSAO_MEDIUM);
    glssao__request q = schedules_request(&frame, &s, 1280, 720);
    frame.rays_texture = 9;
    s.blur_rounds = 1;
    assert_steps(&q, "rays! planar-blur! planar-blur! planar-tile!");
    q.can.path = GLSSAO_PATH_FRAGMENT;
    q.can.is_software = true;
    assert_steps(&q, "tile-values tile-rings tile-blocks tile-fill tile-fill tile-fill rays planar-blur planar-blur "
                     "upsample spread");
    s.history = 16; /* which takes a pixel without rays for another thing than an open one */
    assert_steps(&q, "rays planar-blur planar-blur upsample history steady");
    s.history = 0;
    s.tiles = GLSSAO_TILES_OFF;
    s.half_resolution = false;
    s.blur_rounds = 2;
    assert_steps(&q, "rays planar-blur planar-blur planar-blur planar-blur");
    s.blur = GLSSAO_BLUR_NONE;
    frame.normal_texture = 0;
    assert_steps(&q, "normals rays");
    frame.multisample = true; /* which rays are not */
    assert_steps(&q, "input normals rays");
}

/* The rounds look ever farther, and only the last step fills in what is missing. */
TEST(rounds_of_rays_widen)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_RAYS, GLSSAO_HIGH);
    const glssao__request q = schedules_request(&frame, &s, 64, 48);
    glssao__schedule schedule;
    frame.rays_texture = 9;
    s.blur_rounds = 5;
    glssao__schedule_make(&schedule, &q);
    assert_int_equal(schedule.count, 11);
    for (int i = 0; i < 11; ++i) {
        const glssao__variant *v = &schedule.steps[i].variant;
        assert_int_equal(v->values[MACRO_STRIDE], i == 0 ? 0 : i <= 6 ? (i - 1) / 2 : 3);
        assert_int_equal(v->values[MACRO_RAYS], i == 10 ? 2 : 1);
        assert_true(i == 0 || schedule.steps[i].is_horizontal == (i % 2 == 1));
    }
}

TEST(rays_correct_an_estimate)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    glssao__request q = schedules_request(&frame, &s, 1280, 720);
    frame.rays_texture = 9;
    assert_steps(&q, "distance! horizon! planar-tile! rays! planar-blur! planar-blur! planar-blur! planar-blur! "
                     "planar-tile!");
    q.can.path = GLSSAO_PATH_FRAGMENT;
    q.can.is_software = true;
    assert_steps(&q, "distance tile-class =0 tile-near tile-rows tile-bounds tile-class tile-rings tile-blocks =1 =1 "
                     "horizon open planar-blur planar-blur "
                     "tile-values tile-rings tile-blocks tile-fill tile-fill tile-fill tile-fill "
                     "rays planar-blur planar-blur planar-blur planar-blur upsample spread");
    s.history = 16; /* tiles are not sorted again */
    assert_steps(&q,
                 "distance tile-class =0 tile-near tile-rows tile-bounds tile-class tile-rings tile-blocks =1 =1 =1 "
                 "horizon open planar-blur planar-blur "
                 "rays planar-blur planar-blur planar-blur rays planar-blur upsample history steady");
    s = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_LOW);
    s.half_resolution = false; /* one round more */
    assert_steps(&q, "tile-rows tile-bounds tile-class tile-rings tile-blocks =1 =1 classic open blur blur "
                     "tile-values tile-rings tile-blocks tile-fill tile-fill tile-fill rays planar-blur "
                     "planar-blur planar-blur planar-blur planar-blur planar-blur");
    s.radius = 0.0f;
    assert_steps(&q, "=1 =1");
}

/* The same steps and variants as ever where there are no rays. */
TEST(no_rays_cost_nothing)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    const glssao__request q = schedules_request(&frame, &s, 1280, 720);
    glssao__schedule schedule;
    glssao__schedule_make(&schedule, &q);
    assert_false(schedule.plan.passes[GLSSAO_PASS_RAYS].run);
    assert_int_equal(schedule.maps[MAP_RAYS_0].format, 0);
    for (int i = 0; i < schedule.count; ++i)
        assert_true(schedule.steps[i].variant.values[MACRO_RAYS] == 0 &&
                    schedule.steps[i].variant.values[MACRO_STRIDE] == 0);
}

TEST(history_reads_upsampled_blocks)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    glssao__request q = schedules_request(&frame, &s, 64, 48);
    s.history = 16;
    assert_steps(&q, "distance! horizon! planar-tile! history! steady!");
    glssao__schedule first, second;
    glssao__schedule_make(&first, &q);
    q.frames = 1;
    glssao__schedule_make(&second, &q);
    assert_int_equal(first.maps[MAP_DISTANCE].width, 64); /* though the estimate has half the size */
    assert_int_equal(first.steps[1].region.width, 32);
    assert_int_equal(first.steps[3].target, MAP_HISTORY_0);
    assert_int_equal(second.steps[3].target, MAP_HISTORY_1);
    assert_int_equal(first.result, MAP_RESULT);
    q.can.path = GLSSAO_PATH_FRAGMENT;
    assert_steps(&q, "distance horizon planar-blur planar-blur planar-blur upsample history steady");
    s = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_LOW);
    s.history = 4;
    assert_steps(&q, "classic blur blur upsample history steady");
    q.can.is_software = true; /* tiles that get no estimate are open in both maps that the history reads */
    q.size[0] = 1280;
    q.size[1] = 720;
    assert_steps(
        &q,
        "tile-rows tile-bounds tile-class tile-rings tile-blocks tile-fill =1 =1 =1 classic open blur blur upsample "
        "history steady");
    s.history = 0;
    assert_steps(&q, "tile-rows tile-bounds tile-class tile-rings tile-blocks =1 =1 classic blur blur");
}

TEST(histories_take_12_steps_a_side_at_least)
{
    static const int without[] = {6, 8, 12, 12};
    for (int quality = GLSSAO_LOW; quality <= GLSSAO_ULTRA; ++quality)
        for (int reuses = 0; reuses < 2; ++reuses) {
            glssao_frame frame;
            glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)quality);
            const glssao__request q = schedules_request(&frame, &s, 64, 48);
            glssao__schedule schedule;
            s.history = reuses;
            glssao__schedule_make(&schedule, &q);
            assert_int_equal(schedule.steps[1].shader, SHADER_HORIZON);
            assert_int_equal(schedule.steps[1].variant.values[MACRO_STEPS], reuses ? 12 : without[quality]);
        }
}

TEST(histories_know_radii_in_pixels)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    const glssao__request q = schedules_request(&frame, &s, 64, 48);
    glssao__schedule schedule;
    s.history = 16;
    s.radius = 20.0f;
    s.radius_in_pixels = true;
    glssao__schedule_make(&schedule, &q);
    for (int i = schedule.count - 2; i < schedule.count; ++i) {
        assert_int_equal(schedule.steps[i].pass, GLSSAO_PASS_HISTORY);
        assert_int_equal(schedule.steps[i].variant.values[MACRO_RADIUS_GROWS], 1);
    }
}

TEST(nothing_is_only_cleared)
{
    glssao_frame frame;
    glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    const glssao__request q = schedules_request(&frame, &s, 64, 48);
    frame.only_sky = true;
    assert_steps(&q, "=1 =1");
    frame.margin = 8;
    assert_steps(&q, "=1 =1 =1");
    glssao__schedule schedule;
    glssao__schedule_make(&schedule, &q);
    assert_int_equal(schedule.result, MAP_RESULT);
    assert_int_equal(schedule.maps[MAP_RESULT].width, (64 + 1) / 2 - 8); /* half the margin on each side */
}

/* ---- rules ---- */

static bool is_draw(const glssao__step *step)
{
    return step->kind == STEP_DRAW || step->kind == STEP_DISPATCH;
}

/* What holds for every step of every schedule. */
static void check_rules(const glssao__request *q, const glssao__schedule *s, void *user)
{
    int calls[GLSSAO_PASS_COUNT] = {0};
    bool is_written[MAP_COUNT] = {false}, waits = false;
    (void)user;
    is_written[MAP_SUM] = is_written[MAP_OTHER_SUM] = q->estimates > 1; /* by earlier calls */
    assert_true(s->count <= SCHEDULE_STEPS);
    for (int i = 0; i < s->count; ++i) {
        const glssao__step *step = &s->steps[i];
        const glssao__target_spec *target = &s->maps[step->target];
        assert_true(step->target >= MAP_FIRST_TARGET && target->format != 0);
        assert_true(i == 0 || step->pass >= s->steps[i - 1].pass || s->steps[i - 1].kind == STEP_CLEAR_TO_ZERO);
        assert_true(step->region.x >= 0 && step->region.y >= 0 && step->region.width > 0 && step->region.height > 0);
        assert_true(step->region.x + step->region.width <= target->width);
        assert_true(step->region.y + step->region.height <= target->height);
        for (int k = 0; k < step->read_count; ++k) {
            const enum glssao__map map = step->reads[k].map;
            assert_true(map != MAP_NONE && map != step->target && map != step->second); /* no feedback loop */
            assert_true(map < MAP_FIRST_TARGET || s->maps[map].format);                 /* it exists */
            assert_true(map < MAP_FIRST_TARGET || is_written[map] ||
                        step->reads[k].unit == UNIT_HISTORY); /* by this frame; the history by the last one */
            for (int j = 0; j < k; ++j)
                assert_true(step->reads[j].unit != step->reads[k].unit || step->reads[j].map == map);
        }
        /* Dispatched texels are waited for before anything else touches them. */
        assert_true(!waits || step->barrier != BARRIER_NONE);
        assert_true(step->kind == STEP_DISPATCH || step->barrier != BARRIER_DISPATCH);
        waits = step->kind == STEP_DISPATCH;
        is_written[step->target] = true;
        if (step->second != MAP_NONE) { /* a second target is of the first one's size, and for bent normals alone */
            assert_true(q->settings->bent_normals && step->variant.values[MACRO_BENT]);
            assert_true(s->maps[step->second].width == target->width && s->maps[step->second].height == target->height);
            is_written[step->second] = true;
        }
        assert_true(q->settings->bent_normals || step->variant.values[MACRO_BENT] == 0);
        if (is_draw(step)) {
            calls[step->pass] += 1;
            assert_true(s->plan.passes[step->pass].run);
            assert_int_equal(step->kind == STEP_DISPATCH, step->variant.values[MACRO_COMPUTE]);
            assert_true(step->kind != STEP_DISPATCH || s->plan.path == GLSSAO_PATH_COMPUTE);
        }
        for (int m = 0; m < MACRO_COUNT; ++m)
            assert_true(!is_draw(step) || step->variant.values[m] == 0 ||
                        glssao__shader_tests(step->shader, (enum glssao__macro)m));
    }
    assert_int_equal(s->last_barrier == BARRIER_ALL, waits);
    assert_true(is_written[s->result]);
    assert_int_equal(is_written[MAP_BENT], q->settings->bent_normals);
    assert_int_equal(s->maps[MAP_BENT].format != 0, q->settings->bent_normals);
    assert_true(q->settings->bent_normals || s->maps[MAP_PAIRED_0].format != GL_RGBA32F);
    for (int pass = 0; pass < GLSSAO_PASS_COUNT; ++pass) {
        assert_int_equal(s->plan.passes[pass].draw_calls, calls[pass]);
        assert_true(s->plan.passes[pass].run == (calls[pass] > 0));
        assert_true(strlen(s->plan.passes[pass].reason) > 0);
    }
}

TEST(all_schedules_keep_the_rules)
{
    const int count = schedules_visit(check_rules, NULL);
    print_message("%d schedules\n", count);
    assert_true(count > 10000);
}

TEST(frames_by_levels_have_at_most_32_steps)
{
    for (int technique = 0; technique <= GLSSAO_RAYS; ++technique)
        for (int quality = 0; quality <= GLSSAO_ULTRA; ++quality) {
            glssao_frame frame;
            glssao_settings s = glssao_default_settings((glssao_technique)technique, (glssao_quality)quality);
            glssao__request q = schedules_request(&frame, &s, 1280, 720);
            q.can.is_software = true;
            frame.normal_texture = 0;
            frame.rays_texture = 9;
            glssao__schedule schedule;
            glssao__schedule_make(&schedule, &q);
            assert_true(schedule.count <= 32);
        }
}

/* ---- unrolling ---- */

TEST(loops_are_written_out)
{
    static const struct {
        const char *source, *wanted;
    } cases[] = {
        {"a\nb", "a\nb"},
        {"for (int i = 0; i < 2; ++i) { x; }", "for (int i = 0; i < 2; ++i) { x; }"},
        {"UNROLL for (int i = 0; i < 2; ++i) { x[i]; }",
         "{ const int i = 0; { x[i]; } }\n{ const int i = 1; { x[i]; } }\n"},
        {"#define N 3\nUNROLL for (int k = N - 1; k >= 1; --k) { y(k); } z",
         "#define N 3\n{ const int k = 2; { y(k); } }\n{ const int k = 1; { y(k); } }\n z"},
        {"UNROLL for (int i = -1; i <= 0; ++i) { if (a) { b; } }",
         "{ const int i = -1; { if (a) { b; } } }\n{ const int i = 0; { if (a) { b; } } }\n"},
        {"UNROLL for (int i = 0; i < 1; ++i) { UNROLL for (int k = 0; k < 2; ++k) { c; } }",
         "{ const int i = 0; { { const int k = 0; { c; } }\n{ const int k = 1; { c; } }\n } }\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        SCOPED(memory) char *unrolled = glssao__unroll(cases[i].source, true);
        assert_string_equal(unrolled, cases[i].wanted);
    }
    static const char *const loop = "UNROLL_IF_SHORT for (int i = 0; i < 1; ++i) { x; }";
    char *kept = glssao__unroll(loop, false), *unrolled = glssao__unroll(loop, true);
    assert_string_equal(kept, loop);
    assert_string_equal(unrolled, "{ const int i = 0; { x; } }\n");
    free(kept);
    free(unrolled);
}

TEST_MAIN(NULL, NULL, NULL)
