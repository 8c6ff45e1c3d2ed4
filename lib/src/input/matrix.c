/* SPDX-License-Identifier: MIT
 *
 * Tells what kind of projection a matrix is. All of it in double precision, because at near : far of 1 : 10^7 rounding
 * would lose what the float entries still hold.
 */
#include "input/matrix.h"

#include <float.h>
#include <math.h>

/* What float rounding leaves where 0 belongs, relative to the rest of its row: a product of two matrices sums four
 * terms for each entry, each rounded to 2^-24, and 16 products are allowed for. At the edge of a picture of 4000 pixels
 * it moves a point by less than a hundredth of a pixel. */
static const double RESIDUE = 16 * 4 * 0x1p-24;

/* mingw-w64's isfinite converts doubles to float. */
static bool is_finite(double value)
{
    return fabs(value) <= DBL_MAX;
}

const char *glssao__matrix_hint(enum glssao__doubt doubt)
{
    return doubt == DOUBT_TRANSPOSED ? "; the matrix looks transposed, want column-major" : "";
}

static bool refuse(const glssao__log *log, const glssao__matrix *m, int entry, const char *wanted)
{
    glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.projection[%d] = %g: %s%s", entry, m->clip_from_view[entry], wanted,
                      glssao__matrix_hint(m->doubt));
    return false;
}

/* Gauss-Jordan with partial pivoting. */
bool glssao__matrix_invert(const double m[16], double out[16])
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

/* Whether the four entries are (0, 0, 1, 0) or (0, 0, 0, 1) but for the sign, as the last row of a projection is. */
static bool is_last_row(double a, double b, double c, double d, double tolerance)
{
    const double low = fmin(fabs(c), fabs(d)), high = fmax(fabs(c), fabs(d));
    return fabs(a) <= tolerance && fabs(b) <= tolerance && low <= tolerance && fabs(high - 1.0) <= tolerance;
}

/* The transpose of a projection has its last row for the last column. A projection may have that too, but then its own
 * last row is as it should be. */
static enum glssao__doubt doubt_of(const double p[16])
{
    bool is_identity = true;
    for (int i = 0; i < 16; ++i)
        is_identity = is_identity && p[i] == (i % 5 == 0 ? 1.0 : 0.0);
    if (is_identity)
        return DOUBT_IDENTITY;
    return is_last_row(p[12], p[13], p[14], p[15], 0.0) && !is_last_row(p[3], p[7], p[11], p[15], RESIDUE)
               ? DOUBT_TRANSPOSED
               : DOUBT_NONE;
}

/* Clip w: from view z alone, or constant. The last row of a product with a view matrix has other entries too. */
static bool read_w(glssao__matrix *m, const glssao__log *log)
{
    double *p = m->clip_from_view;
    const double x = hypot(p[0], p[4]), y = hypot(p[1], p[5]), z = fabs(p[10]);
    /* Across the part of view space that is seen, 2 / z deep for a w of 1, w must not change by more than a residue. */
    if (p[15] > 0.0 && 2.0 * fabs(p[11]) <= RESIDUE * z)
        p[11] = 0.0;
    m->is_orthographic = p[11] == 0.0;
    const double most[2] = {m->is_orthographic ? x : fabs(p[11]), m->is_orthographic ? y : fabs(p[11])};
    for (int i = 0; i < 2; ++i) {
        if (fabs(p[3 + 4 * i]) > RESIDUE * most[i])
            return refuse(log, m, 3 + 4 * i, "must be 0: want the projection alone, without view or model");
        p[3 + 4 * i] = 0.0;
    }
    if (p[11] > 0.0)
        return refuse(log, m, 11, "view space must look down -z, so clip w must not grow with z");
    if (p[11] == 0.0 && !(p[15] > 0.0))
        return refuse(log, m, 15, "an orthographic projection needs a positive clip w");
    return true;
}

/* Clip x and y: a scale each, after a turn of view x and y. The turn is the identity where there is none but for
 * rounding. */
static bool read_xy(glssao__matrix *m, const glssao__log *log)
{
    double *p = m->clip_from_view;
    const double x = hypot(p[0], p[4]), y = hypot(p[1], p[5]);
    m->cosine = 1.0;
    m->sine = 0.0;
    m->is_turned = x > 0.0 && y > 0.0 && (fabs(p[4]) > RESIDUE * x || fabs(p[1]) > RESIDUE * y);
    if (!m->is_turned) {
        p[1] = p[4] = 0.0;
        return true;
    }
    if (fabs(p[0] * p[1] + p[4] * p[5]) > RESIDUE * x * y) {
        const int entry = fabs(p[1]) * x > fabs(p[4]) * y ? 1 : 4;
        return refuse(log, m, entry, "a sheared projection, whose pixels are not rectangles, is not supported");
    }
    m->cosine = p[0] / x;
    m->sine = p[4] / x;
    const double z[2] = {p[2], p[6]};
    p[5] = m->cosine * p[5] - m->sine * p[1];
    p[0] = x;
    p[1] = p[4] = 0.0;
    p[2] = m->cosine * z[0] + m->sine * z[1];
    p[6] = m->cosine * z[1] - m->sine * z[0];
    return true;
}

bool glssao__matrix_read(const float projection[16], const glssao__log *log, glssao__matrix *out)
{
    double *p = out->clip_from_view;
    out->doubt = DOUBT_NONE;
    for (int i = 0; i < 16; ++i) {
        p[i] = (double)projection[i];
        if (!is_finite(p[i]))
            return refuse(log, out, i, "not finite");
    }
    out->doubt = doubt_of(p);
    if (!read_w(out, log) || !read_xy(out, log))
        return false;
    const double most = RESIDUE * (fabs(p[10]) + fabs(p[11]));
    out->is_oblique = fabs(p[2]) > most || fabs(p[6]) > most;
    if (!out->is_oblique)
        p[2] = p[6] = 0.0;
    return true;
}

bool glssao__matrix_normals(const float m[16], double out_rows[9])
{
    double r[3][3], lengths = 1.0, determinant = 0.0, size = 0.0;
    for (int row = 0; row < 3; ++row) {
        for (int col = 0; col < 3; ++col)
            r[row][col] = (double)m[4 * col + row];
        lengths *= sqrt(r[row][0] * r[row][0] + r[row][1] * r[row][1] + r[row][2] * r[row][2]);
    }
    for (int row = 0; row < 3; ++row) {
        const double *a = r[(row + 1) % 3], *b = r[(row + 2) % 3];
        for (int col = 0; col < 3; ++col) {
            const double cofactor = a[(col + 1) % 3] * b[(col + 2) % 3] - a[(col + 2) % 3] * b[(col + 1) % 3];
            out_rows[3 * row + col] = cofactor;
            size = fmax(size, fabs(cofactor));
            determinant += row == 0 ? r[0][col] * cofactor : 0.0;
        }
    }
    if (!(fabs(determinant) > RESIDUE * lengths)) /* also false for nan */
        return false;
    for (int i = 0; i < 9; ++i)
        out_rows[i] /= determinant < 0.0 ? -size : size;
    return true;
}
