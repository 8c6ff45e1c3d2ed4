/* SPDX-License-Identifier: MIT */
#define CGLM_ALL_UNALIGNED /* the camera's vectors are plain float[3] */
#include "navigate.h"

#include <cglm/cglm.h>

#include <math.h>

static const float steepest_rad = 1.55f; /* keeps up away from the line of sight */

typedef struct frame_of_sight {
    vec3 ahead, right, up; /* unit, world space */
    float distance;        /* from eye to target */
} frame_of_sight;

static frame_of_sight look_along(const camera *c)
{
    frame_of_sight f;
    vec3 up;
    glm_vec3_sub((float *)c->target, (float *)c->eye, f.ahead);
    f.distance = glm_vec3_norm(f.ahead);
    glm_vec3_normalize(f.ahead);
    glm_vec3_copy((float *)c->up, up);
    glm_vec3_crossn(f.ahead, up, f.right);
    glm_vec3_cross(f.right, f.ahead, f.up);
    return f;
}

/* Turns the vector from `from` to `to` about the axis and upwards, and moves `to`. The camera is upright afterwards. */
static void turn(camera *c, const float axis[3], const float from[3], float to[3], float right_rad, float up_rad)
{
    vec3 way, flat;
    glm_vec3_sub(to, (float *)from, way);
    const float length = glm_vec3_norm(way);
    const float height = glm_clamp(glm_vec3_dot(way, (float *)axis) / length, -1, 1);
    glm_vec3_copy(way, flat);
    if (1 - height * height <
        1e-6f) /* seen from straight above or below, the picture's up gives the horizontal direction */
        glm_vec3_scale(c->up, height > 0 ? -1 : 1, flat);
    glm_vec3_muladds((float *)axis, -glm_vec3_dot(flat, (float *)axis), flat);
    glm_vec3_normalize(flat);
    glm_vec3_rotate(flat, right_rad, (float *)axis);
    const float elevation = glm_clamp(asinf(height) + up_rad, -steepest_rad, steepest_rad);
    glm_vec3_copy((float *)from, to);
    glm_vec3_muladds(flat, length * cosf(elevation), to);
    glm_vec3_muladds((float *)axis, length * sinf(elevation), to);
    glm_vec3_copy((float *)axis, c->up);
}

void navigate_orbit(camera *c, const float axis[3], float right_rad, float up_rad)
{
    turn(c, axis, c->target, c->eye, right_rad, up_rad);
}

void navigate_look(camera *c, const float axis[3], float right_rad, float up_rad)
{
    turn(c, axis, c->eye, c->target, -right_rad, up_rad);
}

static void move(camera *c, const vec3 by)
{
    glm_vec3_add(c->eye, (float *)by, c->eye);
    glm_vec3_add(c->target, (float *)by, c->target);
}

void navigate_pan(camera *c, float right, float up)
{
    const frame_of_sight f = look_along(c);
    const float height = 2 * f.distance * tanf(0.5f * c->fov_y_rad);
    vec3 by = {0, 0, 0};
    glm_vec3_muladds((float *)f.right, right * height, by);
    glm_vec3_muladds((float *)f.up, up * height, by);
    move(c, by);
}

void navigate_zoom(camera *c, float factor)
{
    vec3 way;
    glm_vec3_sub(c->eye, c->target, way);
    glm_vec3_scale(way, factor, way);
    glm_vec3_add(c->target, way, c->eye);
}

void navigate_walk(camera *c, const float axis[3], float ahead, float right, float up)
{
    const frame_of_sight f = look_along(c);
    vec3 by;
    glm_vec3_scale((float *)axis, up, by);
    glm_vec3_muladds((float *)f.ahead, ahead, by);
    glm_vec3_muladds((float *)f.right, right, by);
    move(c, by);
}
