/* SPDX-License-Identifier: MIT
 *
 * Makes and frees a scene_renderer: decides which draw calls the scene takes, and uploads buffers, textures and
 * programs for those and nothing else.
 */
#include "draw_internal.h"
#include "gl.h"
#include "scene_shaders.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool draw_normal_matrix(const float affine[16], float out[3][3])
{
    double m[3][3], cofactors[3][3];
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++)
            m[c][r] = affine[4 * c + r];
    /* The cofactor matrix is the determinant times the inverse transpose, and exists where the inverse does not. */
    for (int c = 0; c < 3; c++) {
        const double *a = m[(c + 1) % 3], *b = m[(c + 2) % 3];
        for (int r = 0; r < 3; r++)
            cofactors[c][r] = a[(r + 1) % 3] * b[(r + 2) % 3] - a[(r + 2) % 3] * b[(r + 1) % 3];
    }
    double determinant = 0.0, largest = 0.0;
    for (int r = 0; r < 3; r++)
        determinant += m[0][r] * cofactors[0][r];
    for (int i = 0; i < 9; i++)
        largest = fmax(largest, fabs(cofactors[i / 3][i % 3]));
    bool mirrors = determinant < 0.0;
    double scale = largest > 0.0 ? (mirrors ? -1.0 : 1.0) / largest : 0.0;
    for (int i = 0; i < 9; i++)
        out[i / 3][i % 3] = (float)(scale * cofactors[i / 3][i % 3]);
    return mirrors;
}

static bool has_colors(const scene *s, const scene_primitive *p)
{
    for (uint32_t i = 0; i < p->index_count; i++) {
        const float *color = s->vertices[s->indices[p->first_index + i]].color;
        if (color[0] != 1.0f || color[1] != 1.0f || color[2] != 1.0f || color[3] != 1.0f)
            return true;
    }
    return false;
}

static void choose_variants(const scene_material *m, bool colored, draw_item *item)
{
    unsigned color = (m->base_color_texture >= 0 ? VARIANT_TEXTURED : 0u) | (colored ? VARIANT_COLORED : 0u);
    unsigned sides = m->double_sided ? VARIANT_DOUBLE_SIDED : 0u;

    item->normals_variant = VARIANT_LIT | sides;
    if (m->alpha == SCENE_ALPHA_MASK)
        item->normals_variant |= VARIANT_MASKED | color;

    item->main_variant = color | (m->unlit ? 0u : VARIANT_LIT | sides);
    if (m->alpha == SCENE_ALPHA_MASK)
        item->main_variant |= VARIANT_MASKED;
    if (m->alpha == SCENE_ALPHA_BLEND)
        item->main_variant |= VARIANT_BLENDED;
}

static draw_item *add_item(scene_renderer *r, uint32_t *capacity)
{
    if (r->item_count == *capacity) {
        if (*capacity > UINT32_MAX / 2)
            return NULL;
        uint32_t wanted = *capacity ? *capacity * 2 : 64;
        draw_item *items = realloc(r->items, wanted * sizeof *items);
        if (!items)
            return NULL;
        r->items = items;
        *capacity = wanted;
    }
    return &r->items[r->item_count++];
}

static void find_centre(const scene_primitive *p, const draw_instance *instance, double out[3])
{
    for (int row = 0; row < 3; row++) {
        out[row] = instance->world_from_mesh[3][row];
        for (int c = 0; c < 3; c++)
            out[row] += instance->world_from_mesh[c][row] * 0.5 * ((double)p->bounds_min[c] + p->bounds_max[c]);
    }
}

/* The items of one primitive, for `count` instances from `first` on that all mirror or all do not. */
static bool add_primitive(scene_renderer *r, uint32_t *capacity, const scene_primitive *p, bool colored,
                          const draw_instance *instances, uint32_t first, uint32_t count, bool mirrored)
{
    const scene_material *m = &r->scene->materials[p->material];
    bool blended = m->alpha == SCENE_ALPHA_BLEND;
    uint32_t step = blended ? 1 : count;
    for (uint32_t i = 0; i < count; i += step) {
        draw_item *item = add_item(r, capacity);
        if (!item)
            return false;
        *item = (draw_item){.first_index = p->first_index,
                            .index_count = p->index_count,
                            .first_instance = first + i,
                            .instance_count = step,
                            .material = p->material,
                            .mirrored = mirrored};
        choose_variants(m, colored, item);
        if (blended)
            find_centre(p, &instances[first + i], item->centre_world);
    }
    return true;
}

