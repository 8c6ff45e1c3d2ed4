/* SPDX-License-Identifier: MIT
 *
 * Draws a scene_renderer's items: the pre-pass, the main pass, and two full-screen passes over maps. Each function
 * sets all the state it needs and leaves GL's defaults behind.
 */
#define CGLM_ALL_UNALIGNED /* the matrices are plain float[16] */
#include "draw_internal.h"
#include "gl.h"

#include <cglm/cglm.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

scene_lighting scene_default_lighting(void)
{
    /* Tuned by eye: a bluish sky and a warm sun from the upper left front, near 1 together on a white wall. The sky
     * gives about half, so that occlusion is seen in the lit parts too. */
    return (scene_lighting){.ambient = {0.46f, 0.50f, 0.56f},
                            .direction_world = {0.48f, -0.72f, -0.50120f},
                            .directional = {1.76f, 1.58f, 1.32f},
                            .sky = {0.42f, 0.52f, 0.64f}};
}

/* What is the same for all draw calls of a pass, and what the last one left bound. */
typedef struct triangle_pass {
    const scene_renderer *renderer;
    const scene_view *view;
    const draw_program *programs;
    bool is_main;
    mat3 normal_view_from_world;
    vec3 ambient, directional, to_light_view; /* main pass */

    const draw_program *program;
    int material;
    int uv_set;
    uint32_t first_instance;
} triangle_pass;

static void set_defaults(void)
{
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_FRAMEBUFFER_SRGB);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.FrontFace(GL_CCW);
    gl.CullFace(GL_BACK);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ZERO);
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.BindBuffer(GL_ARRAY_BUFFER, 0);
    for (unsigned unit = 2; unit-- > 0;) {
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        gl.BindSampler(unit, 0);
    }
}

static void bind_texture(unsigned unit, unsigned texture, unsigned sampler)
{
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.BindSampler(unit, sampler);
}

static triangle_pass begin_triangles(const scene_renderer *r, const scene_view *view, const draw_program *programs)
{
    triangle_pass pass = {.renderer = r, .view = view, .programs = programs, .material = -1, .uv_set = -1};
    pass.first_instance = UINT32_MAX;
    draw_normal_matrix(view->view_from_world, pass.normal_view_from_world);
    set_defaults();
    gl.Viewport(0, 0, view->width, view->height);
    gl.Enable(GL_DEPTH_TEST);
    gl.BindVertexArray(r->vertex_array);
    return pass;
}

static void use_program(triangle_pass *pass, const draw_program *p)
{
    const scene_view *view = pass->view;
    gl.UseProgram(p->name);
    gl.UniformMatrix4fv(p->view_from_world, 1, GL_FALSE, view->view_from_world);
    gl.UniformMatrix4fv(p->clip_from_view, 1, GL_FALSE, view->clip_from_view);
    gl.UniformMatrix3fv(p->normal_view_from_world, 1, GL_FALSE, pass->normal_view_from_world[0]);
    if (pass->is_main) {
        gl.Uniform3fv(p->ambient, 1, pass->ambient);
        gl.Uniform3fv(p->directional, 1, pass->directional);
        gl.Uniform3fv(p->to_light_view, 1, pass->to_light_view);
        gl.Uniform2f(p->pixel_uv, 1.0f / (float)view->width, 1.0f / (float)view->height);
    }
    pass->program = p;
    pass->material = -1;
}

