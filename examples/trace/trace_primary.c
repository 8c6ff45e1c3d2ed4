/* SPDX-License-Identifier: MIT
 *
 * Rays through pixel centres, from clip space to the world in double precision. Both ends of a ray stay homogeneous,
 * so that off-centre, infinite, reversed and orthographic projections share one formula.
 */
#include "trace_internal.h"

#include <math.h>

static void multiply(const float a[16], const float b[16], double out[16])
{
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) {
            out[4 * c + r] = 0;
            for (int k = 0; k < 4; k++)
                out[4 * c + r] += (double)a[4 * k + r] * (double)b[4 * c + k];
        }
}

/* Gauss-Jordan with row pivots; false where the matrix is singular. Overwrites m. */
static bool invert(double m[16], double out[16])
{
    for (int i = 0; i < 16; i++)
        out[i] = i % 5 == 0;
    for (int c = 0; c < 4; c++) {
        int pivot = c;
        for (int r = c + 1; r < 4; r++)
            pivot = fabs(m[4 * c + r]) > fabs(m[4 * c + pivot]) ? r : pivot;
        const double value = m[4 * c + pivot];
        if (!(fabs(value) > 0) || !isfinite(value))
            return false;
        for (int k = 0; k < 4; k++) { /* swaps rows c and pivot, scales row c */
            const double x = m[4 * k + pivot], y = out[4 * k + pivot];
            m[4 * k + pivot] = m[4 * k + c];
            out[4 * k + pivot] = out[4 * k + c];
            m[4 * k + c] = x / value;
            out[4 * k + c] = y / value;
        }
        for (int r = 0; r < 4; r++) {
            const double factor = r == c ? 0 : m[4 * c + r];
            for (int k = 0; factor != 0 && k < 4; k++) {
                m[4 * k + r] -= factor * m[4 * k + c];
                out[4 * k + r] -= factor * out[4 * k + c];
            }
        }
    }
    return true;
}

bool trace_eye_open(const scene_view *view, trace_eye *out)
{
    double clip_from_world[16];
    multiply(view->clip_from_view, view->view_from_world, clip_from_world);
    for (int i = 0; i < 3; i++)
        out->forward[i] = -(double)view->view_from_world[4 * i + 2];
    return invert(clip_from_world, out->world_from_clip);
}

bool trace_eye_ray(const trace_eye *eye, double x_ndc, double y_ndc, double out_origin[3], double out_direction[3],
                   double *out_length)
{
    double ends[2][4];
    for (int end = 0; end < 2; end++) {
        const double clip[4] = {x_ndc, y_ndc, end ? 1 : -1, 1};
        for (int r = 0; r < 4; r++) {
            ends[end][r] = 0;
            for (int k = 0; k < 4; k++)
                ends[end][r] += eye->world_from_clip[4 * k + r] * clip[k];
        }
    }
    /* The world's w is 1 over the view distance in perspective, so 0 where an end lies at infinity. In front of the
     * camera it is not negative, and this difference points from the first end to the second wherever they are. */
    double toward[3], along = 0, square = 0;
    for (int i = 0; i < 3; i++) {
        toward[i] = ends[1][i] * ends[0][3] - ends[0][i] * ends[1][3];
        along += toward[i] * eye->forward[i];
        square += toward[i] * toward[i];
    }
    const bool reversed = along < 0;
    const double *near_end = ends[reversed], *far_end = ends[!reversed];
    const double length = sqrt(square);
    for (int i = 0; i < 3; i++) {
        out_origin[i] = near_end[i] / near_end[3];
        out_direction[i] = (reversed ? -toward[i] : toward[i]) / length;
    }
    /* Matrices of single precision put an infinite far plane no farther than this. */
    *out_length = far_end[3] > 1e-8 * near_end[3] ? length / (near_end[3] * far_end[3]) : INFINITY;
    return length > 0 && isfinite(length + out_origin[0] + out_origin[1] + out_origin[2]);
}
