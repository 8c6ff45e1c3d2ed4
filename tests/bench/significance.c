/* SPDX-License-Identifier: MIT
 *
 * Welch's t-test of two sample sets.
 */
#include "significance.h"

#include <math.h>

sample_set sample_set_begin(size_t pixels, double *sum, double *sum2)
{
    return (sample_set){.pixels = pixels, .sum = sum, .sum2 = sum2};
}

void sample_set_add(sample_set *s, const float *picture)
{
    for (size_t i = 0; i < s->pixels; i++) {
        s->sum[i] += (double)picture[i];
        s->sum2[i] += (double)picture[i] * (double)picture[i];
    }
    s->count++;
}

double student_p(double t, double freedom)
{
    /* With t = sqrt(freedom) tan(a) the density is cos(a)^(freedom - 1), up to a factor. Simpson's rule. */
    enum { STEPS = 2000 };
    const double half_pi = 1.57079632679489662, from = atan(fabs(t) / sqrt(freedom));
    double tail = 0, whole = 0;
    for (int i = 0; i <= STEPS; i++) {
        const double weight = i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2;
        tail += weight * pow(cos(from + (half_pi - from) * i / STEPS), freedom - 1);
        whole += weight * pow(cos(half_pi * i / STEPS), freedom - 1);
    }
    return tail * (half_pi - from) / (whole * half_pi);
}

/* Square of the standard error of the mean; 0 for one picture. */
static double error2(const sample_set *s, size_t i, double *out_mean)
{
    const double n = s->count, mean = s->sum[i] / n;
    *out_mean = mean;
    return s->count > 1 ? fmax(s->sum2[i] / n - mean * mean, 0) / (n - 1) : 0;
}

double significance(const sample_set *estimate, double scale, const sample_set *reference, double step)
{
    double least = 1;
    for (size_t i = 0; i < estimate->pixels; i++) {
        double mean, expected;
        const double a = scale * scale * error2(estimate, i, &mean), b = error2(reference, i, &expected);
        const double noise2 = a + b + step * step, difference = scale * mean - expected;
        const double parts =
            a * a / (estimate->count - 1) + (reference->count > 1 ? b * b / (reference->count - 1) : 0);
        const double freedom = parts > 0 ? (a + b) * (a + b) / parts : estimate->count - 1;
        const double t = difference / sqrt(noise2);
        if (fabs(t) > 3) /* nearer ones can't be the least of many */
            least = fmin(least, student_p(t, freedom));
    }
    return -expm1((double)estimate->pixels * log1p(-fmin(least, 1 - 1e-12)));
}