static void use_material(triangle_pass *pass, int index)
{
    const scene_renderer *r = pass->renderer;
    const scene_material *m = &r->scene->materials[index];
    const draw_program *p = pass->program;
    gl.Uniform4fv(p->base_color, 1, m->base_color);
    gl.Uniform1f(p->alpha_cutoff, m->alpha_cutoff);
    if (m->base_color_texture >= 0) {
        bind_texture(UNIT_BASE_COLOR, r->images[r->scene->textures[m->base_color_texture].image],
                     r->samplers[m->base_color_texture]);
        gl.Uniform3fv(p->uv_row_u, 1, m->base_color_uv_from_uv);
        gl.Uniform3fv(p->uv_row_v, 1, m->base_color_uv_from_uv + 3);
        if (pass->uv_set != m->base_color_uv) {
            gl.BindBuffer(GL_ARRAY_BUFFER, r->vertex_buffer);
            gl.VertexAttribPointer(
                ATTRIBUTE_UV, 2, GL_FLOAT, GL_FALSE, sizeof(scene_vertex),
                (const void *)(offsetof(scene_vertex, uv) + (size_t)m->base_color_uv * sizeof(float[2])));
            pass->uv_set = m->base_color_uv;
        }
    }
    if (m->double_sided)
        gl.Disable(GL_CULL_FACE);
    else
        gl.Enable(GL_CULL_FACE);
    pass->material = index;
}

static void use_instances(triangle_pass *pass, uint32_t first)
{
    size_t base = first * sizeof(draw_instance);
    gl.BindBuffer(GL_ARRAY_BUFFER, pass->renderer->instance_buffer);
    for (unsigned c = 0; c < 4; c++)
        gl.VertexAttribPointer(ATTRIBUTE_WORLD_FROM_MESH + c, 3, GL_FLOAT, GL_FALSE, sizeof(draw_instance),
                               (const void *)(base + offsetof(draw_instance, world_from_mesh) + c * sizeof(float[3])));
    for (unsigned c = 0; c < 3; c++)
        gl.VertexAttribPointer(
            ATTRIBUTE_NORMAL_WORLD_FROM_MESH + c, 3, GL_FLOAT, GL_FALSE, sizeof(draw_instance),
            (const void *)(base + offsetof(draw_instance, normal_world_from_mesh) + c * sizeof(float[3])));
    pass->first_instance = first;
}

static void use_item(triangle_pass *pass, const draw_item *item)
{
    const draw_program *program = &pass->programs[pass->is_main ? item->main_variant : item->normals_variant];
    if (pass->program != program)
        use_program(pass, program);
    if (pass->material != item->material)
        use_material(pass, item->material);
    if (pass->first_instance != item->first_instance)
        use_instances(pass, item->first_instance);
    gl.FrontFace(item->mirrored ? GL_CW : GL_CCW);
}

static void draw_triangles(const draw_item *item)
{
    gl.DrawElementsInstanced(GL_TRIANGLES, (GLsizei)item->index_count, GL_UNSIGNED_INT,
                             (const void *)(item->first_index * sizeof(uint32_t)), (GLsizei)item->instance_count);
}

static void draw_opaque(triangle_pass *pass)
{
    for (uint32_t i = 0; i < pass->renderer->opaque_count; i++) {
        use_item(pass, &pass->renderer->items[i]);
        draw_triangles(&pass->renderer->items[i]);
    }
}

void scene_draw_normals(scene_renderer *r, const scene_view *view)
{
    triangle_pass pass = begin_triangles(r, view, r->normals);
    draw_opaque(&pass);
    set_defaults();
}

static int compare_back_to_front(const void *a, const void *b)
{
    const draw_order *x = a, *y = b;
    if (x->view_distance != y->view_distance)
        return x->view_distance > y->view_distance ? -1 : 1;
    return (x->item > y->item) - (x->item < y->item);
}

static void sort_blended(scene_renderer *r, const scene_view *view)
{
    const float *m = view->view_from_world;
    for (uint32_t i = r->opaque_count; i < r->item_count; i++) {
        const double *centre = r->items[i].centre_world;
        r->blended_order[i - r->opaque_count] = (draw_order){
            .view_distance = -((double)m[2] * centre[0] + (double)m[6] * centre[1] + (double)m[10] * centre[2] + m[14]),
            .item = i};
    }
    qsort(r->blended_order, r->item_count - r->opaque_count, sizeof *r->blended_order, compare_back_to_front);
}

