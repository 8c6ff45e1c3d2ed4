/* SPDX-License-Identifier: MIT
 *
 * The host's textures: whether they are what the frame says they are, how exactly they hold depth, and the pass that
 * copies those which the other passes can't read as they are (multisample, larger than the picture, logarithmic) to
 * maps of the effect's own.
 */
#include "effect.h"

#include <math.h>

enum { INPUT_DEPTH, INPUT_NORMAL, INPUT_BACK, INPUT_SECOND };

/* The host's textures of a frame, 0 where one is not read. */
static void list_textures(const glssao_frame *frame, gl_uint out_textures[INPUT_COUNT])
{
    out_textures[INPUT_DEPTH] = frame->depth_kind != GLSSAO_DEPTH_NORMAL_ALPHA ? frame->depth_texture : 0;
    out_textures[INPUT_NORMAL] = frame->normal_texture;
    out_textures[INPUT_BACK] = frame->back_texture;
    out_textures[INPUT_SECOND] = frame->second_texture;
}

static bool has_viewport(const glssao_frame *frame)
{
    return frame->viewport[2] != 0 || frame->viewport[3] != 0;
}

/* Which of the textures are copied. Normals alone don't depend on how depth is stored. */
static void list_copies(const glssao_frame *frame, gl_uint out_textures[INPUT_COUNT])
{
    const bool all = frame->multisample || has_viewport(frame);
    list_textures(frame, out_textures);
    for (int i = 0; i < INPUT_COUNT; ++i)
        if (!all && (frame->depth_kind != GLSSAO_DEPTH_LOGARITHMIC || i == INPUT_NORMAL))
            out_textures[i] = 0;
}

int glssao__inputs_count(const glssao_frame *frame)
{
    gl_uint copies[INPUT_COUNT];
    int count = 0;
    list_copies(frame, copies);
    for (int i = 0; i < INPUT_COUNT; ++i)
        count += copies[i] != 0;
    return count;
}

static gl_enum target_of(const glssao_frame *frame)
{
    return frame->multisample ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
}

/* The multisample texture of the active unit, for put_back. Hosts without one pay no query. */
static gl_int save_multisample(const glssao__gl *gl, const glssao_frame *frame)
{
    gl_int bound = 0;
    if (frame->multisample)
        gl->GetIntegerv(GL_TEXTURE_BINDING_2D_MULTISAMPLE, &bound);
    return bound;
}

static void put_back_multisample(const glssao__gl *gl, const glssao_frame *frame, gl_int bound)
{
    if (frame->multisample)
        gl->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, (gl_uint)bound);
}

static gl_int level_parameter(const glssao__gl *gl, gl_enum target, gl_enum name)
{
    gl_int value = 0;
    gl->GetTexLevelParameteriv(target, 0, name, &value);
    return value;
}

/* Binds the texture and looks at its size. */
static bool check_size(const glssao_effect *effect, const glssao_frame *frame, gl_uint texture, const char *field)
{
    const glssao__gl *gl = &effect->gl;
    const gl_enum target = target_of(frame);
    const char *const kind = frame->multisample ? "GL_TEXTURE_2D_MULTISAMPLE" : "GL_TEXTURE_2D";
    if (!gl->IsTexture(texture)) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s = %u: no texture of this context", field, texture);
        return false;
    }
    gl->BindTexture(target, 0);
    gl->BindTexture(target, texture); /* of another kind, it does not bind, and 0 has no size */
    const int width = level_parameter(gl, target, GL_TEXTURE_WIDTH);
    const int height = level_parameter(gl, target, GL_TEXTURE_HEIGHT);
    if (has_viewport(frame)) {
        /* The sums can't overflow: the viewport's size is the effect's. */
        if (width - frame->viewport[2] >= frame->viewport[0] && height - frame->viewport[3] >= frame->viewport[1])
            return true;
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s = %u: a %s of %d x %d does not hold frame.viewport",
                          field, texture, kind, width, height);
        return false;
    }
    if (width == effect->width && height == effect->height)
        return true;
    glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s = %u: not a %s of the full size, %d x %d", field, texture,
                      kind, effect->width, effect->height);
    return false;
}

