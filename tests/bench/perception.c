/* SPDX-License-Identifier: MIT
 *
 * SSIM and FLIP. Names of FLIP's steps and constants are those of the paper.
 */
#include "perception.h"

#include "filter.h"

#include <math.h>
#include <stdlib.h>

enum { PICTURES = 14 };

static const double pixels_per_degree = 0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180;

static void blur(const perception *p, const float *in, const kernel *x, const kernel *y, filter_edge edge, float *out)
{
    filter_picture(in, p->width, p->height, x, y, edge, p->scratch[5], out);
}

static size_t pixels(const perception *p)
{
    return (size_t)p->width * (size_t)p->height;
}

static kernel ssim_window(void)
{
    return kernel_gaussian(1.5, 5);
}

/* First or second derivative of a Gaussian, positive and negative taps each summing to 1 (section 4.2). */
static kernel feature_kernel(bool second)
{
    const double sd = 0.5 * 0.082 * pixels_per_degree;
    kernel k = {.radius = (int)ceil(3 * sd)};
    double taps[FILTER_MAX_TAPS], positive = 0, negative = 0;
    for (int i = 0; i <= 2 * k.radius; i++) {
        const double x = i - k.radius, g = exp(-x * x / (2 * sd * sd));
        taps[i] = second ? (x * x / (sd * sd) - 1) * g : -x * g;
        *(taps[i] > 0 ? &positive : &negative) += fabs(taps[i]);
    }
    for (int i = 0; i <= 2 * k.radius; i++)
        k.taps[i] = (float)(taps[i] / (taps[i] > 0 ? positive : negative));
    return k;
}

/* L* of CIELAB from linear luminance. */
static double lightness(double y)
{
    const double delta = 6.0 / 29;
    return 116 * (y > delta * delta * delta ? cbrt(y) : y / (3 * delta * delta) + 4.0 / 29) - 16;
}

