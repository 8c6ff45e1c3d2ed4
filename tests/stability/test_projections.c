/* SPDX-License-Identifier: MIT
 *
 * Pictures that must not depend on how their projection is written: turned about the view axis, with the eye elsewhere
 * along it, with rounding residues, or with a near plane that is oblique; nor on the space that normals are stored in.
 * By draws and by dispatches.
 */
#include "techniques.h"

enum { W = 72, H = 56, NUMBERS = 6, PATHS = 2 };
static const int numbers[NUMBERS] = {0, 5, 12, 17, 18, 23}; /* configurations */
static const double PI = 3.14159265358979323846;

static glssao_effect *effects[PATHS]; /* by draws, by dispatches */

static int setup(void **state)
{
    const int failed = fixture_setup(state);
    for (int i = 0; i < PATHS && !failed; ++i) {
        glssao_config config = fixture_config(*state, W, H);
        config.path = i ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
        if (i == 1 && fixture_hides_newer())
            continue;
        if (glssao_create(&config, &effects[i]) != GLSSAO_OK)
            return 1;
    }
    return failed;
}

static int teardown(void **state)
{
    for (int i = 0; i < PATHS; ++i)
        glssao_destroy(effects[i]);
    return fixture_teardown(state);
}

static subject room(analytic_projection kind)
{
    const analytic_view view = analytic_make_view(kind, (double)W / H, 0.5, 40.0, 1.0);
    return subject_of(&view, analytic_unit_room, ANALYTIC_ROOM_SHAPES, W, H);
}

static void assert_same(fixture *f, const glssao_frame *plain, const glssao_frame *other, double most, const char *what)
{
    for (int i = 0; i < NUMBERS * PATHS; ++i) {
        glssao_effect *effect = effects[i % PATHS];
        if (!effect)
            continue;
        configuration c = configuration_of(numbers[i / PATHS]);
        c.settings = settings_scaled(&c.settings, 2.0);                    /* more occlusion */
        c.settings.tiles = i % PATHS ? GLSSAO_TILES_OFF : GLSSAO_TILES_ON; /* the bounds of tiles read distances too */
        SCOPED(picture)
        picture a = subject_shade_by(f, effect, plain, &c.settings),
                b = subject_shade_by(f, effect, other, &c.settings);
        assert_true(a.width == b.width && a.height == b.height && picture_mean(&a) < 0.999);
        double apart = 0.0;
        for (int k = 0; k < a.width * a.height; ++k)
            apart += fabs((double)a.values[k] - (double)b.values[k]) / (a.width * a.height);
        if (apart > most)
            fail_msg("%s, %s, %s: %g apart", what, c.name, i % PATHS ? "dispatched" : "drawn", apart);
    }
}

/* ---- turned about the view axis ---- */

/* The same picture from a camera that is turned by an angle: view space turns the other way, and so do normals. */
static void turn_frame(const subject *s, double degrees, normal_store normal, glssao_frame *out)
{
    const double c = cos(degrees * PI / 180.0), n = sin(degrees * PI / 180.0);
    subject turned = *s;
    turned.normals = malloc((size_t)W * H * 3 * sizeof(float));
    for (int i = 0; i < W * H; ++i) {
        const float *from = s->normals + 3 * i;
        turned.normals[3 * i] = (float)(c * (double)from[0] - n * (double)from[1]);
        turned.normals[3 * i + 1] = (float)(n * (double)from[0] + c * (double)from[1]);
        turned.normals[3 * i + 2] = from[2];
    }
    *out = subject_frame(&turned, DEPTH_32F, normal);
    const float *p = s->view.projection;
    for (int row = 0; row < 4; ++row) {
        out->projection[row] = (float)((double)p[row] * c - (double)p[4 + row] * n);
        out->projection[4 + row] = (float)((double)p[row] * n + (double)p[4 + row] * c);
    }
    free(turned.normals);
}

