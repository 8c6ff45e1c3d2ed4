/* SPDX-License-Identifier: MIT
 *
 * What a scene_renderer is made of. draw_upload.c fills it once; draw.c reads it every frame.
 */
#ifndef GLSSAO_EXAMPLES_DRAW_INTERNAL_H
#define GLSSAO_EXAMPLES_DRAW_INTERNAL_H

#include "draw.h"
#include "program.h"

/* Vertex attributes; a matrix takes one location a column. */
enum {
    ATTRIBUTE_POSITION = 0,
    ATTRIBUTE_NORMAL = 1,
    ATTRIBUTE_UV = 2,
    ATTRIBUTE_COLOR = 3,
    ATTRIBUTE_WORLD_FROM_MESH = 4,
    ATTRIBUTE_NORMAL_WORLD_FROM_MESH = 8
};

/* As the vertex shader reads it: columns of three. */
typedef struct draw_instance {
    float world_from_mesh[4][3];
    float normal_world_from_mesh[3][3];
} draw_instance;

/* One draw call: a primitive for the instances of its mesh that are mirrored, or for those that are not. Blended
 * primitives get an item for each instance, since each has its place in the order of depth. */
typedef struct draw_item {
    uint32_t first_index, index_count;
    uint32_t first_instance, instance_count; /* in the instance buffer */
    int material;
    unsigned normals_variant, main_variant;
    bool mirrored;          /* triangles change their winding */
    double centre_world[3]; /* of the primitive's bounds; blended items only */
} draw_item;

typedef struct draw_order {
    double view_distance;
    uint32_t item;
} draw_order;

struct scene_renderer {
    const scene *scene;
    unsigned vertex_array, empty_vertex_array;
    unsigned vertex_buffer, index_buffer, instance_buffer;
    unsigned *images;   /* GL texture of each of the scene's images, 0 where no material uses it */
    unsigned *samplers; /* of each of the scene's textures, 0 likewise */
    unsigned linear_sampler, nearest_sampler; /* clamped, for screen-sized maps */
    unsigned white_texture;                   /* stands in for the ambient map */
    draw_item *items; /* opaque ones first, sorted by program and material; then blended ones as in the file */
    uint32_t opaque_count, item_count;
    draw_order *blended_order;                                /* scratch, one for each blended item */
    draw_program normals[VARIANT_COUNT], main[VARIANT_COUNT]; /* built only where an item needs it */
    draw_program map, view_distance;
};

/* The inverse transpose of the upper 3x3 of a column-major affine matrix, up to a positive factor: scaled so that its
 * largest element is 1. Where the matrix is singular it is the limit from the unmirrored side. Returns true for a
 * matrix that mirrors. */
bool draw_normal_matrix(const float affine[16], float out[3][3]);

#endif
