/* SPDX-License-Identifier: MIT
 *
 * Reuse of earlier frames, and noise that differs from frame to frame: in a room that is computed, not drawn, for every
 * projection, with the camera at rest and in motion, and with a box that moves.
 */
#include "fixture.h"

enum { W = 96, H = 64, N = W * H, FRAMES = 20 };

/* How the host hands over what it has. */
typedef enum situation { AS_IT_IS, IN_A_VIEWPORT, LOGARITHMIC, WITH_RAYS, SITUATION_COUNT } situation;

/* What the camera sees from a place. The shapes are moved instead of the eye. */
typedef struct shot {
    analytic_projection projection;
    double x, z;  /* of the eye, in the view space of the first shot */
    double box_x; /* how far the last shape has moved along x */
    int width, height, margin;
    bool depth_alone;
    situation situation;
    uint32_t noise; /* of the rays */
} shot;

static const double NEAREST = 0.5, FARTHEST = 40.0;

/* The texture as a part of a larger one, which has 0.25 in all other texels. */
static GLuint enlarge(GLuint texture, int channels, const int viewport[4])
{
    const int width = viewport[2] + 16, height = viewport[3] + 10;
    SCOPED(memory)
    float *part = channels == 1 ? fixture_read_depth(texture, viewport[2], viewport[3])
                                : fixture_read_texture(texture, viewport[2], viewport[3], channels);
    SCOPED(memory) float *all = malloc((size_t)(width * height * channels) * sizeof *all);
    for (int i = 0; i < width * height * channels; ++i)
        all[i] = 0.25f;
    for (int y = 0; y < viewport[3]; ++y)
        memcpy(all + ((y + viewport[1]) * width + viewport[0]) * channels, part + y * viewport[2] * channels,
               (size_t)(viewport[2] * channels) * sizeof *all);
    const GLuint larger =
        channels == 1 ? fixture_texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, width, height, all)
                      : fixture_texture(GL_RGBA32F, channels == 3 ? GL_RGB : GL_RGBA, GL_FLOAT, width, height, all);
    gl.DeleteTextures(1, &texture);
    return larger;
}

/* From window depth of the perspective projection, as three.js stores it. */
static GLuint make_logarithmic(GLuint texture, int width, int height)
{
    SCOPED(memory) float *depth = fixture_read_depth(texture, width, height);
    for (int i = 0; i < width * height; ++i) {
        const double distance = NEAREST * FARTHEST / (FARTHEST - (double)depth[i] * (FARTHEST - NEAREST));
        depth[i] = depth[i] < 1.0f ? (float)(log2(distance + 1.0) / log2(FARTHEST + 1.0)) : 1.0f;
    }
    const GLuint made = fixture_texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, width, height, depth);
    gl.DeleteTextures(1, &texture);
    return made;
}

/* Two rays a pixel that say 0.5 in the mean; one pixel in eight has none. */
static GLuint make_rays(int width, int height, uint32_t noise)
{
    SCOPED(memory) float *values = malloc((size_t)(width * height) * sizeof *values);
    uint32_t random = 12345u + 2654435761u * noise;
    for (int i = 0; i < width * height; ++i) {
        random = random * 1664525u + 1013904223u;
        const uint32_t roll = random >> 29;
        values[i] = roll == 0 ? -1.0f : roll < 3 ? 0.0f : roll < 5 ? 1.0f : roll == 5 ? NAN : 0.5f;
    }
    const GLuint made = fixture_texture(GL_R32F, GL_RED, GL_FLOAT, width, height, values);
    return made;
}

static void put(glssao_frame *frame, const shot *s)
{
    const int viewport[4] = {7, 5, s->width, s->height};
    if (s->situation == IN_A_VIEWPORT) {
        memcpy(frame->viewport, viewport, sizeof viewport);
        frame->depth_texture = enlarge(frame->depth_texture, 1, viewport);
        frame->normal_texture = frame->normal_texture ? enlarge(frame->normal_texture, 3, viewport) : 0;
    }
    if (s->situation == LOGARITHMIC) {
        frame->depth_kind = GLSSAO_DEPTH_LOGARITHMIC;
        frame->log_depth_far = (float)FARTHEST;
        frame->depth_texture = make_logarithmic(frame->depth_texture, s->width, s->height);
    }
    if (s->situation == WITH_RAYS)
        frame->rays_texture = make_rays(s->width, s->height, s->noise);
}

