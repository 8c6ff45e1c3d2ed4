/* SPDX-License-Identifier: MIT
 *
 * The parts of glssao-bake: reading the file's vertices, casting rays, computing values at vertices, writing the file.
 */
#pragma once

#include "fault.h"
#include "gltf_document.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum bake_method {
    BAKE_TRIANGLES = 0, /* rays from each triangle's centroid; a vertex gets the mean of its triangles */
    BAKE_VERTICES,      /* rays from the vertices */
    BAKE_FIT            /* rays from many points of each triangle; the vertices' values are fitted to them */
} bake_method;

typedef struct bake_options {
    const char *input, *output;
    bake_method method;
    int rays;
    float distance;    /* scene units, INFINITY: none */
    float offset;      /* scene units, below 0: chosen by the scene's size */
    float floor_value; /* accessibility below it is raised to it */
    bool cosine, accessibility_only;
    scene_load_options file;           /* how to load the input, except the memory limit: */
    int memory_mib;                    /* 0: half of the machine's */
    bool in_place;                     /* the output may be the input */
    bool vertices, fit, help, version; /* as given */
    uint32_t seed;
    int threads;
} bake_options;

/* The options for the loader. */
scene_load_options bake_load_options(const bake_options *o);

/* options.c: as in glssao-render. BAKE_DONE: help or version was printed. BAKE_WRONG: one line in `error`. */
typedef enum bake_result { BAKE_RUN, BAKE_DONE, BAKE_WRONG } bake_result;
bake_result bake_parse_options(int argc, char **argv, bake_options *out, failure *fault);

/* The vertices that one or more primitives of a node's mesh share. */
typedef struct bake_part {
    size_t node;
    size_t *primitives; /* numbers in the mesh */
    size_t primitive_count;
    uint32_t vertex_count, index_count;
    float (*positions)[3];
    float (*normals)[3]; /* NULL: the file has none */
    float (*colors)[4];  /* COLOR_0; NULL: white */
    uint32_t *indices;
    bool double_sided;
    double center[3];              /* positions are relative to it */
    double (*world_from_mesh)[16]; /* of each instance, in the file's coordinates */
    size_t instance_count;
    float *accessibility; /* of each vertex: the result */
} bake_part;

/* bake_model.c: the parts of everything that the file shows. Blended materials too: they block nothing, but are seen.
 */
typedef struct bake_model {
    gltf_document document;
    scene_warnings warnings;
    bake_part *parts;
    size_t part_count;
    double origin[3]; /* in the file's coordinates, of the space that rays are cast in; set by bake_cast */
} bake_model;

/* False, with the fault set; bake_model_close is due in either case. */
bool bake_model_open(bake_model *m, const bake_options *o, failure *fault);
void bake_model_close(bake_model *m);

/* bake_points.c: where rays start. Of a part, for one of its instances, in the world. */
typedef struct bake_points {
    size_t count;
    float (*positions)[3], (*normals)[3];
    uint32_t *triangles; /* the triangle of each point; NULL with BAKE_VERTICES, where point i is vertex i */
    float (*weights)[3]; /* of its corners */
    float *areas;        /* the share of the triangle's area that each point stands for, in the first instance */
} bake_points;

/* Points for the method; `total_area` and `total_triangles` of all parts say how densely BAKE_FIT samples. */
bool bake_points_make(bake_points *p, const bake_part *part, size_t instance, const double origin[3],
                      bake_method method, double triangles_per_area, failure *fault);
void bake_points_free(bake_points *p);
/* The area of a part's triangles in its first instance. */
double bake_part_area(const bake_part *part);

/* bake_spread.c: from values at points to part->accessibility. */
bool bake_spread(bake_part *part, const bake_points *points, const float *values, bake_method method, failure *fault);

/* bake_cast.c: fills part->accessibility of all parts. */
typedef struct bake_stats {
    uint64_t rays;
    double seconds;
} bake_stats;
bool bake_cast(bake_model *m, const bake_options *o, bake_stats *out, failure *fault);

/* bake_write.cpp: writes the file as a GLB with the parts' accessibility in COLOR_0, multiplied by the colours there or
 * alone. A mesh that several nodes share becomes one mesh for each node. */
bool bake_write(const bake_model *m, const bake_options *o, failure *fault);

#ifdef __cplusplus
}
#endif