static bool add_mesh(scene_renderer *r, uint32_t *capacity, const scene_mesh *mesh, draw_instance *instances)
{
    const scene *s = r->scene;
    /* Mirrored instances fill the mesh's range from its end, the others from its start. */
    uint32_t split = mesh->first_instance, end = mesh->first_instance + mesh->instance_count;
    for (uint32_t i = mesh->first_instance; i < mesh->first_instance + mesh->instance_count; i++) {
        const float *world_from_mesh = s->instances[i].world_from_mesh;
        draw_instance instance;
        bool mirrored = draw_normal_matrix(world_from_mesh, instance.normal_world_from_mesh);
        for (int c = 0; c < 4; c++)
            memcpy(instance.world_from_mesh[c], world_from_mesh + 4 * c, sizeof instance.world_from_mesh[c]);
        instances[mirrored ? --end : split++] = instance;
    }
    uint32_t plain_count = split - mesh->first_instance, mirrored_count = mesh->instance_count - plain_count;
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        const scene_primitive *p = &s->primitives[mesh->first_primitive + i];
        if (!p->index_count)
            continue;
        bool colored = has_colors(s, p);
        if (!add_primitive(r, capacity, p, colored, instances, mesh->first_instance, plain_count, false) ||
            !add_primitive(r, capacity, p, colored, instances, split, mirrored_count, true))
            return false;
    }
    return true;
}

/* A total order, so that the same scene is drawn in the same order everywhere. */
static int compare_items(const void *a, const void *b)
{
    const draw_item *x = a, *y = b;
    bool x_blended = x->main_variant & VARIANT_BLENDED, y_blended = y->main_variant & VARIANT_BLENDED;
    if (x_blended != y_blended)
        return x_blended - y_blended;
    if (x->main_variant != y->main_variant && !x_blended)
        return x->main_variant < y->main_variant ? -1 : 1;
    if (x->material != y->material && !x_blended)
        return x->material - y->material;
    if (x->first_index != y->first_index)
        return x->first_index < y->first_index ? -1 : 1;
    return (x->first_instance > y->first_instance) - (x->first_instance < y->first_instance);
}

static void upload_buffer(unsigned *name, GLenum target, const void *data, size_t size)
{
    gl.GenBuffers(1, name);
    gl.BindBuffer(target, *name);
    gl.BufferData(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
}

static void upload_geometry(scene_renderer *r, const draw_instance *instances)
{
    const scene *s = r->scene;
    gl.GenVertexArrays(1, &r->empty_vertex_array);
    gl.GenVertexArrays(1, &r->vertex_array);
    gl.BindVertexArray(r->vertex_array);
    upload_buffer(&r->instance_buffer, GL_ARRAY_BUFFER, instances, s->instance_count * sizeof *instances);
    upload_buffer(&r->vertex_buffer, GL_ARRAY_BUFFER, s->vertices, s->vertex_count * sizeof *s->vertices);
    upload_buffer(&r->index_buffer, GL_ELEMENT_ARRAY_BUFFER, s->indices, s->index_count * sizeof *s->indices);

    /* Which uv set, and which instances, is set before each draw call: 3.3 has no base instance. */
    static const struct {
        unsigned location;
        int components;
        size_t offset;
    } attributes[] = {
        {ATTRIBUTE_POSITION, 3, offsetof(scene_vertex, position)},
        {ATTRIBUTE_NORMAL, 3, offsetof(scene_vertex, normal)},
        {ATTRIBUTE_UV, 2, offsetof(scene_vertex, uv)},
        {ATTRIBUTE_COLOR, 4, offsetof(scene_vertex, color)},
    };
    for (size_t i = 0; i < sizeof attributes / sizeof attributes[0]; i++) {
        gl.VertexAttribPointer(attributes[i].location, attributes[i].components, GL_FLOAT, GL_FALSE,
                               sizeof(scene_vertex), (const void *)attributes[i].offset);
        gl.EnableVertexAttribArray(attributes[i].location);
    }
    for (unsigned i = ATTRIBUTE_WORLD_FROM_MESH; i < ATTRIBUTE_NORMAL_WORLD_FROM_MESH + 3; i++) {
        gl.EnableVertexAttribArray(i);
        gl.VertexAttribDivisor(i, 1);
    }
    gl.BindVertexArray(0);
    gl.BindBuffer(GL_ARRAY_BUFFER, 0);
}

static unsigned make_sampler(GLint min_filter, GLint mag_filter, GLint wrap_u, GLint wrap_v)
{
    unsigned sampler = 0;
    gl.GenSamplers(1, &sampler);
    gl.SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, min_filter);
    gl.SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, mag_filter);
    gl.SamplerParameteri(sampler, GL_TEXTURE_WRAP_S, wrap_u);
    gl.SamplerParameteri(sampler, GL_TEXTURE_WRAP_T, wrap_v);
    return sampler;
}

