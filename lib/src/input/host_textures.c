/* SPDX-License-Identifier: MIT
 *
 * Looks at the host's textures.
 */
#include "input/host_textures.h"

#include <math.h>
#include <string.h>

void glssao__host_names(const glssao_frame *frame, gl_uint out_names[HOST_TEXTURES])
{
    out_names[HOST_DEPTH] = frame->depth_kind != GLSSAO_DEPTH_NORMAL_ALPHA ? frame->depth_texture : 0;
    out_names[HOST_NORMAL] = frame->normal_texture;
    out_names[HOST_BACK] = frame->back_texture;
    out_names[HOST_SECOND] = frame->second_texture;
    out_names[HOST_MOTION] = frame->motion_texture;
    out_names[HOST_RAYS] = frame->rays_texture;
}

/* Parameters that change what a shader reads without a sampler object having a say. */
static const struct parameter {
    gl_enum name;
    int count;
    gl_int wanted[4];
    enum { EVERYWHERE, STENCIL_TEXTURING, COMPATIBILITY_PROFILE } where;
} parameters[HOST_PARAMETERS] = {
    {GL_TEXTURE_BASE_LEVEL, 1, {0}, EVERYWHERE},
    {GL_TEXTURE_SWIZZLE_RGBA, 4, {GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA}, EVERYWHERE},
    {GL_DEPTH_STENCIL_TEXTURE_MODE, 1, {GL_DEPTH_COMPONENT}, STENCIL_TEXTURING},
    {GL_DEPTH_TEXTURE_MODE, 1, {GL_LUMINANCE}, COMPATIBILITY_PROFILE},
};

static bool has_parameter(const glssao__gl *gl, const struct parameter *p)
{
    return p->where == EVERYWHERE || (p->where == STENCIL_TEXTURING && gl->stencil_texturing) ||
           (p->where == COMPATIBILITY_PROFILE && gl->compatibility);
}

static bool is_wanted(const struct parameter *p, const gl_int value[4])
{
    return memcmp(value, p->wanted, (size_t)p->count * sizeof *value) == 0;
}

static void read_parameters(const glssao__gl *gl, glssao__host_texture *t)
{
    for (int i = 0; i < HOST_PARAMETERS; ++i) {
        memcpy(t->parameters[i], parameters[i].wanted, sizeof t->parameters[i]);
        if (has_parameter(gl, &parameters[i]))
            gl->GetTexParameteriv(t->target, parameters[i].name, t->parameters[i]);
        t->has_changes = t->has_changes || !is_wanted(&parameters[i], t->parameters[i]);
    }
}

/* To what the passes want, or back; the texture is bound. */
static void put_parameters(const glssao__gl *gl, const glssao__host_texture *t, bool back)
{
    for (int i = 0; i < HOST_PARAMETERS; ++i)
        if (!is_wanted(&parameters[i], t->parameters[i]))
            gl->TexParameteriv(t->target, parameters[i].name, back ? t->parameters[i] : parameters[i].wanted);
}

static gl_int level_parameter(const glssao__gl *gl, gl_enum target, gl_enum name)
{
    gl_int value = 0;
    gl->GetTexLevelParameteriv(target, 0, name, &value);
    return value;
}

static glssao__format format_of(const glssao__gl *gl, gl_enum target, bool reads_alpha)
{
    glssao__format f = {.internal = (gl_enum)level_parameter(gl, target, GL_TEXTURE_INTERNAL_FORMAT),
                        .red_bits = level_parameter(gl, target, GL_TEXTURE_RED_SIZE),
                        .red_type = (gl_enum)level_parameter(gl, target, GL_TEXTURE_RED_TYPE),
                        .green_bits = level_parameter(gl, target, GL_TEXTURE_GREEN_SIZE),
                        .blue_bits = level_parameter(gl, target, GL_TEXTURE_BLUE_SIZE),
                        .depth_bits = level_parameter(gl, target, GL_TEXTURE_DEPTH_SIZE),
                        .depth_type = (gl_enum)level_parameter(gl, target, GL_TEXTURE_DEPTH_TYPE)};
    if (reads_alpha) {
        f.alpha_bits = level_parameter(gl, target, GL_TEXTURE_ALPHA_SIZE);
        f.alpha_type = (gl_enum)level_parameter(gl, target, GL_TEXTURE_ALPHA_TYPE);
    }
    return f;
}

