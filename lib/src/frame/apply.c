/* SPDX-License-Identifier: MIT
 *
 * Multiplies accessibility into the host's picture, by a draw that is blended or by a dispatch.
 */
#include "frame/apply.h"

#include <math.h>

/* The maps of the host are read through units that no other input of this shader has. */
enum { UNIT_STRENGTH = UNIT_DEPTH, UNIT_ALBEDO = UNIT_NORMAL };

static bool is_black(const float color[3])
{
    return color[0] == 0.0f && color[1] == 0.0f && color[2] == 0.0f;
}

glssao__variant glssao__apply_variant(const glssao__apply_job *job)
{
    glssao__variant variant = {{0}};
    variant.values[MACRO_COMPUTE] = job->image.texture != 0;
    variant.values[MACRO_IMAGE] = (uint8_t)(job->image.texture ? job->image.kind : 0);
    variant.values[MACRO_STRENGTH] = job->strength_texture    ? STRENGTH_TEXTURE
                                     : job->intensity != 1.0f ? STRENGTH_UNIFORM
                                                              : STRENGTH_FULL;
    variant.values[MACRO_ALBEDO] = job->albedo_texture != 0;
    variant.values[MACRO_TINTED] = !job->image.texture && !job->show && !is_black(job->color);
    return variant;
}

glssao__state_need glssao__apply_need(const glssao__apply_job *job, bool may_dispatch)
{
    glssao__state_need need = {STATE_DRAW | STATE_BLEND | STATE_ALL_MASKS, .units = 1u << UNIT_AMBIENT};
    if (!is_black(job->color))
        need.parts |= STATE_BLEND_COLOR;
    if (may_dispatch)
        need.parts |= STATE_IMAGE;
    if (job->strength_texture)
        need.units |= 1u << UNIT_STRENGTH;
    if (job->albedo_texture)
        need.units |= 1u << UNIT_ALBEDO;
    return need;
}

/* What a picture of that kind can hold; the blender clamps too. */
static float brightest(int kind)
{
    const bool is_normalized = kind == IMAGE_RGBA8 || kind == IMAGE_RGBA16 || kind == IMAGE_RGB10_A2;
    return is_normalized ? 1.0f : HUGE_VALF;
}

static void bind(const glssao__resources *r, int unit, gl_uint texture, enum glssao__sampler sampler)
{
    if (texture == 0)
        return;
    r->gl->ActiveTexture(GL_TEXTURE0 + (gl_enum)unit);
    r->gl->BindTexture(GL_TEXTURE_2D, texture);
    r->gl->BindSampler((gl_uint)unit, r->samplers[sampler]);
}

/* The picture times what stays, plus the colour times what goes. */
static void draw(const glssao__resources *r, const glssao__apply_job *job)
{
    const glssao__gl *gl = r->gl;
    const int *d = job->destination;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, job->framebuffer);
    gl->BindVertexArray(r->vertex_array);
    if (job->show) {
        glssao__state_blend(gl, GL_ONE, GL_ZERO);
    } else if (is_black(job->color)) {
        glssao__state_blend(gl, GL_ZERO, GL_SRC_COLOR);
    } else {
        gl->BlendColor(job->color[0], job->color[1], job->color[2], 1.0f);
        glssao__state_blend(gl, GL_CONSTANT_COLOR, GL_ONE_MINUS_SRC_COLOR);
    }
    glssao__state_viewport(gl, (const gl_float[4]){(gl_float)d[0], (gl_float)d[1], (gl_float)d[2], (gl_float)d[3]});
    gl->DrawArrays(GL_TRIANGLES, 0, 6);
}

static void dispatch(const glssao__resources *r, const glssao__apply_job *job, const glssao__variant *variant)
{
    const glssao__gl *gl = r->gl;
    const gl_bitfield images = GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
    int group[2];
    glssao__shader_group(SHADER_APPLY, variant, group);
    gl->MemoryBarrier(images); /* the host may have stored the picture by a shader, too */
    gl->BindImageTexture(0, job->image.texture, 0, 0, 0, GL_READ_WRITE, job->image.format);
    gl->DispatchCompute((gl_uint)((job->destination[2] + group[0] - 1) / group[0]),
                        (gl_uint)((job->destination[3] + group[1] - 1) / group[1]), 1);
    gl->MemoryBarrier(images | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

void glssao__apply_run(glssao__resources *r, const glssao__apply_job *job)
{
    const glssao__gl *gl = r->gl;
    const glssao__variant variant = glssao__apply_variant(job);
    const glssao__program *program = glssao__resources_program(r, SHADER_APPLY, &variant);
    const int *d = job->destination, *p = job->picture;
    const float most = brightest(job->image.kind);
    glssao__timers_begin(&r->timers, gl, GLSSAO_PASS_APPLY);
    gl->UseProgram(program->name);
    bind(r, UNIT_AMBIENT, r->targets[job->map].texture, SAMPLER_LINEAR_CLAMP);
    bind(r, UNIT_STRENGTH, job->strength_texture, SAMPLER_POINT_CLAMP);
    bind(r, UNIT_ALBEDO, job->albedo_texture, SAMPLER_POINT_CLAMP);
    gl->Uniform4f(program->locations[UNIFORM_SHADE], fminf(job->color[0], most), fminf(job->color[1], most),
                  fminf(job->color[2], most), job->intensity);
    gl->Uniform4f(program->locations[UNIFORM_PICTURE], (gl_float)p[0], (gl_float)p[1], (gl_float)p[2], (gl_float)p[3]);
    gl->Uniform4i(program->locations[UNIFORM_REGION], d[0], d[1], d[2], d[3]);
    if (job->image.texture)
        dispatch(r, job, &variant);
    else
        draw(r, job);
    glssao__timers_end(&r->timers, gl, GLSSAO_PASS_APPLY);
}
