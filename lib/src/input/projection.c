/* SPDX-License-Identifier: MIT
 *
 * Analysis of a projection: the conversion of stored depth to view distance, the ray through a uv, and the depth of the
 * sky. In double precision, as input/matrix.c.
 */
#include "input/projection.h"

#include <float.h>
#include <math.h>

static bool is_finite(double value)
{
    return fabs(value) <= DBL_MAX;
}

/* View distance at one end of the depth range, where numerator / denominator is it; infinite where a perspective
 * matrix, rounded to float, puts the far plane at or beyond infinity. */
static double distance_at(double numerator, double denominator, bool perspective)
{
    double distance = numerator / denominator;
    return perspective && !(distance > 0.0) ? INFINITY : distance;
}

/* Moves the eye of an orthographic projection along the view axis, which changes no picture, to the near end of the
 * depth range. Without it, points behind the eye would have view distances below 0, and far from the eye floats would
 * not tell neighbours apart. A range that begins near the eye stays as it is. Returns how far the eye moved. */
static double move_eye(double p[16], double ndc_at_0)
{
    if (p[10] == 0.0)
        return 0.0;
    const double ends[2] = {(p[14] - ndc_at_0 * p[15]) / p[10], (p[14] - p[15]) / p[10]};
    const double least = fmin(ends[0], ends[1]);
    if (least >= 0.0 && least <= fabs(ends[0] - ends[1]))
        return 0.0;
    for (int row = 0; row < 3; ++row)
        p[12 + row] -= least * p[8 + row];
    return least;
}

/* The ray through a uv. ndc x = (p[0] x - p[8] t + p[12]) / (p[15] - p[11] t), solved for x, with ndc x = 2 u - 1; y
 * alike. */
static void find_rays(const double p[16], double out_origin[4], double out_direction[4])
{
    for (int axis = 0; axis < 2; ++axis) {
        const double s = p[axis * 5], skew = p[8 + axis], shift = p[12 + axis];
        out_origin[axis] = 2.0 * p[15] / s;
        out_origin[axis + 2] = (-p[15] - shift) / s;
        out_direction[axis] = -2.0 * p[11] / s;
        out_direction[axis + 2] = (p[11] + skew) / s;
    }
}

/* With t = -z: ndc z = (p[2] x + p[6] y - p[10] t + p[14]) / (p[15] - p[11] t), solved for t at both ends of the depth
 * range, where x = ox + t dx and y = oy + t dy on the ray: t = (p[14] + p[2] ox + p[6] oy - ndc p[15]) / (p[10] - p[2]
 * dx - p[6] dy - ndc p[11]). p[2] and p[6] are 0 unless the near plane is oblique (E. Lengyel, "Oblique View Frustum
 * Depth Projection and Clipping", 2005). */
static void find_ends(const double p[16], double ndc_at_0, const double origin[4], const double direction[4],
                      glssao__projection *out)
{
    const double constant[2] = {p[14] + p[2] * origin[2] + p[6] * origin[3],
                                p[10] - p[2] * direction[2] - p[6] * direction[3]};
    const double k[4] = {constant[0] - ndc_at_0 * p[15], constant[0] - p[15], constant[1] - ndc_at_0 * p[11],
                         constant[1] - p[11]};
    const double gained[4] = {p[2] * origin[0], p[6] * origin[1], -p[2] * direction[0], -p[6] * direction[1]};
    /* Only the quotient counts: numbers near 1 keep small scenes out of the denormals. */
    const double scale = 1.0 / fmax(fabs(k[2]), fabs(k[3]));
    for (int i = 0; i < 4; ++i) {
        out->distance_from_depth[i] = (float)(out->ends[i] = k[i] * scale);
        out->oblique[i] = (float)(gained[i] * scale);
    }
}

/* Which end of the depth range is far. With an oblique near plane the ends lie elsewhere at each pixel; the sign of the
 * derivative of distance by depth is the same at all. */
static bool find_sky(const glssao__log *log, glssao__projection *out)
{
    const double *k = out->ends;
    const double d0 = distance_at(k[0], k[2], !out->is_orthographic),
                 d1 = distance_at(k[1], k[3], !out->is_orthographic);
    const double derivative = k[1] * k[2] - k[0] * k[3];
    if (out->is_oblique ? derivative == 0.0 : d0 == d1 || !(is_finite(d0) || is_finite(d1))) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.projection: depth 0 and depth 1 lie at the same distance%s",
                          glssao__matrix_hint(out->doubt));
        return false;
    }
    out->sky_depth = (out->is_oblique ? derivative > 0.0 : d1 > d0) ? 1.0f : 0.0f;
    return true;
}

bool glssao__projection_analyse(const glssao_frame *frame, const glssao__log *log, glssao__projection *out)
{
    glssao__matrix m;
    double inverse[16], origin[4], direction[4];
    const double ndc_at_0 = frame->clip_zero_to_one ? 0.0 : -1.0;
    if (!glssao__matrix_read(frame->projection, log, &m))
        return false;
    out->is_turned = m.is_turned;
    out->is_orthographic = m.is_orthographic;
    out->is_oblique = m.is_oblique;
    out->doubt = m.doubt;
    out->turn[0] = (float)m.cosine;
    out->turn[1] = (float)m.sine;
    out->eye = 0.0;
    if (m.is_orthographic && !m.is_oblique && frame->depth_kind == GLSSAO_DEPTH_WINDOW)
        out->eye = move_eye(m.clip_from_view, ndc_at_0);
    if (!glssao__matrix_invert(m.clip_from_view, inverse)) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.projection is singular%s", glssao__matrix_hint(m.doubt));
        return false;
    }
    find_rays(m.clip_from_view, origin, direction);
    find_ends(m.clip_from_view, ndc_at_0, origin, direction, out);
    for (int i = 0; i < 16; ++i) {
        out->clip_from_view[i] = (float)m.clip_from_view[i];
        out->view_from_clip[i] = (float)inverse[i];
    }
    for (int i = 0; i < 4; ++i) {
        out->ray_origin[i] = (float)origin[i];
        out->ray_direction[i] = (float)direction[i];
    }
    return find_sky(log, out);
}

bool glssao__projection_reads_window_depth(const glssao_frame *frame, bool is_oblique)
{
    return frame->depth_kind == GLSSAO_DEPTH_WINDOW && !is_oblique;
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
    /* Under an oblique near plane the value at a distance differs from pixel to pixel; none has larger steps than 1. */
    const bool relative = precision->relative && !near_one && !projection->is_oblique;
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
