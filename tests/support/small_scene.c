/* SPDX-License-Identifier: MIT */
#include "small_scene.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

scene_material small_scene_material(void)
{
    return (scene_material){.base_color = {1, 1, 1, 1},
                            .base_color_texture = -1,
                            .base_color_uv_from_uv = {1, 0, 0, 0, 1, 0},
                            .alpha_cutoff = 0.5f};
}

small_scene *small_scene_create(void)
{
    small_scene *s = calloc(1, sizeof *s);
    assert(s);
    s->scene.vertices = s->vertices;
    s->scene.indices = s->indices;
    s->scene.primitives = s->primitives;
    s->scene.meshes = s->meshes;
    s->scene.instances = s->instances;
    s->scene.materials = s->materials;
    s->scene.textures = s->textures;
    s->scene.images = s->images;
    return s;
}

int small_scene_add_material(small_scene *s, scene_material material)
{
    s->materials[s->scene.material_count] = material;
    return (int)s->scene.material_count++;
}

int small_scene_add_texture(small_scene *s, int width, int height, const uint8_t *rgba)
{
    int index = (int)s->scene.image_count;
    s->images[index] = (scene_image){width, height, (uint8_t *)(uintptr_t)rgba, false};
    s->textures[index] = (scene_texture){.image = index, .min_nearest = true, .mag_nearest = true};
    s->scene.image_count++;
    s->scene.texture_count++;
    return index;
}

void small_scene_begin_mesh(small_scene *s, int material)
{
    s->primitives[s->scene.primitive_count] = (scene_primitive){.first_index = s->scene.index_count,
                                                                .material = material,
                                                                .bounds_min = {INFINITY, INFINITY, INFINITY},
                                                                .bounds_max = {-INFINITY, -INFINITY, -INFINITY}};
    s->meshes[s->scene.mesh_count] = (scene_mesh){
        .first_primitive = s->scene.primitive_count, .primitive_count = 1, .first_instance = s->scene.instance_count};
    s->scene.primitive_count++;
    s->scene.mesh_count++;
}

static scene_vertex *add_vertex(small_scene *s, const float position[3], const float normal[3], float u, float v)
{
    assert(s->scene.vertex_count < SMALL_SCENE_VERTICES);
    scene_vertex *vertex = &s->vertices[s->scene.vertex_count];
    *vertex = (scene_vertex){.uv = {{u, v}, {v, u}}, .color = {1, 1, 1, 1}};
    memcpy(vertex->position, position, sizeof vertex->position);
    memcpy(vertex->normal, normal, sizeof vertex->normal);
    scene_primitive *p = &s->primitives[s->scene.primitive_count - 1];
    for (int i = 0; i < 3; i++) {
        p->bounds_min[i] = fminf(p->bounds_min[i], position[i]);
        p->bounds_max[i] = fmaxf(p->bounds_max[i], position[i]);
    }
    s->scene.vertex_count++;
    return vertex;
}

static void add_triangle(small_scene *s, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t triangle[3] = {a, b, c};
    memcpy(s->indices + s->scene.index_count, triangle, sizeof triangle);
    s->scene.index_count += 3;
    s->primitives[s->scene.primitive_count - 1].index_count += 3;
}

