/* SPDX-License-Identifier: MIT
 *
 * Formats and targets of the host's textures: their names, and which can hold depth, distance or normals.
 */
#include "input/formats.h"

#include <stddef.h>

enum { LEAST_DEPTH_BITS = 16, LEAST_SIGNED_FLOAT_BITS = 16 /* floats of 10 and 11 bits have no sign */ };

typedef struct named {
    gl_enum value;
    const char *name;
} named;

static const named formats[] = {
    {0x1902, "GL_DEPTH_COMPONENT"},
    {0x1903, "GL_RED"},
    {0x1907, "GL_RGB"},
    {0x1908, "GL_RGBA"},
    {0x8051, "GL_RGB8"},
    {0x8054, "GL_RGB16"},
    {0x8057, "GL_RGB5_A1"},
    {0x8058, "GL_RGBA8"},
    {0x8059, "GL_RGB10_A2"},
    {0x805B, "GL_RGBA16"},
    {0x81A5, "GL_DEPTH_COMPONENT16"},
    {0x81A6, "GL_DEPTH_COMPONENT24"},
    {0x81A7, "GL_DEPTH_COMPONENT32"},
    {0x8229, "GL_R8"},
    {0x822A, "GL_R16"},
    {0x822B, "GL_RG8"},
    {0x822C, "GL_RG16"},
    {0x822D, "GL_R16F"},
    {0x822E, "GL_R32F"},
    {0x822F, "GL_RG16F"},
    {0x8230, "GL_RG32F"},
    {0x8236, "GL_R32UI"},
    {0x8814, "GL_RGBA32F"},
    {0x8815, "GL_RGB32F"},
    {0x881A, "GL_RGBA16F"},
    {0x881B, "GL_RGB16F"},
    {0x88F0, "GL_DEPTH24_STENCIL8"},
    {0x8C3A, "GL_R11F_G11F_B10F"},
    {0x8C3D, "GL_RGB9_E5"},
    {0x8C41, "GL_SRGB8"},
    {0x8C43, "GL_SRGB8_ALPHA8"},
    {0x8CAC, "GL_DEPTH_COMPONENT32F"},
    {0x8CAD, "GL_DEPTH32F_STENCIL8"},
    {0x8D48, "GL_STENCIL_INDEX8"},
    {0x8D7C, "GL_RGBA8UI"},
    {0x8D70, "GL_RGBA32UI"},
    {0x8F94, "GL_R8_SNORM"},
    {0x8F95, "GL_RG8_SNORM"},
    {0x8F96, "GL_RGB8_SNORM"},
    {0x8F97, "GL_RGBA8_SNORM"},
};

static const named targets[] = {
    {0x0DE0, "GL_TEXTURE_1D"},
    {0x0DE1, "GL_TEXTURE_2D"},
    {0x806F, "GL_TEXTURE_3D"},
    {0x84F5, "GL_TEXTURE_RECTANGLE"},
    {0x8513, "GL_TEXTURE_CUBE_MAP"},
    {0x8C18, "GL_TEXTURE_1D_ARRAY"},
    {0x8C1A, "GL_TEXTURE_2D_ARRAY"},
    {0x8C2A, "GL_TEXTURE_BUFFER"},
    {0x9009, "GL_TEXTURE_CUBE_MAP_ARRAY"},
    {0x9100, "GL_TEXTURE_2D_MULTISAMPLE"},
    {0x9102, "GL_TEXTURE_2D_MULTISAMPLE_ARRAY"},
};

static const named statuses[] = {
    {0x8219, "GL_FRAMEBUFFER_UNDEFINED: this context has no default framebuffer"},
    {0x8CD6, "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT"},
    {0x8CD7, "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT"},
    {0x8CDB, "GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER"},
    {0x8CDC, "GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER"},
    {0x8CDD, "GL_FRAMEBUFFER_UNSUPPORTED"},
    {0x8D56, "GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE"},
    {0x8DA8, "GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS"},
};

static const char *name_in(const named *table, size_t count, gl_enum value)
{
    for (size_t i = 0; i < count; ++i)
        if (table[i].value == value)
            return table[i].name;
    return NULL;
}

const char *glssao__format_name(gl_enum internal)
{
    return name_in(formats, sizeof formats / sizeof *formats, internal);
}

const char *glssao__format_target_name(gl_enum target)
{
    const char *name = name_in(targets, sizeof targets / sizeof *targets, target);
    return name ? name : "texture";
}

const char *glssao__format_status_name(gl_enum status)
{
    const char *name = name_in(statuses, sizeof statuses / sizeof *statuses, status);
    return name ? name : "";
}

static bool is_integer(gl_enum type)
{
    return type == GL_INT || type == GL_UNSIGNED_INT;
}

static const char *distance_fault(const glssao__format *f)
{
    const bool is_float = f->depth_bits > 0 ? f->depth_type == GL_FLOAT
                                            : f->red_type == GL_FLOAT && f->red_bits >= LEAST_SIGNED_FLOAT_BITS;
    return is_float ? NULL : "can't hold view distance: want red of GL_R32F or GL_R16F";
}

static const char *normal_fault(const glssao__format *f, glssao_normal kind)
{
    const bool has_sign =
        f->red_type == GL_SIGNED_NORMALIZED || (f->red_type == GL_FLOAT && f->red_bits >= LEAST_SIGNED_FLOAT_BITS);
    if (f->depth_bits > 0 || f->red_bits == 0)
        return "can't hold normals: want a colour format";
    if (kind != GLSSAO_NORMAL_OCTAHEDRAL && f->blue_bits == 0)
        return "has no third channel for a normal: want one, or GLSSAO_NORMAL_OCTAHEDRAL";
    if (kind == GLSSAO_NORMAL_SIGNED && !has_sign)
        return "can't hold numbers below 0: want GLSSAO_NORMAL_UNSIGNED, or a signed or float format";
    if (kind == GLSSAO_NORMAL_OCTAHEDRAL && !has_sign)
        return "can't hold numbers below 0, as GLSSAO_NORMAL_OCTAHEDRAL has them: want a signed or float format";
    return NULL;
}

const char *glssao__format_fault(const glssao__format *f, enum glssao__role role, glssao_normal normals)
{
    if (is_integer(f->red_type) || is_integer(f->alpha_type))
        return "is an integer format: want depth, normalized or float";
    switch (role) {
    case ROLE_WINDOW_DEPTH:
        return f->depth_bits > 0 || f->red_bits >= LEAST_DEPTH_BITS
                   ? NULL
                   : "can't hold depth: want a depth format, or red of 16 bits or more";
    case ROLE_DISTANCE:
        return distance_fault(f);
    case ROLE_MOTION:
        return f->depth_bits == 0 && f->red_type == GL_FLOAT && f->red_bits >= LEAST_SIGNED_FLOAT_BITS &&
                       f->green_bits > 0
                   ? NULL
                   : "can't hold motion: want GL_RG16F or GL_RG32F";
    case ROLE_NORMAL:
        return normal_fault(f, normals);
    case ROLE_NORMAL_AND_DISTANCE:
        if (f->alpha_type != GL_FLOAT || f->alpha_bits < LEAST_SIGNED_FLOAT_BITS)
            return "can't hold view distance in alpha: want GL_RGBA32F or GL_RGBA16F";
        return normal_fault(f, normals);
    case ROLE_COLOR:
    case ROLE_RAYS:
        break;
    }
    return NULL;
}
