/* SPDX-License-Identifier: MIT
 *
 * Puts a scene together piece by piece: what the glTF loader and the built-in scenes share. It grows the arrays,
 * keeps the counts, sorts the instances by mesh, measures the bounds, and moves the world's zero to the middle of a
 * scene that is far from it. Until then places are in double precision.
 */
#pragma once

#include "fault.h"
#include "scene.h"

/* An instance as it was added. */
typedef struct scene_placement {
    int mesh;
    double world_from_mesh[16];
} scene_placement;

typedef struct scene_builder {
    scene *made;
    failure *fault;
    uint32_t tangent_count;      /* how many vertices have tangents, zeroed or set */
    uint32_t more_uv_count;      /* the same for more_uvs */
    scene_placement *placements; /* of each instance, until they are sorted */
    double (*centers)[3];        /* of each mesh: where its zero lies in the file's mesh space */
    double (*camera_places)[3], (*light_places)[3];
    uint32_t room[10]; /* allocated elements of each array, by enum in scene_builder.c */
} scene_builder;

/* False, with the fault set, when there is no memory: as with every call below that can fail. */
bool scene_builder_begin(scene_builder *b, const char *name, failure *fault);

/* `count` new elements, to be filled by the caller; the index of the first goes to `out_first`. NULL on failure. The
 * pointer lives until the next call for the same array. */
scene_vertex *scene_builder_add_vertices(scene_builder *b, uint32_t count, uint32_t *out_first);
uint32_t *scene_builder_add_indices(scene_builder *b, uint32_t count, uint32_t *out_first);
/* The same from an array on the heap, which becomes the scene's, even on failure: a large mesh is not copied. */
bool scene_builder_take_indices(scene_builder *b, uint32_t *indices, uint32_t count, uint32_t *out_first);

/* Copies the element in and returns its index, -1 on failure. An image's pixels become the scene's, even then. */
int scene_builder_add_material(scene_builder *b, const scene_material *material);
int scene_builder_add_texture(scene_builder *b, const scene_texture *texture);
int scene_builder_add_image(scene_builder *b, const scene_image *image);
/* A light's and a camera's place is taken from `place`, in the file's coordinates. */
int scene_builder_add_light(scene_builder *b, const scene_light *light, const double place[3]);
int scene_builder_add_camera(scene_builder *b, const scene_camera *camera, const double place[3]);

/* The tangents of all vertices so far, zeros where none were set. NULL on failure. The pointer lives until the next
 * call of this or of scene_builder_add_vertices. */
float (*scene_builder_tangents(scene_builder *b))[4];

/* The same for uv sets 2 and 3. */
float (*scene_builder_more_uvs(scene_builder *b))[2][2];

/* A new mesh without primitives; -1 on failure. Its vertices are relative to `center`. */
int scene_builder_add_mesh_about(scene_builder *b, const double center[3]);
int scene_builder_add_mesh(scene_builder *b); /* about 0, 0, 0 */

/* Adds the indices from `first_index` to the newest, at least one triangle, to the newest mesh. */
bool scene_builder_add_primitive(scene_builder *b, uint32_t first_index, int material);

/* `world_from_mesh` is affine, column-major, of mesh space before it was centred. */
bool scene_builder_place(scene_builder *b, int mesh, const double world_from_mesh[16]);
bool scene_builder_add_instance(scene_builder *b, int mesh, const float *world_from_mesh);

/* Whether a box is so far from zero, for its size, that single precision would coarsen it. */
bool scene_is_far(const double low[3], const double high[3]);

/* White, opaque, single-sided, no texture. */
scene_material scene_default_material(void);

/* scene_settle.c: chooses the world's zero and sets bounds and all places, in single precision; the placements are
 * sorted by mesh. False, with the fault set, if the scene does not fit single precision. */
bool scene_builder_settle(scene_builder *b);

/* Hands over the finished scene; NULL, with everything freed, on failure. */
scene *scene_builder_finish(scene_builder *b);

/* Frees what was put together so far. */
void scene_builder_abandon(scene_builder *b);
