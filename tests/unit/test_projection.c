/* SPDX-License-Identifier: MIT
 *
 * Which matrices count as projections, without a context: rounding residues, turns about the view axis, eyes behind the
 * near plane, oblique near planes, and matrices that were hardly meant.
 */
#include "input/projection.h"
#include "random.h"
#include "testing.h"

static const glssao__log silent;
typedef float matrix[16];

static const matrix lens = {1.3f, 0, 0, 0, 0, 1.9f, 0, 0, 0.2f, -0.1f, -1.002f, -1, 0, 0, -0.2002f, 0};
static const matrix box = {0.1f, 0, 0, 0, 0, 0.2f, 0, 0, 0, 0, -0.02f, 0, 0.3f, -0.2f, -1.002f, 1};

static bool analyse(const matrix m, bool zero_to_one, glssao__projection *out)
{
    glssao_frame frame = {.clip_zero_to_one = zero_to_one};
    memcpy(frame.projection, m, sizeof frame.projection);
    return glssao__projection_analyse(&frame, &silent, out);
}

/* In floats, as hosts multiply. */
static void multiply(const matrix a, const matrix b, matrix out)
{
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            float sum = 0.0f;
            for (int k = 0; k < 4; ++k)
                sum += a[4 * k + r] * b[4 * c + k];
            out[4 * c + r] = sum;
        }
}

static void transpose(const matrix m, matrix out)
{
    for (int i = 0; i < 16; ++i)
        out[i] = m[4 * (i % 4) + i / 4];
}

/* A turn about a random axis by a random angle (Rodrigues). */
static void random_turn(glssao__random *random, matrix out)
{
    float axis[3], length = 0.0f;
    for (int i = 0; i < 3; ++i) {
        axis[i] = 2.0f * glssao__random_unit(random) - 1.0f;
        length += axis[i] * axis[i];
    }
    length = sqrtf(fmaxf(length, 1e-6f));
    const float angle = 6.2831853f * glssao__random_unit(random), c = cosf(angle), s = sinf(angle);
    const float x = axis[0] / length, y = axis[1] / length, z = axis[2] / length;
    const matrix turn = {c + x * x * (1 - c),
                         y * x * (1 - c) + z * s,
                         z * x * (1 - c) - y * s,
                         0,
                         x * y * (1 - c) - z * s,
                         c + y * y * (1 - c),
                         z * y * (1 - c) + x * s,
                         0,
                         x * z * (1 - c) + y * s,
                         y * z * (1 - c) - x * s,
                         c + z * z * (1 - c),
                         0,
                         0,
                         0,
                         0,
                         1};
    memcpy(out, turn, sizeof turn);
}

static void turn_about_z(double angle, matrix out)
{
    const matrix turn = {(float)cos(angle),
                         (float)sin(angle),
                         0,
                         0,
                         (float)-sin(angle),
                         (float)cos(angle),
                         0,
                         0,
                         0,
                         0,
                         1,
                         0,
                         0,
                         0,
                         0,
                         1};
    memcpy(out, turn, sizeof turn);
}

/* A projection times V1 V1^-1 V2 V2^-1, as hosts that undo a view get it. */
TEST(products_leave_residues_that_count_as_zeros)
{
    glssao__random random = glssao__random_seed(5, 0);
    int with_residues = 0;
    for (int i = 0; i < 2000; ++i) {
        const float *start = i % 2 ? lens : box;
        matrix product, turn, back, next;
        memcpy(product, start, sizeof product);
        for (int k = 0; k < 2; ++k) {
            random_turn(&random, turn);
            transpose(turn, back);
            multiply(product, turn, next);
            multiply(next, back, product);
        }
        with_residues += product[1] != 0.0f || product[2] != 0.0f || product[3] != 0.0f;
        glssao__projection p;
        assert_true(analyse(product, false, &p));
        assert_false(p.is_turned);
        assert_false(p.is_oblique);
        assert_true(p.is_orthographic == (start == box));
        for (int at = 0; at < 16; ++at) {
            if (start[at] == 0.0f && (at < 12 && at != 8 && at != 9)) /* off-centre and translations may stay */
                assert_true(p.clip_from_view[at] == 0.0f);
            assert_float_equal(p.clip_from_view[at], start[at], 2e-6f);
        }
    }
    assert_true(with_residues > 1000);
}

/* What is a hundred times larger than a residue is none. */
TEST(shears_are_no_residues)
{
    static const int entries[] = {1, 3, 4, 7};
    glssao__projection p;
    for (int i = 0; i < 8; ++i) {
        matrix m;
        memcpy(m, i < 4 ? lens : box, sizeof m);
        m[entries[i % 4]] += 4e-4f;
        assert_false(analyse(m, false, &p));
    }
    matrix oblique;
    memcpy(oblique, lens, sizeof oblique);
    oblique[2] = 4e-4f;
    assert_true(analyse(oblique, false, &p));
    assert_true(p.is_oblique);
}