scene_vertex *small_scene_add_quad(small_scene *s, const float corner[3], const float u[3], const float v[3])
{
    float normal[3], length = 0;
    for (int i = 0; i < 3; i++)
        normal[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    for (int i = 0; i < 3; i++)
        length += normal[i] * normal[i];
    for (int i = 0; i < 3; i++)
        normal[i] /= sqrtf(length);
    uint32_t first = s->scene.vertex_count;
    for (int k = 0; k < 4; k++) {
        float position[3], at_u = (float)(k & 1), at_v = (float)(k >> 1);
        for (int i = 0; i < 3; i++)
            position[i] = corner[i] + at_u * u[i] + at_v * v[i];
        add_vertex(s, position, normal, at_u, 1 - at_v);
    }
    add_triangle(s, first, first + 1, first + 2);
    add_triangle(s, first + 2, first + 1, first + 3);
    return &s->vertices[first];
}

void small_scene_add_sphere(small_scene *s)
{
    enum { AROUND = 24, DOWN = 12 };
    const double pi = 3.14159265358979323846;
    uint32_t first = s->scene.vertex_count;
    for (int j = 0; j <= DOWN; j++)
        for (int i = 0; i <= AROUND; i++) {
            double longitude = 2 * pi * i / AROUND, latitude = pi * j / DOWN;
            float point[3] = {(float)(sin(latitude) * sin(longitude)), (float)cos(latitude),
                              (float)(sin(latitude) * cos(longitude))};
            add_vertex(s, point, point, (float)i / 4, (float)j / 4);
        }
    for (uint32_t j = 0; j < DOWN; j++)
        for (uint32_t i = 0; i < AROUND; i++) {
            uint32_t above = first + j * (AROUND + 1) + i, below = above + AROUND + 1;
            add_triangle(s, above, below, above + 1);
            add_triangle(s, above + 1, below, below + 1);
        }
}

void small_scene_add_instance(small_scene *s, const float world_from_mesh[16])
{
    const float *m = world_from_mesh ? world_from_mesh : identity;
    const scene_primitive *p = &s->primitives[s->scene.primitive_count - 1];
    scene *all = &s->scene;
    for (int k = 0; k < 8; k++)
        for (int row = 0; row < 3; row++) {
            float at = m[12 + row];
            for (int c = 0; c < 3; c++)
                at += m[4 * c + row] * ((k >> c) & 1 ? p->bounds_max[c] : p->bounds_min[c]);
            bool first = all->instance_count == 0 && k == 0;
            all->bounds_min[row] = first ? at : fminf(all->bounds_min[row], at);
            all->bounds_max[row] = first ? at : fmaxf(all->bounds_max[row], at);
        }
    memcpy(s->instances[all->instance_count++].world_from_mesh, m, sizeof identity);
    s->meshes[all->mesh_count - 1].instance_count++;
}

void small_scene_turned_and_scaled(float x, float y, float z, float out[16])
{
    const double axis[3] = {1 / sqrt(14), 2 / sqrt(14), 3 / sqrt(14)}, cosine = cos(0.8), sine = sin(0.8);
    const double scale[3] = {x, y, z};
    memset(out, 0, 16 * sizeof *out);
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++) {
            const double skew = r == c ? 0 : axis[3 - r - c] * ((r + 1) % 3 == c ? -sine : sine);
            const double turn = (r == c ? cosine : 0) + skew + (1 - cosine) * axis[r] * axis[c];
            out[4 * c + r] = (float)(turn * scale[c]);
        }
    out[15] = 1;
}

/* The inverse transpose of m's upper 3x3, [row][column], up to a positive factor; the sign of its determinant. */
static double normal_matrix(const float m[16], double out[3][3])
{
    double determinant = 0;
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++) {
            const int c1 = (c + 1) % 3, c2 = (c + 2) % 3, r1 = (r + 1) % 3, r2 = (r + 2) % 3;
            out[r][c] = (double)m[4 * c1 + r1] * m[4 * c2 + r2] - (double)m[4 * c1 + r2] * m[4 * c2 + r1];
        }
    for (int r = 0; r < 3; r++)
        determinant += m[r] * out[r][0];
    for (int i = 0; determinant < 0 && i < 9; i++)
        out[i / 3][i % 3] = -out[i / 3][i % 3];
    return determinant < 0 ? -1 : 1;
}

static void bake_instance(small_scene *b, const small_scene *s, const scene_primitive *p, const float m[16])
{
    double cofactors[3][3];
    const bool mirrored = normal_matrix(m, cofactors) < 0;
    small_scene_begin_mesh(b, p->material);
    const uint32_t first = b->scene.vertex_count;
    for (uint32_t i = 0; i < p->index_count; i++) {
        const scene_vertex *from = &s->vertices[s->indices[p->first_index + i]];
        float position[3], normal[3];
        double direction[3] = {0}, length = 0;
        for (int r = 0; r < 3; r++) {
            double at = m[12 + r];
            for (int k = 0; k < 3; k++) {
                at += (double)m[4 * k + r] * from->position[k];
                direction[r] += cofactors[r][k] * from->normal[k];
            }
            position[r] = (float)at;
            length += direction[r] * direction[r];
        }
        for (int r = 0; r < 3; r++)
            normal[r] = (float)(direction[r] / sqrt(length));
        add_vertex(b, position, normal, 0, 0);
    }
    for (uint32_t i = first; i < b->scene.vertex_count; i += 3) /* a mirror reverses the winding */
        add_triangle(b, mirrored ? i + 1 : i, mirrored ? i : i + 1, i + 2);
    small_scene_add_instance(b, NULL);
}

small_scene *small_scene_baked(const small_scene *s)
{
    small_scene *b = small_scene_create();
    for (uint32_t i = 0; i < s->scene.material_count; i++)
        small_scene_add_material(b, s->materials[i]);
    for (uint32_t k = 0; k < s->scene.mesh_count; k++)
        for (uint32_t i = 0; i < s->meshes[k].instance_count; i++)
            bake_instance(b, s, &s->primitives[s->meshes[k].first_primitive],
                          s->instances[s->meshes[k].first_instance + i].world_from_mesh);
    memcpy(b->scene.bounds_min, s->scene.bounds_min, sizeof b->scene.bounds_min);
    memcpy(b->scene.bounds_max, s->scene.bounds_max, sizeof b->scene.bounds_max);
    return b;
}
