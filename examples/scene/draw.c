/* SPDX-License-Identifier: MIT
 *
 * Draws a scene_renderer's items: the pre-pass, the main pass with sky and blended materials, and for draw_shadow.c
 * the shadow map. Each function sets all the state it needs and leaves GL's defaults behind.
 */
#define CGLM_ALL_UNALIGNED /* the matrices are plain float[16] */
#include "draw_internal.h"
#include "gl.h"

#include <cglm/cglm.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is the same for all draw calls of a pass, and what the last one left bound. */
typedef struct triangle_pass {
    const scene_renderer *renderer;
    const scene_view *view;
    draw_kind kind;
    mat3 normal_view_from_world;
    double clip_from_world[16];
    float depth_offset;                                              /* layers */
    vec3 ambient, ambient_tilt, up_view, directional, to_light_view; /* main pass */
    float lights[MOST_LIGHTS][4][4];
    int light_count;

    const draw_program *program;
    unsigned variant;
    int material;
    bool mirrored;
    uint32_t first_instance;
} triangle_pass;

void draw_set_defaults(void)
{
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_FRAMEBUFFER_SRGB);
    gl.Disable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(0, 0);
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
    for (unsigned unit = UNIT_COUNT; unit-- > 0;) {
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        gl.BindSampler(unit, 0);
    }
}

void draw_bind_texture(unsigned unit, unsigned texture, unsigned sampler)
{
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.BindSampler(unit, sampler);
}

static void find_clip_from_world(const scene_view *view, double out[16])
{
    for (int c = 0; c < 4; c++)
        for (int row = 0; row < 4; row++) {
            out[4 * c + row] = 0;
            for (int k = 0; k < 4; k++)
                out[4 * c + row] +=
                    (double)view->clip_from_view[4 * k + row] * (double)view->view_from_world[4 * c + k];
        }
}

static triangle_pass begin_triangles(const scene_renderer *r, const scene_view *view, draw_kind kind)
{
    triangle_pass pass = {.renderer = r, .view = view, .kind = kind, .material = -1, .first_instance = UINT32_MAX};
    draw_normal_matrix(view->view_from_world, pass.normal_view_from_world);
    find_clip_from_world(view, pass.clip_from_world);
    draw_set_defaults();
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
    gl.Uniform1f(p->depth_offset, pass->depth_offset);
    gl.UniformMatrix3fv(p->normal_view_from_world, 1, GL_FALSE, pass->normal_view_from_world[0]);
    if (pass->kind == DRAW_MAIN) {
        gl.Uniform3fv(p->ambient, 1, pass->ambient);
        gl.Uniform3fv(p->ambient_tilt, 1, pass->ambient_tilt);
        gl.Uniform3fv(p->up_view, 1, pass->up_view);
        gl.Uniform3fv(p->directional, 1, pass->directional);
        gl.Uniform3fv(p->to_light_view, 1, pass->to_light_view);
        gl.Uniform2f(p->pixel_uv, 1.0f / (float)(view->width - 2 * view->margin),
                     1.0f / (float)(view->height - 2 * view->margin));
        gl.Uniform2f(p->origin, (float)view->margin, (float)view->margin);
        gl.Uniform1i(p->is_orthographic, view->clip_from_view[11] == 0);
        gl.UniformMatrix4fv(p->shadow_from_world, 1, GL_FALSE, pass->renderer->shadow.shadow_from_world);
        gl.Uniform1i(p->light_count, pass->light_count);
        if (pass->light_count)
            gl.Uniform4fv(p->lights, 4 * pass->light_count, pass->lights[0][0]);
    }
    pass->program = p;
    pass->material = -1;
}

static void use_map(const scene_renderer *r, unsigned unit, int texture, bool is_srgb, int uv_location, int uv,
                    const float uv_from_uv[6])
{
    float rows[3][4] = {{0}};
    for (int row = 0; row < 2; row++) {
        rows[row][2 * uv] = uv_from_uv[3 * row];
        rows[row][2 * uv + 1] = uv_from_uv[3 * row + 1];
        rows[2][row] = uv_from_uv[3 * row + 2];
    }
    draw_bind_texture(unit, r->images[is_srgb][r->scene->textures[texture].image], r->samplers[texture]);
    gl.Uniform4fv(uv_location, 3, rows[0]);
}