static glssao_frame take(const shot *s)
{
    analytic_shape room[ANALYTIC_ROOM_SHAPES];
    analytic_room(room, 1.0);
    for (int i = 2; i < ANALYTIC_ROOM_SHAPES; ++i) /* all but floor and wall */
        room[i].center[0] += s->box_x;
    for (int i = 0; i < ANALYTIC_ROOM_SHAPES; ++i) {
        room[i].center[0] -= s->x;
        room[i].center[2] -= s->z;
    }
    const analytic_view view = analytic_make_view(s->projection, (double)s->width / s->height, NEAREST, FARTHEST, 1.0);
    glssao_frame frame = fixture_frame(&view, room, ANALYTIC_ROOM_SHAPES, s->width, s->height);
    if (s->depth_alone) {
        gl.DeleteTextures(1, &frame.normal_texture);
        frame.normal_texture = 0;
    }
    frame.margin = s->margin;
    frame.view[0] = frame.view[5] = frame.view[10] = frame.view[15] = 1.0f;
    frame.view[12] = (float)-s->x;
    frame.view[14] = (float)-s->z;
    put(&frame, s);
    return frame;
}

static shot first_shot(analytic_projection projection)
{
    return (shot){.projection = projection, .width = W, .height = H};
}

static glssao_settings make_settings(glssao_technique technique, glssao_quality quality, int history)
{
    glssao_settings s = glssao_default_settings(technique, quality);
    s.radius = 1.0f;
    s.history = history;
    return s;
}

static void compute(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    assert_int_equal(glssao_compute(effect, frame, settings), GLSSAO_OK);
}

static float *read_result(const glssao_effect *effect)
{
    int width, height;
    return fixture_read_ambient(effect, &width, &height);
}

static float *shoot(glssao_effect *effect, const shot *s, const glssao_settings *settings)
{
    SCOPED(frame) const glssao_frame frame = take(s);
    compute(effect, &frame, settings);
    return read_result(effect);
}

/* Frees the result before. */
static void replace(float **result, float *by)
{
    free(*result);
    *result = by;
}

/* Whether the effect's result has the bits of this one. */
static void assert_result(const glssao_effect *effect, const float *wanted)
{
    SCOPED(memory) float *got = read_result(effect);
    assert_memory_equal(got, wanted, N * sizeof *got);
}

/* A few frames in motion. The caller frees. */
static float *walk(glssao_effect *effect, shot s, const glssao_settings *settings, int frames)
{
    float *last = NULL;
    for (int i = 0; i < frames; ++i) {
        s.x = 0.05 * i;
        s.noise = (uint32_t)i;
        replace(&last, shoot(effect, &s, settings));
    }
    return last;
}

static double rms(const float *a, const float *b, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        assert_true(isfinite(a[i]) && isfinite(b[i]));
        sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    }
    return sqrt(sum / count);
}

/* The technique's own floor: the mean of many estimates at full size, of as many samples as a history has. */
static float *make_floor(fixture *f, const shot *s, const glssao_settings *settings)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, s->width, s->height);
    glssao_settings plain = *settings;
    plain.history = 0;
    plain.blur = GLSSAO_BLUR_NONE;
    plain.tiles = GLSSAO_TILES_OFF;
    plain.half_resolution = false;
    if (settings->history > 0 && settings->technique == GLSSAO_HORIZON && plain.sample_count < 24)
        plain.sample_count = 24;
    const int pixels = s->width * s->height, count = 32;
    float *sum = calloc((size_t)pixels, sizeof *sum);
    SCOPED(frame) const glssao_frame frame = take(s);
    for (int i = 0; i < count; ++i) {
        plain.noise_index = (uint32_t)i;
        compute(effect, &frame, &plain);
        SCOPED(memory) float *result = read_result(effect);
        for (int p = 0; p < pixels; ++p)
            sum[p] += result[p] / (float)count;
    }
    return sum;
}

