/* SPDX-License-Identifier: MIT
 *
 * Places a camera so that the scene's vertices fill the picture, with equal margins on opposite sides.
 *
 * In the camera's axes, with the origin in the scene's middle, the eye is at (e, f, d). A vertex (x, y, z) lies inside
 * the right border where x - e <= right (d - z), and inside the left one where e - x <= left (d - z); the same holds
 * for y. Only the outermost vertices at each depth z count. So one pass over the vertices keeps, for each of SLICES
 * slices of depth, the smallest and largest x and y.
 */
#include "camera.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float default_fov_y_rad = 0.785398163f;                           /* 45 degrees */
static const float default_azimuth_rad = 0.30f, default_elevation_rad = 0.35f; /* tuned by eye: shows depth */
static const double fill = 0.95;        /* share of the picture's width or height that the scene may take */
static const double least_depth = 0.05; /* of the scene's diagonal, between the eye and the nearest vertex */
enum { SLICES = 1024, TURN_STEPS = 64 };

typedef struct slice {
    double low[2], high[2]; /* x and y */
    double nearest;         /* largest z of the vertices in the slice; -INFINITY: there are none */
} slice;

/* A slice of a scene that turns: its height above the middle, and its largest distance from the axis. */
typedef struct ring {
    double low, high, radius;
} ring;

typedef struct outline {
    double middle[3], axes[3][3]; /* world space; axes: right, up, back */
    double axis[3];               /* of a turntable */
    bool turns;
    double reach; /* the largest distance of a corner of the bounds from the middle: slices span -reach to reach */
    slice slices[SLICES];
    ring rings[SLICES];
} outline;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int slice_of(const outline *o, double along)
{
    const double at = (along / o->reach * 0.5 + 0.5) * SLICES;
    return at < 0 ? 0 : at >= SLICES ? SLICES - 1 : (int)at;
}

/* A point relative to the middle. Coordinates are finite, so that nothing calls for fmin. */
static void add_seen(outline *o, const double p[3])
{
    const double at[2] = {dot(p, o->axes[0]), dot(p, o->axes[1])}, z = dot(p, o->axes[2]);
    slice *s = &o->slices[slice_of(o, z)];
    s->nearest = s->nearest > z ? s->nearest : z;
    for (int i = 0; i < 2; i++) {
        s->low[i] = s->low[i] < at[i] ? s->low[i] : at[i];
        s->high[i] = s->high[i] > at[i] ? s->high[i] : at[i];
    }
}

static void add_vertex(outline *o, const float m[16], const float v[3])
{
    double p[3];
    for (int r = 0; r < 3; r++)
        p[r] = (double)m[r] * (double)v[0] + (double)m[4 + r] * (double)v[1] + (double)m[8 + r] * (double)v[2] +
               (double)m[12 + r] - o->middle[r];
    if (!o->turns) {
        add_seen(o, p);
        return;
    }
    const double height = dot(p, o->axis);
    ring *r = &o->rings[slice_of(o, height)];
    r->low = fmin(r->low, height);
    r->high = fmax(r->high, height);
    r->radius = fmax(r->radius, sqrt(fmax(dot(p, p) - height * height, 0)));
}

/* Adds the points that the rings pass in a full turn. The camera's right lies across the axis, and so does `across`. */
static void add_rings(outline *o)
{
    const double *u = o->axis, *right = o->axes[0];
    double across[3];
    for (int c = 0; c < 3; c++)
        across[c] = u[(c + 1) % 3] * right[(c + 2) % 3] - u[(c + 2) % 3] * right[(c + 1) % 3];
    for (int i = 0; i < SLICES; i++) {
        const ring *r = &o->rings[i];
        for (int k = 0; r->high >= r->low && k < 2 * TURN_STEPS; k++) {
            const double angle = 6.28318530718 * (k / 2) / TURN_STEPS, height = k % 2 ? r->high : r->low;
            double p[3];
            for (int c = 0; c < 3; c++)
                p[c] = height * u[c] + r->radius * (cos(angle) * right[c] + sin(angle) * across[c]);
            add_seen(o, p);
        }
    }
}

/* Visits each vertex of the primitive once; a set bit marks one that was visited. Without memory for bits it visits a
 * vertex as often as triangles have it. */