static void use_further_maps(const scene_renderer *r, const scene_material *m, const draw_program *p, unsigned variant)
{
    const struct {
        unsigned bit, unit;
        const scene_map *map;
        bool is_srgb;
        int uv_location;
    } maps[] = {
        {VARIANT_NORMAL_MAPPED, UNIT_NORMAL, &m->normal_map, false, p->normal_uv},
        {VARIANT_ROUGHNESS_MAPPED, UNIT_METALLIC_ROUGHNESS, &m->metallic_roughness_map, false,
         p->metallic_roughness_uv},
        {VARIANT_BAKED, UNIT_OCCLUSION, &m->occlusion_map, false, p->occlusion_uv},
        {VARIANT_EMISSION_MAPPED, UNIT_EMISSION, &m->emissive_map, true, p->emission_uv},
    };
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++)
        if (variant & maps[i].bit)
            use_map(r, maps[i].unit, maps[i].map->texture, maps[i].is_srgb, maps[i].uv_location, maps[i].map->uv,
                    maps[i].map->uv_from_uv);
    gl.Uniform1f(p->normal_scale, m->normal_scale);
    gl.Uniform2f(p->metallic_roughness, m->metallic, m->roughness);
    gl.Uniform1f(p->occlusion_strength, m->occlusion_strength);
    gl.Uniform3fv(p->emission, 1, m->emissive);
}

static void use_material(triangle_pass *pass, int index)
{
    const scene_renderer *r = pass->renderer;
    const scene_material *m = &r->scene->materials[index];
    const draw_program *p = pass->program;
    gl.Uniform4fv(p->base_color, 1, m->base_color);
    gl.Uniform1f(p->alpha_cutoff, m->alpha_cutoff);
    if (pass->variant & VARIANT_BASE_MAPPED)
        use_map(r, UNIT_BASE_COLOR, m->base_color_texture, true, p->base_color_uv, m->base_color_uv,
                m->base_color_uv_from_uv);
    use_further_maps(r, m, p, pass->variant);
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

static void draw_item_now(triangle_pass *pass, const draw_item *item)
{
    const draw_variant *variant = &pass->renderer->pool->variants[item->program[pass->kind]];
    pass->variant = variant->variant;
    if (pass->program != &variant->program)
        use_program(pass, &variant->program);
    if (pass->material != item->material)
        use_material(pass, item->material);
    if (pass->first_instance != item->first_instance)
        use_instances(pass, item->first_instance);
    gl.Uniform1f(pass->program->handedness, item->mirrored ? -1.0f : 1.0f);
    gl.FrontFace(item->mirrored ? GL_CW : GL_CCW);
    gl.DrawElementsInstanced(GL_TRIANGLES, (GLsizei)item->index_count, GL_UNSIGNED_INT,
                             (const void *)(item->first_index * sizeof(uint32_t)), (GLsizei)item->instance_count);
}

static unsigned draw_opaque(triangle_pass *pass, unsigned *out_culled)
{
    const scene_renderer *r = pass->renderer;
    unsigned drawn = 0;
    for (uint32_t i = 0; i < r->opaque_count; i++) {
        if (draw_item_is_seen(&r->items[i], pass->clip_from_world)) {
            draw_item_now(pass, &r->items[i]);
            drawn++;
        } else {
            (*out_culled)++;
        }
    }
    return drawn;
}

unsigned draw_opaque_items(scene_renderer *r, const scene_view *view, draw_kind kind, unsigned *out_culled)
{
    triangle_pass pass = begin_triangles(r, view, kind);
    if (kind == DRAW_SHADOW)
        draw_shadow_offset();
    const unsigned drawn = draw_opaque(&pass, out_culled);
    draw_set_defaults();
    return drawn;
}

/* A renderer that nobody configured draws plainly. */
static bool is_ready(scene_renderer *r)
{
    if (!r->configured) {
        char error[2048];
        const scene_lighting none = {0};
        if (!scene_renderer_configure(r, &none, &(scene_draw_options){0}, error, sizeof error)) {
            fprintf(stderr, "scene: %s\n", error);
            return false;
        }
    }
    return true;
}

void scene_draw_normals(scene_renderer *r, const scene_view *view)
{
    if (!is_ready(r))
        return;
    r->counts.culled = 0;
    r->counts.normals = draw_opaque_items(r, view, DRAW_NORMALS, &r->counts.culled);
}

scene_seen scene_find_seen(const scene_renderer *r, const scene_view *view)
{
    scene_seen seen = {.opaque_total = r->opaque_count, .blended_total = r->item_count - r->opaque_count};
    double clip_from_world[16];
    find_clip_from_world(view, clip_from_world);
    for (uint32_t i = 0; i < r->item_count; i++)
        if (draw_item_is_seen(&r->items[i], clip_from_world))
            *(i < r->opaque_count ? &seen.opaque : &seen.blended) += 1;
    return seen;
}

void scene_draw_layer(scene_renderer *r, const scene_view *view, unsigned depth_texture, scene_layer layer)
{
    /* Two steps of a 24-bit depth buffer: the same triangle, drawn again, has the same depth but for rounding. */
    const float rounding = 1.2e-7f, far_depth = 1;
    if (!is_ready(r) || !r->options.layers)
        return;
    gl.DepthMask(GL_TRUE);
    gl.ClearBufferfv(GL_DEPTH, 0, &far_depth);
    triangle_pass pass = begin_triangles(r, view, DRAW_LAYER);
    pass.depth_offset = layer == SCENE_LAYER_BACK ? -rounding : rounding;
    draw_bind_texture(UNIT_FIRST_DEPTH, depth_texture, r->nearest_sampler);
    gl.CullFace(layer == SCENE_LAYER_BACK ? GL_FRONT : GL_BACK); /* of single-sided materials */
    unsigned culled = 0;
    (void)draw_opaque(&pass, &culled);
    draw_set_defaults();
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
        double distance = -(double)m[14];
        for (int axis = 0; axis < 3; axis++)
            distance -= (double)m[4 * axis + 2] * 0.5 * (r->items[i].bounds_min[axis] + r->items[i].bounds_max[axis]);
        r->blended_order[i - r->opaque_count] = (draw_order){.view_distance = distance, .item = i};
    }
    qsort(r->blended_order, r->item_count - r->opaque_count, sizeof *r->blended_order, compare_back_to_front);
}

