/* SPDX-License-Identifier: MIT
 *
 * Occluders outside the single layer of the picture: the margin around it, and the second layer behind it.
 */
#include "analytic.h"
#include "fixture.h"

enum {
    W = 96,
    H = 64,
    MARGIN = 30 /* not a multiple of the noise tiles' size */,
    WIDE = W + 2 * MARGIN,
    HIGH = H + 2 * MARGIN
};

/* The room, with `margin` more pixels on each side, under a projection that shows the middle unchanged. */
static glssao_frame make_frame(int margin, float **out_depth)
{
    const int width = W + 2 * margin, height = H + 2 * margin;
    analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    view.projection[0] *= (float)W / (float)width;
    view.projection[5] *= (float)H / (float)height;
    float *depth, *normals;
    analytic_render(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, width, height, &depth, &normals);
    glssao_frame frame = fixture_maps_frame(&view, width, height, GL_DEPTH_COMPONENT32F, depth, normals);
    frame.margin = margin;
    free(normals);
    if (out_depth)
        *out_depth = depth;
    else
        free(depth);
    return frame;
}

static const glssao_technique techniques[] = {GLSSAO_CLASSIC, GLSSAO_HEMISPHERE, GLSSAO_HORIZON};

/* With a margin, the result is the middle of the whole picture's result: drawing less changes no pixel. */
TEST_GL(margin_is_cut_off)
{
    for (int i = 0; i < 3; ++i)
        for (int variant = 0; variant < 4; ++variant) {
            glssao_settings settings = glssao_default_settings(techniques[i], GLSSAO_HIGH);
            settings.half_resolution = variant % 2 == 0;
            settings.upsample = variant < 2;
            if (variant == 3) {
                settings.blur = GLSSAO_BLUR_NONE;
                settings.blur_rounds = 0;
            }
            SCOPED(effect)
            glssao_effect *whole = fixture_effect(f, WIDE, HIGH), *cut = fixture_effect(f, WIDE, HIGH);
            SCOPED(frame) glssao_frame frame = make_frame(MARGIN, NULL);
            int w, h, wide, high;
            SCOPED(memory) float *got = fixture_compute(cut, &frame, &settings, &w, &h);
            frame.margin = 0;
            SCOPED(memory) float *wanted = fixture_compute(whole, &frame, &settings, &wide, &high);
            const int m = (wide - w) / 2;
            assert_true(wide == (variant == 2 ? WIDE / 2 : WIDE) && high == (variant == 2 ? HIGH / 2 : HIGH));
            assert_true(w == (variant == 2 ? W / 2 : W) && h == (variant == 2 ? H / 2 : H));
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x)
                    assert_float_equal(got[y * w + x], wanted[(y + m) * wide + x + m], 2e-5f);
            assert_true(glssao_plan_frame(cut, &frame, &settings).passes[GLSSAO_PASS_ESTIMATE].width ==
                        (variant % 2 == 0 ? WIDE / 2 : WIDE));
            frame.margin = MARGIN;
            if (techniques[i] == GLSSAO_HORIZON) /* three rounds of classic's blur reach as far as the margin */
                assert_true(glssao_plan_frame(cut, &frame, &settings).passes[GLSSAO_PASS_ESTIMATE].width <
                            (variant % 2 == 0 ? WIDE / 2 : WIDE));
        }
}

/* A floor whose wall stands just outside the picture: only the margin shows the occluder. */
TEST_GL(margin_finds_occluders_beyond_the_edge)
{
    double darkened[2];
    for (int i = 0; i < 2; ++i) {
        const int margin = i == 0 ? 0 : MARGIN, width = W + 2 * margin, height = H + 2 * margin;
        analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
        const double edge = 4.0 / (double)view.projection[0]; /* half the picture's width at distance 4 */
        view.projection[0] *= (float)W / (float)width;
        view.projection[5] *= (float)H / (float)height;
        analytic_shape shapes[2] = {{ANALYTIC_PLANE, {0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}},
                                    {ANALYTIC_PLANE, {edge + 0.05, 0.0, 0.0}, {-1.0, 0.0, 0.0}}};
        SCOPED(frame) glssao_frame frame = fixture_frame(&view, shapes, 2, width, height);
        frame.margin = margin;
        SCOPED(effect) glssao_effect *effect = fixture_effect(f, width, height);
        const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_ULTRA);
        int w, h;
        SCOPED(memory) float *got = fixture_compute(effect, &frame, &settings, &w, &h);
        darkened[i] = 0.0;
        for (int y = 0; y < H; ++y)
            darkened[i] += (1.0 - (double)got[y * W + W - 1]) / H;
    }
    print_message("right column darkened by %.3f without, %.3f with a margin\n", darkened[0], darkened[1]);
    assert_true(darkened[0] < 0.02);
    assert_true(darkened[1] > 0.25); /* exact: 0.40; the radius is eight pixels here. Measured: 0.295 */
}