/* ---- noise_index ---- */

/* The mean over indices converges: 16 of them leave less than a third of one's noise, and 8 less than half. */
TEST_GL(means_over_noise_indices_converge)
{
    const shot s = first_shot(PERSPECTIVE);
    for (int t = GLSSAO_CLASSIC; t <= GLSSAO_HORIZON; ++t) {
        glssao_settings settings = make_settings((glssao_technique)t, GLSSAO_LOW, 0);
        settings.half_resolution = false;
        settings.blur = GLSSAO_BLUR_NONE;
        settings.power = 1.0f;
        SCOPED(memory) float *floor_map = make_floor(f, &s, &settings), *mean = calloc((size_t)N, sizeof *mean);
        double errors[17] = {0};
        SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
        for (int i = 0; i < 16; ++i) {
            settings.noise_index = 100 + (uint32_t)i;
            SCOPED(memory) float *result = shoot(effect, &s, &settings);
            for (int p = 0; p < N; ++p)
                mean[p] += (result[p] - mean[p]) / (float)(i + 1);
            errors[i + 1] = rms(mean, floor_map, N);
        }
        assert_true(errors[1] > 0.005);
        assert_true(errors[8] < 0.5 * errors[1]);
        assert_true(errors[16] < errors[1] / 3.0);
    }
}

TEST_GL(index_0_is_the_pattern_without_an_index)
{
    const shot s = first_shot(PERSPECTIVE);
    for (int t = GLSSAO_CLASSIC; t <= GLSSAO_HORIZON; ++t) {
        glssao_settings settings = make_settings((glssao_technique)t, GLSSAO_HIGH, 0);
        SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
        SCOPED(memory) float *zero = shoot(effect, &s, &settings);
        settings.noise_index = 7;
        SCOPED(memory) float *seven = shoot(effect, &s, &settings);
        settings.noise_index = 0;
        SCOPED(memory) float *again = shoot(effect, &s, &settings);
        int width, height;
        (void)glssao_map(effect, GLSSAO_MAP_AMBIENT, &width, &height);
        assert_memory_equal(zero, again, (size_t)(width * height) * sizeof *zero);
        assert_memory_not_equal(zero, seven, (size_t)(width * height) * sizeof *zero);
    }
}

/* ---- history ---- */

/* At rest a history of 16 comes nearer to the floor than the single frame, whatever the projection. */
TEST_GL(rest_converges_in_every_projection)
{
    for (int p = 0; p < PROJECTION_COUNT; ++p)
        for (int depth_alone = 0; depth_alone < 2; ++depth_alone) {
            shot s = first_shot((analytic_projection)p);
            s.depth_alone = depth_alone;
            glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_LOW, 16);
            SCOPED(memory) float *floor_map = make_floor(f, &s, &settings);
            SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
            float *single = shoot(effect, &s, &settings), *last = NULL;
            for (int i = 1; i < FRAMES; ++i)
                replace(&last, shoot(effect, &s, &settings));
            assert_true(rms(last, floor_map, N) < 0.75 * rms(single, floor_map, N));
            free(single);
            free(last);
        }
}

/* A camera that moves finds its points again: the error stays below the single frame's. Without gLastView it would not.
 */
TEST_GL(motion_keeps_the_history)
{
    for (int p = 0; p < PROJECTION_COUNT; ++p) {
        const glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_LOW, 16);
        SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H), *other = fixture_effect(f, W, H);
        shot s = first_shot((analytic_projection)p);
        SCOPED(memory) float *last = NULL;
        for (int i = 0; i < FRAMES; ++i) {
            s.x = 0.03 * i;
            s.z = 0.02 * i;
            replace(&last, shoot(effect, &s, &settings));
        }
        SCOPED(memory) float *floor_map = make_floor(f, &s, &settings), *single = shoot(other, &s, &settings);
        assert_true(rms(last, floor_map, N) < 0.85 * rms(single, floor_map, N));
    }
}

