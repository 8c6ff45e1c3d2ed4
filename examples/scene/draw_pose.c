/* SPDX-License-Identifier: MIT
 *
 * A scene that moves: the same file at another time, and where its points were before.
 */
#include "draw_internal.h"
#include "gl.h"

#include <stdlib.h>
#include <string.h>

static bool has_same_layout(const scene *a, const scene *b)
{
    return a->vertex_count == b->vertex_count && a->index_count == b->index_count &&
           a->instance_count == b->instance_count && a->material_count == b->material_count &&
           a->texture_count == b->texture_count && a->image_count == b->image_count && !a->tangents == !b->tangents &&
           !a->more_uvs == !b->more_uvs && memcmp(a->origin, b->origin, sizeof a->origin) == 0 &&
           memcmp(a->indices, b->indices, a->index_count * sizeof *a->indices) == 0;
}

static bool has_same_items(const scene_renderer *a, const scene_renderer *b)
{
    bool same = a->item_count == b->item_count;
    for (uint32_t i = 0; same && i < a->item_count; i++) {
        const draw_item *x = &a->items[i], *y = &b->items[i];
        same = x->first_index == y->first_index && x->index_count == y->index_count &&
               x->first_instance == y->first_instance && x->instance_count == y->instance_count &&
               x->material == y->material && x->variant == y->variant && x->mirrored == y->mirrored;
    }
    return same;
}

static void swap(unsigned *a, unsigned *b)
{
    const unsigned kept = *a;
    *a = *b;
    *b = kept;
}

/* The buffers of the last pose but one take the new one. */
static void upload_pose(scene_renderer *r, const draw_instance *instances)
{
    const scene *s = r->scene;
    swap(&r->vertex_buffers[0], &r->last_positions);
    swap(&r->instance_buffer, &r->last_instance_buffer);
    gl.BindVertexArray(r->vertex_array);
    draw_upload_buffer(&r->instance_buffer, GL_ARRAY_BUFFER, instances, s->instance_count * sizeof *instances);
    draw_upload_vertices(r);
    draw_point_vertices(r);
    if (s->tangents)
        draw_upload_buffer(&r->tangent_buffer, GL_ARRAY_BUFFER, s->tangents, s->vertex_count * sizeof *s->tangents);
    gl.BindVertexArray(0);
    gl.BindBuffer(GL_ARRAY_BUFFER, 0);
}

bool scene_renderer_pose(scene_renderer *r, const scene *s)
{
    scene_renderer posed = {.scene = s};
    draw_instance *instances = calloc((size_t)s->instance_count + 1, sizeof *instances);
    const bool done =
        instances && has_same_layout(r->scene, s) && draw_plan_items(&posed, instances) && has_same_items(r, &posed);
    if (done) {
        r->scene = s;
        upload_pose(r, instances);
        for (uint32_t i = 0; i < r->item_count; i++) {
            memcpy(r->items[i].bounds_min, posed.items[i].bounds_min, sizeof r->items[i].bounds_min);
            memcpy(r->items[i].bounds_max, posed.items[i].bounds_max, sizeof r->items[i].bounds_max);
        }
        r->shadow.drawn = false;
        r->sky_seen.asked = false;
    }
    free(posed.items);
    free(posed.blended_order);
    free(instances);
    return done;
}

/* Location 1 holds positions of the last pose, in the place of normals. */
static void bind_motion_array(scene_renderer *r)
{
    const bool first = !r->motion_vertex_array;
    if (first)
        gl.GenVertexArrays(1, &r->motion_vertex_array);
    gl.BindVertexArray(r->motion_vertex_array);
    draw_point_vertices(r);
    gl.BindBuffer(GL_ARRAY_BUFFER, r->last_positions ? r->last_positions : r->vertex_buffers[0]);
    gl.VertexAttribPointer(ATTRIBUTE_NORMAL, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    gl.EnableVertexAttribArray(ATTRIBUTE_NORMAL);
    if (!first)
        return;
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, r->index_buffer);
    for (unsigned i = ATTRIBUTE_WORLD_FROM_MESH; i < ATTRIBUTE_NORMAL_WORLD_FROM_MESH + 4; i++) {
        gl.EnableVertexAttribArray(i);
        gl.VertexAttribDivisor(i, 1);
    }
    if (r->more_uv_buffer) {
        gl.BindBuffer(GL_ARRAY_BUFFER, r->more_uv_buffer);
        gl.VertexAttribPointer(ATTRIBUTE_MORE_UVS, 4, GL_FLOAT, GL_FALSE, sizeof *r->scene->more_uvs, NULL);
        gl.EnableVertexAttribArray(ATTRIBUTE_MORE_UVS);
    }
}

void scene_draw_motion(scene_renderer *r, const scene_view *view, const scene_view *last)
{
    const float nowhere[4] = {1e4f, 1e4f, 0, 0};
    if (!draw_is_ready(r) || !r->options.motion)
        return;
    gl.ClearBufferfv(GL_COLOR, 0, nowhere);
    draw_pass pass = draw_begin(r, view, DRAW_MOTION);
    pass.last = last;
    bind_motion_array(r);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(GL_EQUAL);
    unsigned culled = 0;
    (void)draw_opaque(&pass, &culled);
    draw_set_defaults();
}
