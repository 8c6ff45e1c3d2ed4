/* SPDX-License-Identifier: MIT
 *
 * Depth and normal maps that are computed instead of drawn: the ray of each pixel hits spheres, boxes and planes, in
 * double precision, for any supported projection. Tests know every input exactly and need no renderer.
 */
#pragma once

#include <stdbool.h>

typedef enum analytic_kind { ANALYTIC_SPHERE, ANALYTIC_BOX, ANALYTIC_PLANE } analytic_kind;

/* View space. Sphere: center, radius size[0]. Box: center, half sizes. Plane: through center, unit normal in size. */
typedef struct analytic_shape {
    analytic_kind kind;
    double center[3], size[3];
} analytic_shape;

typedef enum analytic_projection {
    PERSPECTIVE,
    PERSPECTIVE_OFF_CENTRE,
    PERSPECTIVE_INFINITE,
    PERSPECTIVE_REVERSED_ZERO_TO_ONE,
    PERSPECTIVE_INFINITE_REVERSED_ZERO_TO_ONE,
    ORTHOGRAPHIC,
    ORTHOGRAPHIC_REVERSED,
    PROJECTION_COUNT
} analytic_projection;

typedef struct analytic_view {
    float projection[16]; /* column-major */
    bool clip_zero_to_one;
    float sky_depth;
} analytic_view;

/* `scale` multiplies every length: near, far, and the orthographic extent. */
analytic_view analytic_make_view(analytic_projection kind, double aspect, double near_plane, double far_plane,
                                 double scale);

/* Window depth (sky where nothing is hit) and normals (xyz; 0, 0, 1 on sky); the caller frees both. */
void analytic_render(const analytic_view *view, const analytic_shape *shapes, int shape_count, int width, int height,
                     float **out_depth, float **out_normals);
/* The same with view distance (scene units; infinite on sky). */
void analytic_render_distance(const analytic_view *view, const analytic_shape *shapes, int shape_count, int width,
                              int height, float **out_depth, float **out_normals, float **out_distance);

/* Cosine-weighted accessibility of a point with that unit normal: the share of `rays` rays (a Fibonacci lattice on the
 * disc below the hemisphere) that hit no shape within `radius`. */
double analytic_accessibility(const analytic_shape *shapes, int shape_count, const double point[3],
                              const double normal[3], double radius, int rays);

/* The same, and the sum of the directions of the rays that hit nothing, over the number of all rays. */
double analytic_open(const analytic_shape *shapes, int shape_count, const double point[3], const double normal[3],
                     double radius, int rays, double out_mean[3]);

/* A floor, a wall, two spheres and two boxes, 3 to 9 units away. */
enum { ANALYTIC_ROOM_SHAPES = 6 };
extern const analytic_shape analytic_unit_room[ANALYTIC_ROOM_SHAPES];
/* The same with all lengths times `scale`. */
void analytic_room(analytic_shape shapes[ANALYTIC_ROOM_SHAPES], double scale);