/* Where the picture's edge cuts occluders off, the history still knows them: a wider picture, whose floor has them, is
 * less far off than the floor of what is seen. Without the weights of what was seen, the ratio is 0.81. */
TEST_GL(what_left_the_picture_still_occludes)
{
    enum { MORE = 48 };
    glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_ULTRA, 16);
    settings.radius = 3.0f;
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    shot s = first_shot(PERSPECTIVE);
    SCOPED(memory) float *last = NULL;
    for (int i = 0; i < 31; ++i) { /* at rest, then to the right */
        s.x = fmax(0.1 * (i - 15), 0.0);
        replace(&last, shoot(effect, &s, &settings));
    }
    SCOPED(memory) float *seen = make_floor(f, &s, &settings);
    s.width += 2 * MORE;
    SCOPED(memory) float *whole = make_floor(f, &s, &settings);
    double squares[2] = {0.0, 0.0};
    for (int i = 0; i < N; ++i) {
        const double truth = (double)whole[i / W * s.width + MORE + i % W];
        const double lost = (double)seen[i] - truth, error = (double)last[i] - truth;
        squares[0] += fabs(lost) > 0.05 ? lost * lost : 0.0;
        squares[1] += fabs(lost) > 0.05 ? error * error : 0.0;
    }
    assert_true(squares[0] > 0.1 && sqrt(squares[1] / squares[0]) < 0.65);
}

TEST_GL(first_frames_and_cuts_stand_alone)
{
    const glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM, 16);
    glssao_settings plain = settings;
    plain.history = 0;
    shot a = first_shot(PERSPECTIVE), b = a;
    b.x = 1.5;
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H), *other = fixture_effect(f, W, H);
    SCOPED(memory) float *fresh = shoot(other, &b, &settings);
    for (int i = 0; i < 4; ++i)
        free(shoot(effect, &a, &settings));
    SCOPED(frame) glssao_frame frame = take(&b);
    frame.cut = true;
    compute(effect, &frame, &settings);
    assert_result(effect, fresh);
    /* Another radius, a frame without a history, and a resize end it too. */
    glssao_settings wider = settings;
    wider.radius = 2.0f;
    frame.cut = false;
    compute(effect, &frame, &wider);
    compute(effect, &frame, &settings);
    assert_result(effect, fresh);
    compute(effect, &frame, &plain);
    compute(effect, &frame, &settings);
    assert_result(effect, fresh);
    assert_int_equal(glssao_resize(effect, W + 2, H), GLSSAO_OK);
    assert_int_equal(glssao_resize(effect, W, H), GLSSAO_OK);
    compute(effect, &frame, &settings);
    assert_result(effect, fresh);
}

/* The single frame is that of today: of a level that estimates at full size, to a step of R16 and what pairing rounds.
 */
TEST_GL(single_frame_is_as_good_as_without_history)
{
    const shot s = first_shot(PERSPECTIVE);
    glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_ULTRA, 16);
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    SCOPED(memory) float *with = shoot(effect, &s, &settings);
    settings.history = 0;
    SCOPED(memory) float *without = shoot(effect, &s, &settings);
    for (int i = 0; i < N; ++i)
        assert_true(fabs((double)with[i] - (double)without[i]) < 1e-3);
}

TEST_GL(same_frames_give_the_same_bits)
{
    const glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_LOW, 16);
    float *results[2] = {NULL, NULL};
    for (int k = 0; k < 2; ++k) {
        SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
        results[k] = walk(effect, first_shot(PERSPECTIVE), &settings, 6);
    }
    assert_memory_equal(results[0], results[1], N * sizeof *results[0]);
    free(results[0]);
    free(results[1]);
}

/* A mean of a still view, taken in between, changes no bit of the history. */
TEST_GL(accumulating_leaves_the_history)
{
    const glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_LOW, 16);
    float *results[2];
    for (int between = 0; between < 2; ++between) {
        SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
        const shot s = first_shot(PERSPECTIVE);
        SCOPED(frame) const glssao_frame frame = take(&s);
        for (int i = 0; i < 5; ++i) {
            compute(effect, &frame, &settings);
            for (int k = 0; k < 2 * between; ++k)
                assert_int_equal(glssao_accumulate(effect, &frame, &settings), GLSSAO_OK);
        }
        compute(effect, &frame, &settings);
        results[between] = read_result(effect);
    }
    assert_memory_equal(results[0], results[1], N * sizeof *results[0]);
    free(results[0]);
    free(results[1]);
}