static void draw_blended(triangle_pass *pass, scene_renderer *r)
{
    sort_blended(r, pass->view);
    gl.DepthFunc(GL_LEQUAL);
    gl.Enable(GL_BLEND);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (uint32_t i = 0; i < r->item_count - r->opaque_count; i++) {
        const draw_item *item = &r->items[r->blended_order[i].item];
        use_item(pass, item);
        if (r->scene->materials[item->material].double_sided) {
            /* The far sides first, to be seen through the near ones. */
            gl.Enable(GL_CULL_FACE);
            gl.CullFace(GL_FRONT);
            draw_triangles(item);
            gl.CullFace(GL_BACK);
            pass->material = -1; /* the next item sets culling again */
        }
        draw_triangles(item);
    }
}

void scene_draw_main(scene_renderer *r, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map)
{
    triangle_pass pass = begin_triangles(r, view, r->main);
    pass.is_main = true;
    for (int i = 0; i < 3; i++) {
        pass.ambient[i] = lighting->ambient[i];
        /* A white Lambert surface turned to the light sends irradiance / pi to every side. */
        pass.directional[i] = lighting->directional[i] / GLM_PIf;
        pass.to_light_view[i] = 0.0f;
        for (int c = 0; c < 3; c++)
            pass.to_light_view[i] -= view->view_from_world[4 * c + i] * lighting->direction_world[c];
    }
    glm_vec3_normalize(pass.to_light_view);

    gl.Enable(GL_FRAMEBUFFER_SRGB);
    const float sky[4] = {lighting->sky[0], lighting->sky[1], lighting->sky[2], 1.0f};
    gl.ClearBufferfv(GL_COLOR, 0, sky);

    bind_texture(UNIT_AMBIENT, ambient_map ? ambient_map : r->white_texture, r->linear_sampler);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(GL_EQUAL);
    draw_opaque(&pass);
    if (r->opaque_count < r->item_count)
        draw_blended(&pass, r);
    set_defaults();
}

static void begin_fullscreen(const scene_renderer *r, const draw_program *p, unsigned map, unsigned sampler, int width,
                             int height)
{
    set_defaults();
    gl.Viewport(0, 0, width, height);
    gl.UseProgram(p->name);
    gl.BindVertexArray(r->empty_vertex_array);
    bind_texture(UNIT_MAP, map, sampler);
}

static void end_fullscreen(void)
{
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    set_defaults();
}

void scene_draw_map(scene_renderer *r, unsigned map, int width, int height, bool red_only, float scale, float bias)
{
    const draw_program *p = &r->map;
    begin_fullscreen(r, p, map, r->linear_sampler, width, height);
    gl.Uniform2f(p->pixel_uv, 1.0f / (float)width, 1.0f / (float)height);
    gl.Uniform1f(p->scale, scale);
    gl.Uniform1f(p->bias, bias);
    gl.Uniform1i(p->red_only, red_only);
    end_fullscreen();
}

void scene_draw_view_distance(scene_renderer *r, const scene_view *view, unsigned depth_texture)
{
    /* ndc_z = (a z + b) / (c z + e) in view space, solved for -z: (b - e ndc_z) / (a - c ndc_z), with ndc_z = -1 at
     * depth 0 and 1 at depth 1. */
    const float *m = view->clip_from_view;
    double a = m[10], b = m[14], c = m[11], e = m[15];
    double numerator[2] = {b + e, b - e}, denominator[2] = {a + c, a - c};
    /* The sign of the quotient's slope says which end is the far one, also where that is infinitely far. */
    bool reversed = numerator[1] * denominator[0] < numerator[0] * denominator[1];

    const draw_program *p = &r->view_distance;
    begin_fullscreen(r, p, depth_texture, r->nearest_sampler, view->width, view->height);
    gl.Uniform2f(p->numerator, (float)numerator[0], (float)numerator[1]);
    gl.Uniform2f(p->denominator, (float)denominator[0], (float)denominator[1]);
    gl.Uniform1f(p->far_depth, reversed ? 0.0f : 1.0f);
    end_fullscreen();
}
