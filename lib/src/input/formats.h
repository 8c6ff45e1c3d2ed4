/* SPDX-License-Identifier: MIT
 *
 * Whether a texture's format can hold what it is said to hold.
 */
#ifndef GLSSAO_INPUT_FORMATS_H
#define GLSSAO_INPUT_FORMATS_H

#include "glssao/glssao.h"
#include "gpu/functions.h"

/* What a texture is read as. */
enum glssao__role {
    ROLE_COLOR, /* any format but integers */
    ROLE_RAYS,  /* the same */
    ROLE_WINDOW_DEPTH,
    ROLE_DISTANCE,
    ROLE_MOTION,
    ROLE_NORMAL,
    ROLE_NORMAL_AND_DISTANCE /* in alpha */
};

/* What OpenGL says of level 0; the bits of a channel that the format lacks are 0. */
typedef struct glssao__format {
    gl_enum internal;
    gl_int depth_bits, red_bits, green_bits, blue_bits, alpha_bits;
    gl_enum depth_type, red_type, alpha_type; /* GL_FLOAT and so on */
} glssao__format;

/* NULL, or what is wrong with the format, as the end of a sentence that begins with its name. */
const char *glssao__format_fault(const glssao__format *format, enum glssao__role role, glssao_normal normals);

/* "GL_RGBA8"; NULL for formats that no program is likely to use here. */
const char *glssao__format_name(gl_enum internal);

/* What an incomplete framebuffer lacks, "GL_FRAMEBUFFER_UNSUPPORTED"; "" for a status that is unknown. */
const char *glssao__format_status_name(gl_enum status);

/* "GL_TEXTURE_2D"; "texture" for a target that is unknown. */
const char *glssao__format_target_name(gl_enum target);

#endif
