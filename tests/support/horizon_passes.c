/* SPDX-License-Identifier: MIT */
#include "horizon_passes.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* What a texel's red is made of. */
enum { NORMAL_BITS = 10, AXIS_BITS = 5 };

typedef struct texel {
    double value, linear;
    int normal[2]; /* steps of constants.normal_step */
} texel;

static uint32_t bits_of(float red)
{
    uint32_t bits;
    memcpy(&bits, &red, sizeof bits);
    return bits;
}

double paired_accessibility(float red)
{
    const uint32_t bits = bits_of(red) >> NORMAL_BITS << NORMAL_BITS;
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

static texel texel_at(const paired_map *map, int x, int y)
{
    x = x < 0 ? 0 : x >= map->width ? map->width - 1 : x;
    y = y < 0 ? 0 : y >= map->height ? map->height - 1 : y;
    const float *t = map->texels + 3 * ((size_t)y * (size_t)map->width + (size_t)x);
    const int code = (int)(bits_of(t[0]) % (1u << NORMAL_BITS));
    return (texel){paired_accessibility(t[0]), (double)t[1], {code >> AXIS_BITS, code % (1 << AXIS_BITS)}};
}

/* Lambert's projection of a unit normal, whose radius is 2 sin(angle / 2), in steps; `out_low` and `out_high` differ
 * where float arithmetic could decide either way. */
static void project(const double normal[3], double step, int out_low[2], int out_high[2])
{
    const double angle = acos(fmax(fmin(normal[2], 1.0), -1.0)), across = hypot(normal[0], normal[1]);
    for (int i = 0; i < 2; ++i) {
        const double at = (across > 0.0 ? 2.0 * sin(0.5 * angle) * normal[i] / across : 0.0) / step + 15.5;
        out_low[i] = (int)fmin(fmax(floor(at - 1e-4), 0.0), 31.0);
        out_high[i] = (int)fmin(fmax(floor(at + 1e-4), 0.0), 31.0);
    }
}

/* What a length about a surface comes to in the linear quantity: d(1 / t) = dt / t^2. */
static double in_linear(double length, double linear, bool orthographic)
{
    return orthographic ? length : length * linear * linear;
}

typedef enum truth { NO, YES, MAYBE } truth;

static truth is_below(double value, double error, double limit)
{
    return value + error < limit ? YES : value - error >= limit ? NO : MAYBE;
}

/* Whether b lies on the line through a and c. Differences of equal floats are exact, sky's among them. */
static truth on_line(double a, double b, double c, double tolerance)
{
    const double bend = fabs(a - 2.0 * b + c);
    const double error = bend > 0.0 ? 3.0 * 0x1p-24 * (fabs(a) + 2.0 * fabs(b) + fabs(c)) : 0.0;
    return is_below(bend, error, tolerance);
}

static truth is_near(double a, double b, double limit)
{
    return is_below(fabs(a - b), 4.0 * 0x1p-24 * (fabs(a) + fabs(b)), limit);
}

/* Whether the surface does not turn away from the eye on the way (-1, 0 or 1 in x and y) to a tap. */
static truth joins(const int center[2], const int tap[2], int way_x, int way_y, const pass_constants *constants)
{
    const int x = tap[0] - center[0], y = tap[1] - center[1];
    if (x * way_x + y * way_y <= 0)
        return YES; /* alike, or a hollow */
    return is_below(hypot(x, y) * constants->normal_step, 1e-6, constants->chord);
}

/* Calls `result` for each way in which the tests that may come out both ways can. */
static void each_outcome(truth *tests, int count, double (*result)(const truth *tests, const void *user),
                         const void *user, double *low, double *high)
{
    for (int i = 0; i < count; ++i)
        if (tests[i] == MAYBE) {
            tests[i] = NO;
            each_outcome(tests, count, result, user, low, high);
            tests[i] = YES;
            each_outcome(tests, count, result, user, low, high);
            tests[i] = MAYBE;
            return;
        }
    const double value = result(tests, user);
    *low = fmin(*low, value);
    *high = fmax(*high, value);
}

enum {
    LINE_BEFORE,
    LINE,
    LINE_AFTER,
    JOINS_BEFORE_2,
    JOINS_BEFORE,
    JOINS_AFTER,
    JOINS_AFTER_2,
    NEAR_BEFORE,
    NEAR_AFTER,
    TESTS
};

static double blurred(const truth *t, const void *user)
{
    const texel *taps = user;
    double weights[5] = {0.0, 0.0, 1.0, 0.0, 0.0};
    weights[0] = t[LINE_BEFORE] && t[JOINS_BEFORE_2] ? 0.5 : 0.0; /* half of it lies beyond the tile */
    weights[1] = t[JOINS_BEFORE] && (t[LINE_BEFORE] || t[LINE]) ? 1.0 : 0.0;
    weights[3] = t[JOINS_AFTER] && (t[LINE_AFTER] || t[LINE]) ? 1.0 : 0.0;
    weights[4] = t[LINE_AFTER] && t[JOINS_AFTER_2] ? 0.5 : 0.0;
    if (weights[1] + weights[3] == 0.0) {
        weights[1] = t[JOINS_BEFORE] && t[NEAR_BEFORE] ? 1.0 : 0.0;
        weights[3] = t[JOINS_AFTER] && t[NEAR_AFTER] ? 1.0 : 0.0;
    }
    double sum = 0.0, total = 0.0;
    for (int i = 0; i < 5; ++i) {
        sum += weights[i] * taps[i].value;
        total += weights[i];
    }
    return sum / total;
}

void planar_blur_model(const paired_map *map, bool horizontal, bool orthographic, const pass_constants *constants,
                       int x, int y, double *out_low, double *out_high)
{
    texel taps[5];
    for (int i = 0; i < 5; ++i)
        taps[i] = texel_at(map, horizontal ? x + i - 2 : x, horizontal ? y : y + i - 2);
    const double tolerance = in_linear(constants->tolerance, taps[2].linear, orthographic);
    const double near = in_linear(constants->near, taps[2].linear, orthographic);
    truth tests[TESTS];
    for (int i = 0; i < 3; ++i)
        tests[LINE_BEFORE + i] = on_line(taps[i].linear, taps[i + 1].linear, taps[i + 2].linear, tolerance);
    for (int i = 0, test = JOINS_BEFORE_2; i < 5; ++i)
        if (i != 2) {
            const int way = i < 2 ? -1 : 1;
            tests[test++] =
                joins(taps[2].normal, taps[i].normal, horizontal ? way : 0, horizontal ? 0 : way, constants);
        }
    tests[NEAR_BEFORE] = is_near(taps[1].linear, taps[2].linear, near);
    tests[NEAR_AFTER] = is_near(taps[3].linear, taps[2].linear, near);
    *out_low = HUGE_VAL;
    *out_high = -HUGE_VAL;
    each_outcome(tests, TESTS, blurred, taps, out_low, out_high);
}

/* Joins 0 to 3, near 4 to 7, on the plane of all four 8; then whether each may be the nearest. */
enum { JOINS_0, NEAR_0 = 4, ON_PLANE = 8, UPSAMPLE_TESTS };

typedef struct four {
    texel at[4];
    double apart[4], error, around_crease;
    bool is_low; /* which end of the interval is wanted where several may be the nearest */
} four;

static double nearest(const truth *t, const four *f)
{
    double off[4], least = HUGE_VAL, value = f->is_low ? HUGE_VAL : -HUGE_VAL;
    for (int i = 0; i < 4; ++i) {
        off[i] = f->apart[i] * (t[JOINS_0 + i] ? 1.0 : f->around_crease);
        least = fmin(least, off[i]);
    }
    for (int i = 0; i < 4; ++i)
        if (off[i] - least <= f->error * ((t[JOINS_0 + i] ? 1.0 : f->around_crease) + 1.0))
            value = f->is_low ? fmin(value, f->at[i].value) : fmax(value, f->at[i].value);
    return value;
}

static double upsampled(const truth *t, const void *user)
{
    const four *f = user;
    double sum = 0.0, total = 0.0;
    bool all = t[ON_PLANE];
    for (int i = 0; i < 4; ++i)
        all = all && t[JOINS_0 + i];
    for (int i = 0; i < 4; ++i)
        if (all || (t[JOINS_0 + i] && t[NEAR_0 + i])) {
            sum += f->at[i].value;
            total += 1.0;
        }
    return total > 0.0 ? sum / total : nearest(t, f);
}

/* As joins, from a pixel whose steps are not certain. */
static truth joins_either(const int low[2], const int high[2], const int tap[2], int way_x, int way_y,
                          const pass_constants *constants)
{
    truth all = joins(low, tap, way_x, way_y, constants);
    for (int i = 1; i < 4; ++i) {
        const int corner[2] = {i % 2 ? high[0] : low[0], i / 2 ? high[1] : low[1]};
        all = joins(corner, tap, way_x, way_y, constants) == all ? all : MAYBE;
    }
    return all;
}

void upsample_model(const paired_map *half, bool orthographic, const pass_constants *constants, const full_pixel *own,
                    int x, int y, double *out_low, double *out_high)
{
    /* A half-size texel stands for the full-size one of twice its index. */
    four f = {.error = 8.0 * 0x1p-24 * fabs(own->linear), .around_crease = constants->around_crease};
    truth tests[UPSAMPLE_TESTS];
    double mean = 0.0;
    int low[2], high[2];
    project(own->normal, constants->normal_step, low, high);
    for (int i = 0; i < 4; ++i) {
        const int way_x = (i % 2 ? 1 : -1) * (x % 2), way_y = (i / 2 ? 1 : -1) * (y % 2);
        f.at[i] = texel_at(half, x / 2 + (i % 2) * (x % 2), y / 2 + (i / 2) * (y % 2));
        f.apart[i] = fabs(f.at[i].linear - own->linear);
        tests[JOINS_0 + i] = joins_either(low, high, f.at[i].normal, way_x, way_y, constants);
        tests[NEAR_0 + i] = is_below(f.apart[i], f.error, in_linear(constants->near, own->linear, orthographic));
        mean += 0.25 * (f.at[i].linear - own->linear);
    }
    /* Where all four face one way, the pixel is taken to face it too. */
    const int *first = f.at[0].normal;
    bool all_alike = true;
    for (int i = 1; i < 4; ++i)
        all_alike = all_alike && f.at[i].normal[0] == first[0] && f.at[i].normal[1] == first[1];
    for (int i = 0; all_alike && i < 4; ++i)
        tests[JOINS_0 + i] = YES;
    tests[ON_PLANE] = is_below(fabs(mean), f.error + 4.0 * 0x1p-24 * fabs(mean),
                               in_linear(constants->tolerance, own->linear, orthographic));
    *out_low = HUGE_VAL;
    *out_high = -HUGE_VAL;
    for (int i = 0; i < 2; ++i) {
        f.is_low = i == 0;
        each_outcome(tests, UPSAMPLE_TESTS, upsampled, &f, out_low, out_high);
    }
}
