/* SPDX-License-Identifier: MIT
 *
 * The library's own arithmetic, without a context: projections, constants, random inputs, default settings.
 */
#include "frame/uniforms.h"
#include "input/check.h"
#include "random.h"
#include "testing.h"

static const glssao__log silent;

#define assert_near(a, b, tolerance) assert_true(fabs((double)(a) - (double)(b)) <= (tolerance))

/* ---- cbSsao ---- */

TEST(block_has_the_offsets_of_the_design)
{
    assert_int_equal(offsetof(glssao_constants, gProj), 0);
    assert_int_equal(offsetof(glssao_constants, gInvProj), 64);
    assert_int_equal(offsetof(glssao_constants, gProjTex), 128);
    assert_int_equal(offsetof(glssao_constants, gOffsetVectors), 192);
    assert_int_equal(offsetof(glssao_constants, gBlurWeights), 416);
    assert_int_equal(offsetof(glssao_constants, gInvRenderTargetSize), 464);
    assert_int_equal(offsetof(glssao_constants, gOcclusionRadius), 472);
    assert_int_equal(offsetof(glssao_constants, gOcclusionFadeStart), 476);
    assert_int_equal(offsetof(glssao_constants, gOcclusionFadeEnd), 480);
    assert_int_equal(offsetof(glssao_constants, gSurfaceEpsilon), 484);
    assert_int_equal(sizeof(glssao_constants), 496);
}