static unsigned upload_image(const scene_image *image, bool mipmaps)
{
    unsigned texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image->width, image->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                  image->rgba);
    if (mipmaps)
        gl.GenerateMipmap(GL_TEXTURE_2D);
    else
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

static bool upload_texture(scene_renderer *r, int index, const bool *image_wants_mipmaps, char *error,
                           size_t error_size)
{
    static const GLint wraps[] = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE};
    const scene_texture *t = &r->scene->textures[index];
    if (!r->samplers[index]) {
        GLint min_filter = t->min_nearest ? (t->mipmaps ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST)
                                          : (t->mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
        r->samplers[index] =
            make_sampler(min_filter, t->mag_nearest ? GL_NEAREST : GL_LINEAR, wraps[t->wrap_u], wraps[t->wrap_v]);
    }
    if (!r->images[t->image]) {
        const scene_image *image = &r->scene->images[t->image];
        GLint limit = 0;
        gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
        if (image->width > limit || image->height > limit) {
            snprintf(error, error_size, "image %d is %d x %d; this driver takes up to %d", t->image, image->width,
                     image->height, limit);
            return false;
        }
        r->images[t->image] = upload_image(image, image_wants_mipmaps[t->image]);
    }
    return true;
}

/* Only what the items use, each image once. */
static bool upload_textures(scene_renderer *r, char *error, size_t error_size)
{
    const scene *s = r->scene;
    bool *wants_mipmaps = calloc((size_t)s->image_count + 1, sizeof *wants_mipmaps);
    r->images = calloc((size_t)s->image_count + 1, sizeof *r->images);
    r->samplers = calloc((size_t)s->texture_count + 1, sizeof *r->samplers);
    bool done = wants_mipmaps && r->images && r->samplers;
    if (!done)
        snprintf(error, error_size, "out of memory");
    for (uint32_t i = 0; done && i < r->item_count; i++) {
        int texture = s->materials[r->items[i].material].base_color_texture;
        if (texture >= 0 && s->textures[texture].mipmaps)
            wants_mipmaps[s->textures[texture].image] = true;
    }
    for (uint32_t i = 0; done && i < r->item_count; i++) {
        int texture = s->materials[r->items[i].material].base_color_texture;
        if (texture >= 0)
            done = upload_texture(r, texture, wants_mipmaps, error, error_size);
    }
    free(wants_mipmaps);
    return done;
}

