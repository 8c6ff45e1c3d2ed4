/* SPDX-License-Identifier: MIT */
#include "horizon_passes.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void paired_free(paired_map *map)
{
    free(map->texels);
}

/* The parts of a texel's red channel. */
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

void paired_set(float *red, double value)
{
    const float stored = (float)value;
    const uint32_t bits = bits_of(stored) >> NORMAL_BITS << NORMAL_BITS | bits_of(*red) % (1u << NORMAL_BITS);
    memcpy(red, &bits, sizeof *red);
}

static texel texel_at(const paired_map *map, int x, int y)
{
    x = x < 0 ? 0 : x >= map->width ? map->width - 1 : x;
    y = y < 0 ? 0 : y >= map->height ? map->height - 1 : y;
    const float *t = map->texels + 3 * ((size_t)y * (size_t)map->width + (size_t)x);
    const int code = (int)(bits_of(t[0]) % (1u << NORMAL_BITS));
    return (texel){paired_accessibility(t[0]), (double)t[1], {code >> AXIS_BITS, code % (1 << AXIS_BITS)}};
}

/* Lambert's projection of a unit normal (radius 2 sin(angle / 2)), in the steps that a texel stores. */
static void project(const double normal[3], double step, double out[2])
{
    const double angle = acos(fmax(fmin(normal[2], 1.0), -1.0)), across = hypot(normal[0], normal[1]);
    for (int i = 0; i < 2; ++i)
        out[i] = (across > 0.0 ? 2.0 * sin(0.5 * angle) * normal[i] / across : 0.0) / step + 15.0;
}

/* A length near a surface, converted to the linear quantity: d(1 / t) = dt / t^2. */
static double in_linear(double length, double linear, bool orthographic)
{
    return orthographic ? length : length * linear * linear;
}

/* `steps` steps of the depth format, converted to the linear quantity. */
static double step_in_linear(double steps, double linear, bool orthographic, const pass_constants *c)
{
    const double t = orthographic ? linear : 1.0 / linear;
    return steps * in_linear(c->depth_step[0] + t * (c->depth_step[1] + t * c->depth_step[2]), linear, orthographic);
}

typedef enum truth { NO, YES, MAYBE } truth;

static truth is_below(double value, double error, double limit)
{
    return value + error < limit * (1.0 - 1e-6) ? YES : value - error >= limit * (1.0 + 1e-6) ? NO : MAYBE;
}

/* Whether b lies on the line through a and c. Differences of equal floats are exact, and so are sky's. */
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

/* Whether the surface does not turn away from the eye on the way (-1, 0 or 1 in x and y) to a tap. `error` bounds the
 * error of the steps of `from`. */
static truth joins(const double from[2], const int tap[2], int way_x, int way_y, double error,
                   const pass_constants *constants)
{
    const double x = tap[0] - from[0], y = tap[1] - from[1], along = x * way_x + y * way_y;
    if (along <= -2.0 * error || (error == 0.0 && along == 0.0))
        return YES; /* similar normals, or a hollow */
    const truth close = is_below(hypot(x, y), error + 1e-6, constants->chord / constants->normal_step);
    return along < 2.0 * error && close == NO ? MAYBE : close;
}

/* Calls `result` once for each outcome of the tests that float arithmetic leaves open. */
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

/* Five taps in a row, how much darker than its neighbours the middle one may be if nothing joins it, and as in
 * pass_constants. */
typedef struct row {
    texel taps[5];
    bool are_rays;
    double alone, alike, prior;
} row;

static double blurred(const truth *t, const void *user)
{
    const row *r = user;
    const texel *taps = r->taps;
    double weights[5] = {0.0, 0.0, 1.0, 0.0, 0.0};
    weights[0] = t[LINE_BEFORE] && t[JOINS_BEFORE_2] ? 0.5 : 0.0; /* half of it lies outside the tile */
    weights[1] = t[JOINS_BEFORE] && (t[LINE_BEFORE] || t[LINE]) ? 1.0 : 0.0;
    weights[3] = t[JOINS_AFTER] && (t[LINE_AFTER] || t[LINE]) ? 1.0 : 0.0;
    weights[4] = t[LINE_AFTER] && t[JOINS_AFTER_2] ? 0.5 : 0.0;
    if (weights[1] + weights[3] == 0.0) {
        weights[1] = t[JOINS_BEFORE] && t[NEAR_BEFORE] ? 1.0 : 0.0;
        weights[3] = t[JOINS_AFTER] && t[NEAR_AFTER] ? 1.0 : 0.0;
    }
    const bool is_alone = weights[1] + weights[3] == 0.0;
    double sum = 0.0, total = 0.0, joined = 0.0;
    for (int i = 0; i < 5; ++i)
        joined += weights[i];
    const double lowest = !r->are_rays && joined < 4.0 ? 0.0 : -1.0; /* a mean over slices needs all taps */
    for (int i = 0; i < 5; ++i) {
        const double off = taps[i].value - taps[2].value;
        if (r->alike > 0.0 && taps[2].value >= 0.0)
            weights[i] *= fmax(1.0 - off * off / (r->alike * r->alike), 0.0);
        if (r->are_rays && taps[i].value < 0.0)
            continue;
        sum += weights[i] * fmax(taps[i].value, lowest);
        total += weights[i];
    }
    if (total <= 0.0)
        return -1.0;
    double mean = sum / total;
    if (r->prior > 0.0) /* the prior's taps have no difference, and all 4 taps outweigh it */
        mean = 0.5 + (mean - 0.5) * joined / (joined + r->prior) * (4.0 + r->prior) / 4.0;
    if (r->are_rays && taps[2].value < 0.0)
        return mean;
    return fmax(mean, is_alone ? fmin(taps[1].value, taps[3].value) - r->alone : 0.0);
}

