/* SPDX-License-Identifier: MIT
 *
 * Recognises projections by their structure. Programs set a projection alone (fixed function, some shaders) or its
 * product with the model-view matrix (most shaders). Both are recognised.
 *
 * Let clip = P V, with P a perspective projection whose clip w is view distance, and V a rotation times a scale s, and
 * a translation. Then row 3 of the product is minus row 2 of V, so its first three numbers have length s; rows 0 and 1
 * are P's focal lengths times rows 0 and 1 of V, plus its shifts times row 3; row 2 is made of rows 2 and 3 of V
 * alone. So P follows from dot products, and any other matrix fails the checks below.
 *
 * An orthographic P leaves row 3 as (0, 0, 0, 1), and rows 0 to 2 are those of V, scaled; z is turned about.
 */
#include "inject.h"

#include <math.h>

typedef double rows[4][4];

static double dot3(const double a[4], const double b[4])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool read_rows(const float m[16], rows out)
{
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) {
            out[r][c] = (double)m[4 * c + r];
            if (!isfinite(out[r][c]))
                return false;
        }
    return true;
}

/* The view distance of this depth in clip space. Where only rounding keeps it from being infinite, it is infinite. */
static double distance_at(double ndc, double p10, double p14)
{
    return fabs(ndc + p10) < 1e-6 ? (double)INFINITY : p14 / (ndc + p10);
}

bool inject_perspective_of(const float m[16], bool zero_to_one, float out_matrix[16])
{
    rows row;
    if (!read_rows(m, row))
        return false;
    const double scale2 = dot3(row[3], row[3]);
    if (!(scale2 > 1e-12))
        return false; /* orthographic, or no projection */
    const double shift_x = dot3(row[0], row[3]) / scale2, shift_y = dot3(row[1], row[3]) / scale2;
    double x[4], y[4], z[4];
    const double p10 = -dot3(row[2], row[3]) / scale2;
    for (int c = 0; c < 4; ++c) {
        x[c] = row[0][c] - shift_x * row[3][c];
        y[c] = row[1][c] - shift_y * row[3][c];
        z[c] = row[2][c] + p10 * row[3][c];
    }
    const double focal_x = sqrt(dot3(x, x) / scale2), focal_y = sqrt(dot3(y, y) / scale2);
    const double tolerance = 1e-3;
    const bool is_rotation = fabs(dot3(x, y)) <= tolerance * focal_x * focal_y * scale2;
    const bool depth_fits = sqrt(dot3(z, z)) <= tolerance * (1.0 + fabs(p10)) * sqrt(scale2);
    /* From 5 to 170 degrees, and no axis stretched more than a window can be. */
    const bool lens_fits = focal_x > 0.08 && focal_x < 25.0 && focal_y > 0.08 && focal_y < 25.0 &&
                           focal_x / focal_y < 8.0 && focal_y / focal_x < 8.0 && fabs(shift_x) < 4.0 &&
                           fabs(shift_y) < 4.0;
    /* The two ends of depth: one is near, the other far, maybe infinitely. P14 = z[3]. */
    const double at_low = distance_at(zero_to_one ? 0.0 : -1.0, p10, z[3]), at_high = distance_at(1.0, p10, z[3]);
    const bool planes_fit = at_low > 0.0 && at_high > 0.0 && at_low != at_high;
    if (!is_rotation || !depth_fits || !lens_fits || !planes_fit)
        return false;
    memset(out_matrix, 0, 16 * sizeof *out_matrix);
    out_matrix[0] = (float)focal_x;
    out_matrix[5] = (float)focal_y;
    out_matrix[8] = (float)-shift_x;
    out_matrix[9] = (float)-shift_y;
    out_matrix[10] = (float)p10;
    out_matrix[11] = -1.0f;
    out_matrix[14] = (float)z[3];
    return true;
}

bool inject_orthographic_of(const float m[16], bool zero_to_one, float out_matrix[16])
{
    rows r;
    if (!read_rows(m, r) || r[3][0] != 0.0 || r[3][1] != 0.0 || r[3][2] != 0.0 || fabs(r[3][3] - 1.0) > 1e-6)
        return false;
    const double x = sqrt(dot3(r[0], r[0])), y = sqrt(dot3(r[1], r[1])), z = sqrt(dot3(r[2], r[2])), tolerance = 1e-3;
    if (!(x > 0.0 && y > 0.0 && z > 0.0) || fabs(dot3(r[0], r[1])) > tolerance * x * y ||
        fabs(dot3(r[0], r[2])) > tolerance * x * z || fabs(dot3(r[1], r[2])) > tolerance * y * z)
        return false;
    /* With x to the right and y upwards, z points at the viewer. Depth grows away from the viewer, or towards it if
     * reversed. */
    const double across[4] = {r[0][1] * r[1][2] - r[0][2] * r[1][1], r[0][2] * r[1][0] - r[0][0] * r[1][2],
                              r[0][0] * r[1][1] - r[0][1] * r[1][0], 0.0};
    const bool is_turned = dot3(across, r[2]) > 0.0;
    if (is_turned && (!zero_to_one || fabs(x - z) + fabs(y - z) <= tolerance * z))
        return false; /* a model's matrix, or y downwards; with depth from 0 to 1 it may be reversed depth */
    /* An interface's box is flat: hundreds wide, and 2 deep. */
    if (z > 20.0 * x || z > 20.0 * y || x / y > 8.0 || y / x > 8.0)
        return false;
    memset(out_matrix, 0, 16 * sizeof *out_matrix);
    out_matrix[0] = (float)x;
    out_matrix[5] = (float)y;
    out_matrix[10] = (float)(is_turned ? z : -z);
    out_matrix[14] = (float)r[2][3]; /* the library moves the eye to the near plane */
    out_matrix[15] = 1.0f;
    return true;
}
