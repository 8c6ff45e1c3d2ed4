/* SPDX-License-Identifier: MIT
 *
 * The built-in scenes. Each suggests a camera that frames it.
 */
#define CGLM_ALL_UNALIGNED /* the scene's matrices are plain float[16] */
#include <cglm/cglm.h>
#include <stdio.h>
#include <string.h>

#include "shapes.h"

/* A matte, opaque, single-sided material of that linear colour; its index. */
static int add_matte(scene_builder *b, float red, float green, float blue)
{
    scene_material material = scene_default_material();
    memcpy(material.base_color, (float[3]){red, green, blue}, 3 * sizeof(float));
    return scene_builder_add_material(b, &material);
}

static bool add_camera(scene_builder *b, const float eye[3], const float target[3], float fov_y_deg)
{
    scene_camera camera = {.name = "suggested", .fov_y_rad = glm_rad(fov_y_deg), .near_plane = 0.1f, .far_plane = 100};
    mat4 view_from_world, world_from_view;
    vec3 from, to, up = {0, 1, 0};
    memcpy(from, eye, sizeof from);
    memcpy(to, target, sizeof to);
    glm_lookat_rh(from, to, up, view_from_world);
    glm_mat4_inv(view_from_world, world_from_view);
    memcpy(camera.world_from_view, world_from_view, sizeof camera.world_from_view);
    return scene_builder_add_camera(b, &camera, (const double[3]){(double)eye[0], (double)eye[1], (double)eye[2]}) >= 0;
}

/* Everything that was added since `first_index` becomes a mesh of one material. */
static int end_mesh(scene_builder *b, uint32_t first_index, int material)
{
    const int mesh = scene_builder_add_mesh(b);
    return mesh >= 0 && scene_builder_add_primitive(b, first_index, material) ? mesh : -1;
}

static bool place(scene_builder *b, int mesh, const float position[3], const float size[3], vec3 axis, float angle_deg)
{
    mat4 world_from_mesh = GLM_MAT4_IDENTITY_INIT;
    vec3 by, scale;
    memcpy(by, position, sizeof by);
    memcpy(scale, size, sizeof scale);
    glm_translate(world_from_mesh, by);
    glm_rotate(world_from_mesh, glm_rad(angle_deg), axis);
    glm_scale(world_from_mesh, scale);
    return scene_builder_add_instance(b, mesh, (const float *)world_from_mesh);
}

static bool place_at(scene_builder *b, int mesh, float x, float y, float z)
{
    return place(b, mesh, (float[3]){x, y, z}, (float[3]){1, 1, 1}, (vec3){0, 1, 0}, 0);
}

static int add_box_mesh(scene_builder *b, int material)
{
    const uint32_t first = b->made->index_count;
    return shape_box(b) ? end_mesh(b, first, material) : -1;
}

/* The box between two corners, as an instance of the unit box. */
static bool place_box(scene_builder *b, int mesh, const float low[3], const float high[3])
{
    float middle[3], size[3];
    for (int axis = 0; axis < 3; ++axis) {
        middle[axis] = 0.5f * (low[axis] + high[axis]);
        size[axis] = high[axis] - low[axis];
    }
    return place(b, mesh, middle, size, (vec3){0, 1, 0}, 0);
}

/* One grid in the world, as a mesh of its own. */
static bool add_wall(scene_builder *b, int material, const float corner[3], const float u[3], const float v[3],
                     uint32_t u_cells, uint32_t v_cells)
{
    const uint32_t first = b->made->index_count;
    const int mesh = shape_grid(b, corner, u, v, u_cells, v_cells) ? end_mesh(b, first, material) : -1;
    return mesh >= 0 && place_at(b, mesh, 0, 0, 0);
}

/* A level floor about the origin, seen from above. */
static bool add_floor(scene_builder *b, int material, float width, float depth, uint32_t x_cells, uint32_t z_cells)
{
    return add_wall(b, material, (float[3]){-width / 2, 0, depth / 2}, (float[3]){width, 0, 0},
                    (float[3]){0, 0, -depth}, x_cells, z_cells);
}

