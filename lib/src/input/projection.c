/* SPDX-License-Identifier: MIT
 *
 * Analysis of a projection matrix: its inverse, the conversion of stored depth to view distance, the ray through a uv,
 * and the depth of the sky. All of it in double precision, because at near : far of 1 : 10^7 rounding would lose what
 * the float entries still hold.
 */
#include "input/projection.h"

#include <float.h>
#include <math.h>

/* mingw-w64's isfinite converts doubles to float. */
static bool is_finite(double value)
{
    return fabs(value) <= DBL_MAX;
}

/* Gauss-Jordan with partial pivoting. */
bool glssao__invert(const double m[16], double out[16])
{
    double a[4][8];
    double largest = 0.0;
    for (int row = 0; row < 4; ++row)
        for (int col = 0; col < 4; ++col) {
            a[row][col] = m[col * 4 + row];
            a[row][col + 4] = row == col ? 1.0 : 0.0;
        }
    for (int col = 0; col < 4; ++col) {
        int pivot = col;
        for (int row = col + 1; row < 4; ++row)
            if (fabs(a[row][col]) > fabs(a[pivot][col]))
                pivot = row;
        if (!(fabs(a[pivot][col]) > 0.0))
            return false;
        for (int k = 0; k < 8; ++k) {
            double swapped = a[col][k];
            a[col][k] = a[pivot][k];
            a[pivot][k] = swapped;
        }
        double scale = 1.0 / a[col][col];
        for (int k = 0; k < 8; ++k)
            a[col][k] *= scale;
        for (int row = 0; row < 4; ++row) {
            double factor = row == col ? 0.0 : a[row][col];
            for (int k = 0; k < 8; ++k)
                a[row][k] -= factor * a[col][k];
        }
    }
    for (int row = 0; row < 4; ++row)
        for (int col = 0; col < 4; ++col) {
            out[col * 4 + row] = a[row][col + 4];
            largest = fmax(largest, fabs(a[row][col + 4]));
        }
    return is_finite(largest) && largest < 3e38; /* the block holds floats */
}

/* View distance at one end of the depth range, where numerator / denominator is it; infinite where a perspective
 * matrix, rounded to float, puts the far plane at or beyond infinity. */
static double distance_at(double numerator, double denominator, bool perspective)
{
    double distance = numerator / denominator;
    return perspective && !(distance > 0.0) ? INFINITY : distance;
}

static bool refuse(const glssao__log *log, int entry, double value, const char *wanted)
{
    glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.projection[%d] = %g: %s", entry, value, wanted);
    return false;
}