/* A perspective with little perspective is none too few. */
TEST(a_little_perspective_counts)
{
    glssao__projection p;
    matrix m;
    memcpy(m, box, sizeof m);
    m[11] = -1e-5f; /* w changes by a thousandth over the range */
    assert_true(analyse(m, false, &p));
    assert_false(p.is_orthographic);
    m[11] = -1e-9f;
    assert_true(analyse(m, false, &p));
    assert_true(p.is_orthographic);
    m[11] = 1e-9f;
    assert_true(analyse(m, false, &p));
    assert_true(p.is_orthographic);
}

/* The ray through the image of a point meets the point, in the passes' view space. */
static void assert_images(const matrix m, const glssao__projection *p)
{
    static const double points[][3] = {{0.5, -0.25, -3.0}, {-4.0, 2.0, -20.0}, {0.1, 0.2, -1.0}};
    for (int i = 0; i < 3; ++i) {
        const double *v = points[i];
        double clip[4];
        for (int r = 0; r < 4; ++r)
            clip[r] = (double)m[r] * v[0] + (double)m[4 + r] * v[1] + (double)m[8 + r] * v[2] + (double)m[12 + r];
        const double turned[2] = {(double)p->turn[0] * v[0] + (double)p->turn[1] * v[1],
                                  (double)p->turn[0] * v[1] - (double)p->turn[1] * v[0]};
        for (int axis = 0; axis < 2; ++axis) {
            const double uv = 0.5 + 0.5 * clip[axis] / clip[3];
            const double origin = uv * (double)p->ray_origin[axis] + (double)p->ray_origin[axis + 2];
            const double direction = uv * (double)p->ray_direction[axis] + (double)p->ray_direction[axis + 2];
            assert_true(fabs(origin - v[2] * direction - turned[axis]) < 2e-5);
        }
    }
}

TEST(turns_about_the_view_axis_are_found)
{
    for (int mirror = 0; mirror < 2; ++mirror)
        for (int i = 0; i < 2; ++i)
            for (int degrees = -180; degrees < 180; degrees += 15) {
                const double angle = degrees * 3.14159265358979323846 / 180.0;
                matrix turn, m;
                turn_about_z(angle, turn);
                multiply(i ? lens : box, turn, m);
                for (int k = 0; k < 4 && mirror; ++k)
                    m[4 * k] = -m[4 * k];
                glssao__projection p;
                assert_true(analyse(m, false, &p));
                assert_true(p.is_turned == (degrees % 180 != 0));
                assert_images(m, &p);
                /* The turn is a rotation, so it mirrors nothing that the scales do not. */
                assert_float_equal(p.turn[0] * p.turn[0] + p.turn[1] * p.turn[1], 1.0f, 1e-6f);
                assert_true((p.ray_direction[0] * p.ray_direction[1] < 0.0f ||
                             p.ray_origin[0] * p.ray_origin[1] < 0.0f) == (mirror == 1));
            }
}

static double distance_at(const glssao__projection *p, double depth)
{
    const float *k = p->distance_from_depth;
    return ((1.0 - depth) * (double)k[0] + depth * (double)k[1]) /
           ((1.0 - depth) * (double)k[2] + depth * (double)k[3]);
}

/* Only the eye moves: distances are counted from the near end of the range, and the picture of a point stays. */
TEST(eyes_in_or_far_from_the_range_are_moved)
{
    static const struct {
        double near_plane, far_plane, counted_from;
    } ranges[] = {
        {0.5, 40.0, 0.0}, {-40.0, 40.0, -40.0}, {-1.0, 9.0, -1.0}, {1000.0, 1010.0, 1000.0}, {-9.0, -1.0, -9.0}};
    for (int i = 0; i < 5; ++i)
        for (int reversed = 0; reversed < 2; ++reversed) {
            const double n = ranges[i].near_plane, f = ranges[i].far_plane, sign = reversed ? -1.0 : 1.0;
            matrix m = {0.1f,
                        0,
                        0,
                        0,
                        0,
                        0.2f,
                        0,
                        0,
                        0.01f,
                        0.02f,
                        (float)(-2.0 / (f - n) * sign),
                        0,
                        0.3f,
                        -0.2f,
                        (float)(-(f + n) / (f - n) * sign),
                        1};
            glssao__projection p;
            assert_true(analyse(m, false, &p));
            assert_true(p.sky_depth == (reversed ? 0.0f : 1.0f));
            for (int k = 0; k <= 4; ++k) {
                const double t = n + (f - n) * k / 4.0;
                const double depth = 0.5 + 0.5 * ((double)m[14] - (double)m[10] * t);
                const double counted = distance_at(&p, depth);
                assert_true(fabs(counted - (t - ranges[i].counted_from)) < 1e-5 * (f - n) + 1e-6 * fabs(n));
                /* The same uv for the same point. */
                const double x = 0.7, u = 0.5 + 0.5 * ((double)m[0] * x - (double)m[8] * t + (double)m[12]);
                const double origin = u * (double)p.ray_origin[0] + (double)p.ray_origin[2];
                const double direction = u * (double)p.ray_direction[0] + (double)p.ray_direction[2];
                assert_true(fabs(origin + counted * direction - x) < 1e-4 + 1e-6 * fabs(n));
            }
        }
    /* View distances are stored as they are, so the eye stays. */
    glssao_frame frame = {.depth_kind = GLSSAO_DEPTH_VIEW_DISTANCE,
                          .projection = {0.1f, 0, 0, 0, 0, 0.2f, 0, 0, 0, 0, -0.025f, 0, 0, 0, 0, 1}};
    glssao__projection p;
    assert_true(glssao__projection_analyse(&frame, &silent, &p));
    assert_true(p.clip_from_view[14] == 0.0f);
}

