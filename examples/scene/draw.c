/* SPDX-License-Identifier: MIT
 *
 * Draws a scene_renderer's items for every pass: the pre-pass, the layers, the shadow map and the main pass. Each
 * public function sets all the state that it needs, and restores GL's defaults.
 */
#include "draw_internal.h"
#include "gl.h"

#include <stdio.h>

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

draw_pass draw_begin(const scene_renderer *r, const scene_view *view, draw_kind kind)
{
    draw_pass pass = {.renderer = r, .view = view, .kind = kind, .material = -1, .first_instance = UINT32_MAX};
    draw_normal_matrix(view->view_from_world, pass.normal_view_from_world);
    find_clip_from_world(view, pass.clip_from_world);
    draw_set_defaults();
    gl.Viewport(0, 0, view->width, view->height);
    gl.Enable(GL_DEPTH_TEST);
    gl.BindVertexArray(r->vertex_array);
    gl.VertexAttrib4f(ATTRIBUTE_COLOR, 1, 1, 1, 1); /* for options.everything without vertex colours */
    return pass;
}

static void use_program(draw_pass *pass, const draw_program *p)
{
    const scene_view *view = pass->view;
    gl.UseProgram(p->name);
    gl.UniformMatrix4fv(p->view_from_world, 1, GL_FALSE, view->view_from_world);
    gl.UniformMatrix4fv(p->clip_from_view, 1, GL_FALSE, view->clip_from_view);
    gl.Uniform1f(p->depth_offset, pass->depth_offset);
    gl.UniformMatrix3fv(p->normal_view_from_world, 1, GL_FALSE, &pass->normal_view_from_world[0][0]);
    if (pass->last) {
        gl.UniformMatrix4fv(p->last_view_from_world, 1, GL_FALSE, pass->last->view_from_world);
        gl.UniformMatrix4fv(p->last_clip_from_view, 1, GL_FALSE, pass->last->clip_from_view);
    }
    if (pass->kind == DRAW_MAIN) {
        gl.Uniform1f(p->intensity, 1.0f - pass->renderer->options.left_out);
        gl.Uniform3fv(p->ambient, 1, pass->ambient);
        gl.Uniform3fv(p->ambient_tilt, 1, pass->ambient_tilt);
        gl.Uniform3fv(p->up_view, 1, pass->up_view);
        gl.UniformMatrix3fv(p->sky_from_view, 1, GL_FALSE, &pass->sky_from_view[0][0]);
        if (pass->environment)
            gl.Uniform3fv(p->irradiance, 9, &pass->environment->irradiance[0][0]);
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

static void use_map(const scene_renderer *r, unsigned unit, int texture, bool is_srgb, int uv_location, bool more_uvs,
                    int uv, const float uv_from_uv[6])
{
    /* Rows 0 and 1 weigh the first two uv sets, 3 and 4 the others, row 2 is added. */
    float rows[5][4] = {{0}};
    for (int row = 0; row < 2; row++) {
        float *weights = rows[row + (uv >= 2 ? 3 : 0)] + 2 * (uv % 2);
        weights[0] = uv_from_uv[3 * row];
        weights[1] = uv_from_uv[3 * row + 1];
        rows[2][row] = uv_from_uv[3 * row + 2];
    }
    draw_bind_texture(unit, r->images[is_srgb][r->scene->textures[texture].image], r->samplers[texture]);
    gl.Uniform4fv(uv_location, more_uvs ? 5 : 3, rows[0]);
}

/* Binds the program's maps. A neutral texture takes the place of a map that the item lacks. */
static void use_maps(const scene_renderer *r, const scene_material *m, const draw_program *p, unsigned variant,
                     unsigned own)
{
    const scene_map base = {.texture = m->base_color_texture, .uv = m->base_color_uv};
    const struct {
        unsigned bit, unit;
        const scene_map *map;
        const float *uv_from_uv;
        bool is_srgb;
        int uv_location;
    } maps[] = {
        {VARIANT_BASE_MAPPED, UNIT_BASE_COLOR, &base, m->base_color_uv_from_uv, true, p->base_color_uv},
        {VARIANT_NORMAL_MAPPED, UNIT_NORMAL, &m->normal_map, m->normal_map.uv_from_uv, false, p->normal_uv},
        {VARIANT_ROUGHNESS_MAPPED, UNIT_METALLIC_ROUGHNESS, &m->metallic_roughness_map,
         m->metallic_roughness_map.uv_from_uv, false, p->metallic_roughness_uv},
        {VARIANT_BAKED, UNIT_OCCLUSION, &m->occlusion_map, m->occlusion_map.uv_from_uv, false, p->occlusion_uv},
        {VARIANT_EMISSION_MAPPED, UNIT_EMISSION, &m->emissive_map, m->emissive_map.uv_from_uv, true, p->emission_uv},
    };
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++)
        if (variant & own & maps[i].bit)
            use_map(r, maps[i].unit, maps[i].map->texture, maps[i].is_srgb, maps[i].uv_location,
                    variant & VARIANT_MORE_UVS, maps[i].map->uv, maps[i].uv_from_uv);
        else if (variant & maps[i].bit)
            draw_bind_texture(maps[i].unit, r->neutral[maps[i].bit == VARIANT_NORMAL_MAPPED], r->linear_sampler);
}

static void use_material(draw_pass *pass, int index, unsigned own)
{
    const scene_renderer *r = pass->renderer;
    const scene_material *m = &r->scene->materials[index];
    const draw_program *p = pass->program;
    use_maps(r, m, p, pass->variant, own);
    gl.Uniform4fv(p->base_color, 1, m->base_color);
    gl.Uniform1f(p->alpha_cutoff, own & VARIANT_MASKED ? m->alpha_cutoff : 0);
    gl.Uniform1f(p->normal_scale, m->normal_scale);
    gl.Uniform2f(p->metallic_roughness, m->metallic, m->roughness);
    gl.Uniform1f(p->occlusion_strength, m->occlusion_strength);
    gl.Uniform3fv(p->emission, 1, m->emissive);
    if (m->double_sided)
        gl.Disable(GL_CULL_FACE);
    else
        gl.Enable(GL_CULL_FACE);
    pass->material = index;
}

static void point_columns(unsigned location, unsigned count, size_t at)
{
    for (unsigned c = 0; c < count; c++)
        gl.VertexAttribPointer(location + c, 3, GL_FLOAT, GL_FALSE, sizeof(draw_instance),
                               (const void *)(at + c * sizeof(float[3])));
}

static void use_instances(draw_pass *pass, uint32_t first)
{
    const scene_renderer *r = pass->renderer;
    const size_t base = first * sizeof(draw_instance);
    gl.BindBuffer(GL_ARRAY_BUFFER, r->instance_buffer);
    point_columns(ATTRIBUTE_WORLD_FROM_MESH, 4, base + offsetof(draw_instance, world_from_mesh));
    if (pass->last) { /* in the place of the normals */
        gl.BindBuffer(GL_ARRAY_BUFFER, r->last_instance_buffer ? r->last_instance_buffer : r->instance_buffer);
        point_columns(ATTRIBUTE_NORMAL_WORLD_FROM_MESH, 4, base + offsetof(draw_instance, world_from_mesh));
    } else {
        point_columns(ATTRIBUTE_NORMAL_WORLD_FROM_MESH, 3, base + offsetof(draw_instance, normal_world_from_mesh));
    }
    pass->first_instance = first;
}

void draw_item_now(draw_pass *pass, const draw_item *item)
{
    const draw_variant *variant = &pass->renderer->pool->variants[item->program[pass->kind]];
    pass->variant = variant->variant;
    if (pass->program != &variant->program)
        use_program(pass, &variant->program);
    if (pass->material != item->material)
        use_material(pass, item->material, item->variant);
    if (pass->first_instance != item->first_instance)
        use_instances(pass, item->first_instance);
    gl.Uniform1f(pass->program->handedness, item->mirrored ? -1.0f : 1.0f);
    gl.FrontFace(item->mirrored ? GL_CW : GL_CCW);
    static const GLenum modes[] = {GL_TRIANGLES, GL_LINES, GL_POINTS};
    gl.DrawElementsInstanced(modes[item->topology], (GLsizei)item->index_count, GL_UNSIGNED_INT,
                             (const void *)(item->first_index * sizeof(uint32_t)), (GLsizei)item->instance_count);
}

unsigned draw_opaque(draw_pass *pass, unsigned *out_culled)
{
    const scene_renderer *r = pass->renderer;
    unsigned drawn = 0;
    for (uint32_t i = 0; i < r->opaque_count; i++) {
        if (r->options.everything || draw_item_is_seen(&r->items[i], pass->clip_from_world)) {
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
    draw_pass pass = draw_begin(r, view, kind);
    if (kind == DRAW_SHADOW)
        draw_shadow_offset();
    const unsigned drawn = draw_opaque(&pass, out_culled);
    draw_set_defaults();
    return drawn;
}

bool draw_is_ready(scene_renderer *r)
{
    if (!r->configured) {
        char error[2048];
        const scene_lighting none = {0};
        if (!scene_renderer_configure(r, &none, &(scene_draw_options){0}, FAULT(error))) {
            fprintf(stderr, "scene: %s\n", error);
            return false;
        }
    }
    return true;
}

void scene_draw_normals(scene_renderer *r, const scene_view *view)
{
    if (!draw_is_ready(r))
        return;
    r->counts.culled = 0;
    r->counts.normals = draw_opaque_items(r, view, DRAW_NORMALS, &r->counts.culled);
}

scene_seen scene_find_seen(const scene_renderer *r, const scene_view *view)
{
    scene_seen seen = {.opaque_total = r->opaque_count, .blended_total = r->item_count - r->first_blended};
    double clip_from_world[16];
    find_clip_from_world(view, clip_from_world);
    for (uint32_t i = 0; i < r->item_count; i++) {
        if (!draw_item_is_seen(&r->items[i], clip_from_world))
            continue;
        const bool opaque = i < r->opaque_count;
        seen.opaque += opaque;
        seen.blended += i >= r->first_blended;
        seen.lit += opaque && r->items[i].variant & VARIANT_LIT;
    }
    return seen;
}

void scene_draw_layer(scene_renderer *r, const scene_view *view, unsigned depth_texture, scene_layer layer)
{
    /* Two steps of a 24-bit depth buffer. A triangle that is drawn again has the same depth up to rounding. */
    const float rounding = 1.2e-7f, far_depth = 1;
    if (!draw_is_ready(r) || !r->options.layers)
        return;
    gl.DepthMask(GL_TRUE);
    gl.ClearBufferfv(GL_DEPTH, 0, &far_depth);
    draw_pass pass = draw_begin(r, view, DRAW_LAYER);
    pass.depth_offset = layer == SCENE_LAYER_BACK ? -rounding : rounding;
    draw_bind_texture(UNIT_FIRST_DEPTH, depth_texture, r->nearest_sampler);
    gl.CullFace(layer == SCENE_LAYER_BACK ? GL_FRONT : GL_BACK); /* of single-sided materials */
    unsigned culled = 0;
    (void)draw_opaque(&pass, &culled);
    draw_set_defaults();
}
