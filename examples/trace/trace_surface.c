/* SPDX-License-Identifier: MIT
 *
 * Turns a hit into a point on the surface: position, shading normal and geometric normal in the world. They are
 * computed in double precision from the scene's vertices, where the rasteriser's vertex shader places them.
 */
#include "trace_internal.h"

#include <math.h>

const trace_part *trace_find_part(const trace_scene *t, unsigned instance, unsigned geometry,
                                  const trace_instance **out_instance)
{
    if (instance == RTC_INVALID_GEOMETRY_ID) {
        const trace_part *part = &t->world_parts[geometry - t->scene->instance_count];
        *out_instance = part->instance;
        return part;
    }
    *out_instance = &t->instances[instance];
    return &t->instances[instance].parts[geometry];
}

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* False, and unchanged, if the vector has no direction. It is scaled first, so that no square overflows. */
static bool normalize(double v[3])
{
    const double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    if (!(largest > 0) || !isfinite(largest))
        return false;
    double scaled[3] = {v[0] / largest, v[1] / largest, v[2] / largest};
    const double length = sqrt(dot(scaled, scaled));
    for (int i = 0; i < 3; i++)
        v[i] = scaled[i] / length;
    return true;
}

static const scene_vertex *corner(const trace_part *part, unsigned triangle, unsigned k)
{
    const scene *s = part->scene;
    return &s->vertices[s->indices[part->primitive->first_index + 3 * triangle + k]];
}

trace_triangle trace_triangle_world(const trace_part *part, const trace_instance *instance, unsigned number)
{
    trace_triangle out;
    const float *m = instance->world_from_mesh;
    for (unsigned k = 0; k < 3; k++) {
        const float *p = corner(part, number, k)->position;
        for (int r = 0; r < 3; r++)
            out.corners[k][r] = (double)m[r] * (double)p[0] + (double)m[4 + r] * (double)p[1] +
                                (double)m[8 + r] * (double)p[2] + (double)m[12 + r];
    }
    return out;
}

void trace_front_normal(const trace_triangle *triangle, const trace_instance *instance, double out[3])
{
    double a[3], b[3];
    subtract(triangle->corners[1], triangle->corners[0], a);
    subtract(triangle->corners[2], triangle->corners[0], b);
    const double sign = instance->mirrored ? -1 : 1;
    for (int i = 0; i < 3; i++)
        out[i] = sign * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
}

/* Unit at each corner, then interpolated. Vertex weights as Embree's u and v have them. */
static void shading_normal(const trace_part *part, const trace_instance *instance, unsigned triangle,
                           const double weights[3], double out[3])
{
    const double *m = instance->normal_from_mesh;
    out[0] = out[1] = out[2] = 0;
    for (unsigned k = 0; k < 3; k++) {
        const float *n = corner(part, triangle, k)->normal;
        double world[3];
        for (int r = 0; r < 3; r++)
            world[r] = m[r] * (double)n[0] + m[3 + r] * (double)n[1] + m[6 + r] * (double)n[2];
        if (normalize(world)) {
            for (int r = 0; r < 3; r++)
                out[r] += weights[k] * world[r];
        }
    }
}

/* How far off the triangle the rays start. Embree works in single precision: the origin is rounded by up to 2^-24 of
 * its coordinates, and the distance to the triangle's plane by a few times 2^-24 of how far the corners are. Measured
 * on planes, large, tilted, far from the world's origin, finely cut, instanced and stretched, the first rays hit the
 * surface they start from at 2^-25 of both together. 2^-19 leaves a factor of 32 for neighbours in the same plane that
 * are much larger, and is 1/12000 of a radius that is 1/20 of the scene. */
static double choose_offset(const double position[3], const trace_triangle *triangle)
{
    double size = 0;
    for (int i = 0; i < 3; i++) {
        double most = 0;
        for (int k = 0; k < 3; k++)
            most = fmax(most, fabs(triangle->corners[k][i] - position[i]));
        size = fmax(size, fabs(position[i]) + most);
    }
    return 0x1p-19 * size;
}

bool trace_resolve_hit(const trace_scene *t, const struct RTCHit *hit, const double direction[3], double most_offset,
                       trace_point *out)
{
    const trace_instance *instance;
    const trace_part *part = trace_find_part(t, hit->instID[0], hit->geomID, &instance);
    const double weights[3] = {1 - (double)hit->u - (double)hit->v, (double)hit->u, (double)hit->v};
    const trace_triangle triangle = trace_triangle_world(part, instance, hit->primID);
    double geometric[3], position[3] = {0, 0, 0};
    trace_front_normal(&triangle, instance, geometric);
    if (!normalize(geometric))
        return false;
    const double side = dot(geometric, direction) > 0 ? -1 : 1; /* the viewer's */
    if (part->primitive->flat) {
        for (int i = 0; i < 3; i++)
            out->normal[i] = geometric[i];
    } else {
        shading_normal(part, instance, hit->primID, weights, out->normal);
    }
    const bool shaded = normalize(out->normal);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            position[i] += weights[k] * triangle.corners[k][i];
        /* A normal without direction faces the viewer, as in the pre-pass. */
        out->normal[i] = shaded ? side * out->normal[i] : -direction[i];
    }
    /* Moves the point off its triangle, along the normal and back along the primary ray, where space is free. Otherwise
     * rounding could put a point in a corner behind the other wall. */
    const double offset = fmin(choose_offset(position, &triangle), most_offset);
    for (int i = 0; i < 3; i++)
        out->origin[i] = position[i] + offset * (side * geometric[i] - direction[i]);
    return true;
}