TEST_GL(turned_cameras_see_the_same)
{
    static const double degrees[] = {30.0, 90.0, 150.0, -135.0};
    static const analytic_projection kinds[] = {PERSPECTIVE_OFF_CENTRE, ORTHOGRAPHIC};
    for (int i = 0; i < 4; ++i)
        for (int normals = 0; normals < 2; ++normals) {
            SCOPED(subject) subject s = room(kinds[i % 2]);
            SCOPED(frame)
            glssao_frame plain = subject_frame(&s, DEPTH_32F, normals ? NORMAL_32F : NORMAL_NONE), turned = {0};
            turn_frame(&s, degrees[i], normals ? NORMAL_32F : NORMAL_NONE, &turned);
            char what[32];
            snprintf(what, sizeof what, "%g degrees", degrees[i]);
            assert_same(f, &plain, &turned, 5e-4, what);
        }
}

/* The map of rebuilt normals is the host's to look at, so it is in the host's view space. */
TEST_GL(rebuilt_normals_are_in_view_space)
{
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    SCOPED(subject) subject s = room(PERSPECTIVE);
    glssao_frame frames[2] = {subject_frame(&s, DEPTH_32F, NORMAL_NONE)};
    turn_frame(&s, 30.0, NORMAL_NONE, &frames[1]);
    float *maps[2];
    for (int i = 0; i < 2; ++i) {
        free(subject_shade_by(f, effects[0], &frames[i], &settings).values);
        maps[i] = fixture_read_rebuilt(effects[0], W, H, 2);
    }
    const double c = cos(PI / 6.0), n = sin(PI / 6.0);
    int off = 0, on_surfaces = 0;
    for (int i = 0; i < W * H; ++i) {
        const float *a = maps[0] + 3 * i, *b = maps[1] + 3 * i;
        on_surfaces += fabsf(a[0]) + fabsf(a[1]) > 0.1f;
        off += fabs(c * (double)a[0] - n * (double)a[1] - (double)b[0]) +
                   fabs(n * (double)a[0] + c * (double)a[1] - (double)b[1]) + fabs((double)a[2] - (double)b[2]) >
               5e-3;
    }
    assert_true(on_surfaces > W * H / 4);
    assert_true(off < W * H / 100); /* where two sides predict equally well, rounding decides */
    for (int i = 0; i < 2; ++i) {
        free(maps[i]);
        fixture_delete_frame(&frames[i]);
    }
}

/* ---- normals in world space ---- */

/* view_from_world: a turn about an axis across all three, a shift, and a scale of each axis. */
static void make_view(const double scale[3], float out[16])
{
    const double c = cos(0.7), s = sin(0.7), k = 1.0 / sqrt(14.0), axis[3] = {k, 2.0 * k, -3.0 * k};
    for (int row = 0; row < 3; ++row)
        for (int col = 0; col < 3; ++col) {
            const int third = 3 - row - col;
            double turn = axis[row] * axis[col] * (1.0 - c) + (row == col ? c : 0.0);
            if (row != col)
                turn += ((col + 1) % 3 == row ? 1.0 : -1.0) * s * axis[third];
            out[4 * col + row] = (float)(turn * scale[col]);
        }
    const float last[4] = {5.0f, -7.0f, 9.0f, 1.0f};
    for (int row = 0; row < 4; ++row) {
        out[12 + row] = last[row];
        out[4 * row + 3] = row == 3 ? 1.0f : 0.0f;
    }
}

/* A normal of view space in world space: the transposed of what turns points to view space (of a row that is the
 * gradient of a plane), brought to unit length. */
static void to_world(const float view[16], const float n[3], float out[3])
{
    double w[3], length = 0.0;
    for (int col = 0; col < 3; ++col) {
        w[col] = 0.0;
        for (int row = 0; row < 3; ++row)
            w[col] += (double)view[4 * col + row] * (double)n[row];
        length += w[col] * w[col];
    }
    for (int i = 0; i < 3; ++i)
        out[i] = (float)(w[i] / sqrt(length));
}