static void draw_blended(triangle_pass *pass, scene_renderer *r)
{
    sort_blended(r, pass->view);
    gl.DepthFunc(GL_LEQUAL);
    gl.Enable(GL_BLEND);
    /* Colour by straight alpha; the target's own alpha as coverage. */
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (uint32_t i = 0; i < r->item_count - r->opaque_count; i++) {
        const draw_item *item = &r->items[r->blended_order[i].item];
        if (draw_item_is_seen(item, pass->clip_from_world)) {
            draw_item_now(pass, item);
            r->counts.blended++;
        } else {
            r->counts.culled++;
        }
    }
}

static void rotate_to_view(const scene_view *view, const float world[3], vec3 out)
{
    for (int i = 0; i < 3; i++)
        out[i] = view->view_from_world[i] * world[0] + view->view_from_world[4 + i] * world[1] +
                 view->view_from_world[8 + i] * world[2];
}

/* As main.frag takes them. */
static void pack_light(const scene_light *light, const scene_view *view, float out[4][4])
{
    memset(out, 0, sizeof(float[4][4]));
    const bool directional = light->kind == SCENE_LIGHT_DIRECTIONAL, spot = light->kind == SCENE_LIGHT_SPOT;
    vec3 axis;
    rotate_to_view(view, light->direction_world, axis);
    rotate_to_view(view, light->position_world, out[0]);
    for (int i = 0; i < 3; i++) {
        out[0][i] = directional ? -axis[i] : out[0][i] + view->view_from_world[12 + i];
        out[1][i] = light->color[i] / GLM_PIf;
        out[2][i] = spot ? axis[i] : 0;
    }
    out[0][3] = directional ? 0 : 1;
    out[1][3] = light->range > 0 ? 1 / (light->range * light->range * light->range * light->range) : 0;
    out[2][3] = spot ? light->outer_cos : -1;
    out[3][0] = spot ? 1 / fmaxf(light->inner_cos - light->outer_cos, 1e-3f) : 1;
}

static void set_lighting(triangle_pass *pass, const scene_lighting *lighting)
{
    static const float up_world[3] = {0, 1, 0};
    for (int i = 0; i < 3; i++) {
        pass->ambient[i] = lighting->ambient[i];
        pass->ambient_tilt[i] = lighting->ambient_tilt[i];
        /* A white matte surface sends pi-th of the irradiance towards the eye. */
        pass->directional[i] = lighting->directional[i] / GLM_PIf;
    }
    rotate_to_view(pass->view, up_world, pass->up_view);
    rotate_to_view(pass->view, lighting->direction_world, pass->to_light_view);
    glm_vec3_negate(pass->to_light_view);
    glm_vec3_normalize(pass->to_light_view);
    glm_vec3_normalize(pass->up_view);
    pass->light_count = (int)(lighting->light_count < MOST_LIGHTS ? lighting->light_count : MOST_LIGHTS);
    for (int i = 0; i < pass->light_count; i++)
        pack_light(&lighting->lights[i], pass->view, pass->lights[i]);
}

