/* SPDX-License-Identifier: MIT
 *
 * Cameras for the examples. All lengths are relative to the size of the scene, so that a scaled scene looks the same.
 * Differences of large coordinates are computed in double precision.
 */
#define CGLM_ALL_UNALIGNED /* the matrices are plain float[16] */
#include "camera.h"

#include <cglm/cglm.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

static const double largest_plane_ratio =
    20000; /* far / near: a 24-bit depth buffer then resolves 1/800 of the far distance */

typedef struct basis {
    double right[3], up[3], back[3]; /* unit vectors in world space; zero if the camera is degenerate */
} basis;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Returns the previous length. */
static double normalize(double v[3])
{
    double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] = length > 0.0 ? v[i] / length : 0.0;
    return length;
}

static basis camera_basis(const camera *c)
{
    basis b;
    double up[3];
    for (int i = 0; i < 3; i++) {
        b.back[i] = (double)c->eye[i] - c->target[i];
        up[i] = c->up[i];
    }
    normalize(b.back);
    cross(up, b.back, b.right);
    normalize(b.right);
    cross(b.back, b.right, b.up);
    return b;
}

static void bounds_corner(const scene *s, int index, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (index >> i) & 1 ? s->bounds_max[i] : s->bounds_min[i];
}

static double bounds_diagonal(const scene *s)
{
    double size[3];
    for (int i = 0; i < 3; i++)
        size[i] = (double)s->bounds_max[i] - s->bounds_min[i];
    return sqrt(dot(size, size));
}

/* Finds the view distances of the nearest and the farthest corner of the bounds. */
static void bounds_distances(const camera *c, const scene *s, double *out_nearest, double *out_farthest)
{
    basis b = camera_basis(c);
    *out_nearest = INFINITY;
    *out_farthest = -INFINITY;
    for (int k = 0; k < 8; k++) {
        double corner[3];
        bounds_corner(s, k, corner);
        for (int i = 0; i < 3; i++)
            corner[i] -= c->eye[i];
        double distance = -dot(corner, b.back);
        *out_nearest = fmin(*out_nearest, distance);
        *out_farthest = fmax(*out_farthest, distance);
    }
}

void camera_fit_planes(camera *c, const scene *s)
{
    double nearest, farthest;
    bounds_distances(c, s, &nearest, &farthest);
    if (!(farthest > 0.0)) {
        /* Everything is behind the camera, so any planes will do. */
        nearest = 0.0;
        farthest = bounds_diagonal(s) > 0.0 ? bounds_diagonal(s) : 1.0;
    }
    /* Leaves room for flat bounds and for rounding in the matrices. */
    double margin = 0.01 * (farthest - fmax(nearest, 0.0)) + 0.001 * farthest;
    double far_plane = farthest + margin;
    c->near_plane = (float)fmax(nearest - margin, far_plane / largest_plane_ratio);
    c->far_plane = (float)far_plane;
}

camera camera_turned(const camera *c, const float pivot[3], const float axis[3], float angle_rad)
{
    camera turned = *c;
    float *const points[] = {turned.eye, turned.target};
    for (int i = 0; i < 2; i++) {
        float *point = points[i];
        glm_vec3_sub(point, (float *)pivot, point);
        glm_vec3_rotate(point, angle_rad, (float *)axis);
        glm_vec3_add(point, (float *)pivot, point);
    }
    glm_vec3_rotate(turned.up, angle_rad, (float *)axis);
    return turned;
}

static bool is_finite3(const float v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

bool camera_check(const camera *c, failure *fault)
{
    const struct {
        const char *name;
        const float *value;
    } vectors[] = {{"eye", c->eye}, {"target", c->target}, {"up", c->up}};
    for (int i = 0; i < 3; i++) {
        const float *v = vectors[i].value;
        if (!is_finite3(v))
            return fault_set(fault, "camera %s (%g, %g, %g) is not finite", vectors[i].name, (double)v[0], (double)v[1],
                             (double)v[2]);
    }
    double offset[3], up[3], right[3], largest = 0.0;
    for (int i = 0; i < 3; i++) {
        offset[i] = (double)c->eye[i] - c->target[i];
        up[i] = c->up[i];
        largest = fmax(largest, fmax(fabs((double)c->eye[i]), fabs((double)c->target[i])));
    }
    /* At a smaller distance, rounding of the coordinates decides where the camera looks. */
    if (!(normalize(offset) > 4.0 * (double)FLT_EPSILON * largest))
        return fault_set(fault, "camera eye and target are the same point (%g, %g, %g)", (double)c->eye[0],
                         (double)c->eye[1], (double)c->eye[2]);
    if (!(normalize(up) > 0.0))
        return fault_set(fault, "camera up is (0, 0, 0)");
    cross(up, offset, right);
    if (!(sqrt(dot(right, right)) > 1e-4))
        return fault_set(fault, "camera up (%g, %g, %g) is along the line from eye to target", (double)c->up[0],
                         (double)c->up[1], (double)c->up[2]);
    if (!(c->fov_y_rad > 0.0f && c->fov_y_rad < GLM_PIf))
        return fault_set(fault, "camera fov of %g degrees is not between 0 and 180",
                         (double)c->fov_y_rad * 180.0 / GLM_PI);
    if (!(c->near_plane > 0.0f && isfinite(c->near_plane)))
        return fault_set(fault, "camera near plane %g is not a positive distance", (double)c->near_plane);
    if (!(c->far_plane > c->near_plane && isfinite(c->far_plane)))
        return fault_set(fault, "camera far plane %g is not beyond the near plane %g", (double)c->far_plane,
                         (double)c->near_plane);
    return true;
}

scene_view camera_view(const camera *c, int width, int height)
{
    scene_view view = {.width = width, .height = height};
    basis b = camera_basis(c);
    const double *rows[3] = {b.right, b.up, b.back};
    const double eye[3] = {c->eye[0], c->eye[1], c->eye[2]};
    for (int r = 0; r < 3; r++) {
        for (int i = 0; i < 3; i++)
            view.view_from_world[4 * i + r] = (float)rows[r][i];
        view.view_from_world[12 + r] = (float)-dot(rows[r], eye);
    }
    view.view_from_world[15] = 1.0f;

    const float aspect = (float)width / (float)height, half = c->half_height;
    mat4 clip_from_view;
    if (half > 0)
        glm_ortho(-half * aspect, half * aspect, -half, half, c->near_plane, c->far_plane, clip_from_view);
    else
        glm_perspective(c->fov_y_rad, aspect, c->near_plane, c->far_plane, clip_from_view);
    glm_mat4_ucopy(clip_from_view, (vec4 *)view.clip_from_view);
    return view;
}

float camera_suggest_radius(const scene *s)
{
    double diagonal = bounds_diagonal(s);
    return diagonal > 0.0 ? (float)(diagonal / 20.0) : 0.5f;
}

scene_view camera_widened_view(const scene_view *view, int margin)
{
    scene_view wide = *view;
    wide.width += 2 * margin;
    wide.height += 2 * margin;
    wide.margin = margin;
    for (int column = 0; column < 4; column++) {
        wide.clip_from_view[4 * column] *= (float)view->width / (float)wide.width;
        wide.clip_from_view[4 * column + 1] *= (float)view->height / (float)wide.height;
    }
    return wide;
}
