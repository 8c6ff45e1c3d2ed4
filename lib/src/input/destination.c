/* SPDX-License-Identifier: MIT
 *
 * Looks at a framebuffer of the host.
 */
#include "input/destination.h"

#include "input/host_textures.h"
#include "values.glsl"

static gl_int attachment(const glssao__gl *gl, gl_enum point, gl_enum what)
{
    gl_int value = 0;
    gl->GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, point, what, &value);
    return value;
}

/* 0 where no texture is attached. */
static gl_uint attached_texture(const glssao__gl *gl, gl_enum point)
{
    if (attachment(gl, point, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_TEXTURE)
        return 0;
    return (gl_uint)attachment(gl, point, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME);
}

bool glssao__destination_has(const glssao__gl *gl, gl_uint framebuffer, gl_uint texture)
{
    for (int i = 0; framebuffer != 0 && texture != 0 && i < gl->max_color_attachments; ++i)
        if (attached_texture(gl, GL_COLOR_ATTACHMENT0 + (gl_enum)i) == texture)
            return true;
    return false;
}

/* The formats with alpha or without that OpenGL 4.2 lets shaders load (table 3.21) and blend. None of sRGB is. */
static int kind_of(gl_enum format)
{
    static const struct {
        gl_enum format;
        int kind;
    } kinds[] = {
        {GL_RGBA8, IMAGE_RGBA8},     {GL_RGBA16, IMAGE_RGBA16},     {GL_RGBA16F, IMAGE_RGBA16F},
        {GL_RGBA32F, IMAGE_RGBA32F}, {GL_RGB10_A2, IMAGE_RGB10_A2}, {GL_R11F_G11F_B10F, IMAGE_R11F_G11F_B10F},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i)
        if (kinds[i].format == format)
            return kinds[i].kind;
    return 0;
}

/* OpenGL may refuse to load from a texture that lacks levels which its own filter would read (4.2, section 3.9.20). A
 * filter without levels is lent for the call. */
static gl_int lend_filter(const glssao__gl *gl)
{
    gl_int filter = 0;
    gl->GetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, &filter);
    if (filter == GL_NEAREST || filter == GL_LINEAR)
        return 0;
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    return filter;
}

static gl_int base_level(const glssao__gl *gl)
{
    gl_int level = 0;
    gl->GetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, &level);
    return level;
}

glssao__image glssao__destination_image(const glssao__gl *gl, gl_uint framebuffer)
{
    const glssao__image none = {0};
    gl_int point = 0, format = 0, samples = 0;
    gl->GetIntegerv(GL_SAMPLES, &samples);
    if (framebuffer == 0 || samples > 0)
        return none;
    gl->GetIntegerv(GL_DRAW_BUFFER0, &point);
    const gl_uint texture = point != 0 ? attached_texture(gl, (gl_enum)point) : 0;
    /* Binding it tells that it is no array or cube map. */
    if (texture == 0 || attachment(gl, (gl_enum)point, GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL) != 0 ||
        !glssao__host_texture_bind(gl, GL_TEXTURE_2D, texture) || base_level(gl) != 0)
        return none;
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    const int kind = kind_of((gl_enum)format);
    return kind ? (glssao__image){texture, (gl_enum)format, kind, lend_filter(gl)} : none;
}

void glssao__destination_give_back(const glssao__gl *gl, const glssao__image *image)
{
    if (!image->host_filter)
        return;
    gl->BindTexture(GL_TEXTURE_2D, image->texture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, image->host_filter);
}