static void add_primitive(outline *o, const scene *s, const scene_primitive *p, const float m[16], uint8_t *visited)
{
    for (uint32_t i = 0; i < p->index_count; i++) {
        const uint32_t v = s->indices[p->first_index + i];
        const uint8_t bit = (uint8_t)(1u << (v & 7));
        if (visited && visited[v >> 3] & bit)
            continue;
        if (visited)
            visited[v >> 3] |= bit;
        add_vertex(o, m, s->vertices[v].position);
    }
    const size_t bytes = s->vertex_count / 8 + 1;
    if (visited && p->index_count > bytes)
        memset(visited, 0, bytes);
    for (uint32_t i = 0; visited && p->index_count <= bytes && i < p->index_count; i++)
        visited[s->indices[p->first_index + i] >> 3] = 0;
}

static void add_scene(outline *o, const scene *s)
{
    for (int i = 0; i < SLICES; i++) {
        o->slices[i] = (slice){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, -INFINITY};
        o->rings[i] = (ring){INFINITY, -INFINITY, 0};
    }
    uint8_t *visited = calloc(s->vertex_count / 8 + 1, 1);
    for (uint32_t k = 0; k < s->mesh_count; k++) {
        const scene_mesh *mesh = &s->meshes[k];
        for (uint32_t i = 0; i < mesh->instance_count; i++)
            for (uint32_t p = 0; p < mesh->primitive_count; p++)
                add_primitive(o, s, &s->primitives[mesh->first_primitive + p],
                              s->instances[mesh->first_instance + i].world_from_mesh, visited);
    }
    free(visited);
    if (o->turns)
        add_rings(o);
}

/* The borders along an axis: of x - e over d - z. */
typedef struct borders {
    double low, high;
} borders;

/* The smallest distance of the eye at which the scene lies between the borders. */
static double least_distance(const outline *o, int axis, borders b)
{
    double above = -INFINITY, below = -INFINITY;
    for (int i = 0; i < SLICES; i++) {
        const slice *s = &o->slices[i];
        if (s->nearest == -INFINITY)
            continue;
        above = fmax(above, s->high[axis] + b.high * s->nearest);
        below = fmax(below, -s->low[axis] - b.low * s->nearest);
    }
    return (above + below) / (b.high - b.low);
}

/* The eye's place along an axis, for a given distance, that leaves equal margins. */
static double centred(const outline *o, int axis, double distance, borders b)
{
    double from = -2 * distance - 2 * o->reach, to = -from;
    for (int step = 0; step < 64; step++) {
        const double e = 0.5 * (from + to);
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i < SLICES; i++) {
            const slice *s = &o->slices[i];
            if (s->nearest == -INFINITY)
                continue;
            low = fmin(low, (s->low[axis] - e) / (distance - s->nearest));
            high = fmax(high, (s->high[axis] - e) / (distance - s->nearest));
        }
        if (low + high > b.low + b.high) /* too far to the right or to the top */
            from = e;
        else
            to = e;
    }
    return 0.5 * (from + to);
}

static double nearest_vertex(const outline *o)
{
    double nearest = -INFINITY;
    for (int i = 0; i < SLICES; i++)
        nearest = fmax(nearest, o->slices[i].nearest);
    return nearest;
}

/* Fills eye[] in the camera's axes, and the half height of an orthographic view. */
static void place_eye(const outline *o, const camera_framing *how, double eye[3], double *half_height)
{
    const double aspect = how->aspect > 0 ? (double)how->aspect : 1;
    const double tan_y = how->orthographic ? 1 : tan(0.5 * (double)how->fov_y_rad), tan_x = tan_y * aspect;
    const double middle = (double)how->free_left + (double)how->free_right - 1;
    const double half = (double)how->free_right - (double)how->free_left;
    const double depth = least_depth * 2 * o->reach;
    const borders b[2] = {{tan_x * (middle - fill * half), tan_x * (middle + fill * half)},
                          {-tan_y * fill, tan_y * fill}};
    eye[2] = nearest_vertex(o) + depth;
    if (!how->orthographic) {
        for (int i = 0; i < 2; i++)
            eye[2] = fmax(eye[2], least_distance(o, i, b[i]));
        for (int i = 0; i < 2; i++)
            eye[i] = centred(o, i, eye[2], b[i]);
        return;
    }
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < SLICES; i++)
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], o->slices[i].low[k]);
            high[k] = fmax(high[k], o->slices[i].high[k]);
        }
    *half_height = 1e-6 * o->reach; /* a line seen from its end */
    for (int k = 0; k < 2; k++)
        *half_height = fmax(*half_height, (high[k] - low[k]) / (b[k].high - b[k].low));
    for (int k = 0; k < 2; k++) /* the middle of the scene goes to the middle of the free part */
        eye[k] = 0.5 * (low[k] + high[k]) - 0.5 * (b[k].low + b[k].high) * *half_height;
}

