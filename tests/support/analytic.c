/* SPDX-License-Identifier: MIT */
#include "analytic.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

analytic_view analytic_make_view(analytic_projection kind, double aspect, double near_plane, double far_plane,
                                 double scale)
{
    analytic_view view = {.sky_depth = 1.0f};
    double n = near_plane * scale, f = far_plane * scale, p[16] = {0};
    double focal = 1.0 / tan(0.5 * 60.0 * 3.14159265358979323846 / 180.0);
    double half_height = 3.0 * scale;
    bool orthographic = kind == ORTHOGRAPHIC || kind == ORTHOGRAPHIC_REVERSED;
    if (orthographic) {
        p[0] = 1.0 / (half_height * aspect);
        p[5] = 1.0 / half_height;
        p[15] = 1.0;
    } else {
        p[0] = focal / aspect;
        p[5] = focal;
        p[11] = -1.0;
    }
    switch (kind) {
    case PERSPECTIVE_OFF_CENTRE:
        p[8] = 0.35;
        p[9] = -0.2; /* fallthrough */
    case PERSPECTIVE:
    case PROJECTION_COUNT:
        p[10] = -(f + n) / (f - n);
        p[14] = -2.0 * f * n / (f - n);
        break;
    case PERSPECTIVE_INFINITE:
        p[10] = -1.0;
        p[14] = -2.0 * n;
        break;
    case PERSPECTIVE_REVERSED_ZERO_TO_ONE:
        p[10] = n / (f - n);
        p[14] = f * n / (f - n);
        break;
    case PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE:
        p[14] = n;
        break;
    case ORTHOGRAPHIC:
        p[10] = -2.0 / (f - n);
        p[14] = -(f + n) / (f - n);
        break;
    case ORTHOGRAPHIC_REVERSED:
        p[10] = 2.0 / (f - n);
        p[14] = (f + n) / (f - n);
        break;
    }
    view.clip_zero_to_one =
        kind == PERSPECTIVE_REVERSED_ZERO_TO_ONE || kind == PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE;
    if (view.clip_zero_to_one || kind == ORTHOGRAPHIC_REVERSED)
        view.sky_depth = 0.0f;
    for (int i = 0; i < 16; ++i)
        view.projection[i] = (float)p[i];
    return view;
}

/* Distance along the ray to the shape and the normal there; HUGE_VAL for a miss. */
static double hit(const analytic_shape *s, const double o[3], const double d[3], double out_normal[3])
{
    double to[3] = {o[0] - s->center[0], o[1] - s->center[1], o[2] - s->center[2]};
    if (s->kind == ANALYTIC_PLANE) {
        double facing = 0.0, height = 0.0;
        for (int i = 0; i < 3; ++i) {
            facing += d[i] * s->size[i];
            height += to[i] * s->size[i];
            out_normal[i] = s->size[i];
        }
        return facing < 0.0 ? -height / facing : HUGE_VAL;
    }
    if (s->kind == ANALYTIC_SPHERE) {
        double a = 0.0, b = 0.0, c = -s->size[0] * s->size[0];
        for (int i = 0; i < 3; ++i) {
            a += d[i] * d[i];
            b += d[i] * to[i];
            c += to[i] * to[i];
        }
        double root = b * b - a * c;
        if (root < 0.0)
            return HUGE_VAL;
        double t = (-b - sqrt(root)) / a;
        for (int i = 0; i < 3; ++i)
            out_normal[i] = (to[i] + t * d[i]) / s->size[0];
        return t;
    }
    double enter = -HUGE_VAL, leave = HUGE_VAL;
    int axis = 0;
    for (int i = 0; i < 3; ++i) {
        double inverse = 1.0 / d[i];
        double a = (-s->size[i] - to[i]) * inverse, b = (s->size[i] - to[i]) * inverse;
        if (fmin(a, b) > enter) {
            enter = fmin(a, b);
            axis = i;
        }
        leave = fmin(leave, fmax(a, b));
    }
    for (int i = 0; i < 3; ++i)
        out_normal[i] = i == axis ? (d[i] > 0.0 ? -1.0 : 1.0) : 0.0;
    return enter <= leave ? enter : HUGE_VAL;
}

/* View distance and normal of the surface seen through a pixel; HUGE_VAL if there is none. */
static double see(const analytic_view *view, const analytic_shape *shapes, int shape_count, double ndc_x, double ndc_y,
                  double out_normal[3])
{
    const float *p = view->projection;
    const double ndc[2] = {ndc_x, ndc_y};
    double o[3] = {0}, d[3] = {0.0, 0.0, -1.0}, nearest = HUGE_VAL;
    for (int i = 0; i < 2; ++i) {
        o[i] = (ndc[i] * (double)p[15] - (double)p[12 + i]) / (double)p[5 * i];
        d[i] = (-ndc[i] * (double)p[11] + (double)p[8 + i]) / (double)p[5 * i];
    }
    for (int i = 0; i < shape_count; ++i) {
        double candidate[3] = {0.0}, t = hit(&shapes[i], o, d, candidate);
        if (t > 0.0 && t < nearest) {
            nearest = t;
            memcpy(out_normal, candidate, sizeof candidate);
        }
    }
    return nearest;
}