/* Depth and normals that are not numbers leave no trace once they are gone. */
TEST_GL(no_number_is_forgotten)
{
    const glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_LOW, 16);
    const shot s = first_shot(PERSPECTIVE);
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    SCOPED(frame) glssao_frame frame = take(&s);
    static float normals[N * 3], depth[N], motion[N * 2];
    for (int i = 0; i < N; ++i) {
        normals[3 * i] = normals[3 * i + 1] = normals[3 * i + 2] = i % 3 ? NAN : INFINITY;
        depth[i] = i % 5 == 0 ? NAN : i % 5 == 1 ? -INFINITY : 3.0f;
        motion[2 * i] = motion[2 * i + 1] = i % 2 ? NAN : 1e30f;
    }
    SCOPED(frame) glssao_frame broken = frame;
    broken.depth_kind = GLSSAO_DEPTH_VIEW_DISTANCE;
    broken.depth_texture = fixture_texture(GL_R32F, GL_RED, GL_FLOAT, W, H, depth);
    broken.normal_texture = fixture_normal_texture(W, H, normals);
    broken.motion_texture = fixture_texture(GL_RG32F, GL_RG, GL_FLOAT, W, H, motion);
    for (int i = 0; i < 3; ++i)
        compute(effect, i == 1 ? &broken : &frame, &settings);
    SCOPED(memory) float *result = read_result(effect);
    for (int i = 0; i < N; ++i)
        assert_true(result[i] >= 0.0f && result[i] <= 1.0f);
}

/* How far the result is from that of an effect that saw nothing else, in the mean over pixels that change by more than
 * 0.05, so many frames after the box moved. */
static double left_over(fixture *f, glssao_quality quality, double from, double to, int frames)
{
    const glssao_settings settings = make_settings(GLSSAO_HORIZON, quality, 16);
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H), *other = fixture_effect(f, W, H);
    shot s = first_shot(PERSPECTIVE);
    SCOPED(memory) float *before = NULL, *last = NULL, *never = NULL;
    for (int i = 0; i < FRAMES + frames; ++i) {
        s.box_x = i < FRAMES ? from : to;
        float **to_keep = i < FRAMES ? &before : &last;
        free(*to_keep);
        *to_keep = shoot(effect, &s, &settings);
    }
    for (int i = 0; i < FRAMES; ++i)
        replace(&never, shoot(other, &s, &settings));
    double sum = 0.0;
    int changed = 0;
    for (int i = 0; i < N; ++i)
        if (fabsf(before[i] - never[i]) > 0.05f) {
            sum += (double)last[i] - (double)never[i];
            changed += 1;
        }
    assert_true(changed > 10);
    print_message("%d frames after: off by %.4f\n", frames, sum / changed);
    return sum / changed;
}

TEST_GL(shadows_of_what_moved_away_fade)
{
    assert_true(fabs(left_over(f, GLSSAO_HIGH, 0.0, 50.0, 6)) < 0.02);
}

/* At full size there is little noise, so that a small change counts sooner. */
TEST_GL(shadows_of_what_arrives_appear)
{
    assert_true(fabs(left_over(f, GLSSAO_ULTRA, 50.0, 0.0, 3)) < 0.02);
}

/* Draws and dispatches give the same history, within what an eye can see. */
TEST_GL(dispatches_do_as_draws)
{
    const glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM, 16);
    float *results[2] = {NULL, NULL};
    for (int k = 0; k < 2; ++k) {
        glssao_config config = fixture_config(f, W, H);
        config.path = k ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
        SCOPED(effect) glssao_effect *effect = NULL;
        const glssao_result made = glssao_create(&config, &effect);
        if (made == GLSSAO_UNSUPPORTED_CONTEXT) {
            fixture_clear_log(f);
            break;
        }
        results[k] = walk(effect, first_shot(PERSPECTIVE), &settings, 8);
    }
    if (results[1])
        assert_true(rms(results[0], results[1], N) < 5e-4);
    free(results[0]);
    free(results[1]);
}

