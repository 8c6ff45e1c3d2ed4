/* SPDX-License-Identifier: MIT
 *
 * Occlusion rays of one point, 16 at a time.
 */
#include "trace_internal.h"

#include <math.h>

/* Two unit vectors that make a right-handed frame with n (Duff et al., "Building an orthonormal basis, revisited",
 * JCGT 2017). */
static void make_frame(const double n[3], double u[3], double v[3])
{
    const double sign = copysign(1, n[2]);
    const double a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    u[0] = 1 + sign * n[0] * n[0] * a;
    u[1] = sign * b;
    u[2] = -sign * n[0];
    v[0] = b;
    v[1] = sign + n[1] * n[1] * a;
    v[2] = -n[1];
}

static void hand_over(const struct RTCRay16 *rays, int count, uint64_t number, const trace_point *point,
                      trace_fan_fn take, void *user)
{
    float directions[TRACE_PACKET][3];
    bool blocked[TRACE_PACKET];
    for (int i = 0; i < count; i++) {
        directions[i][0] = rays->dir_x[i];
        directions[i][1] = rays->dir_y[i];
        directions[i][2] = rays->dir_z[i];
        blocked[i] = rays->tfar[i] < 0;
    }
    const trace_fan fan = {(size_t)number, point->normal, (const float(*)[3])directions, blocked, count};
    take(&fan, user);
}

float trace_point_accessibility(const trace_scene *t, const trace_samples *samples, float radius, uint64_t number,
                                const trace_point *point, trace_fan_fn take, void *user)
{
    trace_query query = {.trace = t};
    embree_init_context(&query.embree);
    double frame[2][3];
    float u[3], v[3], n[3], origin[3];
    make_frame(point->normal, frame[0], frame[1]);
    for (int i = 0; i < 3; i++) {
        u[i] = (float)frame[0][i];
        v[i] = (float)frame[1][i];
        n[i] = (float)point->normal[i];
        origin[i] = (float)point->origin[i];
    }
    int blocked = 0;
    for (int first = 0; first < samples->count; first += TRACE_PACKET) {
        struct RTCRay16 rays;
        _Alignas(64) int valid[TRACE_PACKET];
        float x[TRACE_PACKET], y[TRACE_PACKET], z[TRACE_PACKET];
        const int left = samples->count - first, count = left < TRACE_PACKET ? left : TRACE_PACKET;
        trace_samples_get(samples, number, first, x, y, z);
        for (int i = 0; i < TRACE_PACKET; i++) {
            valid[i] = i < count ? -1 : 0;
            rays.org_x[i] = origin[0];
            rays.org_y[i] = origin[1];
            rays.org_z[i] = origin[2];
            rays.dir_x[i] = x[i] * u[0] + y[i] * v[0] + z[i] * n[0];
            rays.dir_y[i] = x[i] * u[1] + y[i] * v[1] + z[i] * n[1];
            rays.dir_z[i] = x[i] * u[2] + y[i] * v[2] + z[i] * n[2];
            rays.tnear[i] = 0;
            rays.tfar[i] = radius;
            rays.time[i] = 0;
            rays.mask[i] = UINT32_MAX;
            rays.id[i] = (unsigned)i;
            rays.flags[i] = 0;
        }
        embree_occluded(t->world, &query.embree, valid, &rays);
        for (int i = 0; i < count; i++)
            blocked += rays.tfar[i] < 0;
        if (take)
            hand_over(&rays, count, number, point, take, user);
    }
    return 1 - (float)blocked / (float)samples->count;
}