void planar_blur_model(const paired_map *map, bool horizontal, bool orthographic, const pass_constants *constants,
                       int x, int y, double *out_low, double *out_high)
{
    row r = {.are_rays = constants->are_rays,
             .alone = constants->alone,
             .alike = constants->alike,
             .prior = constants->prior};
    texel *taps = r.taps;
    const int apart = constants->apart > 0 ? constants->apart : 1;
    for (int i = 0; i < 5; ++i)
        taps[i] = texel_at(map, horizontal ? x + (i - 2) * apart : x, horizontal ? y : y + (i - 2) * apart);
    const double tolerance = fmax(in_linear(constants->tolerance, taps[2].linear, orthographic),
                                  step_in_linear(1.0, taps[2].linear, orthographic, constants));
    const double near = in_linear(constants->near, taps[2].linear, orthographic);
    const double own[2] = {taps[2].normal[0], taps[2].normal[1]};
    truth tests[TESTS];
    for (int i = 0; i < 3; ++i)
        tests[LINE_BEFORE + i] = on_line(taps[i].linear, taps[i + 1].linear, taps[i + 2].linear, tolerance);
    for (int i = 0, test = JOINS_BEFORE_2; i < 5; ++i)
        if (i != 2) {
            const int way = i < 2 ? -1 : 1;
            tests[test++] = joins(own, taps[i].normal, horizontal ? way : 0, horizontal ? 0 : way, 0.0, constants);
        }
    tests[NEAR_BEFORE] = is_near(taps[1].linear, taps[2].linear, near);
    tests[NEAR_AFTER] = is_near(taps[3].linear, taps[2].linear, near);
    *out_low = HUGE_VAL;
    *out_high = -HUGE_VAL;
    each_outcome(tests, TESTS, blurred, &r, out_low, out_high);
}

enum { ON_ROW, ON_COLUMN, JOINS_AROUND, WIDE_TESTS = JOINS_AROUND + 4 };

/* The fifth tap is the pixel's own; opposite pairs are 0 and 1, 2 and 3. */
typedef struct cross {
    texel taps[5];
    double alike; /* difference from which on taps count no more */
} cross;

static double blurred_wide(const truth *t, const void *user)
{
    const cross *c = user;
    const texel *taps = c->taps;
    double sum = taps[4].value / 4.0, total = 1.0 / 4.0;
    for (int i = 0; i < 4; ++i)
        if (t[i < 2 ? ON_ROW : ON_COLUMN] && t[JOINS_AROUND + i]) {
            const int opposite = t[JOINS_AROUND + (i ^ 1)] ? i ^ 1 : i;
            const double apart = ((taps[i].value + taps[opposite].value) / 2.0 - taps[4].value) / c->alike;
            const double weight = 3.0 / 16.0 * fmax(1.0 - apart * apart, 0.0);
            sum += weight * taps[i].value;
            total += weight;
        }
    return sum / total;
}

