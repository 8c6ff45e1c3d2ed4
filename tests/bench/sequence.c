/* SPDX-License-Identifier: MIT
 *
 * Reprojection in double precision.
 */
#include "sequence.h"

#include <math.h>

static const double tolerance = 0.01; /* of the view distance */

static void multiply(const float m[16], const double v[4], double out[4])
{
    for (int r = 0; r < 4; r++)
        out[r] = (double)m[r] * v[0] + (double)m[4 + r] * v[1] + (double)m[8 + r] * v[2] + (double)m[12 + r] * v[3];
}

/* Of a rotation and a translation. */
static void multiply_inverse(const float m[16], const double v[3], double out[4])
{
    for (int r = 0; r < 3; r++) {
        out[r] = 0;
        for (int k = 0; k < 3; k++)
            out[r] += (double)m[4 * r + k] * (v[k] - (double)m[12 + k]);
    }
    out[3] = 1;
}

/* Where the point that pixel x, y of `now` shows lies in `before`: pixels, and its view distance there. */
static void reproject(const sequence_frame *before, const sequence_frame *now, int x, int y, double out_at[2],
                      double *out_distance)
{
    const scene_view *v = &now->view;
    const float *c = v->clip_from_view;
    const double distance = (double)now->distance[y * v->width + x];
    const double point[3] = {((2 * x + 1.0) / v->width - 1 + (double)c[8]) / (double)c[0] * distance,
                             ((2 * y + 1.0) / v->height - 1 + (double)c[9]) / (double)c[5] * distance, -distance};
    double world[4], old[4], clip[4];
    multiply_inverse(v->view_from_world, point, world);
    multiply(before->view.view_from_world, world, old);
    multiply(before->view.clip_from_view, old, clip);
    out_at[0] = (clip[0] / clip[3] + 1) / 2 * before->view.width - 0.5;
    out_at[1] = (clip[1] / clip[3] + 1) / 2 * before->view.height - 0.5;
    *out_distance = -old[2];
}

/* Interpolates the result of `before` at the point that pixel x, y of `now` shows; false where it was not seen. */
static bool find_before(const sequence_frame *before, const sequence_frame *now, int x, int y, double *out_value)
{
    const int width = before->view.width, height = before->view.height;
    double at[2], distance, value = 0;
    reproject(before, now, x, y, at, &distance);
    if (!(distance > 0 && at[0] >= 0 && at[1] >= 0 && at[0] < width - 1 && at[1] < height - 1))
        return false;
    const int left = (int)at[0], below = (int)at[1];
    for (int k = 0; k < 4; k++) {
        const size_t n = (size_t)(below + k / 2) * (size_t)width + (size_t)(left + k % 2);
        const double wx = at[0] - left, wy = at[1] - below;
        const double weight = (k % 2 ? wx : 1 - wx) * (k / 2 ? wy : 1 - wy);
        if (weight >= 1e-6 && !(fabs((double)before->distance[n] - distance) < tolerance * distance))
            return false;
        value += before->result ? weight * (double)before->result[n] : 0;
    }
    *out_value = value;
    return true;
}

void sequence_compare(frame_change *c, const sequence_frame *before, const sequence_frame *now)
{
    for (int y = 0; y < now->view.height; y++)
        for (int x = 0; x < now->view.width; x++) {
            const size_t i = (size_t)y * (size_t)now->view.width + (size_t)x;
            double value;
            if (!(now->distance[i] > 0) || !find_before(before, now, x, y, &value))
                continue;
            c->sum2 += ((double)now->result[i] - value) * ((double)now->result[i] - value);
            c->pixels++;
        }
}

void sequence_find_new(const sequence_frame *before, const sequence_frame *now, unsigned char *out_new)
{
    for (int y = 0; y < now->view.height; y++)
        for (int x = 0; x < now->view.width; x++) {
            const size_t i = (size_t)y * (size_t)now->view.width + (size_t)x;
            double value;
            out_new[i] = now->distance[i] > 0 && !find_before(before, now, x, y, &value);
        }
}