/* HyAB distance of Hunt-adjusted green and blue, the largest in the sRGB gamut, to the power 0.7 (section 4.1). */
static double largest_error(void)
{
    static const double xyz_from_rgb[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                              {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                              {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
    double lab[2][3];
    for (int color = 0; color < 2; color++) {
        double l[3]; /* lightness of X, Y and Z, each in parts of white's */
        for (int i = 0; i < 3; i++) {
            const double *row = xyz_from_rgb[i];
            l[i] = lightness(row[1 + color] / (row[0] + row[1] + row[2]));
        }
        lab[color][0] = l[1];
        lab[color][1] = 0.01 * l[1] * 500 / 116 * (l[0] - l[1]);
        lab[color][2] = 0.01 * l[1] * 200 / 116 * (l[1] - l[2]);
    }
    return pow(fabs(lab[0][0] - lab[1][0]) + hypot(lab[0][1] - lab[1][1], lab[0][2] - lab[1][2]), 0.7);
}

/* L* after the achromatic contrast sensitivity filter, and the strength of edges and points, of a grey picture. */
static void flip_features(const perception *p, const float *picture, float *out_lightness, float *out_edges,
                          float *out_points)
{
    const double pi = 3.14159265358979323846, sd = sqrt(0.0047 / (2 * pi * pi)) * pixels_per_degree;
    const double feature_sd = 0.5 * 0.082 * pixels_per_degree;
    const kernel sensitivity = kernel_gaussian(sd, (int)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree));
    const kernel edge = feature_kernel(false), point = feature_kernel(true);
    const kernel across = kernel_gaussian(feature_sd, edge.radius);
    float *other = p->scratch[4];
    const size_t count = pixels(p);
    blur(p, picture, &sensitivity, &sensitivity, FILTER_REPLICATE, out_lightness);
    for (size_t i = 0; i < count; i++)
        out_lightness[i] = (float)lightness(fmin(fmax((double)out_lightness[i], 0), 1));
    for (int k = 0; k < 2; k++) {
        const kernel *along = k == 0 ? &edge : &point;
        float *out = k == 0 ? out_edges : out_points;
        blur(p, picture, along, &across, FILTER_REPLICATE, out);
        blur(p, picture, &across, along, FILTER_REPLICATE, other);
        for (size_t i = 0; i < count; i++)
            out[i] = sqrtf(out[i] * out[i] + other[i] * other[i]);
    }
}

bool perception_create(perception *p, const float *truth, const uint8_t *shows, int width, int height)
{
    *p = (perception){.width = width, .height = height};
    const size_t count = pixels(p);
    float *all = calloc(count, PICTURES * sizeof *all);
    if (!all)
        return false;
    float **const names[PICTURES] = {&p->shown,      &p->truth,      &p->weight,     &p->mean,       &p->square,
                                     &p->lightness,  &p->edges,      &p->points,     &p->scratch[0], &p->scratch[1],
                                     &p->scratch[2], &p->scratch[3], &p->scratch[4], &p->scratch[5]};
    for (size_t i = 0; i < PICTURES; i++)
        *names[i] = all + i * count;
    for (size_t i = 0; i < count; i++) {
        p->shown[i] = shows[i] ? 1 : 0;
        p->truth[i] = shows[i] ? truth[i] : 1;
        p->shown_count += shows[i] != 0;
        p->mean[i] = p->shown[i] * p->truth[i];
        p->square[i] = p->mean[i] * p->truth[i];
    }
    const kernel window = ssim_window();
    blur(p, p->shown, &window, &window, FILTER_ZERO, p->weight);
    blur(p, p->mean, &window, &window, FILTER_ZERO, p->mean);
    blur(p, p->square, &window, &window, FILTER_ZERO, p->square);
    flip_features(p, p->truth, p->lightness, p->edges, p->points);
    return true;
}

void perception_destroy(perception *p)
{
    free(p->shown); /* all of them are one block */
    *p = (perception){.width = 0};
}

double perception_ssim(perception *p, const float *picture)
{
    static const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    float *mean = p->scratch[0], *square = p->scratch[1], *product = p->scratch[2];
    const size_t count = pixels(p);
    for (size_t i = 0; i < count; i++) {
        mean[i] = p->shown[i] > 0 ? picture[i] : 0;
        square[i] = mean[i] * mean[i];
        product[i] = mean[i] * p->truth[i];
    }
    const kernel window = ssim_window();
    blur(p, mean, &window, &window, FILTER_ZERO, mean);
    blur(p, square, &window, &window, FILTER_ZERO, square);
    blur(p, product, &window, &window, FILTER_ZERO, product);
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        if (!(p->shown[i] > 0))
            continue;
        const double w = (double)p->weight[i], x = (double)mean[i] / w, y = (double)p->mean[i] / w;
        const double xx = fmax((double)square[i] / w - x * x, 0), yy = fmax((double)p->square[i] / w - y * y, 0);
        const double xy = (double)product[i] / w - x * y;
        sum += (2 * x * y + c1) * (2 * xy + c2) / ((x * x + y * y + c1) * (xx + yy + c2));
    }
    return p->shown_count > 0 ? sum / p->shown_count : 1;
}

double perception_flip(perception *p, const float *picture)
{
    static const double qc = 0.7, qf = 0.5, pc = 0.4, pt = 0.95;
    const double most = largest_error(), bend = pc * most;
    float *shown = p->scratch[0], *light = p->scratch[1], *edges = p->scratch[2], *points = p->scratch[3];
    const size_t count = pixels(p);
    for (size_t i = 0; i < count; i++)
        shown[i] = p->shown[i] > 0 ? fminf(fmaxf(picture[i], 0), 1) : 1;
    flip_features(p, shown, light, edges, points);
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        if (!(p->shown[i] > 0))
            continue;
        const double color = pow(fabs((double)light[i] - (double)p->lightness[i]), qc);
        const double spread = color < bend ? pt / bend * color : pt + (color - bend) / (most - bend) * (1 - pt);
        const double edge = fabs((double)edges[i] - (double)p->edges[i]);
        const double point = fabs((double)points[i] - (double)p->points[i]);
        sum += pow(spread, 1 - pow(fmax(edge, point) / sqrt(2), qf));
    }
    return p->shown_count > 0 ? sum / p->shown_count : 0;
}