/* Ten tapered columns with spheres on top in two rows, and a box between them. */
static bool make_columns(scene_builder *b)
{
    const int floor = add_matte(b, 0.42f, 0.40f, 0.37f), stone = add_matte(b, 0.62f, 0.58f, 0.50f);
    const int marble = add_matte(b, 0.35f, 0.48f, 0.62f), brick = add_matte(b, 0.55f, 0.27f, 0.18f);
    if (!add_floor(b, floor, 20, 30, 40, 60))
        return false;
    const int box = add_box_mesh(b, brick);
    const uint32_t column_first = b->made->index_count;
    const int column = shape_cylinder(b, 0.5f, 0.3f, 3, 32, 8) ? end_mesh(b, column_first, stone) : -1;
    const uint32_t sphere_first = b->made->index_count;
    const int sphere = shape_sphere(b, 0.5f, 32, 20) ? end_mesh(b, sphere_first, marble) : -1;
    bool ok = box >= 0 && column >= 0 && sphere >= 0 &&
              place_box(b, box, (float[3]){-1.5f, 0, -1.5f}, (float[3]){1.5f, 1, 1.5f});
    for (int i = 0; ok && i < 10; ++i) {
        const float x = i % 2 ? 5.0f : -5.0f, z = -10.0f + 5.0f * (float)(i / 2);
        ok = place_at(b, column, x, 0, z) && place_at(b, sphere, x, 3.5f, z);
    }
    return ok && add_camera(b, (float[3]){2.4f, 5.5f, -18}, (float[3]){0, 0.8f, 0}, 45);
}

/* A closed room whose walls face inwards, so that one looks in through the back of the front wall. */
static bool make_cornell(scene_builder *b)
{
    const float h = 2.75f, side = 2 * h;
    const float right[3] = {side, 0, 0}, left[3] = {-side, 0, 0}, up[3] = {0, side, 0};
    const float back[3] = {0, 0, -side}, front[3] = {0, 0, side};
    const int white = add_matte(b, 0.73f, 0.71f, 0.68f), red = add_matte(b, 0.57f, 0.04f, 0.04f);
    const int green = add_matte(b, 0.10f, 0.40f, 0.08f);
    bool ok = add_wall(b, white, (float[3]){-h, 0, h}, right, back, 8, 8) &&
              add_wall(b, white, (float[3]){-h, side, -h}, right, front, 8, 8) &&
              add_wall(b, white, (float[3]){-h, 0, -h}, right, up, 8, 8) &&
              add_wall(b, white, (float[3]){h, 0, h}, left, up, 8, 8) &&
              add_wall(b, red, (float[3]){-h, 0, h}, back, up, 8, 8) &&
              add_wall(b, green, (float[3]){h, 0, -h}, front, up, 8, 8);
    const int box = add_box_mesh(b, white);
    vec3 y = {0, 1, 0};
    ok = ok && box >= 0 && place(b, box, (float[3]){-0.9f, 1.65f, -0.9f}, (float[3]){1.65f, 3.3f, 1.65f}, y, 17) &&
         place(b, box, (float[3]){0.95f, 0.825f, 0.85f}, (float[3]){1.65f, 1.65f, 1.65f}, y, -17);
    /* Inside: from outside, the front wall would be culled and yet occlude. */
    return ok && add_camera(b, (float[3]){0.4f, h, h - 0.1f}, (float[3]){0, h - 0.5f, 0}, 72);
}