/* The distance between two stored values that stand for depth. */
static glssao__precision precision_of(const glssao__format *f, bool reads_alpha)
{
    const int bits = reads_alpha ? f->alpha_bits : f->depth_bits > 0 ? f->depth_bits : f->red_bits;
    const gl_enum type = reads_alpha ? f->alpha_type : f->depth_bits > 0 ? f->depth_type : f->red_type;
    const bool is_float = type == GL_FLOAT;
    /* Fractions of half and single precision have 10 and 23 bits; single precision is what the shaders compute in. */
    const int fraction = !is_float ? bits : bits <= 16 ? 10 : 23;
    return (glssao__precision){.step = ldexp(1.0, -(fraction < 24 ? fraction : 24)), .relative = is_float};
}

bool glssao__host_texture_bind(const glssao__gl *gl, gl_enum target, gl_uint texture)
{
    gl_int value = 0;
    if (gl->GetTextureParameteriv) {
        gl->GetTextureParameteriv(texture, GL_TEXTURE_TARGET, &value);
        if (value == 0) /* a buffer texture has no parameters */
            (void)glssao__gl_take_error(gl, GL_INVALID_OPERATION);
        if ((gl_enum)value == target)
            gl->BindTexture(target, texture);
        return (gl_enum)value == target;
    }
    gl->BindTexture(target, 0);
    gl->BindTexture(target, texture);
    gl->GetIntegerv(target == GL_TEXTURE_2D ? GL_TEXTURE_BINDING_2D : GL_TEXTURE_BINDING_2D_MULTISAMPLE, &value);
    if ((gl_uint)value == texture)
        return true;
    (void)glssao__gl_take_error(gl, GL_INVALID_OPERATION);
    return false;
}

/* The target that a texture was made for; 0 where OpenGL does not tell. Bindings stay as they are. */
static gl_enum target_of(const glssao__gl *gl, gl_uint texture)
{
    static const struct {
        gl_enum target, binding;
    } targets[] = {{GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
                   {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
                   {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
                   {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
                   {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP}};
    gl_int target = 0;
    if (gl->GetTextureParameteriv) {
        gl->GetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
        if (target == 0) /* a buffer texture has no parameters */
            (void)glssao__gl_take_error(gl, GL_INVALID_OPERATION);
        return (gl_enum)target;
    }
    for (size_t i = 0; i < sizeof targets / sizeof *targets; ++i) {
        gl_int before = 0, bound = 0;
        gl->GetIntegerv(targets[i].binding, &before);
        const bool was_bound = (gl_uint)before == texture;
        gl->BindTexture(targets[i].target, texture);
        gl->GetIntegerv(targets[i].binding, &bound);
        if (was_bound || (gl_uint)bound == texture) {
            gl->BindTexture(targets[i].target, (gl_uint)before);
            return targets[i].target;
        }
        (void)glssao__gl_take_error(gl, GL_INVALID_OPERATION);
    }
    return 0;
}

/* Says what the texture is instead of what it should be, and what helps. */
static void tell_target(const glssao__gl *gl, const glssao__log *log, const char *field, const glssao__host_texture *t)
{
    const gl_enum found = target_of(gl, t->name);
    const char *cure = "copy it to one";
    if (found == GL_TEXTURE_2D)
        cure = "frame.multisample must be false";
    else if (found == GL_TEXTURE_2D_MULTISAMPLE)
        cure = t->role == ROLE_COLOR || t->role == ROLE_RAYS ? "resolve it" : "set frame.multisample";
    else if (found == GL_TEXTURE_2D_ARRAY || found == GL_TEXTURE_CUBE_MAP)
        cure = "hand over a glTextureView of one layer, or copy it";
    glssao__log_write(log, GLSSAO_LOG_ERROR, "%s = %u: a %s, not a %s: %s", field, t->name,
                      glssao__format_target_name(found), glssao__format_target_name(t->target), cure);
}

/* Fills what OpenGL knows of the texture; false where it is none of that kind. */
static bool look_at(const glssao__gl *gl, const glssao__log *log, const char *field, glssao__host_texture *t)
{
    if (!gl->IsTexture(t->name)) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "%s = %u: no texture of this context", field, t->name);
        return false;
    }
    if (!glssao__host_texture_bind(gl, t->target, t->name)) {
        tell_target(gl, log, field, t);
        return false;
    }
    read_parameters(gl, t);
    /* Level 0 is meant, whatever the base level is. */
    t->width = level_parameter(gl, t->target, GL_TEXTURE_WIDTH);
    t->height = level_parameter(gl, t->target, GL_TEXTURE_HEIGHT);
    if (t->width == 0) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "%s = %u: its level 0 has no storage", field, t->name);
        return false;
    }
    t->format = format_of(gl, t->target, t->role == ROLE_NORMAL_AND_DISTANCE);
    t->precision = precision_of(&t->format, t->role == ROLE_NORMAL_AND_DISTANCE);
    return true;
}

