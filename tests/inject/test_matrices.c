/* SPDX-License-Identifier: MIT
 *
 * glssao-inject's search for a projection among the matrices that a program sets.
 */
#include "inject.h"
#include "testing.h"

typedef float matrix[16];

static double now = 100.0; /* the clock of these tests */

double inject_seconds(void)
{
    return now;
}

static char contexts[3]; /* stand for three contexts */

/* A framebuffer of the first context. */
static inject_place at(unsigned framebuffer)
{
    return (inject_place){&contexts[0], framebuffer};
}

static void multiply(const matrix a, const matrix b, matrix out)
{
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            double sum = 0.0;
            for (int k = 0; k < 4; ++k)
                sum += (double)a[4 * k + r] * (double)b[4 * c + k];
            out[4 * c + r] = (float)sum;
        }
}

static void frustum(float shift_x, float near_plane, float far_plane, matrix out)
{
    memset(out, 0, sizeof(matrix));
    out[0] = 1.3f;
    out[5] = 1.9f;
    out[8] = shift_x;
    out[10] = isinf(far_plane) ? -1.0f : (far_plane + near_plane) / (near_plane - far_plane);
    out[11] = -1.0f;
    out[14] = isinf(far_plane) ? -2.0f * near_plane : 2.0f * far_plane * near_plane / (near_plane - far_plane);
}

/* Turned about y and x, scaled along the axes, moved. */
static void model_view(float sx, float sy, float sz, matrix out)
{
    const float cy = cosf(0.7f), dy = sinf(0.7f), cx = cosf(0.4f), dx = sinf(0.4f);
    const matrix turn_y = {cy, 0, -dy, 0, 0, 1, 0, 0, dy, 0, cy, 0, 0, 0, 0, 1};
    const matrix turn_x = {1, 0, 0, 0, 0, cx, dx, 0, 0, -dx, cx, 0, 3, -2, -9, 1};
    const matrix scale = {sx, 0, 0, 0, 0, sy, 0, 0, 0, 0, sz, 0, 0, 0, 0, 1};
    matrix turned;
    multiply(turn_x, turn_y, turned);
    multiply(turned, scale, out);
}

static void assert_alike(const matrix a, const matrix b)
{
    for (int i = 0; i < 16; ++i)
        assert_float_equal(a[i], b[i], 2e-4f * (1.0f + fabsf(a[i])));
}

TEST(a_projection_is_its_own)
{
    matrix p, found;
    frustum(0.0f, 0.1f, 100.0f, p);
    assert_true(inject_perspective_of(p, false, found));
    assert_alike(p, found);
    frustum(0.3f, 0.5f, INFINITY, p);
    assert_true(inject_perspective_of(p, false, found));
    assert_alike(p, found);
}

TEST(a_projection_is_found_in_a_product)
{
    static const float scales[] = {1.0f, 0.02f, 40.0f};
    for (int i = 0; i < 3; ++i) {
        matrix p, v, product, found;
        frustum(0.2f, 0.1f, 60.0f, p);
        model_view(scales[i], scales[i], scales[i], v);
        multiply(p, v, product);
        assert_true(inject_perspective_of(product, false, found));
        assert_alike(p, found);
    }
}

TEST(other_matrices_are_refused)
{
    const matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const matrix orthographic = {0.1f, 0, 0, 0, 0, 0.1f, 0, 0, 0, 0, -0.02f, 0, 0, 0, -1.0f, 1};
    matrix p, v, product, found;
    assert_false(inject_perspective_of(identity, false, found));
    assert_false(inject_perspective_of(orthographic, false, found));
    model_view(1.0f, 1.0f, 1.0f, v);
    assert_false(inject_perspective_of(v, false, found));
    frustum(0.0f, 0.1f, 60.0f, p);
    model_view(1.0f, 3.0f, 0.5f, v); /* would give a wrong field of view */
    multiply(p, v, product);
    assert_false(inject_perspective_of(product, false, found));
    frustum(0.0f, 60.0f, 0.1f, p);
    p[5] = NAN;
    assert_false(inject_perspective_of(p, false, found));
}

