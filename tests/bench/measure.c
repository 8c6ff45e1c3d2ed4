/* SPDX-License-Identifier: MIT
 *
 * Sums first, figures from them later, so that views can be merged and exponents tried without the pictures.
 */
#include "measure.h"

#include <math.h>
#include <stdlib.h>

static int bin_of(double value)
{
    const int bin = (int)(value * MEASURE_BINS);
    return bin < 0 ? 0 : bin >= MEASURE_BINS ? MEASURE_BINS - 1 : bin;
}

void error_add(error_sum *e, const float *picture, const float *truth, const uint8_t *classes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (classes[i] == PIXEL_NONE)
            continue;
        e->weight++;
        if (!isfinite(picture[i])) {
            e->nonfinite++;
            continue;
        }
        const double error = (double)picture[i] - (double)truth[i];
        e->sum += error;
        e->sum2 += error * error;
        e->histogram[bin_of(fabs(error))]++;
    }
}

void error_merge(error_sum *e, const error_sum *from)
{
    const double scale = from->weight > 0 ? 1 / from->weight : 0;
    e->weight += from->weight * scale;
    e->nonfinite += from->nonfinite * scale;
    e->sum += from->sum * scale;
    e->sum2 += from->sum2 * scale;
    for (int i = 0; i < MEASURE_BINS; i++)
        e->histogram[i] += from->histogram[i] * scale;
}

error_measure error_finish(const error_sum *e)
{
    const double finite = e->weight - e->nonfinite;
    if (!(finite > 0))
        return (error_measure){.nonfinite_share = e->weight > 0 ? 1 : 0};
    error_measure m = {
        .rmse = sqrt(e->sum2 / finite), .mean = e->sum / finite, .nonfinite_share = e->nonfinite / e->weight};
    double below = 0;
    int bin = 0;
    while (bin < MEASURE_BINS - 1 && below + e->histogram[bin] < 0.95 * finite)
        below += e->histogram[bin++];
    m.p95 = (bin + 1.0) / MEASURE_BINS;
    return m;
}

void fit_add(fit_sum *f, const float *picture, const float *truth, const uint8_t *classes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (classes[i] == PIXEL_NONE || !isfinite(picture[i]))
            continue;
        const int c = classes[i], bin = bin_of((double)picture[i]);
        const double t = (double)truth[i];
        f->weight[c][bin]++;
        f->picture[c][bin] += (double)picture[i];
        f->truth[c][bin] += t;
        f->truth2[c][bin] += t * t;
    }
}

void fit_merge(fit_sum *f, const fit_sum *from)
{
    double weight = 0;
    for (int c = 0; c < PIXEL_CLASSES; c++)
        for (int i = 0; i < MEASURE_BINS; i++)
            weight += from->weight[c][i];
    const double scale = weight > 0 ? 1 / weight : 0;
    for (int c = 0; c < PIXEL_CLASSES; c++) {
        for (int i = 0; i < MEASURE_BINS; i++) {
            f->weight[c][i] += from->weight[c][i] * scale;
            f->picture[c][i] += from->picture[c][i] * scale;
            f->truth[c][i] += from->truth[c][i] * scale;
            f->truth2[c][i] += from->truth2[c][i] * scale;
        }
    }
}

typedef struct moments {
    double weight, sum, sum2;
} moments;

static moments error_moments(const fit_sum *f, double exponent, int of_class)
{
    moments m = {0, 0, 0};
    for (int c = 0; c < PIXEL_CLASSES; c++) {
        for (int i = 0; i < MEASURE_BINS; i++) {
            const double w = f->weight[c][i];
            if ((of_class != FIT_ALL && of_class != c) || !(w > 0))
                continue;
            const double a = pow(f->picture[c][i] / w, exponent);
            m.weight += w;
            m.sum += w * a - f->truth[c][i];
            m.sum2 += w * a * a - 2 * a * f->truth[c][i] + f->truth2[c][i];
        }
    }
    return m;
}

double fit_rmse(const fit_sum *f, double exponent, int of_class)
{
    const moments m = error_moments(f, exponent, of_class);
    return m.weight > 0 ? sqrt(fmax(m.sum2 / m.weight, 0)) : 0;
}

double fit_mean(const fit_sum *f, double exponent)
{
    const moments m = error_moments(f, exponent, FIT_ALL);
    return m.weight > 0 ? m.sum / m.weight : 0;
}

double fit_exponent(const fit_sum *f)
{
    /* A coarse scan finds the valley, the golden section its floor. */
    enum { SCAN = 16 };
    const double least = 0.1, most = 8, ratio = pow(most / least, 1.0 / (SCAN - 1));
    int best = 0;
    double best_rmse = INFINITY;
    for (int i = 0; i < SCAN; i++) {
        const double rmse = fit_rmse(f, least * pow(ratio, i), FIT_ALL);
        if (rmse < best_rmse) {
            best_rmse = rmse;
            best = i;
        }
    }
    const double golden = 0.6180339887498949;
    double low = least * pow(ratio, best > 0 ? best - 1 : 0);
    double high = least * pow(ratio, best < SCAN - 1 ? best + 1 : best);
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double rmse_a = fit_rmse(f, a, FIT_ALL), rmse_b = fit_rmse(f, b, FIT_ALL);
    while (high - low > 1e-4) {
        if (rmse_a < rmse_b) {
            high = b;
            b = a;
            rmse_b = rmse_a;
            a = high - golden * (high - low);
            rmse_a = fit_rmse(f, a, FIT_ALL);
        } else {
            low = a;
            a = b;
            rmse_a = rmse_b;
            b = low + golden * (high - low);
            rmse_b = fit_rmse(f, b, FIT_ALL);
        }
    }
    return (low + high) / 2;
}
