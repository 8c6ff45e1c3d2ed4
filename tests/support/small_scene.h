/* SPDX-License-Identifier: MIT
 *
 * Scenes built by hand, for tests of the drawing: materials, then meshes of one primitive, each with its instances.
 */
#pragma once

#include "scene.h"
#include "scene_scopes.h"

enum { SMALL_SCENE_VERTICES = 16384, SMALL_SCENE_PARTS = 256 };

typedef struct small_scene {
    scene scene; /* points into the arrays below */
    scene_vertex vertices[SMALL_SCENE_VERTICES];
    uint32_t indices[SMALL_SCENE_VERTICES * 6];
    scene_primitive primitives[SMALL_SCENE_PARTS];
    scene_mesh meshes[SMALL_SCENE_PARTS];
    scene_instance instances[SMALL_SCENE_PARTS];
    scene_material materials[SMALL_SCENE_PARTS];
    scene_texture textures[4];
    scene_image images[4];
} small_scene;

/* White, opaque, single-sided, lit. */
scene_material small_scene_material(void);

/* free() frees it. */
small_scene *small_scene_create(void);
int small_scene_add_material(small_scene *s, scene_material material);
/* Keeps the pointer to the texels. Nearest filter, repeated. Returns the texture. */
int small_scene_add_texture(small_scene *s, int width, int height, const uint8_t *rgba);

/* Begins a mesh of one primitive; everything added next belongs to it. */
void small_scene_begin_mesh(small_scene *s, int material);
/* A quad with corners corner, + u, + v, both; its front is where u x v points; uv is (0, 1) at the corner and (1, 0)
 * opposite. Its normals are the plane's. Returns the first of its four vertices. */
scene_vertex *small_scene_add_quad(small_scene *s, const float corner[3], const float u[3], const float v[3]);
/* A sphere of radius 1 with its front outside: 24 by 12 quads with the sphere's own normals. */
void small_scene_add_sphere(small_scene *s);
/* An instance of the mesh begun last; NULL leaves it in place. Grows the bounds, so add the vertices first. */
void small_scene_add_instance(small_scene *s, const float world_from_mesh[16]);

/* world_from_mesh: scales, then a turn about (1, 2, 3) by 0.8. A negative scale mirrors. */
void small_scene_turned_and_scaled(float x, float y, float z, float out[16]);
/* A copy whose vertices are where the instances put them, as a modelling program would bake it. Free with free(). */
small_scene *small_scene_baked(const small_scene *s);