camera_framing camera_default_framing(float aspect)
{
    return (camera_framing){.azimuth_rad = default_azimuth_rad,
                            .elevation_rad = default_elevation_rad,
                            .up = {0, 1, 0},
                            .fov_y_rad = default_fov_y_rad,
                            .aspect = aspect,
                            .free_right = 1};
}

void camera_find_turn(const float up[3], double out[3][3])
{
    const double length =
        sqrt((double)up[0] * (double)up[0] + (double)up[1] * (double)up[1] + (double)up[2] * (double)up[2]);
    const double x = (double)up[0] / length, y = (double)up[1] / length, z = (double)up[2] / length;
    const bool over = y < -1 + 1e-9;
    const double k = over ? 0 : 1 / (1 + y); /* Rodrigues' formula about the cross product of +y and up */
    const double turn[3][3] = {
        {over ? -1 : 1 - k * x * x, over ? 0 : -x, -k * x * z}, {x, y, z}, {-k * x * z, over ? 0 : -z, 1 - k * z * z}};
    memcpy(out, turn, sizeof turn);
}

/* The camera's axes for a direction: azimuth and elevation are 0 at the front of the scene. */
static void find_axes(const camera_framing *how, outline *o)
{
    double turn[3][3];
    camera_find_turn(how->up, turn);
    const double *side = turn[0], *front = turn[2], *u = o->axis;
    memcpy(o->axis, turn[1], sizeof o->axis);
    const double sin_a = sin((double)how->azimuth_rad), cos_a = cos((double)how->azimuth_rad);
    const double sin_e = sin((double)how->elevation_rad), cos_e = cos((double)how->elevation_rad);
    for (int i = 0; i < 3; i++) {
        const double level = sin_a * side[i] + cos_a * front[i];
        o->axes[0][i] = cos_a * side[i] - sin_a * front[i];
        o->axes[1][i] = cos_e * u[i] - sin_e * level;
        o->axes[2][i] = cos_e * level + sin_e * u[i];
    }
}

camera camera_frame(const scene *s, const camera_framing *how)
{
    camera c = {.fov_y_rad = how->fov_y_rad};
    outline o = {.turns = how->turns};
    double diagonal = 0, eye[3] = {0, 0, 1}, half_height = 1;
    find_axes(how, &o);
    for (int i = 0; i < 3; i++) {
        const double size = (double)s->bounds_max[i] - (double)s->bounds_min[i];
        o.middle[i] = 0.5 * ((double)s->bounds_min[i] + (double)s->bounds_max[i]);
        diagonal += size * size;
    }
    o.reach = 0.5 * sqrt(diagonal);
    if (s->instance_count && o.reach > 0) {
        add_scene(&o, s);
        place_eye(&o, how, eye, &half_height);
    }
    const double target_z = fmin(0, eye[2] - least_depth * o.reach); /* in front of the eye */
    for (int i = 0; i < 3; i++) {
        const double across = o.middle[i] + eye[0] * o.axes[0][i] + eye[1] * o.axes[1][i];
        c.up[i] = (float)o.axes[1][i];
        c.target[i] = (float)(across + target_z * o.axes[2][i]);
        c.eye[i] = (float)(across + eye[2] * o.axes[2][i]);
    }
    c.half_height = how->orthographic ? (float)half_height : 0;
    camera_fit_planes(&c, s);
    return c;
}

camera camera_frame_scene(const scene *s, float aspect)
{
    const camera_framing how = camera_default_framing(aspect);
    return camera_frame(s, &how);
}