TEST(offset_vectors_are_corners_then_faces_in_opposite_pairs)
{
    glssao__uniforms u;
    glssao__uniforms_init(&u, 42);
    for (int i = 0; i < 14; ++i) {
        const float *o = u.ssao.gOffsetVectors[i];
        float length = sqrtf(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]);
        assert_true(length >= 0.25f && length <= 1.0f);
        assert_true(o[3] == 0.0f);
        int zeros = (o[0] == 0.0f) + (o[1] == 0.0f) + (o[2] == 0.0f);
        assert_int_equal(zeros, i < 8 ? 0 : 2);
        if (i % 2 == 1) {
            const float *p = u.ssao.gOffsetVectors[i - 1];
            float other = sqrtf(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            float cosine = (o[0] * p[0] + o[1] * p[1] + o[2] * p[2]) / (length * other);
            assert_near(cosine, -1.0f, 1e-6);
        }
        for (int k = 0; k < i; ++k) { /* all directions differ */
            const float *p = u.ssao.gOffsetVectors[k];
            float other = sqrtf(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            assert_true((o[0] * p[0] + o[1] * p[1] + o[2] * p[2]) / (length * other) < 0.99f);
        }
    }
}

TEST(gauss_weights_match_the_closed_form)
{
    static const float sigmas[] = {0.1f, 0.5f, 1.0f, 1.7f, 2.5f};
    for (int s = 0; s < 5; ++s) {
        float w[3][4];
        glssao__uniforms_gauss_weights(sigmas[s], w);
        double sum = 0.0;
        int radius = (int)ceil(2.0 * (double)sigmas[s]);
        for (int i = 0; i < 12; ++i) {
            double value = (double)w[i / 4][i % 4];
            int x = abs(i - 5);
            double ratio = x <= radius && i < 11 ? exp(-x * x / (2.0 * (double)sigmas[s] * (double)sigmas[s])) : 0.0;
            assert_near(value, ratio * (double)w[1][1], 1e-6);
            sum += value;
        }
        assert_near(sum, 1.0, 1e-6);
    }
}

/* ---- random ---- */

TEST(random_repeats_and_streams_differ)
{
    glssao__random a = glssao__random_seed(1, 0), b = glssao__random_seed(1, 0), c = glssao__random_seed(1, 1),
                   d = glssao__random_seed(2, 0);
    int same_stream = 0, same_seed = 0;
    for (int i = 0; i < 1000; ++i) {
        uint32_t value = glssao__random_next(&a);
        assert_int_equal(value, glssao__random_next(&b));
        same_stream += value == glssao__random_next(&c);
        same_seed += value == glssao__random_next(&d);
    }
    assert_true(same_stream < 2 && same_seed < 2);
}

/* Chi-squared over 256 bins, 255 degrees of freedom: mean 255, standard deviation 22.6. Also for neighbouring seeds. */
TEST(random_vector_channels_are_uniform_and_independent)
{
    size_t texels = (size_t)RANDOM_VECTOR_MAP_SIZE * RANDOM_VECTOR_MAP_SIZE;
    SCOPED(memory) uint8_t *rgba = malloc(texels * 4), *first = malloc(texels * 4);
    for (uint32_t seed = 0; seed < 4; ++seed) {
        glssao__random_vector_texels(seed, rgba);
        double mean[3] = {0}, product[3] = {0};
        for (int channel = 0; channel < 3; ++channel) {
            double bins[256] = {0}, chi = 0.0, expected = (double)texels / 256.0;
            for (size_t i = 0; i < texels; ++i) {
                bins[rgba[4 * i + (size_t)channel]] += 1.0;
                mean[channel] += rgba[4 * i + (size_t)channel] / (255.0 * (double)texels);
                product[channel] +=
                    (rgba[4 * i + (size_t)channel] - 127.5) * (rgba[4 * i + (size_t)((channel + 1) % 3)] - 127.5);
            }
            for (int k = 0; k < 256; ++k)
                chi += (bins[k] - expected) * (bins[k] - expected) / expected;
            assert_true(chi > 150.0 && chi < 380.0);
            assert_near(mean[channel], 0.5, 0.005);
            assert_near(product[channel] / (double)texels / (127.5 * 127.5 / 3.0), 0.0, 0.02); /* correlation */
        }
        if (seed == 0)
            memcpy(first, rgba, texels * 4);
        else
            assert_true(memcmp(first, rgba, texels * 4) != 0);
    }
}

/* ---- projections ---- */

static double distance_at(const glssao__projection *p, double depth)
{
    const float *k = p->distance_from_depth;
    return ((1.0 - depth) * (double)k[0] + depth * (double)k[1]) /
           ((1.0 - depth) * (double)k[2] + depth * (double)k[3]);
}

static void perspective(float m[16], double n, double f, bool zero_to_one, bool reversed)
{
    memset(m, 0, 16 * sizeof *m);
    m[0] = 1.5f;
    m[5] = 2.0f;
    m[11] = -1.0f;
    double a = zero_to_one ? f / (n - f) : (n + f) / (n - f), b = zero_to_one ? f * n / (n - f) : 2.0 * f * n / (n - f);
    if (reversed) {
        a = n / (f - n);
        b = f * n / (f - n);
    }
    m[10] = (float)a;
    m[14] = (float)b;
}

static bool analyse(const float m[16], bool zero_to_one, glssao__projection *out)
{
    glssao_frame frame = {.clip_zero_to_one = zero_to_one};
    memcpy(frame.projection, m, sizeof frame.projection);
    return glssao__projection_analyse(&frame, &silent, out);
}

TEST(depth_ends_are_the_planes)
{
    glssao__projection p;
    float m[16];
    perspective(m, 0.25, 64.0, false, false);
    assert_true(analyse(m, false, &p));
    assert_near(distance_at(&p, 0.0), 0.25, 1e-5);
    assert_near(distance_at(&p, 1.0), 64.0, 0.01);
    assert_true(p.sky_depth == 1.0f);
    perspective(m, 0.25, 64.0, true, false);
    assert_true(analyse(m, true, &p));
    assert_near(distance_at(&p, 0.0), 0.25, 1e-5);
    assert_near(distance_at(&p, 1.0), 64.0, 0.01);
    perspective(m, 0.25, 64.0, true, true);
    assert_true(analyse(m, true, &p));
    assert_near(distance_at(&p, 1.0), 0.25, 1e-5);
    assert_near(distance_at(&p, 0.0), 64.0, 0.01);
    assert_true(p.sky_depth == 0.0f);
}

/* Near : far of 1 : 10^7. The float matrix cannot resolve the far plane, but every depth in between must be right. */
TEST(distance_survives_a_range_of_ten_million)
{
    float m[16];
    glssao__projection p;
    perspective(m, 0.01, 1e5, true, true);
    assert_true(analyse(m, true, &p));
    for (double t = 0.01; t < 5e4; t *= 3.0) {
        double depth = ((double)m[14] - (double)m[10] * t) / t;
        assert_near(distance_at(&p, (double)(float)depth) / t, 1.0, 1e-5);
    }
}

TEST(ray_through_uv_meets_the_projected_point)
{
    float m[16];
    for (int orthographic = 0; orthographic < 2; ++orthographic) {
        perspective(m, 0.25, 64.0, false, false);
        m[8] = 0.3f;
        m[9] = -0.7f;
        if (orthographic) {
            m[10] = -0.01f;
            m[11] = 0.0f;
            m[12] = 0.2f;
            m[13] = -0.4f;
            m[14] = -1.0f;
            m[15] = 1.0f;
        }
        glssao__projection p;
        assert_true(analyse(m, false, &p));
        static const double points[][3] = {{0.5, -0.25, -3.0}, {-4.0, 2.0, -20.0}, {0.0, 0.0, -1.0}};
        for (int i = 0; i < 3; ++i) {
            const double *v = points[i];
            double w = (double)m[11] * v[2] + (double)m[15];
            for (int axis = 0; axis < 2; ++axis) {
                double clip = (double)m[5 * axis] * v[axis] + (double)m[8 + axis] * v[2] + (double)m[12 + axis];
                double uv = 0.5 + 0.5 * clip / w;
                double origin = uv * (double)p.ray_origin[axis] + (double)p.ray_origin[axis + 2];
                double direction = uv * (double)p.ray_direction[axis] + (double)p.ray_direction[axis + 2];
                assert_near(origin - v[2] * direction, v[axis], 1e-5);
            }
        }
    }
}

TEST(inverse_times_projection_is_identity)
{
    float m[16];
    perspective(m, 1e-3, 1e4, false, false);
    m[8] = 0.25f;
    glssao__projection p;
    assert_true(analyse(m, false, &p));
    for (int row = 0; row < 4; ++row)
        for (int col = 0; col < 4; ++col) {
            double sum = 0.0, largest = 0.0;
            for (int k = 0; k < 4; ++k) {
                double term = (double)m[4 * k + row] * (double)p.view_from_clip[4 * col + k];
                sum += term;
                largest = fmax(largest, fabs(term));
            }
            assert_near(sum, row == col ? 1.0 : 0.0, 1e-6 * fmax(1.0, largest));
        }
}

/* ---- settings ---- */

TEST(default_settings_pass_the_checks)
{
    for (int quality = -1; quality < 6; ++quality)
        for (int technique = 0; technique < 3; ++technique) {
            glssao_settings s = glssao_default_settings((glssao_technique)technique, (glssao_quality)quality);
            assert_true(glssao__check_settings(&s, &silent));
            assert_int_equal(s.technique, technique);
        }
    assert_int_equal(glssao_default_settings((glssao_technique)9, GLSSAO_HIGH).technique, GLSSAO_CLASSIC);
    assert_int_equal(glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH).technique, GLSSAO_HORIZON);
}

