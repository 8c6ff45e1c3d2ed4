/* SPDX-License-Identifier: MIT
 *
 * Finds a program's projection among its matrices by their structure. Programs set projections alone (fixed function,
 * tidy shaders) or times the model-view matrix (most shaders); both can be told.
 *
 * Let clip = P V, with P a perspective projection whose clip w is view distance, and V a rotation times a scale s, and
 * a translation. Then row 3 of the product is minus row 2 of V, so its first three numbers have length s; rows 0 and 1
 * are P's focal lengths times rows 0 and 1 of V, plus its shifts times row 3; row 2 is made of rows 2 and 3 of V
 * alone. So P follows from dot products, and a product that is anything else gives itself away.
 */
#include "inject.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

enum { CANDIDATES = 16 };

typedef struct candidate {
    float projection[16];
    unsigned framebuffer;
    int count;
} candidate;

static candidate seen[CANDIDATES];
static candidate last; /* the window's, of an earlier frame; count 0: none yet */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static double dot3(const double a[4], const double b[4])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool inject_perspective_of(const float m[16], float out_projection[16])
{
    double row[4][4];
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) {
            row[r][c] = (double)m[4 * c + r];
            if (!isfinite(row[r][c]))
                return false;
        }
    const double scale2 = dot3(row[3], row[3]);
    if (!(scale2 > 1e-12))
        return false; /* orthographic, or no projection */
    const double shift_x = dot3(row[0], row[3]) / scale2, shift_y = dot3(row[1], row[3]) / scale2;
    double x[4], y[4], z[4];
    const double depth = dot3(row[2], row[3]) / scale2; /* -P[10] */
    for (int c = 0; c < 4; ++c) {
        x[c] = row[0][c] - shift_x * row[3][c];
        y[c] = row[1][c] - shift_y * row[3][c];
        z[c] = row[2][c] - depth * row[3][c];
    }
    const double focal_x = sqrt(dot3(x, x) / scale2), focal_y = sqrt(dot3(y, y) / scale2);
    const double tolerance = 1e-3;
    const bool is_rotation = fabs(dot3(x, y)) <= tolerance * focal_x * focal_y * scale2;
    const bool depth_fits = sqrt(dot3(z, z)) <= tolerance * (1.0 + fabs(depth)) * sqrt(scale2);
    /* From 5 to 170 degrees, and neither axis stretched more than a window ever is. */
    const bool lens_fits = focal_x > 0.08 && focal_x < 25.0 && focal_y > 0.08 && focal_y < 25.0 &&
                           focal_x / focal_y < 8.0 && focal_y / focal_x < 8.0 && fabs(shift_x) < 4.0 &&
                           fabs(shift_y) < 4.0;
    /* near = P14 / (P10 - 1), far = P14 / (P10 + 1): both positive, or far infinite. P14 = z[3], P10 = -depth. */
    const double near_plane = z[3] / (-depth - 1.0), far_plane = z[3] / (-depth + 1.0);
    const bool planes_fit = near_plane > 0.0 && (far_plane > near_plane || fabs(depth - 1.0) < 1e-6);
    if (!is_rotation || !depth_fits || !lens_fits || !planes_fit)
        return false;
    memset(out_projection, 0, 16 * sizeof *out_projection);
    out_projection[0] = (float)focal_x;
    out_projection[5] = (float)focal_y;
    out_projection[8] = (float)-shift_x;
    out_projection[9] = (float)-shift_y;
    out_projection[10] = (float)-depth;
    out_projection[11] = -1.0f;
    out_projection[14] = (float)z[3];
    return true;
}

static bool alike(const float a[16], const float b[16])
{
    static const int numbers[] = {0, 5, 8, 9, 10, 14};
    for (int i = 0; i < 6; ++i)
        if (fabsf(a[numbers[i]] - b[numbers[i]]) > 2e-3f * (fabsf(a[numbers[i]]) + 1e-3f))
            return false;
    return true;
}

void inject_note_matrix(const float m[16], unsigned framebuffer)
{
    float projection[16];
    if (!inject_perspective_of(m, projection))
        return;
    pthread_mutex_lock(&lock);
    for (int i = 0; i < CANDIDATES; ++i) {
        if (seen[i].count > 0 && (seen[i].framebuffer != framebuffer || !alike(seen[i].projection, projection)))
            continue;
        if (seen[i].count == 0)
            memcpy(seen[i].projection, projection, sizeof projection);
        seen[i].framebuffer = framebuffer;
        ++seen[i].count;
        break;
    }
    pthread_mutex_unlock(&lock);
}

bool inject_get_projection(unsigned framebuffer, float out_projection[16])
{
    pthread_mutex_lock(&lock);
    const candidate *best = NULL;
    bool elsewhere = false;
    for (int i = 0; i < CANDIDATES && seen[i].count > 0; ++i) {
        if (seen[i].framebuffer != framebuffer)
            elsewhere = true;
        else if (!best || seen[i].count > best->count)
            best = &seen[i];
    }
    if (best && framebuffer == 0)
        last = *best;
    if (!best && framebuffer == 0 && !elsewhere && last.count > 0)
        best = &last;
    if (best)
        memcpy(out_projection, best->projection, sizeof best->projection);
    pthread_mutex_unlock(&lock);
    return best != NULL;
}

void inject_end_frame(void)
{
    pthread_mutex_lock(&lock);
    memset(seen, 0, sizeof seen);
    pthread_mutex_unlock(&lock);
}
