/* SPDX-License-Identifier: MIT
 *
 * Render targets and samplers.
 */
#include "gpu/textures.h"

static bool has_size(const glssao__gl *gl, int width, int height)
{
    gl_int w = 0, h = 0;
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &w);
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &h);
    return w == width && h == height;
}

static gl_enum channels_of(gl_enum format)
{
    switch (format) {
    case GL_R16:
    case GL_R32F:
        return GL_RED;
    case GL_RG32F:
        return GL_RG;
    case GL_RG32UI:
        return GL_RG_INTEGER;
    default:
        return GL_RGBA;
    }
}

/* 0 where the driver has no memory: the level then stays undefined, which a query shows without glGetError. Hosts may
 * read the maps with a sampler of their own or with none: they are complete either way. */
static gl_uint make_texture(const glssao__gl *gl, gl_enum format, int width, int height, const void *rgba8)
{
    const gl_int wrap = rgba8 ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    gl_uint texture = 0;
    gl->GenTextures(1, &texture);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexImage2D(GL_TEXTURE_2D, 0, (gl_int)format, width, height, 0, channels_of(format),
                   rgba8                 ? GL_UNSIGNED_BYTE
                   : format == GL_RG32UI ? GL_UNSIGNED_INT
                                         : GL_FLOAT,
                   rgba8);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
    if (has_size(gl, width, height))
        return texture;
    (void)glssao__gl_take_error(gl, GL_OUT_OF_MEMORY);
    gl->DeleteTextures(1, &texture);
    return 0;
}

gl_uint glssao__texture_make_rgba8(const glssao__gl *gl, int width, int height, const void *texels)
{
    return make_texture(gl, GL_RGBA8, width, height, texels);
}

bool glssao__target_fits(const glssao__target *target, const glssao__target_spec *spec)
{
    return target->width == spec->width && target->height == spec->height && target->format == spec->format;
}

glssao_result glssao__target_make(const glssao__gl *gl, const glssao__log *log, const glssao__target_spec *spec,
                                  glssao__target *out)
{
    *out = (glssao__target){.texture = make_texture(gl, spec->format, spec->width, spec->height, NULL),
                            .width = spec->width,
                            .height = spec->height,
                            .format = spec->format};
    if (!out->texture) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "no memory for the %s map of %d x %d", spec->name, spec->width,
                          spec->height);
        *out = (glssao__target){0};
        return GLSSAO_OUT_OF_MEMORY;
    }
    gl->GenFramebuffers(1, &out->framebuffer);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, out->framebuffer);
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, out->texture, 0);
    const gl_enum status = gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE)
        return GLSSAO_OK;
    const bool lacks_memory = glssao__gl_take_error(gl, GL_OUT_OF_MEMORY);
    if (lacks_memory)
        glssao__log_write(log, GLSSAO_LOG_ERROR, "no memory for the %s map of %d x %d", spec->name, spec->width,
                          spec->height);
    else
        glssao__log_write(log, GLSSAO_LOG_ERROR, "the driver rejects the framebuffer of the %s map of %d x %d: 0x%04X",
                          spec->name, spec->width, spec->height, status);
    glssao__target_delete(gl, out);
    return lacks_memory ? GLSSAO_OUT_OF_MEMORY : GLSSAO_FRAMEBUFFER_ERROR;
}

void glssao__target_delete(const glssao__gl *gl, glssao__target *target)
{
    gl->DeleteFramebuffers(1, &target->framebuffer); /* OpenGL ignores the name 0 */
    gl->DeleteTextures(1, &target->texture);
    *target = (glssao__target){0};
}

void glssao__target_clear(const glssao__gl *gl, const glssao__target *target, const gl_float color[4])
{
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target->framebuffer);
    gl->ClearBufferfv(GL_COLOR, 0, color);
}

void glssao__target_clear_to(const glssao__gl *gl, const glssao__target *target, gl_float value)
{
    glssao__target_clear(gl, target, (const gl_float[4]){value, value, value, value});
}

void glssao__samplers_make(const glssao__gl *gl, gl_uint out_samplers[SAMPLER_COUNT])
{
    static const struct {
        gl_int filter, wrap;
    } kinds[SAMPLER_COUNT] = {
        [SAMPLER_POINT_CLAMP] = {GL_NEAREST, GL_CLAMP_TO_EDGE},
        [SAMPLER_LINEAR_CLAMP] = {GL_LINEAR, GL_CLAMP_TO_EDGE},
        [SAMPLER_DEPTH] = {GL_LINEAR, GL_CLAMP_TO_BORDER},
        [SAMPLER_LINEAR_WRAP] = {GL_LINEAR, GL_REPEAT},
    };
    gl->GenSamplers(SAMPLER_COUNT, out_samplers);
    for (int i = 0; i < SAMPLER_COUNT; ++i) {
        gl->SamplerParameteri(out_samplers[i], GL_TEXTURE_MIN_FILTER, kinds[i].filter);
        gl->SamplerParameteri(out_samplers[i], GL_TEXTURE_MAG_FILTER, kinds[i].filter);
        gl->SamplerParameteri(out_samplers[i], GL_TEXTURE_WRAP_S, kinds[i].wrap);
        gl->SamplerParameteri(out_samplers[i], GL_TEXTURE_WRAP_T, kinds[i].wrap);
    }
}
