/* SPDX-License-Identifier: MIT
 *
 * The demo's ambient light in double precision.
 */
#include "open_light.h"

#include <math.h>

double open_light_linear(double accessibility)
{
    const double c = sqrt(fmax(1.0 - accessibility, 0.0));
    return (1.0 + c + c * c) / (1.0 + c);
}

void open_light_matte(const float irradiance[9][3], const double direction[3], double linear, double out[3])
{
    const double x = direction[0], y = direction[1], z = direction[2];
    const double terms[9] = {1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y};
    for (int k = 0; k < 3; ++k) {
        out[k] = 0.0;
        for (int i = 0; i < 9; ++i)
            out[k] += (double)irradiance[i][k] * terms[i] * (i >= 1 && i <= 3 ? linear : 1.0);
        out[k] = fmax(out[k], 0.0);
    }
}

static double overlap(const double axis[3], double open, const double mirror[3], double lobe)
{
    const double dot = axis[0] * mirror[0] + axis[1] * mirror[1] + axis[2] * mirror[2];
    const double between = acos(fmin(fmax(dot, -1.0), 1.0)), inside = fabs(open - lobe);
    const double t = fmin(fmax((between - inside) / fmax(open + lobe - inside, 1e-4), 0.0), 1.0);
    return (1.0 - t * t * (3.0 - 2.0 * t)) * (1.0 - cos(fmin(open, lobe))) / (1.0 - cos(lobe));
}

double open_light_cone(const double bent[3], double accessibility, const double normal[3], const double mirror[3],
                       double roughness)
{
    const double lobe = acos(exp2(-3.32193 * fmax(roughness * roughness, 1e-3)));
    const double open = overlap(bent, acos(sqrt(fmin(fmax(1.0 - accessibility, 0.0), 1.0))), mirror, lobe);
    return fmin(open / fmax(overlap(normal, acos(0.0), mirror, lobe), 1e-3), 1.0);
}

double open_light_lobe(double cos_eye, double accessibility, double roughness)
{
    const double open = pow(cos_eye + accessibility, exp2(-16.0 * roughness - 1.0)) - 1.0 + accessibility;
    return fmin(fmax(open, 0.0), 1.0);
}
