/* SPDX-License-Identifier: MIT */
#include "matrix.h"

#include <math.h>

/* The matrix of cofactors is the determinant times the inverse transpose, and needs no inverse. */
bool matrix_for_normals(const float affine[16], double out[9])
{
    double determinant = 0, largest = 0;
    for (int c = 0; c < 3; c++) {
        const float *a = affine + 4 * ((c + 1) % 3), *b = affine + 4 * ((c + 2) % 3);
        for (int r = 0; r < 3; r++) {
            const int s = (r + 1) % 3, t = (r + 2) % 3;
            out[3 * c + r] = (double)a[s] * (double)b[t] - (double)a[t] * (double)b[s];
            largest = fmax(largest, fabs(out[3 * c + r]));
        }
    }
    for (int r = 0; r < 3; r++)
        determinant += (double)affine[r] * out[r];
    const bool mirrors = determinant < 0;
    for (int i = 0; i < 9 && largest > 0; i++)
        out[i] *= (mirrors ? -1 : 1) / largest;
    return mirrors;
}
