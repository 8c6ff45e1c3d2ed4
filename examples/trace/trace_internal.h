/* SPDX-License-Identifier: MIT
 *
 * The members of a trace_scene, and the interfaces between the parts of the tracer: the scene in Embree, filters,
 * surface points, primary rays, samples, occlusion rays, threads.
 */
#pragma once

#include "embree.h"
#include "trace.h"

typedef struct trace_part trace_part;

/* Of one of the scene's instances. */
typedef struct trace_instance {
    const float *world_from_mesh;
    const trace_part *parts;    /* its mesh's primitives */
    double normal_from_mesh[9]; /* inverse transpose up to a positive factor, columns of three */
    bool mirrored;              /* triangles change their winding */
} trace_instance;

/* One of Embree's triangle meshes: a primitive, in the space of its mesh, or placed in the world. It is the geometry's
 * user pointer. */
struct trace_part {
    const scene *scene;
    const scene_primitive *primitive;
    const trace_instance *instance; /* NULL: in mesh space */
};

/* Two levels: a mesh drawn once stands in the world itself, one drawn more often is an Embree scene with instances.
 * Geometry numbers of the world: the scene's instances, then the parts placed in the world. Of a mesh: its
 * primitives, in order; blended ones are left out. */
struct trace_scene {
    const scene *scene;
    RTCDevice device;
    RTCScene world, *meshes;   /* meshes: NULL where the mesh has no scene of its own */
    trace_instance *instances; /* of each of the scene's instances */
    trace_part *mesh_parts;    /* of each of the scene's primitives */
    trace_part *world_parts;
};

/* trace_filter.c: Embree's filter functions for alpha tests, and for culling of primary rays. */

/* A query's context. Primary rays tell the filters which way they look; occlusion rays need nothing. */
typedef struct trace_query {
    embree_context embree; /* first: Embree hands the filters a pointer to it */
    const trace_scene *trace;
    double direction_world[3];
} trace_query;

/* Whether an alpha test of this primitive can fail anywhere. */
bool trace_filter_needed(const scene *s, const scene_primitive *p);
/* Sets the filter functions that the part needs. */
void trace_filter_install(RTCGeometry geometry, const trace_part *part, bool alpha_tested);

/* trace_surface.c: triangles in world space. */

/* The part that a hit belongs to, and its instance. `instance` and `geometry` as in Embree's hit. */
const trace_part *trace_find_part(const trace_scene *t, unsigned instance, unsigned geometry,
                                  const trace_instance **out_instance);

typedef struct trace_triangle {
    double corners[3][3];
} trace_triangle;

trace_triangle trace_triangle_world(const trace_part *part, const trace_instance *instance, unsigned number);
/* Not normalised; points to the side that is counter-clockwise, mirrored instances considered. */
void trace_front_normal(const trace_triangle *triangle, const trace_instance *instance, double out[3]);

typedef struct trace_point {
    double origin[3]; /* of its rays: off the surface */
    double normal[3]; /* unit: shading normal, about which directions are spread */
} trace_point;

/* The point that a primary ray of that direction hit; its rays start at most `most_offset` off it, along either axis
 * that they are moved by. False where the triangle has no area. */
bool trace_resolve_hit(const trace_scene *t, const struct RTCHit *hit, const double direction[3], double most_offset,
                       trace_point *out);

/* trace_primary.c: rays through pixel centres. */

typedef struct trace_eye {
    double world_from_clip[16]; /* column-major */
    double forward[3];          /* the way the camera looks, in the world */
} trace_eye;

/* False where the view has no inverse. */
bool trace_eye_open(const scene_view *view, trace_eye *out);
/* The ray through that point of normalised device coordinates, from one plane to the other (far may be infinite). */
bool trace_eye_ray(const trace_eye *eye, double x_ndc, double y_ndc, double out_origin[3], double out_direction[3],
                   double *out_length);

/* trace_samples.c: the directions. */

enum { TRACE_PACKET = 16 };

typedef struct trace_samples {
    int count;
    trace_distribution distribution;
    uint32_t seed;
    uint32_t *second; /* Sobol's second dimension, bits reversed */
} trace_samples;

bool trace_samples_open(trace_samples *s, int count, trace_distribution distribution, uint32_t seed);
void trace_samples_close(trace_samples *s);
/* Directions about +z, from number `first` on, a multiple of TRACE_PACKET, of the sequence that belongs to point number
 * `point`. The last packet may reach beyond the count. */
void trace_samples_get(const trace_samples *s, uint64_t point, int first, float x[TRACE_PACKET], float y[TRACE_PACKET],
                       float z[TRACE_PACKET]);

/* A bijection whose every output bit depends on every input bit. */
uint32_t trace_mix(uint32_t x);
/* The index-th point of Sobol's sequence in its first (0) or second (1) dimension, as a fraction of 2^32. */
uint32_t trace_sobol(uint32_t index, int dimension);
/* The same fraction, Owen-scrambled. */
uint32_t trace_owen(uint32_t fraction, uint32_t seed);

/* trace_pattern.c: directions for the pixels of a picture. */

typedef struct trace_pattern {
    int side, rays;         /* of the tile, pixels; of a pixel */
    float (*directions)[3]; /* about +z, cosine-weighted; ray k of pixel x, y: [(y * side + x) * rays + k] */
} trace_pattern;

bool trace_pattern_open(trace_pattern *p, int rays, uint32_t seed);
void trace_pattern_close(trace_pattern *p);

/* trace_rays.c: the share of a point's rays that get through. `take` (may be NULL) is handed all of them. */
float trace_point_accessibility(const trace_scene *t, const trace_samples *samples, float radius, uint64_t number,
                                const trace_point *point, trace_fan_fn take, void *user);

/* trace_jobs.c: threads. */

/* Calls work(job, user) for every job below `count`, on several threads; progress on this one. Threads below 1: as
 * many as there are cores. */
void trace_run_jobs(int threads, size_t count, void (*work)(size_t job, void *user), void *user,
                    trace_progress_fn progress, void *progress_user);
