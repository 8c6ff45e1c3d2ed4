/* SPDX-License-Identifier: MIT */
#include "seen_normal.h"

#include <math.h>
#include <stdbool.h>

static const double OPEN = 1e-5; /* above what rounding changes */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Whether the surface does not fall off by more than across the normal, towards the pixel x, y beside it or from the
 * opposite one, whichever is nearer. */
static seen_side side_by(const double normal[3], const double up[3], double facing, step_beside step, const void *user,
                         int x, int y)
{
    double steps[2][3], lengths[2], rises[2] = {0.0, 0.0};
    seen_side sides[2];
    for (int k = 0; k < 2; ++k) {
        const double way = k == 0 ? 1.0 : -1.0;
        step(user, k == 0 ? x : -x, k == 0 ? y : -y, steps[k]);
        for (int i = 0; i < 3; ++i)
            rises[k] += way * steps[k][i] * (up[i] - facing * normal[i]);
        lengths[k] = sqrt(dot(steps[k], steps[k]));
        const double least = OPEN * lengths[k];
        sides[k] = rises[k] > least ? OTHER_SIDE : rises[k] < -least ? OWN_SIDE : EITHER_SIDE;
    }
    if (sides[0] == sides[1])
        return sides[0];
    const double apart = lengths[0] - lengths[1], least = OPEN * (lengths[0] + lengths[1]);
    return apart < -least ? sides[0] : apart > least ? sides[1] : EITHER_SIDE;
}

seen_side seen_side_of(const double normal[3], const double up[3], const double gain[2], step_beside step,
                       const void *user)
{
    const double facing = dot(normal, up);
    if (facing > OPEN)
        return OWN_SIDE;
    if (facing < -0.5 - OPEN)
        return OTHER_SIDE;
    double lean[2];
    for (int i = 0; i < 2; ++i)
        lean[i] = (normal[i] - facing * up[i]) / gain[i];
    const double length = sqrt(lean[0] * lean[0] + lean[1] * lean[1]);
    seen_side side = EITHER_SIDE;
    for (int i = 0; i < 4; ++i) { /* where a coordinate is next to a half, either way */
        const double by[2] = {i % 2 ? OPEN : -OPEN, i / 2 ? OPEN : -OPEN};
        const int x = (int)rint(lean[0] / length + by[0]), y = (int)rint(lean[1] / length + by[1]);
        const seen_side one = side_by(normal, up, facing, step, user, x, y);
        if (one == EITHER_SIDE || (i > 0 && one != side))
            return EITHER_SIDE;
        side = one;
    }
    const bool near_bound = facing > -OPEN || facing < -0.5 + OPEN;
    return near_bound && side != (facing > -OPEN ? OWN_SIDE : OTHER_SIDE) ? EITHER_SIDE : side;
}