void wide_blur_model(const paired_map *map, bool orthographic, const pass_constants *constants, int x, int y,
                     double *out_low, double *out_high)
{
    static const int ways[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    cross c = {.alike = constants->wide_alike};
    texel *taps = c.taps;
    taps[4] = texel_at(map, x, y);
    const double tolerance = fmax(in_linear(constants->tolerance, taps[4].linear, orthographic),
                                  step_in_linear(1.0, taps[4].linear, orthographic, constants));
    const double own[2] = {taps[4].normal[0], taps[4].normal[1]};
    truth tests[WIDE_TESTS];
    for (int i = 0; i < 4; ++i) {
        taps[i] = texel_at(map, x + 3 * ways[i][0], y + 3 * ways[i][1]);
        tests[JOINS_AROUND + i] = joins(own, taps[i].normal, ways[i][0], ways[i][1], 0.0, constants);
    }
    for (int i = 0; i < 2; ++i) {
        /* Towards the eye, distance falls and its inverse grows. */
        const double before = taps[2 * i].linear, b = taps[4].linear, after = taps[2 * i + 1].linear;
        const bool hollow = orthographic ? before + after < 2.0 * b : before + after > 2.0 * b;
        tests[ON_ROW + i] =
            on_line(before, b, after, hollow ? in_linear(constants->hollow, b, orthographic) : tolerance);
    }
    *out_low = HUGE_VAL;
    *out_high = -HUGE_VAL;
    each_outcome(tests, WIDE_TESTS, blurred_wide, &c, out_low, out_high);
}

/* Joins 0 to 3, near 4 to 7, on the plane of all four 8; the rest: whether each may be the nearest. */
enum { JOINS_0, NEAR_0 = 4, ON_PLANE = 8, UPSAMPLE_TESTS };

typedef struct four {
    texel at[4];
    double apart[4], error;
    bool is_low; /* the end of the interval that is wanted if several may be the nearest */
} four;

static double nearest(const truth *t, const four *f)
{
    double least = HUGE_VAL, value = f->is_low ? HUGE_VAL : -HUGE_VAL;
    for (int i = 0; i < 4; ++i)
        least = t[JOINS_0 + i] ? fmin(least, f->apart[i]) : least;
    for (int i = 0; i < 4; ++i)
        if (t[JOINS_0 + i] && f->apart[i] - least <= 2.0 * f->error)
            value = f->is_low ? fmin(value, f->at[i].value) : fmax(value, f->at[i].value);
    return value;
}

static double upsampled(const truth *t, const void *user)
{
    const four *f = user;
    double sum = 0.0, all = 0.0, count = 0.0;
    bool any_joins = false;
    for (int i = 0; i < 4; ++i) {
        any_joins = any_joins || t[JOINS_0 + i];
        all += 0.25 * f->at[i].value;
        if (t[JOINS_0 + i] && (t[ON_PLANE] || t[NEAR_0 + i])) {
            sum += f->at[i].value;
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : any_joins ? nearest(t, f) : all;
}

/* Which of the four texels count as not turned away, by the lines through them. */
static void joins_by_lines(const four *f, bool orthographic, const pass_constants *constants, const full_pixel *own,
                           double tolerance, truth out[4])
{
    double fall[4], error[4], least = HUGE_VAL, least_error = 0.0;
    for (int i = 0; i < 4; ++i) {
        const double off = 2.0 * f->at[i].linear - own->beyond[i] - own->linear;
        fall[i] = orthographic ? -off : off;
        error[i] = 0x1p-22 * (2.0 * fabs(f->at[i].linear) + fabs(own->beyond[i]) + fabs(own->linear));
        least = fmin(least, fabs(off));
        least_error = fmax(least_error, error[i]);
    }
    for (int i = 0; i < 4; ++i)
        out[i] = is_below(fall[i], error[i] + constants->fall * least_error, constants->fall * least + tolerance);
}

void upsample_model(const paired_map *half, bool orthographic, const pass_constants *constants, const full_pixel *own,
                    int x, int y, double *out_low, double *out_high)
{
    /* A half-size texel stands for the full-size texel of twice its index. */
    four f = {.error = 8.0 * 0x1p-24 * fabs(own->linear)};
    truth tests[UPSAMPLE_TESTS];
    double mean = 0.0, normal[2];
    const double tolerance = fmax(in_linear(constants->tolerance, own->linear, orthographic),
                                  step_in_linear(0.5, own->linear, orthographic, constants));
    if (own->normal)
        project(own->normal, constants->normal_step, normal);
    for (int i = 0; i < 4; ++i) {
        const int way_x = (i % 2 ? 1 : -1) * (x % 2), way_y = (i / 2 ? 1 : -1) * (y % 2);
        f.at[i] = texel_at(half, x / 2 + (i % 2) * (x % 2), y / 2 + (i / 2) * (y % 2));
        f.apart[i] = fabs(f.at[i].linear - own->linear);
        if (own->normal)
            tests[JOINS_0 + i] = way_x || way_y ? joins(normal, f.at[i].normal, way_x, way_y, 1e-2, constants) : YES;
        tests[NEAR_0 + i] = is_below(f.apart[i], f.error, in_linear(constants->near, own->linear, orthographic));
        mean += 0.25 * (f.at[i].linear - own->linear);
    }
    if (!own->normal)
        joins_by_lines(&f, orthographic, constants, own, tolerance, tests + JOINS_0);
    /* If all four face one way, the pixel is taken to face the same way. */
    const int *first = f.at[0].normal;
    bool all_alike = true;
    for (int i = 1; i < 4; ++i)
        all_alike = all_alike && f.at[i].normal[0] == first[0] && f.at[i].normal[1] == first[1];
    for (int i = 0; all_alike && i < 4; ++i)
        tests[JOINS_0 + i] = YES;
    tests[ON_PLANE] = is_below(fabs(mean), f.error + 4.0 * 0x1p-24 * fabs(mean), tolerance);
    *out_low = HUGE_VAL;
    *out_high = -HUGE_VAL;
    for (int i = 0; i < 2; ++i) {
        f.is_low = i == 0;
        each_outcome(tests, UPSAMPLE_TESTS, upsampled, &f, out_low, out_high);
    }
}
