/* SPDX-License-Identifier: MIT
 *
 * Full-screen passes over maps: showing one, and view distance.
 */
#include "draw_internal.h"
#include "gl.h"
#include "scene_shaders.h"

#include <stdio.h>

/* A program of the pool, built on first use. */
static const draw_program *find(draw_program *p, const char *what, const char *fragment_source)
{
    char error[1024];
    if (p->name || draw_program_build(p, what, shader_fullscreen_vert, "", fragment_source, 0, FAULT(error)))
        return p;
    fprintf(stderr, "scene: %s\n", error);
    return NULL;
}

static void begin(const scene_renderer *r, const draw_program *p, unsigned map, unsigned sampler, scene_rectangle place)
{
    draw_set_defaults();
    gl.Viewport(place.x, place.y, place.width, place.height);
    gl.UseProgram(p->name);
    gl.BindVertexArray(r->empty_vertex_array);
    draw_bind_texture(UNIT_MAP, map, sampler);
}

static void end(void)
{
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    draw_set_defaults();
}

void scene_draw_map_in(scene_renderer *r, unsigned map, scene_rectangle place, bool red_only, float scale, float bias)
{
    const draw_program *p = find(&r->pool->map, "map pass", shader_map_frag);
    if (!p)
        return;
    begin(r, p, map, r->linear_sampler, place);
    gl.Uniform2f(p->origin, (float)place.x, (float)place.y);
    gl.Uniform2f(p->pixel_uv, 1.0f / (float)place.width, 1.0f / (float)place.height);
    gl.Uniform1f(p->scale, scale);
    gl.Uniform1f(p->bias, bias);
    gl.Uniform1i(p->red_only, red_only);
    end();
}

void scene_draw_map(scene_renderer *r, unsigned map, int width, int height, bool red_only, float scale, float bias)
{
    scene_draw_map_in(r, map, (scene_rectangle){0, 0, width, height}, red_only, scale, bias);
}

void scene_draw_view_distance(scene_renderer *r, const scene_view *view, unsigned depth_texture)
{
    scene_draw_distance_picture(r, view, depth_texture, 1);
}

/* ndc_z = (a z + b) / (c z + e) in view space, solved for -z: (b - e ndc_z) / (a - c ndc_z), with ndc_z = -1 at depth 0
 * and 1 at depth 1. */
static void set_distance(const draw_program *p, const scene_view *view)
{
    const float *m = view->clip_from_view;
    double a = m[10], b = m[14], c = m[11], e = m[15];
    double numerator[2] = {b + e, b - e}, denominator[2] = {a + c, a - c};
    /* The sign of the quotient's slope says which end is the far one, also where that is infinitely far. */
    bool reversed = numerator[1] * denominator[0] < numerator[0] * denominator[1];
    gl.Uniform2f(p->numerator, (float)numerator[0], (float)numerator[1]);
    gl.Uniform2f(p->denominator, (float)denominator[0], (float)denominator[1]);
    gl.Uniform1f(p->far_depth, reversed ? 0.0f : 1.0f);
}

void scene_draw_distance_picture(scene_renderer *r, const scene_view *view, unsigned depth_texture, float scale)
{
    const draw_program *p = find(&r->pool->view_distance, "view distance pass", shader_view_distance_frag);
    if (!p)
        return;
    begin(r, p, depth_texture, r->nearest_sampler, (scene_rectangle){0, 0, view->width, view->height});
    set_distance(p, view);
    gl.Uniform1f(p->scale, scale);
    end();
}

void scene_draw_surfaces(scene_renderer *r, const scene_view *view, unsigned depth_texture, unsigned normal_texture,
                         int step, const int offset[2])
{
    const draw_program *p = find(&r->pool->surfaces, "surfaces pass", shader_surfaces_frag);
    if (!p)
        return;
    const scene_rectangle place = {0, 0, (view->width + step - 1) / step, (view->height + step - 1) / step};
    begin(r, p, depth_texture, r->nearest_sampler, place);
    draw_bind_texture(UNIT_NORMAL, normal_texture, r->nearest_sampler);
    set_distance(p, view);
    gl.Uniform1f(p->scale, (float)step);
    gl.Uniform2f(p->offset, (float)offset[0], (float)offset[1]);
    end();
}
