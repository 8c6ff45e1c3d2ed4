/* SPDX-License-Identifier: MIT */
#include "horizon_passes.h"

#include <math.h>
#include <stddef.h>

enum { ACCESSIBILITY, LINEAR };

static double texel(const paired_map *map, int x, int y, int channel)
{
    x = x < 0 ? 0 : x >= map->width ? map->width - 1 : x;
    y = y < 0 ? 0 : y >= map->height ? map->height - 1 : y;
    return (double)map->texels[3 * ((size_t)y * (size_t)map->width + (size_t)x) + (size_t)channel];
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

/* Weights of the two taps on one side, for both ways of what is open; a tap two steps off counts half. */
typedef struct weights {
    double near, far;
} weights;

static weights side(bool center_line, bool outer_line)
{
    return (weights){outer_line || center_line ? 1.0 : 0.0, outer_line ? 0.5 : 0.0};
}

void planar_blur_model(const paired_map *map, bool horizontal, bool orthographic, double tolerance, int x, int y,
                       double *out_low, double *out_high)
{
    double value[5], linear[5];
    for (int i = 0; i < 5; ++i) {
        value[i] = texel(map, horizontal ? x + i - 2 : x, horizontal ? y : y + i - 2, ACCESSIBILITY);
        linear[i] = texel(map, horizontal ? x + i - 2 : x, horizontal ? y : y + i - 2, LINEAR);
    }
    const double limit = in_linear(tolerance, linear[2], orthographic);
    truth lines[3]; /* about the tap before, the pixel, the tap after */
    for (int i = 0; i < 3; ++i)
        lines[i] = on_line(linear[i], linear[i + 1], linear[i + 2], limit);
    *out_low = HUGE_VAL;
    *out_high = -HUGE_VAL;
    for (int k = 0; k < 8; ++k) {
        bool line[3], possible = true;
        for (int i = 0; i < 3; ++i) {
            line[i] = k >> i & 1;
            possible = possible && (lines[i] == MAYBE || (lines[i] == YES) == line[i]);
        }
        if (!possible)
            continue;
        const weights before = side(line[1], line[0]), after = side(line[1], line[2]);
        const double sum =
            value[2] + before.near * value[1] + before.far * value[0] + after.near * value[3] + after.far * value[4];
        const double result = sum / (1.0 + before.near + before.far + after.near + after.far);
        *out_low = fmin(*out_low, result);
        *out_high = fmax(*out_high, result);
    }
}

void upsample_model(const paired_map *half, bool orthographic, double tolerance, double own, int x, int y,
                    double *out_low, double *out_high)
{
    /* A half-size texel stands for the full-size one of twice its index. */
    double value[4], apart[4], mean_value = 0.0, mean_linear = 0.0, least = HUGE_VAL;
    for (int i = 0; i < 4; ++i) {
        const int tx = x / 2 + (i % 2) * (x % 2), ty = y / 2 + (i / 2) * (y % 2);
        const double linear = texel(half, tx, ty, LINEAR);
        value[i] = texel(half, tx, ty, ACCESSIBILITY);
        apart[i] = fabs(linear - own);
        least = fmin(least, apart[i]);
        mean_value += 0.25 * value[i];
        mean_linear += 0.25 * linear;
    }
    const double error = 8.0 * 0x1p-24 * fabs(own);
    const truth plane = is_below(fabs(mean_linear - own), error + 2.0 * 0x1p-24 * fabs(mean_linear),
                                 in_linear(tolerance, own, orthographic));
    *out_low = plane == NO ? HUGE_VAL : mean_value;
    *out_high = plane == NO ? -HUGE_VAL : mean_value;
    for (int i = 0; plane != YES && i < 4; ++i)
        if (apart[i] <= least + 2.0 * error) {
            *out_low = fmin(*out_low, value[i]);
            *out_high = fmax(*out_high, value[i]);
        }
}
