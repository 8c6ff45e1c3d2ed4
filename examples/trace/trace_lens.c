/* SPDX-License-Identifier: MIT
 *
 * From what a rasteriser found to where rays start. All in single precision.
 */
#include "trace_picture.h"

#include <math.h>

bool trace_lens_open(const scene_view *view, const trace_seen *seen, trace_lens *out)
{
    const float *c = view->clip_from_view, *v = view->view_from_world;
    const int size[2] = {view->width, view->height};
    for (int i = 0; i < 2; i++) {
        out->ndc[i][0] = (float)(2.0 * seen->step / size[i]);
        out->ndc[i][1] = (float)((2 * seen->offset[i] + 1.0) / size[i] - 1);
        out->scale[i] = 1 / c[5 * i];
        out->shift[i][0] = c[12 + i];
        out->shift[i][1] = c[8 + i];
    }
    out->w[0] = c[15];
    out->w[1] = c[11];
    out->perspective = fabsf(c[11]) > 0;
    /* ndc z = (c10 z + c14) / w: its derivative is (c10 w - c11 (c10 z + c14)) / w^2, and depth is half of it. A
     * rasteriser rounds depth more than once: measured, the surface lies up to four steps from it. */
    const double slope = (double)c[10] * (double)c[15] - (double)c[11] * (double)c[14];
    out->depth_error = (float)(4 * 2 * seen->depth_step / fabs(slope));
    for (int k = 0; k < 3; k++) {
        double eye = 0;
        for (int r = 0; r < 3; r++) {
            out->view_from_world[3 * k + r] = v[4 * k + r];
            eye -= (double)v[4 * k + r] * (double)v[12 + r];
        }
        out->eye[k] = (float)eye;
    }
    return isfinite(out->depth_error) && isfinite(out->scale[0] * out->scale[1]);
}

static inline float least(float a, float b)
{
    return a < b ? a : b;
}

/* Unit normals, and frames about them: Duff et al., "Building an orthonormal basis, revisited", JCGT 2017. */
static void turn_normals(const trace_lens *l, int count, trace_block *b)
{
    const float *m = l->view_from_world;
    for (int i = 0; i < count; i++) {
        const float nx = b->normal[0][i], ny = b->normal[1][i], nz = b->normal[2][i];
        const float unit = 1 / sqrtf(nx * nx + ny * ny + nz * nz);
        const float x = unit * (m[0] * nx + m[1] * ny + m[2] * nz);
        const float y = unit * (m[3] * nx + m[4] * ny + m[5] * nz);
        const float z = unit * (m[6] * nx + m[7] * ny + m[8] * nz);
        const float sign = z < 0 ? -1.0f : 1.0f, a = -1 / (sign + z), xy = x * y * a;
        b->normal[0][i] = x;
        b->normal[1][i] = y;
        b->normal[2][i] = z;
        b->u[0][i] = 1 + sign * x * x * a;
        b->u[1][i] = sign * xy;
        b->u[2][i] = -sign * x;
        b->v[0][i] = xy;
        b->v[1][i] = sign + y * y * a;
        b->v[2][i] = -y;
    }
}

/* Where rays start: off the surface along the normal, by as much as the rasteriser's depth may be off along the ray
 * from the eye; by a 16th of a pixel, since corners are snapped to pixels' 256ths and shading normals are not the
 * triangles' own; and by what single precision loses. */
static void find_origins(const trace_lens *l, float radius, int count, trace_block *b)
{
    const float *m = l->view_from_world;
    for (int i = 0; i < count; i++) {
        const float t = b->distance[i], w = l->w[0] - l->w[1] * t;
        const float ndc_x = b->x[i] * l->ndc[0][0] + l->ndc[0][1], ndc_y = b->y[i] * l->ndc[1][0] + l->ndc[1][1];
        const float x = l->scale[0] * (ndc_x * w - l->shift[0][0] + l->shift[0][1] * t);
        const float y = l->scale[1] * (ndc_y * w - l->shift[1][0] + l->shift[1][1] * t);
        const float nx = b->normal[0][i], ny = b->normal[1][i], nz = b->normal[2][i];
        /* The ray from the surface to the eye, of view distance 1. */
        const float to_eye = l->perspective / t;
        const float toward = (nz - to_eye * (nx * x + ny * y)) / sqrtf(nx * nx + ny * ny + nz * nz);
        const float depth_error = l->depth_error * w * w * fabsf(toward);
        const float pixel = fabsf(l->ndc[1][0] * l->scale[1] * w);
        const float point[3] = {l->eye[0] + m[0] * x + m[1] * y - m[2] * t, l->eye[1] + m[3] * x + m[4] * y - m[5] * t,
                                l->eye[2] + m[6] * x + m[7] * y - m[8] * t};
        const float size = fabsf(point[0]) + fabsf(point[1]) + fabsf(point[2]) + fabsf(t);
        const float offset = least(depth_error + pixel / 16 + 0x1p-20f * size, 0.25f * radius);
        for (int k = 0; k < 3; k++)
            b->origin[k][i] = point[k];
        b->distance[i] = offset;
    }
}

static void move_origins(int count, trace_block *b)
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < count; i++)
            b->origin[k][i] += b->distance[i] * b->normal[k][i];
}

void trace_lens_place(const trace_lens *l, float radius, int count, trace_block *b)
{
    find_origins(l, radius, count, b);
    turn_normals(l, count, b);
    move_origins(count, b);
}