/* A box that moves across the picture keeps its history by the motion texture alone: its front is then nearer to the
 * floor. */
TEST_GL(motion_texture_keeps_the_history_of_what_moves)
{
    const glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_LOW, 16);
    /* The whole picture moves, by 3 pixels a frame, though the view says that nothing does. */
    const double step = 3.0;
    double errors[2] = {0.0, 0.0};
    for (int with = 0; with < 2; ++with) {
        SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
        shot s = first_shot(ORTHOGRAPHIC);
        const analytic_view view = analytic_make_view(ORTHOGRAPHIC, (double)W / H, 0.5, 40.0, 1.0);
        const double pixel = 2.0 / (W * (double)view.projection[0]);
        static float motion[2 * N];
        for (int i = 0; i < N; ++i)
            motion[2 * i] = (float)(-step / W);
        SCOPED(texture) const GLuint texture = fixture_texture(GL_RG32F, GL_RG, GL_FLOAT, W, H, motion);
        SCOPED(memory) float *last = NULL;
        for (int i = 0; i < FRAMES; ++i) {
            s.x = step * pixel * i;
            SCOPED(frame) glssao_frame frame = take(&s);
            frame.view[12] = 0.0f;
            frame.motion_texture = with ? texture : 0;
            compute(effect, &frame, &settings);
            frame.motion_texture = 0;
            replace(&last, read_result(effect));
        }
        SCOPED(memory) float *floor_map = make_floor(f, &s, &settings);
        errors[with] = rms(last, floor_map, N);
    }
    assert_true(errors[1] < 0.85 * errors[0]);
}

/* Whatever the host hands over: the same frames give the same bits; a cut gives those of a first frame, and without it
 * the history counts. A viewport gives the bits of the whole texture, and logarithmic depth nearly the same. */
TEST_GL(every_situation_has_a_history)
{
    static const struct {
        glssao_technique technique;
        situation situation;
        analytic_projection projection;
        int margin;
        bool depth_alone, dispatched;
    } cases[] = {
        {GLSSAO_HORIZON, AS_IT_IS, PERSPECTIVE, 8, false, false},
        {GLSSAO_HORIZON, IN_A_VIEWPORT, PERSPECTIVE, 8, false, false},
        {GLSSAO_HORIZON, LOGARITHMIC, PERSPECTIVE, 8, false, false},
        {GLSSAO_HORIZON, AS_IT_IS, ORTHOGRAPHIC_REVERSED, 0, true, true},
        {GLSSAO_HORIZON, IN_A_VIEWPORT, ORTHOGRAPHIC_REVERSED, 0, true, true},
        {GLSSAO_CLASSIC, AS_IT_IS, PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE, 0, true, false},
        {GLSSAO_HEMISPHERE, IN_A_VIEWPORT, ORTHOGRAPHIC, 4, false, true},
        {GLSSAO_RAYS, WITH_RAYS, PERSPECTIVE, 4, true, false},
        {GLSSAO_HORIZON, WITH_RAYS, ORTHOGRAPHIC, 0, false, true},
        {GLSSAO_CLASSIC, WITH_RAYS, PERSPECTIVE_REVERSED_ZERO_TO_ONE, 0, false, false},
    };
    float *whole = NULL;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        shot s = first_shot(cases[k].projection);
        s.margin = cases[k].margin;
        s.depth_alone = cases[k].depth_alone;
        s.situation = cases[k].situation;
        const glssao_settings settings = make_settings(cases[k].technique, GLSSAO_MEDIUM, 8);
        const size_t size = (size_t)((W - 2 * s.margin) * (H - 2 * s.margin)) * sizeof(float);
        glssao_config config = fixture_config(f, W, H);
        config.path = cases[k].dispatched && !fixture_hides_newer() ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
        glssao_effect *effects[3];
        for (int i = 0; i < 3; ++i)
            assert_int_equal(glssao_create(&config, &effects[i]), GLSSAO_OK);
        float *once = walk(effects[0], s, &settings, 4), *again = walk(effects[1], s, &settings, 4);
        assert_memory_equal(once, again, size);
        s.x = 0.2;
        SCOPED(frame) glssao_frame frame = take(&s);
        compute(effects[0], &frame, &settings);
        compute(effects[2], &frame, &settings);
        frame.cut = true;
        compute(effects[1], &frame, &settings);
        float *reused = read_result(effects[0]), *cut = read_result(effects[1]), *fresh = read_result(effects[2]);
        assert_memory_equal(cut, fresh, size);
        assert_memory_not_equal(reused, fresh, size);
        if (k > 0 && cases[k].situation == IN_A_VIEWPORT && cases[k - 1].situation == AS_IT_IS &&
            cases[k].projection == cases[k - 1].projection)
            assert_memory_equal(once, whole, size);
        if (cases[k].situation == LOGARITHMIC)
            assert_true(rms(once, whole, (int)(size / sizeof *once)) < 5e-3);
        free(again);
        free(reused);
        free(cut);
        free(fresh);
        free(whole);
        whole = once;
        for (int i = 0; i < 3; ++i)
            glssao_destroy(effects[i]);
    }
    free(whole);
}