/* View distance of a window depth, from the definition of a projection alone. */
static double distance_of(const float p[16], bool zero_to_one, double depth)
{
    const double ndc = zero_to_one ? depth : 2.0 * depth - 1.0;
    return ((double)p[14] - ndc * (double)p[15]) / ((double)p[10] - ndc * (double)p[11]);
}

/* The depth step at a view distance must equal the distance between neighbouring stored values. */
TEST(depth_steps_are_differences)
{
    static const struct {
        float p10, p11, p14, p15;
        bool zero_to_one;
    } projections[] = {
        {-1.002002f, -1.0f, -0.2002002f, 0.0f, false}, /* 0.1 to 100 */
        {-1.0f, -1.0f, -0.2f, 0.0f, false},            /* infinite */
        {0.0f, -1.0f, 0.1f, 0.0f, true},               /* infinite, reversed */
        {0.001001f, -1.0f, 0.1001001f, 0.0f, true},    /* reversed */
        {-0.02f, 0.0f, -1.002f, 1.0f, false},          /* orthographic */
    };
    static const glssao__precision formats[] = {{0x1p-16, false}, {0x1p-24, false}, {0x1p-23, true}};
    for (size_t i = 0; i < sizeof projections / sizeof *projections; ++i)
        for (size_t k = 0; k < sizeof formats / sizeof *formats; ++k) {
            glssao_frame frame = {.projection = {[0] = 1.0f,
                                                 [5] = 1.0f,
                                                 [10] = projections[i].p10,
                                                 [11] = projections[i].p11,
                                                 [14] = projections[i].p14,
                                                 [15] = projections[i].p15},
                                  .clip_zero_to_one = projections[i].zero_to_one};
            glssao__projection projection;
            float c[4];
            assert_true(glssao__projection_analyse(&frame, &silent, &projection));
            glssao__projection_depth_step(&frame, &projection, &formats[k], c);
            for (double depth = 0.05; depth < 1.0; depth += 0.09) {
                const double t = distance_of(frame.projection, frame.clip_zero_to_one, depth);
                /* Floats near a sky of 1 are 2^-24 apart; otherwise a step is relative. */
                const double step = !formats[k].relative           ? formats[k].step
                                    : projection.sky_depth == 1.0f ? 0x1p-24
                                                                   : formats[k].step * depth;
                const double wanted =
                    fabs(distance_of(frame.projection, frame.clip_zero_to_one, depth + 1e-3 * step) - t) * 1e3 +
                    0x1p-22 * t;
                assert_near((double)c[0] + t * ((double)c[1] + t * (double)c[2]), wanted, 1e-3 * wanted);
            }
        }
    glssao_frame logarithmic = {.depth_kind = GLSSAO_DEPTH_LOGARITHMIC, .log_depth_far = 100.0f};
    float c[4];
    glssao__projection_depth_step(&logarithmic, &(glssao__projection){0}, &formats[1], c);
    const double t = exp(0.5 * log(101.0)) - 1.0, next = exp((0.5 + 1e-6) * log(101.0)) - 1.0;
    assert_near((double)c[0] + t * (double)c[1], (next - t) * 1e6 * 0x1p-24 + 0x1p-22 * t,
                1e-3 * 0x1p-24 * (next - t) * 1e6);
}

TEST_MAIN(NULL, NULL, NULL)