TEST(reversed_depth_is_told)
{
    matrix p, v, product, found;
    frustum(0.1f, 60.0f, 0.1f, p); /* near and far exchanged */
    model_view(2.0f, 2.0f, 2.0f, v);
    multiply(p, v, product);
    assert_true(inject_perspective_of(product, false, found));
    assert_alike(p, found);
    p[10] = 0.0f; /* infinite, depth from 0 to 1: near over distance */
    p[14] = 0.1f;
    multiply(p, v, product);
    assert_true(inject_perspective_of(product, true, found));
    assert_alike(p, found);
    assert_false(inject_perspective_of(product, false, found)); /* near would lie behind the eye */
}

static void orthographic(float half_width, float half_height, float depth, bool zero_to_one, bool reversed, matrix out)
{
    memset(out, 0, sizeof(matrix));
    out[0] = 1.0f / half_width;
    out[5] = 1.0f / half_height;
    out[10] = (zero_to_one ? -1.0f : -2.0f) / depth * (reversed ? -1.0f : 1.0f);
    out[14] = reversed ? 1.0f : zero_to_one ? 0.0f : -1.0f;
    out[15] = 1.0f;
}

TEST(orthographic_projections_are_told)
{
    for (int i = 0; i < 4; ++i) {
        const bool zero_to_one = i & 1, reversed = i == 3;
        matrix p, v, product, found;
        orthographic(4.0f, 3.0f, 20.0f, zero_to_one, reversed, p);
        model_view(1.0f, 1.0f, 1.0f, v);
        multiply(p, v, product);
        assert_true(inject_orthographic_of(product, zero_to_one, found));
        p[14] = product[14]; /* v moves the eye along the axis; across it the picture is centred */
        assert_alike(p, found);
        assert_false(inject_perspective_of(product, zero_to_one, found));
    }
}

TEST(interfaces_and_models_are_no_orthographic_scene)
{
    const matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    matrix flat, v, found;
    assert_false(inject_orthographic_of(identity, false, found));
    assert_false(inject_orthographic_of(identity, true, found));
    model_view(2.0f, 2.0f, 2.0f, v);
    assert_false(inject_orthographic_of(v, false, found));
    assert_false(inject_orthographic_of(v, true, found));
    orthographic(320.0f, 240.0f, 2.0f, false, false, flat); /* glOrtho(0, 640, 0, 480, -1, 1) */
    assert_false(inject_orthographic_of(flat, false, found));
    orthographic(4.0f, -3.0f, 20.0f, false, false, flat); /* y downwards */
    assert_false(inject_orthographic_of(flat, false, found));
    frustum(0.0f, 0.1f, 60.0f, v);
    assert_false(inject_orthographic_of(v, false, found));
}

TEST(matrices_in_a_uniform_buffer_are_found)
{
    struct {
        float color[4], light[4];
        matrix view, row_major;
        float rest[8];
    } block = {.color = {1, 0.5f, 0.25f, 1}, .light = {0.3f, 0.8f, 0.5f, 0}};
    matrix p, v, product;
    inject_projection found;
    frustum(0.0f, 0.7f, 90.0f, p);
    model_view(1.0f, 1.0f, 1.0f, v);
    multiply(p, v, product);
    memcpy(block.view, v, sizeof v);
    for (int i = 0; i < 16; ++i)
        block.row_major[i] = product[4 * (i % 4) + i / 4];
    inject_end_frame();
    inject_note_buffer(&block, sizeof block);
    assert_true(inject_get_projection(at(0), &found));
    assert_alike(p, found.matrix);
    assert_true(inject_get_projection(at(7), &found)); /* whichever framebuffer is drawn with it */
    inject_end_frame();
}

TEST(perspective_goes_before_orthographic)
{
    matrix p, box;
    inject_projection found;
    frustum(0.0f, 0.5f, 60.0f, p);
    orthographic(4.0f, 3.0f, 20.0f, false, false, box);
    inject_end_frame();
    for (int i = 0; i < 3; ++i)
        inject_note_matrix(box, at(0));
    inject_note_matrix(p, at(0));
    assert_true(inject_get_projection(at(0), &found));
    assert_alike(p, found.matrix);
    for (int frame = 0; frame < 70; ++frame) { /* the scene's matrices stay, the interface's are set */
        inject_end_frame();
        inject_note_matrix(box, at(0));
        assert_true(inject_get_projection(at(0), &found));
        assert_alike(frame < 60 ? p : box, found.matrix);
    }
    inject_end_frame();
}