/* Rays that differ from frame to frame: at rest the mean comes nearer to what they say, 0.5 in the open and closed
 * alike, than one frame does, alone and as a correction. Where no ray says anything, what is known stays. */
TEST_GL(means_of_rays_converge)
{
    for (int alone = 0; alone < 2; ++alone)
        for (int half = 0; half < 2; ++half) {
            shot s = first_shot(PERSPECTIVE);
            s.situation = WITH_RAYS;
            glssao_settings settings = make_settings(alone ? GLSSAO_RAYS : GLSSAO_HORIZON, GLSSAO_MEDIUM, 16);
            settings.half_resolution = half;
            settings.power = 2.0f;
            SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
            double errors[2];
            SCOPED(memory) float *result = NULL;
            for (int i = 0; i < FRAMES; ++i) {
                s.noise = (uint32_t)i;
                replace(&result, shoot(effect, &s, &settings));
                double sum = 0.0;
                int count = 0;
                for (int y = 0; y < H / 3; ++y) /* the floor, without the sky */
                    for (int x = 0; x < W; ++x, ++count)
                        sum += pow((double)result[y * W + x] - 0.25, 2.0);
                errors[i > 0] = sqrt(sum / count);
            }
            print_message("%s, %s: error of one frame %.4f, of the mean %.4f\n", alone ? "alone" : "correction",
                          half ? "half size" : "full size", errors[0], errors[1]);
            assert_true(errors[1] < 0.7 * errors[0]);
        }
}

/* What rays of a pixel of the full size say: stripes of 3 pixels. */
static float stripe(int x)
{
    return x % 6 < 3 ? 0.25f : 0.75f;
}