/* The host's rays are a picture of the effect's own, whatever its other textures are a part of. */
static bool has_size_of_rays(const glssao__log *log, const char *field, const int size[2],
                             const glssao__host_texture *t)
{
    const int half[2] = {(size[0] + 1) / 2, (size[1] + 1) / 2};
    if ((t->width == size[0] && t->height == size[1]) || (t->width == half[0] && t->height == half[1]))
        return true;
    glssao__log_write(log, GLSSAO_LOG_ERROR,
                      "%s = %u: %d x %d, neither of the full size, %d x %d, nor of half, %d x %d", field, t->name,
                      t->width, t->height, size[0], size[1], half[0], half[1]);
    return false;
}

static bool is_fitting(const glssao__log *log, const char *field, const glssao__host_texture *t, glssao_normal normals)
{
    const char *const fault = glssao__format_fault(&t->format, t->role, normals);
    const char *const name = glssao__format_name(t->format.internal);
    if (!fault)
        return true;
    if (name)
        glssao__log_write(log, GLSSAO_LOG_ERROR, "%s = %u: %s %s", field, t->name, name, fault);
    else
        glssao__log_write(log, GLSSAO_LOG_ERROR, "%s = %u: format 0x%04X %s", field, t->name, t->format.internal,
                          fault);
    return false;
}

static bool is_large_enough(const glssao__log *log, const char *field, const glssao_frame *frame, const int size[2],
                            const glssao__host_texture *t)
{
    const char *const kind = glssao__format_target_name(t->target);
    const int *v = frame->viewport;
    if (v[2] != 0 || v[3] != 0) {
        /* The differences can't overflow: the viewport's size is the effect's. */
        if (t->width - v[2] >= v[0] && t->height - v[3] >= v[1])
            return true;
        glssao__log_write(log, GLSSAO_LOG_ERROR,
                          "%s = %u: a %s of %d x %d does not hold frame.viewport, %d x %d at %d, %d", field, t->name,
                          kind, t->width, t->height, v[2], v[3], v[0], v[1]);
        return false;
    }
    if (t->width == size[0] && t->height == size[1])
        return true;
    glssao__log_write(
        log, GLSSAO_LOG_ERROR,
        "%s = %u: a %s of %d x %d, not of the full size, %d x %d: call glssao_resize, or set frame.viewport", field,
        t->name, kind, t->width, t->height, size[0], size[1]);
    return false;
}

static const glssao__host_texture *find_seen(const glssao__host_textures *known, const glssao__host_texture *wanted)
{
    for (int i = 0; known && i < HOST_SEEN; ++i) {
        const glssao__host_texture *t = &known->seen[i];
        if (t->name == wanted->name && t->target == wanted->target && t->role == wanted->role)
            return t;
    }
    return NULL;
}

void glssao__host_textures_forget(glssao__host_textures *known, gl_uint name)
{
    for (int i = 0; i < HOST_SEEN; ++i)
        if (known->seen[i].name == name)
            known->seen[i] = (glssao__host_texture){0};
}