/* Lengyel's matrix: the third row becomes the plane, scaled so that the far plane still holds the frustum. */
static void make_oblique(const matrix m, const double plane[4], bool zero_to_one, matrix out)
{
    memcpy(out, m, sizeof(matrix));
    /* The corner of clip space opposite the plane. */
    const double q[4] = {((plane[0] > 0.0) - (plane[0] < 0.0) + (double)m[8]) / (double)m[0],
                         ((plane[1] > 0.0) - (plane[1] < 0.0) + (double)m[9]) / (double)m[5], -1.0,
                         (1.0 + (double)m[10]) / (double)m[14]};
    double dot = 0.0;
    for (int i = 0; i < 4; ++i)
        dot += plane[i] * q[i];
    for (int c = 0; c < 4; ++c)
        out[4 * c + 2] = (float)(zero_to_one ? plane[c] / dot : 2.0 * plane[c] / dot - (double)m[4 * c + 3]);
}

TEST(oblique_depth_is_turned_into_distance)
{
    static const double planes[][4] = {
        {0.0, 0.3, -0.9539, -1.5}, {-0.4, 0.0, -0.9165, -0.5}, {0.3, -0.3, -0.9055, -2.0}};
    for (int i = 0; i < 3; ++i)
        for (int zero_to_one = 0; zero_to_one < 2; ++zero_to_one) {
            matrix m;
            make_oblique(lens, planes[i], zero_to_one, m);
            glssao__projection p;
            assert_true(analyse(m, zero_to_one, &p));
            assert_true(p.is_oblique && p.sky_depth == 1.0f);
            for (double t = 2.5; t < 50.0; t *= 1.7)
                for (int k = 0; k < 9; ++k) {
                    const double u = 0.1 + 0.4 * (k % 3), v = 0.1 + 0.4 * (k / 3);
                    const double x = t * (u * (double)p.ray_direction[0] + (double)p.ray_direction[2]);
                    const double y = t * (v * (double)p.ray_direction[1] + (double)p.ray_direction[3]);
                    const double z = (double)m[2] * x + (double)m[6] * y - (double)m[10] * t + (double)m[14];
                    const double depth = zero_to_one ? z / t : 0.5 + 0.5 * z / t;
                    const float *e = p.distance_from_depth, *o = p.oblique;
                    const double above =
                        (1.0 - depth) * (double)e[0] + depth * (double)e[1] + (double)o[0] * u + (double)o[1] * v;
                    const double below =
                        (1.0 - depth) * (double)e[2] + depth * (double)e[3] + (double)o[2] * u + (double)o[3] * v;
                    assert_true(fabs(above / below / t - 1.0) < 3e-5);
                }
        }
}

static char said[256];

static void listen(glssao_log_level level, const char *message, void *user)
{
    (void)level;
    (void)user;
    snprintf(said, sizeof said, "%s", message);
}

/* The doubt, or where the matrix is refused what the message says. */
static enum glssao__doubt doubt_of(const matrix m)
{
    const glssao__log log = {.write = listen};
    glssao__projection p;
    glssao_frame frame = {0};
    memcpy(frame.projection, m, sizeof frame.projection);
    if (glssao__projection_analyse(&frame, &log, &p))
        return p.doubt;
    return strstr(said, "looks transposed") ? DOUBT_TRANSPOSED : DOUBT_NONE;
}

TEST(matrices_that_were_hardly_meant_are_told)
{
    static const matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const matrix infinite_from_a_half = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0};
    static const matrix left_handed = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.002f, 1, 0, 0, -0.2f, 0};
    const float *const projections[] = {lens, box, infinite_from_a_half, left_handed};
    matrix turn, other, product;
    assert_int_equal(doubt_of(identity), DOUBT_IDENTITY);
    turn_about_z(0.3, turn);
    for (int i = 0; i < 4; ++i) {
        assert_int_equal(doubt_of(projections[i]), DOUBT_NONE);
        transpose(projections[i], other);
        if (i != 2) /* where the distance to the near plane is a half, the transpose is a projection too */
            assert_int_equal(doubt_of(other), DOUBT_TRANSPOSED);
        multiply(projections[i], turn, product);
        assert_int_equal(doubt_of(product), DOUBT_NONE);
        transpose(product, other);
        if (i != 2)
            assert_int_equal(doubt_of(other), DOUBT_TRANSPOSED);
    }
    memcpy(other, infinite_from_a_half, sizeof other);
    other[3] = 2.7e-8f; /* its last column is (0, 0, -1, 0), and its last row is that but for rounding */
    assert_int_equal(doubt_of(other), DOUBT_NONE);
}

TEST_MAIN(NULL, NULL, NULL)