TEST(the_projection_of_most_matrices_is_taken_and_kept)
{
    matrix rare, usual;
    inject_projection found;
    inject_forget_projections(&contexts[0]);
    assert_false(inject_get_projection(at(0), &found));
    frustum(0.0f, 0.1f, 10.0f, rare);
    frustum(0.0f, 0.5f, 60.0f, usual);
    inject_note_matrix(rare, at(0));
    for (int i = 0; i < 3; ++i) {
        matrix v, product;
        model_view(1.0f + (float)i, 1.0f + (float)i, 1.0f + (float)i, v);
        multiply(usual, v, product);
        inject_note_matrix(product, at(0));
    }
    assert_true(inject_get_projection(at(0), &found));
    assert_alike(usual, found.matrix);
    inject_end_frame();
    memset(&found, 0, sizeof found);
    assert_true(inject_get_projection(at(0), &found)); /* a frame that sets none */
    assert_alike(usual, found.matrix);
}

TEST(each_framebuffer_has_its_own)
{
    matrix in_7, in_window;
    inject_projection found;
    frustum(0.0f, 0.1f, 10.0f, in_7);
    frustum(0.0f, 0.5f, 60.0f, in_window);
    inject_end_frame();
    inject_note_matrix(in_7, at(7));
    inject_note_matrix(in_7, at(7));
    assert_false(inject_get_projection(at(0), &found)); /* the window's of old would be a guess here */
    inject_note_matrix(in_window, at(0));
    assert_true(inject_get_projection(at(0), &found));
    assert_alike(in_window, found.matrix);
    assert_true(inject_get_projection(at(7), &found));
    assert_alike(in_7, found.matrix);
    inject_end_frame();
    assert_false(inject_get_projection(at(7), &found)); /* nothing of old, where nothing was drawn anew */
}

/* A program that draws on demand draws few frames, but seconds pass. */
TEST(orthographic_takes_over_after_a_second)
{
    matrix p, box;
    inject_projection found;
    frustum(0.0f, 0.5f, 60.0f, p);
    orthographic(4.0f, 3.0f, 20.0f, false, false, box);
    inject_end_frame();
    inject_note_matrix(p, at(0));
    assert_true(inject_get_projection(at(0), &found));
    inject_end_frame();
    inject_note_matrix(box, at(0));
    now += 0.5;
    assert_true(inject_get_projection(at(0), &found));
    assert_alike(p, found.matrix);
    now += 0.6;
    assert_true(inject_get_projection(at(0), &found));
    assert_alike(box, found.matrix);
    inject_end_frame();
}

/* An icon in a corner sets more matrices than the scene. */
TEST(the_projection_of_most_depth_goes_before_that_of_most_matrices)
{
    matrix icon, scene;
    inject_projection found;
    frustum(0.0f, 0.1f, 10.0f, icon);
    frustum(0.0f, 0.5f, 60.0f, scene);
    inject_end_frame();
    inject_note_matrix(scene, at(0));
    inject_note_draw(at(0), 1.0f);
    for (int i = 0; i < 5; ++i) {
        inject_note_matrix(icon, at(0));
        inject_note_draw(at(0), 0.02f);
    }
    assert_true(inject_get_projection(at(0), &found));
    assert_alike(scene, found.matrix);
    inject_end_frame();
}

/* A window's projection is its context's, and goes with it. */
TEST(contexts_do_not_mix)
{
    matrix first, second;
    inject_projection found;
    const inject_place other = {&contexts[1], 0}, third = {&contexts[2], 0};
    frustum(0.0f, 0.1f, 10.0f, first);
    frustum(0.0f, 0.5f, 60.0f, second);
    inject_end_frame();
    inject_note_matrix(first, at(0));
    inject_note_matrix(second, other);
    assert_true(inject_get_projection(at(0), &found));
    assert_alike(first, found.matrix);
    assert_true(inject_get_projection(other, &found));
    assert_alike(second, found.matrix);
    assert_false(inject_get_projection(third, &found));
    inject_end_frame();
    assert_true(inject_get_projection(other, &found));
    inject_forget_projections(&contexts[1]);
    assert_false(inject_get_projection(other, &found)); /* another context may have that address now */
    assert_true(inject_get_projection(at(0), &found));
}

TEST_MAIN(NULL, NULL, NULL)
