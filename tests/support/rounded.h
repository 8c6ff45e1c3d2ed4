/* SPDX-License-Identifier: MIT
 *
 * A number that a float program computes: its exact value, and a bound on its rounding error that is carried from
 * operation to operation (running error analysis, N. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd
 * ed., section 3.3). Each operation is as exact as GLSL requires from 4.10 on: half a unit in the last place; division
 * and square roots two and a half.
 */
#pragma once

#include <math.h>

static const double ROUNDING = 0x1p-24;

typedef struct rounded {
    double v, e;
} rounded;

static inline rounded exactly(double v)
{
    return (rounded){v, 0.0};
}

/* A constant or an input, rounded to float once. */
static inline rounded once_rounded(double v)
{
    return (rounded){v, ROUNDING * fabs(v)};
}

static inline rounded add(rounded a, rounded b)
{
    const double v = a.v + b.v;
    return (rounded){v, a.e + b.e + ROUNDING * fabs(v)};
}

static inline rounded subtract(rounded a, rounded b)
{
    return add(a, (rounded){-b.v, b.e});
}

static inline rounded multiply(rounded a, rounded b)
{
    const double v = a.v * b.v;
    return (rounded){v, fabs(a.v) * b.e + fabs(b.v) * a.e + a.e * b.e + ROUNDING * fabs(v)};
}

/* b must certainly differ from 0; otherwise the error is infinite. */
static inline rounded divide(rounded a, rounded b)
{
    const double v = a.v / b.v, least = fabs(b.v) - b.e;
    return (rounded){v, least > 0.0 ? (a.e + fabs(v) * b.e) / least + 5.0 * ROUNDING * fabs(v) : HUGE_VAL};
}

static inline rounded square_root(rounded a)
{
    const double v = sqrt(fmax(a.v, 0.0)), low = sqrt(fmax(a.v - a.e, 0.0)), high = sqrt(fmax(a.v + a.e, 0.0));
    return (rounded){v, fmax(v - low, high - v) + 5.0 * ROUNDING * high};
}

/* max(a, least), if `least` is exact. */
static inline rounded at_least(rounded a, double least)
{
    return a.v + a.e < least ? exactly(least) : (rounded){fmax(a.v, least), a.e};
}

static inline rounded clamp_to(rounded a, double least, double most)
{
    return a.v - a.e > most ? exactly(most) : at_least((rounded){fmin(a.v, most), a.e}, least);
}

/* Bounds of a quantity. */
typedef struct interval {
    double low, high;
} interval;

static inline interval bounds(rounded a)
{
    return (interval){a.v - a.e, a.v + a.e};
}

static inline rounded middle(interval a)
{
    return (rounded){0.5 * (a.low + a.high), 0.5 * (a.high - a.low)};
}