void analytic_render(const analytic_view *view, const analytic_shape *shapes, int shape_count, int width, int height,
                     float **out_depth, float **out_normals)
{
    float *distance;
    analytic_render_distance(view, shapes, shape_count, width, height, out_depth, out_normals, &distance);
    free(distance);
}

void analytic_render_distance(const analytic_view *view, const analytic_shape *shapes, int shape_count, int width,
                              int height, float **out_depth, float **out_normals, float **out_distance)
{
    double p[16];
    for (int i = 0; i < 16; ++i)
        p[i] = (double)view->projection[i];
    size_t count = (size_t)width * (size_t)height;
    float *depth = malloc(count * sizeof *depth), *normals = malloc(count * 3 * sizeof *normals);
    float *distance = malloc(count * sizeof *distance);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double normal[3] = {0.0, 0.0, 1.0};
            const double nearest =
                see(view, shapes, shape_count, 2.0 * (x + 0.5) / width - 1.0, 2.0 * (y + 0.5) / height - 1.0, normal);
            size_t at = (size_t)y * (size_t)width + (size_t)x;
            double ndc_z = (p[14] - p[10] * nearest) / (p[15] - p[11] * nearest);
            double window = view->clip_zero_to_one ? ndc_z : 0.5 * ndc_z + 0.5;
            bool drawn = window >= 0.0 && window <= 1.0; /* between the planes; false for a miss */
            depth[at] = drawn ? (float)window : view->sky_depth;
            distance[at] = drawn ? (float)nearest : INFINITY;
            for (int i = 0; i < 3; ++i)
                normals[3 * at + (size_t)i] = drawn ? (float)normal[i] : (i == 2 ? 1.0f : 0.0f);
        }
    *out_depth = depth;
    *out_normals = normals;
    *out_distance = distance;
}

static bool blocked(const analytic_shape *shapes, int shape_count, const double point[3], const double d[3],
                    double radius)
{
    double normal[3];
    for (int i = 0; i < shape_count; ++i) {
        const double t = hit(&shapes[i], point, d, normal);
        if (t > 1e-9 * radius && t < radius)
            return true;
    }
    return false;
}

double analytic_open(const analytic_shape *shapes, int shape_count, const double point[3], const double normal[3],
                     double radius, int rays, double out_mean[3])
{
    const double two_pi = 6.28318530717958647692, golden = 0.61803398874989484820;
    /* Any vector across the normal. */
    const int axis = fabs(normal[0]) < 0.6 ? 0 : 1;
    double u[3], v[3], length = sqrt(1.0 - normal[axis] * normal[axis]);
    for (int i = 0; i < 3; ++i)
        u[i] = ((i == axis ? 1.0 : 0.0) - normal[axis] * normal[i]) / length;
    for (int i = 0; i < 3; ++i)
        v[i] = normal[(i + 1) % 3] * u[(i + 2) % 3] - normal[(i + 2) % 3] * u[(i + 1) % 3];
    int open = 0;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < rays; ++k) {
        const double square = (k + 0.5) / rays, angle = two_pi * (golden * k - floor(golden * k)), r = sqrt(square);
        double d[3];
        for (int i = 0; i < 3; ++i)
            d[i] = r * cos(angle) * u[i] + r * sin(angle) * v[i] + sqrt(1.0 - square) * normal[i];
        if (blocked(shapes, shape_count, point, d, radius))
            continue;
        open += 1;
        for (int i = 0; i < 3; ++i)
            sum[i] += d[i];
    }
    for (int i = 0; i < 3; ++i)
        out_mean[i] = sum[i] / rays;
    return (double)open / rays;
}

double analytic_accessibility(const analytic_shape *shapes, int shape_count, const double point[3],
                              const double normal[3], double radius, int rays)
{
    double mean[3];
    return analytic_open(shapes, shape_count, point, normal, radius, rays, mean);
}

const analytic_shape analytic_unit_room[ANALYTIC_ROOM_SHAPES] = {
    {ANALYTIC_PLANE, {0.0, -1.5, 0.0}, {0.0, 1.0, 0.0}},   {ANALYTIC_PLANE, {-2.5, 0.0, 0.0}, {1.0, 0.0, 0.0}},
    {ANALYTIC_SPHERE, {0.6, -0.7, -4.0}, {0.8, 0.0, 0.0}}, {ANALYTIC_SPHERE, {1.8, -1.1, -5.2}, {0.4, 0.0, 0.0}},
    {ANALYTIC_BOX, {-1.2, -1.0, -5.5}, {0.5, 0.5, 0.5}},   {ANALYTIC_BOX, {0.9, -0.2, -8.5}, {1.6, 1.3, 0.4}},
};

void analytic_room(analytic_shape shapes[ANALYTIC_ROOM_SHAPES], double scale)
{
    memcpy(shapes, analytic_unit_room, sizeof analytic_unit_room);
    for (int i = 0; i < ANALYTIC_ROOM_SHAPES; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            shapes[i].center[axis] *= scale;
            if (shapes[i].kind != ANALYTIC_PLANE)
                shapes[i].size[axis] *= scale;
        }
}