static bool is_gradient(const scene_lighting *lighting)
{
    return lighting->sky_tilt[0] != 0 || lighting->sky_tilt[1] != 0 || lighting->sky_tilt[2] != 0;
}

/* Whether the sky of this view was drawn before and no pixel of it passed: the scene stands still, so none will. Never
 * waits; where it is not known, the sky may be seen. */
static bool is_sky_hidden(scene_renderer *r, const scene_view *view)
{
    draw_sky_seen *seen = &r->sky_seen;
    GLuint known = 0, samples = 1;
    if (!seen->asked || memcmp(&seen->view, view, sizeof *view) != 0 || gl.IsEnabled(GL_SCISSOR_TEST))
        return false;
    gl.GetQueryObjectuiv(seen->query, GL_QUERY_RESULT_AVAILABLE, &known);
    if (known)
        gl.GetQueryObjectuiv(seen->query, GL_QUERY_RESULT, &samples);
    return samples == 0;
}

/* At the far plane, where opaque surfaces left it to be seen. */
static void draw_sky(scene_renderer *r, const scene_view *view, const scene_lighting *lighting)
{
    mat4 clip_from_world, world_from_clip, view_from_world;
    memcpy(view_from_world, view->view_from_world, sizeof view_from_world);
    /* Only directions matter: without the eye's place, nothing is lost to large coordinates. */
    view_from_world[3][0] = view_from_world[3][1] = view_from_world[3][2] = 0;
    glm_mat4_mul((vec4 *)view->clip_from_view, view_from_world, clip_from_world);
    glm_mat4_inv(clip_from_world, world_from_clip);
    const draw_program *p = &r->sky;
    gl.UseProgram(p->name);
    gl.BindVertexArray(r->empty_vertex_array);
    gl.UniformMatrix4fv(p->world_from_clip, 1, GL_FALSE, world_from_clip[0]);
    gl.Uniform3fv(p->sky, 1, lighting->sky);
    gl.Uniform3fv(p->sky_tilt, 1, lighting->sky_tilt);
    gl.Disable(GL_CULL_FACE);
    gl.FrontFace(GL_CCW);
    gl.DepthFunc(GL_LEQUAL);
    /* Through scissors less may pass than the next drawing shows. */
    r->sky_seen.asked = !gl.IsEnabled(GL_SCISSOR_TEST);
    if (r->sky_seen.asked) {
        if (!r->sky_seen.query)
            gl.GenQueries(1, &r->sky_seen.query);
        r->sky_seen.view = *view;
        gl.BeginQuery(GL_SAMPLES_PASSED, r->sky_seen.query);
    }
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    if (r->sky_seen.asked)
        gl.EndQuery(GL_SAMPLES_PASSED);
    r->counts.sky = 1;
}

void scene_draw_main(scene_renderer *r, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map)
{
    if (!is_ready(r))
        return;
    triangle_pass pass = begin_triangles(r, view, DRAW_MAIN);
    set_lighting(&pass, lighting);
    r->counts.culled = r->counts.blended = r->counts.sky = 0;

    gl.Enable(GL_FRAMEBUFFER_SRGB);
    const float sky[4] = {lighting->sky[0], lighting->sky[1], lighting->sky[2], 1.0f};
    gl.ClearBufferfv(GL_COLOR, 0, sky);

    draw_bind_texture(UNIT_AMBIENT, ambient_map ? ambient_map : r->white_texture, r->linear_sampler);
    if (r->shadow.used)
        draw_bind_texture(UNIT_SHADOW, r->shadow.texture, r->shadow.sampler);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(GL_EQUAL);
    r->counts.main = draw_opaque(&pass, &r->counts.culled);
    if (is_gradient(lighting) && !is_sky_hidden(r, view)) {
        draw_sky(r, view, lighting);
        gl.BindVertexArray(r->vertex_array);
        pass.program = NULL;
    }
    if (r->opaque_count < r->item_count)
        draw_blended(&pass, r);
    draw_set_defaults();
}
