/* SPDX-License-Identifier: MIT */
#include "error_color.h"

#include <math.h>

void error_color(double error, double range, double out_rgb[3])
{
    static const double dark[3] = {0.02, 0.19, 0.50}, bright[3] = {0.80, 0.20, 0.00}, none = 0.97;
    const double share = sqrt(fmin(fabs(error) / range, 1)); /* the root makes small errors visible */
    for (int k = 0; k < 3; k++)
        out_rgb[k] = none + share * ((error < 0 ? dark[k] : bright[k]) - none);
}