TEST_GL(normals_in_world_space_are_turned)
{
    static const double scales[][3] = {{1.0, 1.0, 1.0}, {0.01, 0.01, 0.01}, {-1.0, 1.0, 1.0}, {2.0, 0.5, 1.0}};
    static const normal_store stores[] = {NORMAL_32F, NORMAL_16F, NORMAL_OCTAHEDRAL, NORMAL_UNSIGNED_8};
    for (int i = 0; i < 4; ++i) {
        const normal_store store = stores[i];
        subject s = room(i % 2 ? ORTHOGRAPHIC : PERSPECTIVE), world = s;
        float view[16];
        make_view(scales[i], view);
        world.normals = malloc((size_t)W * H * 3 * sizeof(float));
        for (int k = 0; k < W * H; ++k)
            to_world(view, s.normals + 3 * k, world.normals + 3 * k);
        SCOPED(frame)
        glssao_frame plain = subject_frame(&s, DEPTH_32F, NORMAL_32F), other = subject_frame(&world, DEPTH_32F, store);
        memcpy(other.view, view, sizeof view);
        other.world_normals = true;
        /* Half floats and 8 bits are off by up to half a degree; at thresholds that shows. */
        assert_same(f, &plain, &other, store == NORMAL_32F || store == NORMAL_OCTAHEDRAL ? 1e-3 : 6e-3, "world space");
        glssao_frame turned = other; /* and by a camera that rolls: view space turns, world space does not */
        const double c = cos(1.0), n = sin(1.0);
        for (int k = 0; k < 4; ++k) {
            turned.projection[k] = (float)((double)other.projection[k] * c - (double)other.projection[4 + k] * n);
            turned.projection[4 + k] = (float)((double)other.projection[k] * n + (double)other.projection[4 + k] * c);
            turned.view[4 * k] = (float)(c * (double)view[4 * k] - n * (double)view[4 * k + 1]);
            turned.view[4 * k + 1] = (float)(n * (double)view[4 * k] + c * (double)view[4 * k + 1]);
        }
        assert_same(f, &other, &turned, 1e-3, "world space, turned");
        subject_free(&s);
        free(world.normals);
    }
}

TEST_GL(views_are_checked_where_they_count)
{
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    SCOPED(subject) subject s = room(PERSPECTIVE);
    SCOPED(frame) glssao_frame frame = subject_frame(&s, DEPTH_32F, NORMAL_32F);
    static const double flat[3] = {1.0, 0.0, 1.0}, plain[3] = {1.0, 1.0, 1.0};
    static const char *const wanted[] = {"frame.view is singular", "frame.view is singular", "frame.view[5] = nan",
                                         NULL};
    for (int i = 0; i < 4; ++i) {
        frame.world_normals = true;
        if (i > 0)
            make_view(i == 1 ? flat : plain, frame.view);
        if (i == 2)
            frame.view[5] = NAN;
        fixture_clear_log(f);
        assert_int_equal(glssao_compute(effects[0], &frame, &settings),
                         wanted[i] ? GLSSAO_INVALID_ARGUMENT : GLSSAO_OK);
        assert_true(wanted[i] ? strstr(f->log, wanted[i]) != NULL : f->log[0] == '\0');
        frame.world_normals = false; /* not read */
        assert_int_equal(glssao_compute(effects[0], &frame, &settings), GLSSAO_OK);
    }
}

/* ---- rounding ---- */

TEST_GL(residues_change_nothing)
{
    static const analytic_projection kinds[] = {PERSPECTIVE, PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE, ORTHOGRAPHIC};
    static const int entries[] = {1, 2, 3, 4, 6, 7};
    for (int i = 0; i < 3; ++i) {
        SCOPED(subject) subject s = room(kinds[i]);
        glssao_frame plain = subject_frame(&s, DEPTH_32F, NORMAL_NONE), other = plain;
        for (int k = 0; k < 6; ++k) /* infinite reversed depth has a third row of 0, and so none of its own */
            if (i != 1 || entries[k] % 4 != 2)
                other.projection[entries[k]] = (k % 2 ? -2.7e-8f : 2.7e-8f) * (i == 2 ? 0.01f : 1.0f);
        assert_same(f, &plain, &other, 0.0, "residues");
        fixture_delete_frame(&plain);
    }
}

