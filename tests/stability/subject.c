/* SPDX-License-Identifier: MIT */
#include "subject.h"

static const struct depth_format {
    const char *name;
    GLenum internal;
    glssao_depth kind;
} depths[DEPTH_STORES] = {
    [DEPTH_16] = {"16 bit", GL_DEPTH_COMPONENT16, GLSSAO_DEPTH_WINDOW},
    [DEPTH_24] = {"24 bit", GL_DEPTH_COMPONENT24, GLSSAO_DEPTH_WINDOW},
    [DEPTH_24_STENCIL] = {"24 bit with stencil", GL_DEPTH24_STENCIL8, GLSSAO_DEPTH_WINDOW},
    [DEPTH_32] = {"32 bit", GL_DEPTH_COMPONENT32, GLSSAO_DEPTH_WINDOW},
    [DEPTH_32F] = {"32 bit float", GL_DEPTH_COMPONENT32F, GLSSAO_DEPTH_WINDOW},
    [DEPTH_32F_STENCIL] = {"32 bit float with stencil", GL_DEPTH32F_STENCIL8, GLSSAO_DEPTH_WINDOW},
    [DISTANCE_32F] = {"distance", GL_R32F, GLSSAO_DEPTH_VIEW_DISTANCE},
    [DISTANCE_16F] = {"distance in 16 bit", GL_R16F, GLSSAO_DEPTH_VIEW_DISTANCE},
    [ALPHA_32F] = {"alpha", GL_RGBA32F, GLSSAO_DEPTH_NORMAL_ALPHA},
    [ALPHA_16F] = {"alpha in 16 bit", GL_RGBA16F, GLSSAO_DEPTH_NORMAL_ALPHA},
};

static const struct normal_format {
    const char *name;
    GLenum internal;
    glssao_normal kind;
} normals[NORMAL_STORES] = {
    [NORMAL_NONE] = {"rebuilt normals", 0, GLSSAO_NORMAL_SIGNED},
    [NORMAL_32F] = {"float normals", GL_RGB32F, GLSSAO_NORMAL_SIGNED},
    [NORMAL_16F] = {"half float normals", GL_RGBA16F, GLSSAO_NORMAL_SIGNED},
    [NORMAL_8] = {"signed 8 bit normals", GL_RGB8_SNORM, GLSSAO_NORMAL_SIGNED},
    [NORMAL_UNSIGNED_8] = {"unsigned 8 bit normals", GL_RGB8, GLSSAO_NORMAL_UNSIGNED},
    [NORMAL_OCTAHEDRAL] = {"octahedral normals", GL_RG16_SNORM, GLSSAO_NORMAL_OCTAHEDRAL},
};

const char *subject_depth_name(depth_store depth)
{
    return depths[depth].name;
}

const char *subject_normal_name(normal_store normal)
{
    return normals[normal].name;
}

subject subject_of(const analytic_view *view, const analytic_shape *shapes, int count, int width, int height)
{
    subject s = {.width = width, .height = height, .view = *view};
    analytic_render_distance(view, shapes, count, width, height, &s.depth, &s.normals, &s.distance);
    return s;
}

void subject_free(subject *s)
{
    free(s->depth);
    free(s->normals);
    free(s->distance);
}

static GLuint make_texture(GLenum internal, GLenum format, GLenum type, const subject *s, const void *data)
{
    return fixture_texture(internal, format, type, s->width, s->height, data);
}

static size_t count_of(const subject *s)
{
    return (size_t)s->width * (size_t)s->height;
}

static GLuint depth_with_stencil(const subject *s)
{
    struct texel {
        float depth;
        uint32_t stencil;
    } *texels = malloc(count_of(s) * sizeof *texels);
    for (size_t i = 0; i < count_of(s); ++i)
        texels[i] = (struct texel){s->depth[i], (uint32_t)(i % 251)};
    GLuint texture = make_texture(GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, s, texels);
    free(texels);
    return texture;
}

static GLuint octahedral(const subject *s)
{
    SCOPED(memory) float *texels = malloc(count_of(s) * 2 * sizeof *texels);
    for (size_t i = 0; i < count_of(s); ++i) {
        const float *n = s->normals + 3 * i;
        const float sum = fabsf(n[0]) + fabsf(n[1]) + fabsf(n[2]), x = n[0] / sum, y = n[1] / sum;
        texels[2 * i] = n[2] >= 0.0f ? x : (1.0f - fabsf(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        texels[2 * i + 1] = n[2] >= 0.0f ? y : (1.0f - fabsf(x)) * (y >= 0.0f ? 1.0f : -1.0f);
    }
    GLuint texture = make_texture(GL_RG16_SNORM, GL_RG, GL_FLOAT, s, texels);
    return texture;
}

static GLuint unsigned_normals(const subject *s)
{
    SCOPED(memory) float *texels = malloc(count_of(s) * 3 * sizeof *texels);
    for (size_t i = 0; i < 3 * count_of(s); ++i)
        texels[i] = 0.5f * s->normals[i] + 0.5f;
    GLuint texture = make_texture(GL_RGB8, GL_RGB, GL_FLOAT, s, texels);
    return texture;
}

static GLuint normals_with_distance(const subject *s, GLenum internal)
{
    SCOPED(memory) float *texels = malloc(count_of(s) * 4 * sizeof *texels);
    for (size_t i = 0; i < count_of(s); ++i) {
        memcpy(texels + 4 * i, s->normals + 3 * i, 3 * sizeof *texels);
        texels[4 * i + 3] = s->distance[i];
    }
    GLuint texture = make_texture(internal, GL_RGBA, GL_FLOAT, s, texels);
    return texture;
}

glssao_frame subject_frame(const subject *s, depth_store depth, normal_store normal)
{
    glssao_frame frame = {.depth_kind = depths[depth].kind, .clip_zero_to_one = s->view.clip_zero_to_one};
    memcpy(frame.projection, s->view.projection, sizeof frame.projection);
    const GLenum internal = depths[depth].internal;
    if (frame.depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA) {
        frame.normal_texture = normals_with_distance(s, internal);
        return frame;
    }
    if (frame.depth_kind == GLSSAO_DEPTH_VIEW_DISTANCE)
        frame.depth_texture = make_texture(internal, GL_RED, GL_FLOAT, s, s->distance);
    else if (depth == DEPTH_32F_STENCIL)
        frame.depth_texture = depth_with_stencil(s);
    else
        frame.depth_texture = fixture_depth_texture(internal, s->width, s->height, s->depth);
    frame.normal_kind = normals[normal].kind;
    if (normal == NORMAL_OCTAHEDRAL)
        frame.normal_texture = octahedral(s);
    else if (normal == NORMAL_UNSIGNED_8)
        frame.normal_texture = unsigned_normals(s);
    else if (normal != NORMAL_NONE)
        frame.normal_texture = make_texture(normals[normal].internal, GL_RGB, GL_FLOAT, s, s->normals);
    return frame;
}

picture subject_shade_by(fixture *f, glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings)
{
    fixture_clear_log(f);
    const glssao_result result = glssao_compute(effect, frame, settings);
    if (result != GLSSAO_OK)
        fail_msg("glssao_compute: %s: %s", glssao_result_string(result), f->log);
    picture p;
    p.values = fixture_read_ambient(effect, &p.width, &p.height);
    return p;
}

picture subject_shade(fixture *f, int width, int height, const glssao_frame *frame, const glssao_settings *settings)
{
    return subject_shade_by(f, fixture_shared_effect(f, width, height), frame, settings);
}

void test_end_picture(const picture *p)
{
    free(p->values);
}
