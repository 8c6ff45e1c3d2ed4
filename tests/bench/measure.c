/* SPDX-License-Identifier: MIT
 *
 * Errors, and the exponent that fits best.
 */
#include "measure.h"

#include <math.h>
#include <stdlib.h>

static int bin_of(double value)
{
    const int bin = (int)(value * MEASURE_BINS);
    return bin < 0 ? 0 : bin >= MEASURE_BINS ? MEASURE_BINS - 1 : bin;
}

static double percentile(const double histogram[MEASURE_BINS], double below)
{
    double sum = 0;
    int bin = 0;
    while (bin < MEASURE_BINS - 1 && sum + histogram[bin] < below)
        sum += histogram[bin++];
    return (bin + 1.0) / MEASURE_BINS;
}

error_measure measure_error(const float *picture, const float *truth, const uint8_t *classes, size_t count)
{
    double histogram[MEASURE_BINS] = {0}, pixels[PIXEL_EDGE + 1] = {0}, squares[PIXEL_EDGE + 1] = {0};
    double sum = 0, off = 0, nonfinite = 0;
    for (size_t i = 0; i < count; i++) {
        if (classes[i] == PIXEL_NONE)
            continue;
        if (!isfinite(picture[i])) {
            nonfinite++;
            continue;
        }
        const double error = (double)picture[i] - (double)truth[i];
        pixels[classes[i]]++;
        squares[classes[i]] += error * error;
        sum += error;
        off += fabs(error) > 0.1;
        histogram[bin_of(fabs(error))]++;
    }
    const double finite = pixels[PIXEL_SMOOTH] + pixels[PIXEL_EDGE];
    if (!(finite > 0))
        return (error_measure){.nonfinite_share = nonfinite > 0 ? 1 : 0};
    return (error_measure){.rmse = sqrt((squares[PIXEL_SMOOTH] + squares[PIXEL_EDGE]) / finite),
                           .mean = sum / finite,
                           .p95 = percentile(histogram, 0.95 * finite),
                           .p99 = percentile(histogram, 0.99 * finite),
                           .off_share = off / finite,
                           .nonfinite_share = nonfinite / (finite + nonfinite),
                           .smooth_rmse = sqrt(squares[PIXEL_SMOOTH] / fmax(pixels[PIXEL_SMOOTH], 1)),
                           .edge_rmse = sqrt(squares[PIXEL_EDGE] / fmax(pixels[PIXEL_EDGE], 1))};
}

void fit_add(fit_sum *f, const float *picture, const float *truth, const uint8_t *classes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (classes[i] == PIXEL_NONE || !isfinite(picture[i]))
            continue;
        const int bin = bin_of((double)picture[i]);
        const double t = (double)truth[i];
        f->weight[bin]++;
        f->picture[bin] += (double)picture[i];
        f->truth[bin] += t;
        f->truth2[bin] += t * t;
    }
}

void fit_merge(fit_sum *f, const fit_sum *from)
{
    double weight = 0;
    for (int i = 0; i < MEASURE_BINS; i++)
        weight += from->weight[i];
    const double scale = weight > 0 ? 1 / weight : 0;
    for (int i = 0; i < MEASURE_BINS; i++) {
        f->weight[i] += from->weight[i] * scale;
        f->picture[i] += from->picture[i] * scale;
        f->truth[i] += from->truth[i] * scale;
        f->truth2[i] += from->truth2[i] * scale;
    }
}

double fit_rmse(const fit_sum *f, double exponent)
{
    double weight = 0, sum2 = 0;
    for (int i = 0; i < MEASURE_BINS; i++) {
        const double w = f->weight[i];
        if (!(w > 0))
            continue;
        const double a = pow(f->picture[i] / w, exponent);
        weight += w;
        sum2 += w * a * a - 2 * a * f->truth[i] + f->truth2[i];
    }
    return weight > 0 ? sqrt(fmax(sum2 / weight, 0)) : 0;
}

double fit_exponent(const fit_sum *f)
{
    /* A coarse scan finds the valley, the golden section its floor. */
    enum { SCAN = 16 };
    const double least = 0.1, most = 8, ratio = pow(most / least, 1.0 / (SCAN - 1));
    int best = 0;
    double best_rmse = INFINITY;
    for (int i = 0; i < SCAN; i++) {
        const double rmse = fit_rmse(f, least * pow(ratio, i));
        if (rmse < best_rmse) {
            best_rmse = rmse;
            best = i;
        }
    }
    const double golden = 0.6180339887498949;
    double low = least * pow(ratio, best > 0 ? best - 1 : 0);
    double high = least * pow(ratio, best < SCAN - 1 ? best + 1 : best);
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double rmse_a = fit_rmse(f, a), rmse_b = fit_rmse(f, b);
    while (high - low > 1e-4) {
        if (rmse_a < rmse_b) {
            high = b;
            b = a;
            rmse_b = rmse_a;
            a = high - golden * (high - low);
            rmse_a = fit_rmse(f, a);
        } else {
            low = a;
            a = b;
            rmse_a = rmse_b;
            b = low + golden * (high - low);
            rmse_b = fit_rmse(f, b);
        }
    }
    return (low + high) / 2;
}