/* ---- the eye of an orthographic projection ---- */

TEST_GL(eyes_behind_the_near_plane_see_the_same)
{
    static const double moves[] = {4.0, 60.0, -5000.0}; /* into the scene, behind it, far before it */
    for (int i = 0; i < 3; ++i)
        for (int reversed = 0; reversed < 2; ++reversed) {
            SCOPED(subject) subject s = room(reversed ? ORTHOGRAPHIC_REVERSED : ORTHOGRAPHIC);
            glssao_frame plain = subject_frame(&s, DEPTH_32F, i == 1 ? NORMAL_NONE : NORMAL_32F), other = plain;
            other.projection[14] -= (float)moves[i] * other.projection[10];
            char what[48];
            snprintf(what, sizeof what, "an eye that is %g farther%s", moves[i], reversed ? ", reversed" : "");
            assert_same(f, &plain, &other, 1e-3, what);
            fixture_delete_frame(&plain);
        }
}

/* The settings count view distance from the host's eye. */
TEST_GL(far_fades_follow_the_hosts_eye)
{
    static const double moves[] = {2.0, -5000.0};
    for (int i = 0; i < 4; ++i) {
        SCOPED(subject) subject s = room(ORTHOGRAPHIC);
        SCOPED(frame) glssao_frame frame = subject_frame(&s, DEPTH_32F, NORMAL_32F);
        glssao_settings settings = glssao_default_settings(i % 2 ? GLSSAO_HORIZON : GLSSAO_HEMISPHERE, GLSSAO_HIGH);
        settings.radius = 2.0f;
        SCOPED(picture) picture without = subject_shade_by(f, effects[0], &frame, &settings);
        settings.fade_far_start = 5.0f;
        settings.fade_far_end = 9.0f;
        SCOPED(picture) picture plain = subject_shade_by(f, effects[0], &frame, &settings);
        frame.projection[14] -= (float)moves[i / 2] * frame.projection[10];
        settings.fade_far_start -= (float)moves[i / 2];
        settings.fade_far_end -= (float)moves[i / 2];
        SCOPED(picture) picture moved = subject_shade_by(f, effects[0], &frame, &settings);
        double apart = 0.0, faded = 0.0;
        for (int k = 0; k < W * H; ++k) {
            apart = fmax(apart, fabs((double)plain.values[k] - (double)moved.values[k]));
            faded = fmax(faded, (double)plain.values[k] - (double)without.values[k]);
        }
        if (!(faded > 0.05 && apart < 0.01))
            fail_msg("case %d: %g faded, %g apart", i, faded, apart);
    }
}

/* ---- oblique near planes ---- */

/* Lengyel's third row for a plane in view space, and the window depth that it gives. */
static void make_oblique(subject *s, const double plane[4], bool reversed)
{
    float *p = s->view.projection;
    const double q[4] = {((plane[0] > 0.0) - (plane[0] < 0.0) + (double)p[8]) / (double)p[0],
                         ((plane[1] > 0.0) - (plane[1] < 0.0) + (double)p[9]) / (double)p[5], -1.0,
                         (1.0 + (double)p[10]) / (double)p[14]};
    double dot = 0.0;
    for (int i = 0; i < 4; ++i)
        dot += plane[i] * q[i];
    for (int c = 0; c < 4; ++c) {
        const double row = 2.0 * plane[c] / dot - (double)p[4 * c + 3];
        p[4 * c + 2] = (float)(reversed ? -row : row);
    }
    for (int y = 0; y < H; ++y)
        for (int x = 0; x < W; ++x) {
            const double t = (double)s->distance[y * W + x];
            const double vx = t * (2.0 * (x + 0.5) / W - 1.0 + (double)p[8]) / (double)p[0];
            const double vy = t * (2.0 * (y + 0.5) / H - 1.0 + (double)p[9]) / (double)p[5];
            const double z = (double)p[2] * vx + (double)p[6] * vy - (double)p[10] * t + (double)p[14];
            s->depth[y * W + x] = isfinite(t) ? (float)(0.5 + 0.5 * z / t) : reversed ? 0.0f : 1.0f;
            assert_true(s->depth[y * W + x] >= 0.0f && s->depth[y * W + x] <= 1.0f); /* nothing is clipped */
        }
    s->view.sky_depth = reversed ? 0.0f : 1.0f;
}

