/* SPDX-License-Identifier: MIT
 *
 * Grids in two parameters, bent into the solids.
 */
#include "shapes.h"

#include <math.h>
#include <string.h>

static const float two_pi = 6.28318530718f;

/* Where a grid's point lies, for s and t within 0 and 1: position and normal, of any length but 0. */
typedef void surface_fn(const void *surface, float s, float t, float position[3], float normal[3]);

static bool same_place(const float a[3], const float b[3])
{
    return fabsf(a[0] - b[0]) + fabsf(a[1] - b[1]) + fabsf(a[2] - b[2]) < 1e-6f;
}

/* Where a side of the grid shrinks to a point, half of its triangles have no area and are left out. */
static bool add_triangle(scene_builder *b, uint32_t i, uint32_t j, uint32_t k)
{
    const scene_vertex *v = b->made->vertices;
    if (same_place(v[i].position, v[j].position) || same_place(v[j].position, v[k].position) ||
        same_place(v[k].position, v[i].position))
        return true;
    uint32_t first = 0;
    uint32_t *to = scene_builder_add_indices(b, 3, &first);
    if (to)
        memcpy(to, (uint32_t[3]){i, j, k}, 3 * sizeof *to);
    return to;
}

/* Evaluates the surface at (s_cells + 1) x (t_cells + 1) points; it faces the way of d/ds x d/dt. */
static bool add_surface(scene_builder *b, surface_fn *at, const void *surface, uint32_t s_cells, uint32_t t_cells)
{
    uint32_t first = 0;
    scene_vertex *vertex = scene_builder_add_vertices(b, (s_cells + 1) * (t_cells + 1), &first);
    bool ok = vertex;
    for (uint32_t t = 0; ok && t <= t_cells; ++t)
        for (uint32_t s = 0; s <= s_cells; ++s, ++vertex) {
            vertex->uv[0][0] = vertex->uv[1][0] = (float)s / (float)s_cells;
            vertex->uv[0][1] = vertex->uv[1][1] = 1 - (float)t / (float)t_cells;
            at(surface, (float)s / (float)s_cells, (float)t / (float)t_cells, vertex->position, vertex->normal);
            const float *n = vertex->normal, length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            for (int axis = 0; axis < 3; ++axis)
                vertex->normal[axis] /= length;
            for (int c = 0; c < 4; ++c)
                vertex->color[c] = 1;
        }
    for (uint32_t t = 0; t < t_cells; ++t)
        for (uint32_t s = 0; ok && s < s_cells; ++s) {
            const uint32_t here = first + t * (s_cells + 1) + s, above = here + s_cells + 1;
            ok = add_triangle(b, here, here + 1, above + 1) && add_triangle(b, here, above + 1, above);
        }
    return ok;
}

typedef struct plane {
    const float *corner, *u, *v;
} plane;

static void plane_at(const void *surface, float s, float t, float position[3], float normal[3])
{
    const plane *p = surface;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        position[i] = p->corner[i] + s * p->u[i] + t * p->v[i];
        normal[i] = p->u[j] * p->v[k] - p->u[k] * p->v[j];
    }
}

bool shape_grid(scene_builder *b, const float corner[3], const float u[3], const float v[3], uint32_t u_cells,
                uint32_t v_cells)
{
    const plane p = {corner, u, v};
    return add_surface(b, plane_at, &p, u_cells, v_cells);
}

bool shape_box(scene_builder *b)
{
    for (int axis = 0; axis < 3; ++axis)
        for (int side = -1; side <= 1; side += 2) {
            /* u x v points along side * axis. */
            float corner[3] = {-0.5f, -0.5f, -0.5f}, u[3] = {0}, v[3] = {0};
            corner[axis] = 0.5f * (float)side;
            u[(axis + (side > 0 ? 1 : 2)) % 3] = 1;
            v[(axis + (side > 0 ? 2 : 1)) % 3] = 1;
            if (!shape_grid(b, corner, u, v, 1, 1))
                return false;
        }
    return true;
}

typedef struct cone {
    float bottom_radius, top_radius, height;
} cone;

static void cone_side_at(const void *surface, float s, float t, float position[3], float normal[3])
{
    const cone *c = surface;
    const float radius = c->bottom_radius + t * (c->top_radius - c->bottom_radius);
    const float x = sinf(two_pi * s), z = cosf(two_pi * s);
    memcpy(position, (float[3]){radius * x, t * c->height, radius * z}, 3 * sizeof *position);
    memcpy(normal, (float[3]){c->height * x, c->bottom_radius - c->top_radius, c->height * z}, 3 * sizeof *normal);
}

typedef struct disc {
    float radius, y;
    bool up;
} disc;

/* From the rim to the middle, so that the order of s sets the side. */
static void disc_at(const void *surface, float s, float t, float position[3], float normal[3])
{
    const disc *d = surface;
    const float radius = (1 - t) * d->radius, angle = two_pi * (d->up ? s : -s);
    memcpy(position, (float[3]){radius * sinf(angle), d->y, radius * cosf(angle)}, 3 * sizeof *position);
    memcpy(normal, (float[3]){0, d->up ? 1.0f : -1.0f, 0}, 3 * sizeof *normal);
}

bool shape_cylinder(scene_builder *b, float bottom_radius, float top_radius, float height, uint32_t slices,
                    uint32_t stacks)
{
    const cone side = {bottom_radius, top_radius, height};
    const disc bottom = {bottom_radius, 0, false}, top = {top_radius, height, true};
    return add_surface(b, cone_side_at, &side, slices, stacks) && add_surface(b, disc_at, &bottom, slices, 1) &&
           add_surface(b, disc_at, &top, slices, 1);
}

static void sphere_at(const void *surface, float s, float t, float position[3], float normal[3])
{
    const float radius = *(const float *)surface, up = two_pi * 0.5f * (t - 0.5f);
    memcpy(normal, (float[3]){cosf(up) * sinf(two_pi * s), sinf(up), cosf(up) * cosf(two_pi * s)}, 3 * sizeof *normal);
    for (int axis = 0; axis < 3; ++axis)
        position[axis] = radius * normal[axis];
}

bool shape_sphere(scene_builder *b, float radius, uint32_t slices, uint32_t stacks)
{
    return add_surface(b, sphere_at, &radius, slices, stacks);
}