static void make_screen_maps(scene_renderer *r)
{
    static const uint8_t white = 255;
    gl.GenTextures(1, &r->white_texture);
    gl.BindTexture(GL_TEXTURE_2D, r->white_texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, 1, 1, 0, GL_RED, GL_UNSIGNED_BYTE, &white);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    r->linear_sampler = make_sampler(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    r->nearest_sampler = make_sampler(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
}

static bool build_programs(scene_renderer *r, char *error, size_t error_size)
{
    for (uint32_t i = 0; i < r->item_count; i++) {
        const draw_item *item = &r->items[i];
        draw_program *normals = &r->normals[item->normals_variant], *main = &r->main[item->main_variant];
        if (i < r->opaque_count && !normals->name &&
            !draw_program_build(normals, "scene normals pass", shader_scene_vert, shader_normals_frag,
                                item->normals_variant, error, error_size))
            return false;
        if (!main->name && !draw_program_build(main, "scene main pass", shader_scene_vert, shader_main_frag,
                                               item->main_variant, error, error_size))
            return false;
    }
    return draw_program_build(&r->map, "map pass", shader_fullscreen_vert, shader_map_frag, 0, error, error_size) &&
           draw_program_build(&r->view_distance, "view distance pass", shader_fullscreen_vert,
                              shader_view_distance_frag, 0, error, error_size);
}

static bool plan_items(scene_renderer *r, draw_instance *instances)
{
    uint32_t capacity = 0;
    for (uint32_t i = 0; i < r->scene->mesh_count; i++)
        if (!add_mesh(r, &capacity, &r->scene->meshes[i], instances))
            return false;
    if (r->item_count)
        qsort(r->items, r->item_count, sizeof *r->items, compare_items);
    while (r->opaque_count < r->item_count && !(r->items[r->opaque_count].main_variant & VARIANT_BLENDED))
        r->opaque_count++;
    r->blended_order = calloc((size_t)(r->item_count - r->opaque_count) + 1, sizeof *r->blended_order);
    return r->blended_order != NULL;
}

scene_renderer *scene_renderer_create(const scene *s, char *error, size_t error_size)
{
    scene_renderer *r = calloc(1, sizeof *r);
    draw_instance *instances = calloc((size_t)s->instance_count + 1, sizeof *instances);
    bool done = r && instances;
    if (done) {
        r->scene = s;
        done = plan_items(r, instances);
    }
    if (!done) {
        snprintf(error, error_size, "out of memory");
    } else {
        /* An error from before is not ours; a lost context may report without end. */
        for (int i = 0; i < 16 && gl.GetError() != GL_NO_ERROR; i++)
            continue;
        upload_geometry(r, instances);
        make_screen_maps(r);
        done = upload_textures(r, error, error_size) && build_programs(r, error, error_size);
        GLenum code = gl.GetError();
        if (done && code != GL_NO_ERROR) {
            snprintf(error, error_size, "uploading the scene failed: %s (GL error 0x%04x)",
                     code == GL_OUT_OF_MEMORY ? "out of GPU memory" : "the driver refused it", code);
            done = false;
        }
    }
    free(instances);
    if (!done) {
        scene_renderer_destroy(r);
        return NULL;
    }
    return r;
}

void scene_renderer_destroy(scene_renderer *r)
{
    if (!r)
        return;
    /* GL ignores the name 0, which is what was not made. */
    unsigned buffers[] = {r->vertex_buffer, r->index_buffer, r->instance_buffer};
    unsigned vertex_arrays[] = {r->vertex_array, r->empty_vertex_array};
    unsigned samplers[] = {r->linear_sampler, r->nearest_sampler};
    gl.DeleteBuffers(3, buffers);
    gl.DeleteVertexArrays(2, vertex_arrays);
    gl.DeleteSamplers(2, samplers);
    gl.DeleteTextures(1, &r->white_texture);
    if (r->images)
        gl.DeleteTextures((GLsizei)r->scene->image_count, r->images);
    if (r->samplers)
        gl.DeleteSamplers((GLsizei)r->scene->texture_count, r->samplers);
    for (int i = 0; i < VARIANT_COUNT; i++) {
        gl.DeleteProgram(r->normals[i].name);
        gl.DeleteProgram(r->main[i].name);
    }
    gl.DeleteProgram(r->map.name);
    gl.DeleteProgram(r->view_distance.name);
    free(r->images);
    free(r->samplers);
    free(r->items);
    free(r->blended_order);
    free(r);
}