TEST_GL(oblique_near_planes_change_nothing)
{
    static const double planes[][4] = {{0.0, 0.3, -0.9539, -1.0}, {0.4, -0.1, -0.9110, -1.2}};
    static const depth_store stores[] = {DEPTH_32F, DEPTH_24};
    for (int i = 0; i < 4; ++i) {
        SCOPED(subject) subject s = room(i < 2 ? PERSPECTIVE : PERSPECTIVE_OFF_CENTRE);
        SCOPED(frame) glssao_frame plain = subject_frame(&s, DISTANCE_32F, i % 2 ? NORMAL_NONE : NORMAL_32F);
        make_oblique(&s, planes[i % 2], i == 3);
        SCOPED(frame) glssao_frame other = subject_frame(&s, stores[i / 2], i % 2 ? NORMAL_NONE : NORMAL_32F);
        assert_same(f, &plain, &other, 2e-3, "an oblique near plane");
    }
}

/* A plane in all of these stays open, whatever looks at it. */
TEST_GL(planes_stay_open)
{
    const analytic_shape plane = {ANALYTIC_PLANE, {0.0, -0.3, -3.0}, {0.0, 0.6, 0.8}};
    static const double near_plane[4] = {0.0, 0.3, -0.9539, -0.3};
    const analytic_view view = analytic_make_view(PERSPECTIVE, (double)W / H, 0.1, 100.0, 1.0);
    const analytic_view box = analytic_make_view(ORTHOGRAPHIC, (double)W / H, 0.1, 100.0, 0.2);
    for (int i = 0; i < 3; ++i) {
        SCOPED(subject) subject s = subject_of(i == 1 ? &box : &view, &plane, 1, W, H);
        if (i == 2)
            make_oblique(&s, near_plane, false);
        for (int normals = 0; normals < 2; ++normals) {
            SCOPED(frame) glssao_frame frame = {0};
            turn_frame(&s, i == 1 ? 0.0 : 40.0, normals ? NORMAL_32F : NORMAL_NONE, &frame);
            if (i == 1)
                frame.projection[14] -= 10.0f * frame.projection[10]; /* the plane lies behind the eye */
            for (int number = 1; number < CONFIGURATIONS; number += 3) {
                const configuration c = configuration_of(number);
                SCOPED(picture) picture p = subject_shade_by(f, effects[0], &frame, &c.settings);
                if (picture_least(&p) < 0.995)
                    fail_msg("case %d, %s: %g", i, c.name, picture_least(&p));
            }
        }
    }
}

/* ---- matrices that were hardly meant ---- */

TEST_GL(doubts_are_told_once)
{
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    SCOPED(subject) subject s = room(PERSPECTIVE);
    glssao_frame frame = subject_frame(&s, DEPTH_32F, NORMAL_NONE), bad = frame;
    SCOPED(effect) glssao_effect *effect = fixture_effect(f, W, H);
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 16; ++k)
            bad.projection[k] = i ? frame.projection[4 * (k % 4) + k / 4] : identity[k];
        for (int again = 0; again < 2; ++again) {
            fixture_clear_log(f);
            (void)glssao_plan_frame(effect, &bad, &settings);
            assert_string_equal(f->log, "");
            assert_int_equal(glssao_compute(effect, &bad, &settings), GLSSAO_OK);
            const bool told = strstr(f->log, i ? "looks transposed" : "is the identity") != NULL;
            assert_true(told == (again == 0));
        }
    }
    fixture_clear_log(f);
    assert_int_equal(glssao_compute(effect, &frame, &settings), GLSSAO_OK);
    assert_string_equal(f->log, "");
    fixture_delete_frame(&frame);
}

TEST_MAIN(NULL, setup, teardown)