/* The error at rest, on the floor, after frames whose half-size rays belong to another pixel each, or to the same. */
static double error_of_stripes(fixture *f, const glssao_settings *settings, glssao_path path, bool turns)
{
    static const int offsets[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    const shot s = first_shot(PERSPECTIVE);
    glssao_config config = fixture_config(f, W, H);
    config.path = path;
    SCOPED(effect) glssao_effect *effect = NULL;
    if (glssao_create(&config, &effect) == GLSSAO_UNSUPPORTED_CONTEXT)
        return fixture_clear_log(f), turns ? 0.0 : 1.0;
    SCOPED(frame) glssao_frame frame = take(&s);
    for (int i = 0; i < FRAMES; ++i) {
        static float values[N / 4];
        memcpy(frame.rays_offset, offsets[turns ? i % 4 : 0], sizeof frame.rays_offset);
        for (int k = 0; k < N / 4; ++k)
            values[k] = stripe(2 * (k % (W / 2)) + frame.rays_offset[0]);
        gl.DeleteTextures(1, &frame.rays_texture);
        frame.rays_texture = fixture_texture(GL_R32F, GL_RED, GL_FLOAT, W / 2, H / 2, values);
        compute(effect, &frame, settings);
    }
    SCOPED(memory) float *result = read_result(effect);
    double sum = 0.0;
    for (int i = 0; i < N / 3; ++i)
        sum += pow((double)result[i] - (double)stripe(i % W), 2.0);
    return sqrt(sum / (N / 3));
}

/* Rays of half size that take all four pixels by turns find detail of the full size. */
TEST_GL(rays_of_other_pixels_find_detail)
{
    for (int k = 0; k < 3; ++k) {
        const glssao_quality quality = k == 1 ? GLSSAO_ULTRA : GLSSAO_MEDIUM;
        const glssao_settings settings = make_settings(k == 0 ? GLSSAO_RAYS : GLSSAO_HORIZON, quality, 16);
        const glssao_path path = k == 2 ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
        const double same = error_of_stripes(f, &settings, path, false);
        const double other = error_of_stripes(f, &settings, path, true);
        assert_true(other < 0.92 * same);
    }
}

TEST_GL(every_technique_size_and_margin_runs)
{
    for (int t = GLSSAO_CLASSIC; t <= GLSSAO_HORIZON; ++t)
        for (int k = 0; k < 8; ++k) {
            shot s = first_shot(k % 2 ? ORTHOGRAPHIC : PERSPECTIVE);
            s.width = k & 2 ? 61 : W;
            s.height = k & 2 ? 1 + 6 * 7 : H;
            s.margin = k & 4 ? 8 : 0;
            glssao_settings settings = make_settings((glssao_technique)t, GLSSAO_MEDIUM, 8);
            settings.half_resolution = true;
            SCOPED(effect) glssao_effect *effect = fixture_effect(f, s.width, s.height);
            for (int i = 0; i < 6; ++i) {
                s.x = 0.1 * i;
                free(shoot(effect, &s, &settings));
                SCOPED(frame) const glssao_frame frame = take(&s);
                const glssao_plan plan = glssao_plan_frame(effect, &frame, &settings);
                assert_true(plan.passes[GLSSAO_PASS_HISTORY].run && plan.passes[GLSSAO_PASS_UPSAMPLE].run);
            }
            int width, height;
            (void)glssao_map(effect, GLSSAO_MAP_AMBIENT, &width, &height);
            assert_int_equal(width, s.width - 2 * s.margin);
            assert_int_equal(height, s.height - 2 * s.margin);
        }
}

/* Each refusal names the field. */
TEST_GL(bad_views_are_refused_by_name)
{
    const glssao_settings settings = make_settings(GLSSAO_HORIZON, GLSSAO_LOW, 16);
    const shot s = first_shot(PERSPECTIVE);
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    SCOPED(frame) glssao_frame frame = take(&s);
    frame.view[5] = NAN;
    fixture_refused(f, glssao_compute(effect, &frame, &settings), "frame.view[5]");
    memset(frame.view, 0, sizeof frame.view);
    fixture_refused(f, glssao_compute(effect, &frame, &settings), "settings.history");
    glssao_settings plain = settings;
    plain.history = 0;
    frame.motion_texture = 12345; /* not read */
    compute(effect, &frame, &plain);
    frame.view[0] = frame.view[5] = frame.view[10] = frame.view[15] = 1.0f;
    fixture_refused(f, glssao_compute(effect, &frame, &settings), "frame.motion_texture");
    frame.motion_texture = 0;
    glssao_settings bent = settings;
    bent.bent_normals = true;
    fixture_refused(f, glssao_compute(effect, &frame, &bent), "bent normals are not reused over time");
    frame.rays_offset[1] = 2;
    fixture_refused(f, glssao_compute(effect, &frame, &settings), "frame.rays_offset[1] = 2");
    frame.rays_offset[1] = 1;
    fixture_refused(f, glssao_compute(effect, &frame, &plain), "frame.rays_offset[1] = 1");
    frame.rays_offset[1] = 0;
    plain.history = 64;
    fixture_refused(f, glssao_compute(effect, &frame, &plain), "settings.history = 64");
    frame.motion_texture = 0;
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