/* Checks one texture; with `known`, OpenGL is asked only the first time. */
static bool check_texture(const glssao__gl *gl, const glssao__log *log, const char *field, const glssao_frame *frame,
                          const int size[2], glssao__host_textures *known, glssao__host_texture *t)
{
    const glssao__host_texture *seen = find_seen(known, t);
    if (seen)
        *t = *seen;
    else if (!look_at(gl, log, field, t))
        return false;
    if (!is_fitting(log, field, t, frame->normal_kind))
        return false;
    if (known && t->has_changes) {
        glssao__log_write(log, GLSSAO_LOG_ERROR,
                          "%s = %u: base level, swizzle or stencil texture mode is not the default, which "
                          "config.host_restores_state asks for",
                          field, t->name);
        return false;
    }
    if (t->role == ROLE_RAYS ? !has_size_of_rays(log, field, size, t) : !is_large_enough(log, field, frame, size, t))
        return false;
    if (known && !seen) {
        known->seen[known->next] = *t;
        known->next = (known->next + 1) % HOST_SEEN;
    }
    return true;
}

bool glssao__host_texture_check(const glssao__gl *gl, const glssao__log *log, const char *field, const int viewport[4],
                                const int size[2], glssao__host_textures *known, glssao__host_texture *t)
{
    glssao_frame frame = {0};
    memcpy(frame.viewport, viewport, sizeof frame.viewport);
    if (!check_texture(gl, log, field, &frame, size, known, t))
        return false;
    if (t->has_changes) {
        gl->BindTexture(t->target, t->name);
        put_parameters(gl, t, false);
    }
    return true;
}

void glssao__host_texture_restore(const glssao__gl *gl, const glssao__host_texture *t)
{
    if (!t->has_changes)
        return;
    gl->BindTexture(t->target, t->name);
    put_parameters(gl, t, true);
}

glssao_result glssao__host_textures_check(const glssao__gl *gl, const glssao__log *log, const glssao_frame *frame,
                                          const int size[2], int unit, const gl_uint names[HOST_TEXTURES],
                                          glssao__host_textures *known, glssao__host_inputs *out)
{
    static const char *const fields[HOST_TEXTURES] = {"frame.depth_texture",  "frame.normal_texture",
                                                      "frame.back_texture",   "frame.second_texture",
                                                      "frame.motion_texture", "frame.rays_texture"};
    const bool in_alpha = frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA;
    const bool in_red = in_alpha || frame->depth_kind == GLSSAO_DEPTH_VIEW_DISTANCE;
    memset(out, 0, sizeof *out);
    gl->ActiveTexture(GL_TEXTURE0 + (gl_enum)unit);
    for (int i = 0; i < HOST_TEXTURES; ++i) {
        glssao__host_texture *t = &out->textures[i];
        if (!names[i])
            continue;
        t->name = names[i];
        t->target = frame->multisample && i != HOST_RAYS ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
        t->role = i == HOST_RAYS     ? ROLE_RAYS
                  : i == HOST_MOTION ? ROLE_MOTION
                  : i != HOST_NORMAL ? (in_red ? ROLE_DISTANCE : ROLE_WINDOW_DEPTH)
                  : in_alpha         ? ROLE_NORMAL_AND_DISTANCE
                                     : ROLE_NORMAL;
        if (!check_texture(gl, log, fields[i], frame, size, known, t))
            return GLSSAO_INVALID_ARGUMENT;
    }
    out->precision = out->textures[in_alpha ? HOST_NORMAL : HOST_DEPTH].precision;
    for (int i = 0; i < HOST_TEXTURES; ++i)
        if (out->textures[i].has_changes) {
            gl->BindTexture(out->textures[i].target, out->textures[i].name);
            put_parameters(gl, &out->textures[i], false);
        }
    return GLSSAO_OK;
}

void glssao__host_textures_restore(const glssao__gl *gl, const glssao__host_inputs *inputs, int unit)
{
    for (int i = 0; i < HOST_TEXTURES; ++i)
        if (inputs->textures[i].has_changes) {
            gl->ActiveTexture(GL_TEXTURE0 + (gl_enum)unit);
            gl->BindTexture(inputs->textures[i].target, inputs->textures[i].name);
            put_parameters(gl, &inputs->textures[i], true);
        }
}
