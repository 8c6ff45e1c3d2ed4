/* SPDX-License-Identifier: MIT
 *
 * Objects that are bound: program, framebuffers, textures, samplers, buffers and images, and how pixels reach them.
 */
#include "gpu/state_pieces.h"

static void save_targets(const glssao__gl *gl, glssao__state *s)
{
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &s->program);
    gl->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->vertex_array);
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->draw_framebuffer);
    gl->GetFloatv(GL_VIEWPORT, s->viewport);
}

static void restore_targets(const glssao__gl *gl, const glssao__state *s)
{
    gl->UseProgram((gl_uint)s->program);
    gl->BindVertexArray((gl_uint)s->vertex_array);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (gl_uint)s->draw_framebuffer);
    glssao__state_viewport(gl, s->viewport);
}

static void save_read(const glssao__gl *gl, glssao__state *s)
{
    gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &s->read_framebuffer);
}

static void restore_read(const glssao__gl *gl, const glssao__state *s)
{
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (gl_uint)s->read_framebuffer);
}

static bool has_unit(const glssao__state *s, gl_uint unit)
{
    return s->need.units & 1u << unit;
}

static void save_textures(const glssao__gl *gl, glssao__state *s)
{
    gl->GetIntegerv(GL_ACTIVE_TEXTURE, &s->active_texture);
    for (gl_uint unit = 0; unit < STATE_UNITS; ++unit)
        if (has_unit(s, unit)) {
            gl->ActiveTexture(GL_TEXTURE0 + unit);
            gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &s->textures[unit]);
            gl->GetIntegerv(GL_SAMPLER_BINDING, &s->samplers[unit]);
            if ((s->need.parts & STATE_MULTISAMPLE) && s->need.multisample_unit == (int)unit)
                gl->GetIntegerv(GL_TEXTURE_BINDING_2D_MULTISAMPLE, &s->multisample_texture);
        }
}

static void restore_textures(const glssao__gl *gl, const glssao__state *s)
{
    for (gl_uint unit = 0; unit < STATE_UNITS; ++unit)
        if (has_unit(s, unit)) {
            gl->ActiveTexture(GL_TEXTURE0 + unit);
            gl->BindTexture(GL_TEXTURE_2D, (gl_uint)s->textures[unit]);
            gl->BindSampler(unit, (gl_uint)s->samplers[unit]);
            if ((s->need.parts & STATE_MULTISAMPLE) && s->need.multisample_unit == (int)unit)
                gl->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, (gl_uint)s->multisample_texture);
        }
    gl->ActiveTexture((gl_enum)s->active_texture);
}

static const gl_enum image_names[6] = {GL_IMAGE_BINDING_NAME,  GL_IMAGE_BINDING_LEVEL,  GL_IMAGE_BINDING_LAYERED,
                                       GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT};

static gl_uint image_count(const glssao__state *s)
{
    return s->need.parts & STATE_SECOND ? 2 : 1;
}

static void save_images(const glssao__gl *gl, glssao__state *s)
{
    for (gl_uint unit = 0; unit < image_count(s); ++unit)
        for (int i = 0; i < 6; ++i)
            gl->GetIntegeri_v(image_names[i], unit, &s->images[unit][i]);
}

static void restore_images(const glssao__gl *gl, const glssao__state *s)
{
    for (gl_uint unit = 0; unit < image_count(s); ++unit) {
        const gl_int *image = s->images[unit];
        gl->BindImageTexture(unit, (gl_uint)image[0], image[1], image[2] != 0, image[3], (gl_enum)image[4],
                             (gl_enum)image[5]);
    }
}

static void save_uniforms(const glssao__gl *gl, glssao__state *s)
{
    gl->GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &s->uniform_buffer);
    for (gl_uint i = 0; i < (gl_uint)s->need.blocks; ++i) {
        gl->GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &s->uniform_bindings[i].buffer);
        gl->GetInteger64i_v(GL_UNIFORM_BUFFER_START, i, &s->uniform_bindings[i].offset);
        gl->GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, i, &s->uniform_bindings[i].size);
    }
}