/* Posts of 0.03 along the open side, and the handrail over them. */
static bool add_railing(scene_builder *b, int metal, int steps, float rise, float run, float front)
{
    const float post = 0.03f, high = 0.9f, top = rise * (float)steps;
    bool ok = true;
    for (int i = 0; ok && i < steps; ++i) {
        const float x = 1.6f - run * ((float)i + 0.5f), y = rise * (float)(i + 1);
        ok = place_box(b, metal, (float[3]){x - post / 2, y, front - post},
                       (float[3]){x + post / 2, y + high - rise / 2, front});
    }
    for (int i = 1; ok && i < 6; ++i) {
        const float x = 1.6f - run * (float)steps - 0.3f * (float)i;
        ok = place_box(b, metal, (float[3]){x - post / 2, top, front - post},
                       (float[3]){x + post / 2, top + high, front});
    }
    /* The sloping rail runs at the height of the posts' tops, the level one on from there. */
    const float length = (float)steps * sqrtf(rise * rise + run * run), slope = glm_deg(atan2f(rise, run));
    const float end = 1.6f - run * (float)steps;
    return ok &&
           place(b, metal, (float[3]){1.6f - run * (float)steps / 2, top / 2 + high, front - post / 2},
                 (float[3]){length, 0.05f, 0.06f}, (vec3){0, 0, 1}, -slope) &&
           place_box(b, metal, (float[3]){end - 1.6f, top + high - 0.025f, front - 0.045f},
                     (float[3]){end + 0.02f, top + high + 0.025f, front + 0.015f});
}

/* A staircase against a wall, up to a landing, with posts and a thin railing on its open side. */
static bool make_steps(scene_builder *b)
{
    enum { STEPS = 8 };
    const float rise = 0.18f, run = 0.3f, wall = -1.5f, front = 0.1f, top = rise * STEPS;
    const int ground = add_matte(b, 0.40f, 0.38f, 0.35f), plaster = add_matte(b, 0.70f, 0.66f, 0.58f);
    const int stone = add_matte(b, 0.50f, 0.50f, 0.52f), wood = add_matte(b, 0.42f, 0.25f, 0.13f);
    const int iron = add_matte(b, 0.16f, 0.17f, 0.19f);
    if (!add_floor(b, ground, 9, 7, 18, 14))
        return false;
    const int block = add_box_mesh(b, stone), back = add_box_mesh(b, plaster), post = add_box_mesh(b, wood);
    const int metal = add_box_mesh(b, iron);
    bool ok = block >= 0 && back >= 0 && post >= 0 && metal >= 0 &&
              place_box(b, back, (float[3]){-3.2f, 0, wall - 0.25f}, (float[3]){3.2f, 3.6f, wall});
    for (int i = 0; ok && i < STEPS; ++i)
        ok = place_box(b, block, (float[3]){1.6f - run * (float)(i + 1), 0, wall},
                       (float[3]){1.6f - run * (float)i, rise * (float)(i + 1), front});
    const float landing = 1.6f - run * STEPS;
    ok = ok && place_box(b, block, (float[3]){landing - 1.6f, 0, wall}, (float[3]){landing, top, front}) &&
         place_box(b, post, (float[3]){1.62f, 0, front - 0.1f}, (float[3]){1.74f, 1.1f, front + 0.02f}) &&
         place_box(b, post, (float[3]){landing - 1.6f, top, front - 0.1f},
                   (float[3]){landing - 1.48f, top + 1.05f, front + 0.02f});
    return ok && add_railing(b, metal, STEPS, rise, run, front) &&
           add_camera(b, (float[3]){4.4f, 2.9f, 4.4f}, (float[3]){-0.3f, 1.1f, -0.6f}, 42);
}

static bool make_plane(scene_builder *b)
{
    const int grey = add_matte(b, 0.5f, 0.5f, 0.5f);
    return grey >= 0 && add_floor(b, grey, 20, 20, 8, 8) &&
           add_camera(b, (float[3]){12, 9, 20}, (float[3]){0, 0, 0.8f}, 45);
}

scene *scene_make(const char *name, failure *out_fault)
{
    static const struct {
        const char *name;
        bool (*make)(scene_builder *b);
    } scenes[] = {{"columns", make_columns}, {"cornell", make_cornell}, {"steps", make_steps}, {"plane", make_plane}};
    failure fault = {.file = name, .text = out_fault->text, .size = out_fault->size};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i) {
        scene_builder builder;
        if (strcmp(name, scenes[i].name) != 0)
            continue;
        if (!scene_builder_begin(&builder, name, &fault))
            return NULL;
        if (scenes[i].make(&builder))
            return scene_builder_finish(&builder);
        scene_builder_abandon(&builder);
        return NULL;
    }
    fault_set(&fault, "no built-in scene of that name; there are columns, cornell, steps and plane");
    return NULL;
}