/* How far apart two stored values of the bound texture may lie that stand for depth. */
static glssao__precision precision_of(const glssao__gl *gl, const glssao_frame *frame)
{
    const gl_enum target = target_of(frame);
    const bool in_alpha = frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA;
    int bits = in_alpha ? 0 : level_parameter(gl, target, GL_TEXTURE_DEPTH_SIZE);
    gl_int type = level_parameter(gl, target, GL_TEXTURE_DEPTH_TYPE);
    if (bits == 0) {
        bits = level_parameter(gl, target, in_alpha ? GL_TEXTURE_ALPHA_SIZE : GL_TEXTURE_RED_SIZE);
        type = level_parameter(gl, target, in_alpha ? GL_TEXTURE_ALPHA_TYPE : GL_TEXTURE_RED_TYPE);
    }
    const bool is_float = type == GL_FLOAT;
    /* Fractions of half and single precision have 10 and 23 bits; single precision is what the shaders compute in. */
    const int fraction = !is_float ? bits : bits <= 16 ? 10 : 23;
    return (glssao__precision){.step = ldexp(1.0, -(fraction < 24 ? fraction : 24)), .relative = is_float};
}

glssao_result glssao__inputs_check(glssao_effect *effect, const glssao_frame *frame, glssao__precision *out_precision)
{
    static const char *const fields[INPUT_COUNT] = {"frame.depth_texture", "frame.normal_texture", "frame.back_texture",
                                                    "frame.second_texture"};
    const glssao__gl *gl = &effect->gl;
    gl_uint textures[INPUT_COUNT];
    list_textures(frame, textures);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_DEPTH);
    const gl_int bound = save_multisample(gl, frame);
    const int with_depth = frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA ? INPUT_NORMAL : INPUT_DEPTH;
    bool ok = true;
    for (int i = 0; i < INPUT_COUNT && ok; ++i) {
        if (!textures[i])
            continue;
        ok = check_size(effect, frame, textures[i], fields[i]);
        if (ok && i == with_depth)
            *out_precision = precision_of(gl, frame);
    }
    put_back_multisample(gl, frame, bound);
    return ok ? GLSSAO_OK : GLSSAO_INVALID_ARGUMENT;
}

glssao_result glssao__inputs_fit(glssao_effect *effect, const glssao_frame *frame)
{
    gl_uint copies[INPUT_COUNT];
    list_copies(frame, copies);
    glssao_result result = GLSSAO_OK;
    for (int i = 0; i < INPUT_COUNT && result == GLSSAO_OK; ++i)
        if (copies[i])
            result = glssao__maps_fit_input(effect, i == INPUT_NORMAL, &effect->inputs[i]);
    return result;
}

glssao_frame glssao__inputs_frame(const glssao_effect *effect, const glssao_frame *frame)
{
    glssao_frame read = *frame;
    gl_uint copies[INPUT_COUNT];
    list_copies(frame, copies);
    uint32_t *const fields[INPUT_COUNT] = {&read.depth_texture, &read.normal_texture, &read.back_texture,
                                           &read.second_texture};
    for (int i = 0; i < INPUT_COUNT; ++i)
        if (copies[i])
            *fields[i] = effect->inputs[i].texture;
    if (read.depth_kind == GLSSAO_DEPTH_LOGARITHMIC)
        read.depth_kind = GLSSAO_DEPTH_VIEW_DISTANCE;
    return read;
}

glssao_result glssao__inputs_programs(glssao_effect *effect, const glssao_frame *frame,
                                      glssao__program_object out_programs[INPUT_COUNT])
{
    gl_uint copies[INPUT_COUNT];
    list_copies(frame, copies);
    glssao_result result = GLSSAO_OK;
    for (int i = 0; i < INPUT_COUNT && result == GLSSAO_OK; ++i) {
        const bool logarithmic = frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC && i != INPUT_NORMAL;
        if (copies[i])
            result = glssao__program_get(effect, SHADER_INPUT,
                                         (frame->multisample ? VARIANT_MULTISAMPLE : 0u) |
                                             (logarithmic ? VARIANT_LOGARITHMIC : 0u),
                                         &out_programs[i]);
    }
    return result;
}

void glssao__inputs_copy(glssao_effect *effect, const glssao_frame *frame,
                         const glssao__program_object programs[INPUT_COUNT])
{
    const glssao__gl *gl = &effect->gl;
    gl_uint copies[INPUT_COUNT];
    list_copies(frame, copies);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_DEPTH);
    const gl_int bound = save_multisample(gl, frame);
    for (int i = 0; i < INPUT_COUNT; ++i) {
        if (!copies[i])
            continue;
        gl->UseProgram(programs[i].name);
        gl->Uniform2f(programs[i].origin_location, (gl_float)frame->viewport[0], (gl_float)frame->viewport[1]);
        gl->BindTexture(target_of(frame), copies[i]);
        gl->BindSampler(UNIT_DEPTH, effect->samplers[SAMPLER_POINT_CLAMP]); /* the host's own may compare depths */
        glssao__draw(effect, effect->inputs[i].framebuffer, effect->width, effect->height);
    }
    put_back_multisample(gl, frame, bound);
}