static void restore_uniforms(const glssao__gl *gl, const glssao__state *s)
{
    for (gl_uint i = 0; i < (gl_uint)s->need.blocks; ++i) {
        const gl_uint buffer = (gl_uint)s->uniform_bindings[i].buffer;
        if (buffer && s->uniform_bindings[i].size > 0)
            gl->BindBufferRange(GL_UNIFORM_BUFFER, i, buffer, (gl_intptr)s->uniform_bindings[i].offset,
                                (gl_sizeiptr)s->uniform_bindings[i].size);
        else /* size 0: the whole buffer was bound */
            gl->BindBufferBase(GL_UNIFORM_BUFFER, i, buffer);
    }
    gl->BindBuffer(GL_UNIFORM_BUFFER, (gl_uint)s->uniform_buffer); /* the calls above changed the generic binding */
}

/* How pixels are stored in memory, and in compatibility contexts how they are scaled on their way. */
static const struct transfer {
    gl_enum name;
    float wanted;
    bool scales; /* set by glPixelTransfer */
} transfers[] = {
    {GL_UNPACK_SWAP_BYTES, 0, false}, {GL_UNPACK_LSB_FIRST, 0, false},   {GL_UNPACK_ROW_LENGTH, 0, false},
    {GL_UNPACK_SKIP_ROWS, 0, false},  {GL_UNPACK_SKIP_PIXELS, 0, false}, {GL_UNPACK_ALIGNMENT, 4, false},
    {GL_PACK_SWAP_BYTES, 0, false},   {GL_PACK_LSB_FIRST, 0, false},     {GL_PACK_ROW_LENGTH, 0, false},
    {GL_PACK_SKIP_ROWS, 0, false},    {GL_PACK_SKIP_PIXELS, 0, false},   {GL_PACK_ALIGNMENT, 4, false},
    {GL_MAP_COLOR, 0, true},          {GL_RED_SCALE, 1, true},           {GL_RED_BIAS, 0, true},
    {GL_GREEN_SCALE, 1, true},        {GL_GREEN_BIAS, 0, true},          {GL_BLUE_SCALE, 1, true},
    {GL_BLUE_BIAS, 0, true},          {GL_ALPHA_SCALE, 1, true},         {GL_ALPHA_BIAS, 0, true},
};
enum { TRANSFER_COUNT = sizeof transfers / sizeof *transfers };
_Static_assert(sizeof transfers / sizeof *transfers <= STATE_TRANSFERS,
               "glssao__state has no room for all transfer parameters");

static void put_transfer(const glssao__gl *gl, int i, float value)
{
    if (!transfers[i].scales)
        gl->PixelStorei(transfers[i].name, (gl_int)value);
    else if (gl->PixelTransferf)
        gl->PixelTransferf(transfers[i].name, value);
}

static void save_transfers(const glssao__gl *gl, glssao__state *s)
{
    gl->GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &s->unpack_buffer);
    gl->GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &s->pack_buffer);
    for (int i = 0; i < TRANSFER_COUNT; ++i) {
        s->transfers[i] = transfers[i].wanted;
        if (!transfers[i].scales || gl->PixelTransferf)
            gl->GetFloatv(transfers[i].name, &s->transfers[i]);
    }
}

static void set_transfers(const glssao__gl *gl, const glssao__state *s)
{
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0); /* otherwise a NULL pointer means the start of the buffer */
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (int i = 0; i < TRANSFER_COUNT; ++i)
        if (s->transfers[i] != transfers[i].wanted || !s->is_saved)
            put_transfer(gl, i, transfers[i].wanted);
}

static void restore_transfers(const glssao__gl *gl, const glssao__state *s)
{
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, (gl_uint)s->unpack_buffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, (gl_uint)s->pack_buffer);
    for (int i = 0; i < TRANSFER_COUNT; ++i)
        if (s->transfers[i] != transfers[i].wanted)
            put_transfer(gl, i, s->transfers[i]);
}

const glssao__state_piece glssao__state_bindings[] = {
    {STATE_DRAW, save_targets, NULL, restore_targets},
    {STATE_READ, save_read, NULL, restore_read},
    {0, save_textures, NULL, restore_textures},
    {STATE_IMAGE, save_images, NULL, restore_images},
    {STATE_UNIFORMS, save_uniforms, NULL, restore_uniforms},
    {STATE_TRANSFER, save_transfers, set_transfers, restore_transfers},
    {0, NULL, NULL, NULL},
};