bool glssao__projection_analyse(const float projection[16], bool clip_zero_to_one, const glssao__log *log,
                                glssao__projection *out)
{
    double p[16], inverse[16];
    for (int i = 0; i < 16; ++i) {
        p[i] = (double)projection[i];
        if (!is_finite(p[i]))
            return refuse(log, i, p[i], "not finite");
    }
    /* clip.w = p[11] z + p[15], clip.x and clip.y without the other's coordinate, clip.z from z alone. */
    static const int zeros[] = {1, 2, 3, 4, 6, 7};
    for (int i = 0; i < 6; ++i)
        if (p[zeros[i]] != 0.0)
            return refuse(log, zeros[i], p[zeros[i]], "must be 0: sheared and oblique projections are not supported");
    if (p[11] > 0.0)
        return refuse(log, 11, p[11], "view space must look down -z, so clip w must not grow with z");
    if (p[11] == 0.0 && !(p[15] > 0.0))
        return refuse(log, 15, p[15], "an orthographic projection needs a positive clip w");
    if (!glssao__invert(p, inverse)) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.projection is singular");
        return false;
    }
    for (int i = 0; i < 16; ++i)
        out->view_from_clip[i] = (float)inverse[i];

    /* With t = -z: ndc z = (p[14] - p[10] t) / (p[15] - p[11] t), solved for t at both ends of the depth range. */
    double ndc_at_0 = clip_zero_to_one ? 0.0 : -1.0;
    double k[4] = {p[14] - ndc_at_0 * p[15], p[14] - p[15], p[10] - ndc_at_0 * p[11], p[10] - p[11]};
    /* Only the quotient counts: numbers near 1 keep small scenes out of the denormals. */
    double scale = 1.0 / fmax(fabs(k[2]), fabs(k[3]));
    for (int i = 0; i < 4; ++i)
        out->distance_from_depth[i] = (float)(out->ends[i] = k[i] * scale);
    bool perspective = p[11] != 0.0;
    double distance_0 = distance_at(k[0], k[2], perspective), distance_1 = distance_at(k[1], k[3], perspective);
    if (distance_0 == distance_1 || !(is_finite(distance_0) || is_finite(distance_1))) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.projection: depth 0 and depth 1 lie at the same distance");
        return false;
    }
    out->sky_depth = distance_1 > distance_0 ? 1.0f : 0.0f;
    out->sky_distance = (float)fmax(distance_0, distance_1);

    /* ndc x = (p[0] x - p[8] t + p[12]) / (p[15] - p[11] t), solved for x, with ndc x = 2 u - 1; y alike. */
    for (int axis = 0; axis < 2; ++axis) {
        double s = p[axis * 5], skew = p[8 + axis], shift = p[12 + axis];
        out->ray_origin[axis] = (float)(2.0 * p[15] / s);
        out->ray_origin[axis + 2] = (float)((-p[15] - shift) / s);
        out->ray_direction[axis] = (float)(-2.0 * p[11] / s);
        out->ray_direction[axis + 2] = (float)((p[11] + skew) / s);
    }
    return true;
}

double glssao__projection_log_constant(const glssao_frame *frame)
{
    return frame->log_depth_constant == 0.0f ? 1.0 : (double)frame->log_depth_constant;
}

void glssao__projection_depth_step(const glssao_frame *frame, const glssao__projection *projection,
                                   const glssao__precision *precision, float out_step[4])
{
    /* Floats just below 1 lie as far apart as half their step there, and no farther anywhere nearer. */
    const bool near_one =
        precision->relative && frame->depth_kind == GLSSAO_DEPTH_WINDOW && projection->sky_depth == 1.0f;
    const bool relative = precision->relative && !near_one;
    const double step = near_one ? 0.5 * precision->step : precision->step;
    double c[3] = {0.0, step, 0.0}; /* view distance in floats */
    if (frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC) {
        /* d = log(c t + 1) / L: dt / dd = L (t + 1 / c) */
        const double constant = glssao__projection_log_constant(frame);
        const double length = log(constant * (double)frame->log_depth_far + 1.0);
        c[0] = step * length / constant;
        c[1] = step * length;
    } else if (frame->depth_kind == GLSSAO_DEPTH_WINDOW) {
        /* t = N / D with N = (1 - d) k0 + d k1, D = (1 - d) k2 + d k3: dt / dd = (k1 k2 - k0 k3) / D^2 = W / D^2, where
         * D = -W / (a - b t); and d = (k0 - k2 t) / (a - b t). */
        const double *k = projection->ends;
        const double w = fabs(k[1] * k[2] - k[0] * k[3]), a = k[0] - k[1], b = k[2] - k[3];
        const double last[2] = {relative ? k[0] : a, relative ? -k[2] : -b};
        c[0] = step / w * a * last[0];
        c[1] = step / w * (a * last[1] - b * last[0]);
        c[2] = step / w * -b * last[1];
    } else if (!relative) {
        c[0] = step;
        c[1] = 0.0;
    }
    /* Positions are computed in single precision, whatever depth is stored in. */
    c[1] += ldexp(1.0, -22);
    for (int i = 0; i < 3; ++i)
        out_step[i] = (float)c[i];
    out_step[3] = 0.0f;
}
