/* SPDX-License-Identifier: MIT
 *
 * Makes and frees a scene_renderer: uploads buffers and textures for the draw calls that the scene takes, and nothing
 * else.
 */
#include "draw_internal.h"
#include "gl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void draw_upload_buffer(unsigned *name, GLenum target, const void *data, size_t size)
{
    if (!*name)
        gl.GenBuffers(1, name);
    gl.BindBuffer(target, *name);
    gl.BufferData(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
}

/* The parts of a scene_vertex, in buffers of their own: drivers count the bytes to a vertex in 31 bits, and so have
 * room for more vertices than of whole ones. */
static const struct {
    unsigned location;
    size_t components, offset;
} parts[DRAW_VERTEX_PARTS] = {
    {ATTRIBUTE_POSITION, 3, offsetof(scene_vertex, position)},
    {ATTRIBUTE_NORMAL, 3, offsetof(scene_vertex, normal)},
    {ATTRIBUTE_UVS, 4, offsetof(scene_vertex, uv)},
    {ATTRIBUTE_COLOR, 4, offsetof(scene_vertex, color)},
};

/* Which parts some draw call reads. */
static void find_parts(const scene_renderer *r, bool out[DRAW_VERTEX_PARTS])
{
    out[0] = true;
    out[1] = out[2] = out[3] = false;
    for (uint32_t i = 0; i < r->item_count; i++) {
        out[1] = out[1] || !r->items[i].flat;
        out[2] = out[2] || r->items[i].variant & VARIANT_TEXTURED;
        out[3] = out[3] || r->items[i].colored;
    }
}

static bool vertices_fit(const scene_renderer *r, failure *fault)
{
    bool read[DRAW_VERTEX_PARTS];
    find_parts(r, read);
    const bool wide = read[2] || read[3] || r->scene->tangents || r->scene->more_uvs;
    const size_t largest = (wide ? 4 : 3) * sizeof(float);
    if (r->scene->vertex_count <= INT32_MAX / largest)
        return true;
    return fault_set(fault, "%u vertices: a vertex buffer takes up to %zu of them", r->scene->vertex_count,
                     INT32_MAX / largest);
}

void draw_upload_vertices(scene_renderer *r)
{
    enum { BLOCK = 4096 }; /* vertices packed at a time, so that a large scene needs no packed copy */
    const scene *s = r->scene;
    bool read[DRAW_VERTEX_PARTS];
    float block[BLOCK * 4];
    find_parts(r, read);
    for (size_t k = 0; k < DRAW_VERTEX_PARTS; k++) {
        const size_t size = parts[k].components * sizeof(float);
        if (!read[k])
            continue;
        draw_upload_buffer(&r->vertex_buffers[k], GL_ARRAY_BUFFER, NULL, s->vertex_count * size);
        for (size_t first = 0; first < s->vertex_count; first += BLOCK) {
            const size_t count = s->vertex_count - first < BLOCK ? s->vertex_count - first : BLOCK;
            for (size_t i = 0; i < count; i++)
                memcpy(block + i * parts[k].components, (const char *)&s->vertices[first + i] + parts[k].offset, size);
            gl.BufferSubData(GL_ARRAY_BUFFER, (GLintptr)(first * size), (GLsizeiptr)(count * size), block);
        }
    }
}

void draw_point_vertices(const scene_renderer *r)
{
    for (size_t k = 0; k < DRAW_VERTEX_PARTS; k++) {
        if (!r->vertex_buffers[k])
            continue;
        gl.BindBuffer(GL_ARRAY_BUFFER, r->vertex_buffers[k]);
        gl.VertexAttribPointer(parts[k].location, (GLint)parts[k].components, GL_FLOAT, GL_FALSE, 0, NULL);
        gl.EnableVertexAttribArray(parts[k].location);
    }
}

static void upload_geometry(scene_renderer *r, const draw_instance *instances)
{
    const scene *s = r->scene;
    gl.GenVertexArrays(1, &r->empty_vertex_array);
    gl.GenVertexArrays(1, &r->vertex_array);
    gl.BindVertexArray(r->vertex_array);
    /* The attributes of the instances are set before each draw call, since OpenGL 3.3 has no base instance. */
    draw_upload_buffer(&r->instance_buffer, GL_ARRAY_BUFFER, instances, s->instance_count * sizeof *instances);
    draw_upload_buffer(&r->index_buffer, GL_ELEMENT_ARRAY_BUFFER, s->indices, s->index_count * sizeof *s->indices);
    draw_upload_vertices(r);
    draw_point_vertices(r);
    if (s->tangents) {
        draw_upload_buffer(&r->tangent_buffer, GL_ARRAY_BUFFER, s->tangents, s->vertex_count * sizeof *s->tangents);
        gl.VertexAttribPointer(ATTRIBUTE_TANGENT, 4, GL_FLOAT, GL_FALSE, sizeof *s->tangents, NULL);
        gl.EnableVertexAttribArray(ATTRIBUTE_TANGENT);
    }
    if (s->more_uvs) {
        draw_upload_buffer(&r->more_uv_buffer, GL_ARRAY_BUFFER, s->more_uvs, s->vertex_count * sizeof *s->more_uvs);
        gl.VertexAttribPointer(ATTRIBUTE_MORE_UVS, 4, GL_FLOAT, GL_FALSE, sizeof *s->more_uvs, NULL);
        gl.EnableVertexAttribArray(ATTRIBUTE_MORE_UVS);
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

static unsigned upload_image(const scene_image *image, bool is_srgb, bool mipmaps)
{
    unsigned texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, is_srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, image->width, image->height, 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, image->rgba);
    if (mipmaps)
        gl.GenerateMipmap(GL_TEXTURE_2D);
    else
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

/* The textures that a draw call reads, according to the variant of its material. */
typedef struct texture_list {
    int texture[5];
    bool is_srgb[5];
    int count;
} texture_list;

static texture_list list_textures(const scene *s, const draw_item *item)
{
    const scene_material *m = &s->materials[item->material];
    const struct {
        unsigned bit;
        int texture;
        bool is_srgb;
    } maps[] = {{VARIANT_BASE_MAPPED, m->base_color_texture, true},
                {VARIANT_NORMAL_MAPPED, m->normal_map.texture, false},
                {VARIANT_ROUGHNESS_MAPPED, m->metallic_roughness_map.texture, false},
                {VARIANT_BAKED, m->occlusion_map.texture, false},
                {VARIANT_EMISSION_MAPPED, m->emissive_map.texture, true}};
    texture_list list = {.count = 0};
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++)
        if (item->variant & maps[i].bit) {
            list.texture[list.count] = maps[i].texture;
            list.is_srgb[list.count++] = maps[i].is_srgb;
        }
    return list;
}

/* What the items read of an image. */
typedef struct image_use {
    bool mipmaps;
    int spaces; /* 2: as sRGB and as linear data */
    bool is_srgb[2];
} image_use;

static bool upload_texture(scene_renderer *r, int index, bool is_srgb, const image_use *uses, scene *spent,
                           failure *fault)
{
    static const GLint wraps[] = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE};
    const scene_texture *t = &r->scene->textures[index];
    if (!r->samplers[index]) {
        GLint min_filter = t->min_nearest ? (t->mipmaps ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST)
                                          : (t->mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
        r->samplers[index] =
            make_sampler(min_filter, t->mag_nearest ? GL_NEAREST : GL_LINEAR, wraps[t->wrap_u], wraps[t->wrap_v]);
    }
    if (!r->images[is_srgb][t->image]) {
        const scene_image *image = &r->scene->images[t->image];
        GLint limit = 0;
        gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
        if (image->width > limit || image->height > limit)
            return fault_set(fault, "image %d is %d x %d; this driver takes up to %d", t->image, image->width,
                             image->height, limit);
        r->images[is_srgb][t->image] = upload_image(image, is_srgb, uses[t->image].mipmaps);
        if (spent && image->opaque && (uses[t->image].spaces == 1 || r->images[!is_srgb][t->image])) {
            free(image->rgba);
            spent->images[t->image].rgba = NULL;
        }
    }
    return true;
}

/* Uploads only images that the items use: once as sRGB for colours, once as linear for other data. */
static bool upload_textures(scene_renderer *r, scene *spent, failure *fault)
{
    const scene *s = r->scene;
    image_use *uses = calloc((size_t)s->image_count + 1, sizeof *uses);
    for (int k = 0; k < 2; k++)
        r->images[k] = calloc((size_t)s->image_count + 1, sizeof *r->images[k]);
    r->samplers = calloc((size_t)s->texture_count + 1, sizeof *r->samplers);
    bool done = uses && r->images[0] && r->images[1] && r->samplers;
    if (!done)
        fault_set_memory(fault);
    for (uint32_t i = 0; done && i < r->item_count; i++) {
        const texture_list list = list_textures(s, &r->items[i]);
        for (int k = 0; k < list.count; k++) {
            const scene_texture *t = &s->textures[list.texture[k]];
            image_use *use = &uses[t->image];
            use->mipmaps = use->mipmaps || t->mipmaps;
            use->spaces += !use->is_srgb[list.is_srgb[k]];
            use->is_srgb[list.is_srgb[k]] = true;
        }
    }
    for (uint32_t i = 0; done && i < r->item_count; i++) {
        const texture_list list = list_textures(s, &r->items[i]);
        for (int k = 0; done && k < list.count; k++)
            done = upload_texture(r, list.texture[k], list.is_srgb[k], uses, spent, fault);
    }
    free(uses);
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

void draw_make_neutral(scene_renderer *r)
{
    static const uint8_t texels[2][4] = {{255, 255, 255, 255}, {128, 128, 255, 255}};
    for (int i = 0; i < 2 && !r->neutral[i]; i++) {
        gl.GenTextures(1, &r->neutral[i]);
        gl.BindTexture(GL_TEXTURE_2D, r->neutral[i]);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels[i]);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        gl.BindTexture(GL_TEXTURE_2D, 0);
    }
}

/* `spent`: the same scene if its texels may be freed, else NULL. */
static scene_renderer *create(const scene *s, scene *spent, const scene_renderer *like, failure *fault)
{
    scene_renderer *r = calloc(1, sizeof *r);
    draw_instance *instances = calloc((size_t)s->instance_count + 1, sizeof *instances);
    bool done = r && instances;
    if (done) {
        r->scene = s;
        done = draw_plan_items(r, instances);
    }
    if (!done) {
        fault_set_memory(fault);
    } else {
        /* An error from before is not ours; a lost context may report without end. */
        for (int i = 0; i < 16 && gl.GetError() != GL_NO_ERROR; i++)
            continue;
        done = vertices_fit(r, fault);
        if (done)
            upload_geometry(r, instances);
        make_screen_maps(r);
        done = done && upload_textures(r, spent, fault) && draw_pool_join(r, like, fault);
        GLenum code = gl.GetError();
        if (done && code != GL_NO_ERROR) {
            fault_set(fault, "uploading the scene failed: %s (GL error 0x%04x)",
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

scene_renderer *scene_renderer_create(const scene *s, failure *fault)
{
    return create(s, NULL, NULL, fault);
}

scene_renderer *scene_renderer_create_spending(scene *s, const scene_renderer *like, failure *fault)
{
    return create(s, s, like, fault);
}

void scene_renderer_destroy(scene_renderer *r)
{
    if (!r)
        return;
    /* GL ignores the name 0, which stands for an object that was not created. */
    unsigned buffers[] = {r->tangent_buffer,  r->more_uv_buffer, r->index_buffer,
                          r->instance_buffer, r->last_positions, r->last_instance_buffer};
    unsigned vertex_arrays[] = {r->vertex_array, r->empty_vertex_array, r->motion_vertex_array};
    unsigned samplers[] = {r->linear_sampler, r->nearest_sampler};
    gl.DeleteBuffers(6, buffers);
    gl.DeleteBuffers(DRAW_VERTEX_PARTS, r->vertex_buffers);
    gl.DeleteVertexArrays(3, vertex_arrays);
    gl.DeleteSamplers(2, samplers);
    gl.DeleteTextures(1, &r->white_texture);
    gl.DeleteTextures(2, r->neutral);
    for (int k = 0; k < 2; k++)
        if (r->images[k])
            gl.DeleteTextures((GLsizei)r->scene->image_count, r->images[k]);
    if (r->samplers)
        gl.DeleteSamplers((GLsizei)r->scene->texture_count, r->samplers);
    draw_shadow_free(&r->shadow);
    if (r->sky_seen.query)
        gl.DeleteQueries(1, &r->sky_seen.query);
    draw_pool_leave(r);
    free(r->images[0]);
    free(r->images[1]);
    free(r->samplers);
    free(r->items);
    free(r->blended_order);
    free(r);
}