/* Occlusion of the plane behind a plate of varying thickness, which only a second layer can tell. */
static double behind_a_plate(fixture *f, double thickness, bool layers, double sheet_behind)
{
    analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.5, 40.0, 1.0);
    const analytic_shape shapes[2] = {{ANALYTIC_PLANE, {0.0, 0.0, -5.0}, {0.0, 0.0, 1.0}},
                                      {ANALYTIC_BOX, {0.0, 0.0, -4.6 - thickness / 2}, {0.4, 4.0, thickness / 2}}};
    const analytic_shape behind[2] = {{ANALYTIC_PLANE, {0.0, 0.0, -4.6 - thickness}, {0.0, 0.0, 1.0}},
                                      {ANALYTIC_PLANE, {0.0, 0.0, -4.6 - thickness - sheet_behind}, {0.0, 0.0, 1.0}}};
    float *depth, *normals, *back, *second, *spare;
    analytic_render(&view, shapes, 2, W, H, &depth, &normals);
    analytic_render(&view, &behind[0], 1, W, H, &back, &spare);
    free(spare);
    analytic_render(&view, &behind[1], 1, W, H, &second, &spare);
    free(spare);
    for (int i = 0; i < W * H; ++i)
        if (normals[3 * i + 2] < 0.99f || depth[i] >= back[i])
            back[i] = second[i] = 1.0f; /* the plane behind has neither layer */
    SCOPED(frame) glssao_frame frame = fixture_maps_frame(&view, W, H, GL_DEPTH_COMPONENT32F, depth, normals);
    if (layers) {
        frame.back_texture = fixture_depth_texture(GL_DEPTH_COMPONENT32F, W, H, back);
        frame.second_texture = fixture_depth_texture(GL_DEPTH_COMPONENT32F, W, H, second);
    }
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_ULTRA);
    int w, h;
    SCOPED(memory) float *got = fixture_compute(effect, &frame, &settings, &w, &h);
    double sum = 0.0;
    int count = 0;
    for (int x = 0; x < W; ++x) {
        const int i = H / 2 * W + x;
        const bool is_plate = depth[i] < depth[H / 2 * W];
        const bool is_near = (x > 3 && depth[i - 4] < depth[i]) || (x + 4 < W && depth[i + 4] < depth[i]);
        if (!is_plate && is_near) {
            sum += 1.0 - (double)got[i];
            ++count;
        }
    }
    assert_true(count >= 4);
    free(depth);
    free(normals);
    free(back);
    free(second);
    return sum / count;
}

TEST_GL(thickness_is_read)
{
    const double far_off = 20.0;
    const double thin = behind_a_plate(f, 0.05, true, far_off), thick = behind_a_plate(f, 0.4, true, far_off);
    const double guess_thin = behind_a_plate(f, 0.05, false, far_off),
                 guess_thick = behind_a_plate(f, 0.4, false, far_off);
    const double seconded = behind_a_plate(f, 0.05, true, 0.2);
    print_message("occlusion beside a plate: thin %.3f, thick %.3f; guessed %.3f, %.3f; second surface %.3f\n", thin,
                  thick, guess_thin, guess_thick, seconded);
    assert_true(fabs(guess_thin - guess_thick) < 0.02); /* seen from the front, both look the same */
    assert_true(thick > thin + 0.05);
    assert_true(seconded > thin + 0.02); /* surfaces behind the plate occlude too */
}

TEST_GL(refuses_what_it_cannot_use)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    static const int margins[] = {-2, 3, H / 2, 1 << 30};
    for (int i = 0; i < 4; ++i) {
        SCOPED(frame) glssao_frame frame = make_frame(0, NULL);
        frame.margin = margins[i];
        fixture_refused(f, glssao_compute(effect, &frame, &settings), "frame.margin");
    }
    SCOPED(frame) glssao_frame frame = make_frame(0, NULL);
    frame.back_texture = frame.depth_texture;
    fixture_refused(f, glssao_compute(effect, &frame, &settings), "frame.second_texture");
    frame.second_texture = 9999;
    fixture_refused(f, glssao_compute(effect, &frame, &settings), "frame.second_texture");
    frame.back_texture = frame.second_texture = 0;
}

/* The last frame's margin does not apply to the new size; glssao_apply would draw a negative area. */
TEST_GL(resize_forgets_the_margin)
{
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, WIDE, HIGH);
    SCOPED(frame) glssao_frame frame = make_frame(MARGIN, NULL);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    assert_int_equal(glssao_compute(effect, &frame, &settings), GLSSAO_OK);
    assert_int_equal(glssao_resize(effect, 16, 16), GLSSAO_OK);
    SCOPED(target) const fixture_target target = fixture_make_target(GL_RGBA8, 16, 16);
    assert_int_equal(glssao_apply(effect, target.framebuffer), GLSSAO_OK); /* the teardown checks for OpenGL errors */
}

/* The mean of a frame with a margin. Where nothing lies outside the picture, it converges to the mean without one. */
TEST_GL(accumulation_keeps_the_margin)
{
    SCOPED(effect)
    glssao_effect *effect = fixture_effect(f, WIDE, HIGH), *wide_effect = fixture_effect(f, WIDE, HIGH);
    glssao_frame frame = make_frame(MARGIN, NULL), wide_frame = frame;
    wide_frame.margin = 0;
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    for (int i = 0; i < 5; ++i) {
        assert_int_equal(glssao_accumulate(effect, &frame, &settings), GLSSAO_OK);
        assert_int_equal(glssao_accumulate(wide_effect, &wide_frame, &settings), GLSSAO_OK);
    }
    int w, h, wide, high;
    const uint32_t map = glssao_map(effect, GLSSAO_MAP_AMBIENT, &w, &h),
                   wide_map = glssao_map(wide_effect, GLSSAO_MAP_AMBIENT, &wide, &high);
    assert_true(w == W && h == H && wide == WIDE && high == HIGH);
    SCOPED(memory)
    float *got = fixture_read_texture(map, w, h, 1), *wanted = fixture_read_texture(wide_map, wide, high, 1);
    for (int y = 0; y < H; ++y)
        for (int x = 0; x < W; ++x)
            assert_float_equal(got[y * W + x], wanted[(y + MARGIN) * WIDE + x + MARGIN], 2e-5f);
    gl.Finish();
    assert_true(glssao_get_stats(effect).sampling_error > 0.0);
    fixture_delete_frame(&frame);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
