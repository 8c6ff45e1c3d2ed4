/* SPDX-License-Identifier: MIT
 *
 * Saves the host's GL state, sets what the passes need, and puts the state back. The table at the end drives all
 * three: a row a piece of state, in the order it is set and restored.
 */
#include "effect.h"

/* Toggles that must be off while the passes draw: each could drop or change their fragments. */
static const struct toggle {
    gl_enum cap;
    enum { ALWAYS, COMPATIBILITY, DEPTH_BOUNDS } where;
} toggles[] = {
    {GL_CULL_FACE, ALWAYS},
    {GL_DEPTH_TEST, ALWAYS},
    {GL_STENCIL_TEST, ALWAYS},
    {GL_COLOR_LOGIC_OP, ALWAYS},
    {GL_RASTERIZER_DISCARD, ALWAYS},
    {GL_SAMPLE_MASK, ALWAYS},
    {GL_SAMPLE_COVERAGE, ALWAYS},
    {GL_POLYGON_SMOOTH, ALWAYS},
    {GL_PRIMITIVE_RESTART, ALWAYS},  /* early specifications let the index cut DrawArrays too */
    {GL_PROGRAM_POINT_SIZE, ALWAYS}, /* on only while tiles are drawn */
    {GL_POINT_SMOOTH, COMPATIBILITY},
    {GL_ALPHA_TEST, COMPATIBILITY},
    {GL_POLYGON_STIPPLE, COMPATIBILITY},
    {GL_DEPTH_BOUNDS_TEST_EXT, DEPTH_BOUNDS},
};
enum { TOGGLE_COUNT = sizeof toggles / sizeof *toggles };

/* Clip planes that our vertex shader does not write would clip at random; they follow the toggles. */
static int clip_count(const glssao__gl *gl)
{
    int room = TOGGLE_CAPACITY - TOGGLE_COUNT;
    return gl->max_clip_distances < room ? gl->max_clip_distances : room;
}

static gl_enum toggle_at(const glssao__gl *gl, int i) /* 0: not in this context */
{
    if (i >= TOGGLE_COUNT)
        return GL_CLIP_DISTANCE0 + (gl_enum)(i - TOGGLE_COUNT);
    if (toggles[i].where == COMPATIBILITY && !gl->compatibility)
        return 0;
    if (toggles[i].where == DEPTH_BOUNDS && !gl->depth_bounds_test)
        return 0;
    return toggles[i].cap;
}

static void set_enabled(const glssao__gl *gl, gl_enum cap, gl_boolean on)
{
    if (on)
        gl->Enable(cap);
    else
        gl->Disable(cap);
}

static void save_toggles(const glssao__gl *gl, glssao__host_state *s)
{
    for (int i = 0; i < TOGGLE_COUNT + clip_count(gl); ++i)
        if (toggle_at(gl, i))
            s->toggles[i] = gl->IsEnabled(toggle_at(gl, i));
}

static void set_toggles(const glssao__gl *gl)
{
    for (int i = 0; i < TOGGLE_COUNT + clip_count(gl); ++i)
        if (toggle_at(gl, i))
            gl->Disable(toggle_at(gl, i));
}

static void restore_toggles(const glssao__gl *gl, const glssao__host_state *s)
{
    for (int i = 0; i < TOGGLE_COUNT + clip_count(gl); ++i)
        if (toggle_at(gl, i))
            set_enabled(gl, toggle_at(gl, i), s->toggles[i]);
}

/* With viewport arrays, setting without an index would overwrite all sixteen. */
static void save_scissor(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetIntegerv(GL_SCISSOR_BOX, s->scissor_box);
    s->scissor = gl->ViewportIndexedf ? gl->IsEnabledi(GL_SCISSOR_TEST, 0) : gl->IsEnabled(GL_SCISSOR_TEST);
}

static void put_scissor(const glssao__gl *gl, gl_boolean on)
{
    if (!gl->ViewportIndexedf)
        set_enabled(gl, GL_SCISSOR_TEST, on);
    else if (on)
        gl->Enablei(GL_SCISSOR_TEST, 0);
    else
        gl->Disablei(GL_SCISSOR_TEST, 0);
}

static void set_scissor(const glssao__gl *gl)
{
    put_scissor(gl, 0);
}

static void put_scissor_box(const glssao__gl *gl, const gl_int box[4])
{
    if (gl->ScissorIndexed)
        gl->ScissorIndexed(0, box[0], box[1], box[2], box[3]);
    else
        gl->Scissor(box[0], box[1], box[2], box[3]);
}

void glssao__state_set_scissor(const glssao__gl *gl, const gl_int box[4])
{
    put_scissor(gl, box != NULL);
    if (box)
        put_scissor_box(gl, box);
}

static void restore_scissor(const glssao__gl *gl, const glssao__host_state *s)
{
    put_scissor_box(gl, s->scissor_box);
    put_scissor(gl, s->scissor);
}

void glssao__state_set_viewport(const glssao__gl *gl, const gl_float viewport[4])
{
    if (gl->ViewportIndexedf)
        gl->ViewportIndexedf(0, viewport[0], viewport[1], viewport[2], viewport[3]);
    else
        gl->Viewport((gl_int)viewport[0], (gl_int)viewport[1], (gl_sizei)viewport[2], (gl_sizei)viewport[3]);
}

static void save_viewport(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetFloatv(GL_VIEWPORT, s->viewport);
}

static void restore_viewport(const glssao__gl *gl, const glssao__host_state *s)
{
    glssao__state_set_viewport(gl, s->viewport);
}

static void save_program(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &s->program);
}

static void restore_program(const glssao__gl *gl, const glssao__host_state *s)
{
    gl->UseProgram((gl_uint)s->program);
}

static void save_vertex_array(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->vertex_array);
}

static void restore_vertex_array(const glssao__gl *gl, const glssao__host_state *s)
{
    gl->BindVertexArray((gl_uint)s->vertex_array);
}

static void save_framebuffers(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->draw_framebuffer);
    gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &s->read_framebuffer);
}

static void restore_framebuffers(const glssao__gl *gl, const glssao__host_state *s)
{
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (gl_uint)s->draw_framebuffer);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (gl_uint)s->read_framebuffer);
}

static void save_textures(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetIntegerv(GL_ACTIVE_TEXTURE, &s->active_texture);
    for (gl_uint unit = 0; unit < UNIT_COUNT; ++unit) {
        gl->ActiveTexture(GL_TEXTURE0 + unit);
        gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &s->textures[unit]);
        gl->GetIntegerv(GL_SAMPLER_BINDING, &s->samplers[unit]);
    }
}

static void restore_textures(const glssao__gl *gl, const glssao__host_state *s)
{
    for (gl_uint unit = 0; unit < UNIT_COUNT; ++unit) {
        gl->ActiveTexture(GL_TEXTURE0 + unit);
        gl->BindTexture(GL_TEXTURE_2D, (gl_uint)s->textures[unit]);
        gl->BindSampler(unit, (gl_uint)s->samplers[unit]);
    }
    gl->ActiveTexture((gl_enum)s->active_texture);
}

static const gl_enum image_names[6] = {GL_IMAGE_BINDING_NAME,  GL_IMAGE_BINDING_LEVEL,  GL_IMAGE_BINDING_LAYERED,
                                       GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT};

static void save_image(const glssao__gl *gl, glssao__host_state *s)
{
    for (int i = 0; i < 6 && gl->compute; ++i)
        gl->GetIntegeri_v(image_names[i], 0, &s->image[i]);
}

static void restore_image(const glssao__gl *gl, const glssao__host_state *s)
{
    const gl_int *image = s->image;
    if (gl->compute)
        gl->BindImageTexture(0, (gl_uint)image[0], image[1], image[2] != 0, image[3], (gl_enum)image[4],
                             (gl_enum)image[5]);
}

static void save_uniform_buffers(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &s->uniform_buffer);
    for (gl_uint i = 0; i < BLOCK_COUNT; ++i) {
        gl->GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &s->uniform_binding[i].buffer);
        gl->GetInteger64i_v(GL_UNIFORM_BUFFER_START, i, &s->uniform_binding[i].offset);
        gl->GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, i, &s->uniform_binding[i].size);
    }
}

static void restore_uniform_buffers(const glssao__gl *gl, const glssao__host_state *s)
{
    for (gl_uint i = 0; i < BLOCK_COUNT; ++i) {
        gl_uint buffer = (gl_uint)s->uniform_binding[i].buffer;
        if (buffer && s->uniform_binding[i].size > 0)
            gl->BindBufferRange(GL_UNIFORM_BUFFER, i, buffer, (gl_intptr)s->uniform_binding[i].offset,
                                (gl_sizeiptr)s->uniform_binding[i].size);
        else /* size 0: the whole buffer was bound */
            gl->BindBufferBase(GL_UNIFORM_BUFFER, i, buffer);
    }
    gl->BindBuffer(GL_UNIFORM_BUFFER, (gl_uint)s->uniform_buffer); /* the calls above changed the generic binding */
}

/* How pixels pass to and from memory. */
static const struct transfer_parameter {
    gl_enum name;
    gl_int wanted;
} transfer_parameters[TRANSFER_PARAMETERS] = {
    {GL_UNPACK_SWAP_BYTES, 0},  {GL_UNPACK_LSB_FIRST, 0}, {GL_UNPACK_ROW_LENGTH, 0}, {GL_UNPACK_SKIP_ROWS, 0},
    {GL_UNPACK_SKIP_PIXELS, 0}, {GL_UNPACK_ALIGNMENT, 4}, {GL_PACK_SWAP_BYTES, 0},   {GL_PACK_LSB_FIRST, 0},
    {GL_PACK_ROW_LENGTH, 0},    {GL_PACK_SKIP_ROWS, 0},   {GL_PACK_SKIP_PIXELS, 0},  {GL_PACK_ALIGNMENT, 4},
};

static void save_transfer(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &s->unpack_buffer);
    gl->GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &s->pack_buffer);
    for (int i = 0; i < TRANSFER_PARAMETERS; ++i)
        gl->GetIntegerv(transfer_parameters[i].name, &s->transfer[i]);
}

static void set_transfer(const glssao__gl *gl)
{
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0); /* else a NULL pointer means the buffer's start */
    for (int i = 0; i < TRANSFER_PARAMETERS; ++i)
        gl->PixelStorei(transfer_parameters[i].name, transfer_parameters[i].wanted);
}

static void restore_transfer(const glssao__gl *gl, const glssao__host_state *s)
{
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, (gl_uint)s->unpack_buffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, (gl_uint)s->pack_buffer);
    for (int i = 0; i < TRANSFER_PARAMETERS; ++i)
        gl->PixelStorei(transfer_parameters[i].name, s->transfer[i]);
}

static void save_polygon_mode(const glssao__gl *gl, glssao__host_state *s)
{
    s->polygon_mode[1] = 0;
    gl->GetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
    if (s->polygon_mode[1] == 0) /* drivers of the core profile may give one value */
        s->polygon_mode[1] = s->polygon_mode[0];
}

static void set_polygon_mode(const glssao__gl *gl)
{
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

static void restore_polygon_mode(const glssao__gl *gl, const glssao__host_state *s)
{
    if (s->polygon_mode[0] == s->polygon_mode[1]) {
        gl->PolygonMode(GL_FRONT_AND_BACK, (gl_enum)s->polygon_mode[0]);
        return;
    }
    gl->PolygonMode(GL_FRONT, (gl_enum)s->polygon_mode[0]); /* compatibility profile only */
    gl->PolygonMode(GL_BACK, (gl_enum)s->polygon_mode[1]);
}

static void save_clip_control(const glssao__gl *gl, glssao__host_state *s)
{
    if (!gl->ClipControl)
        return;
    gl->GetIntegerv(GL_CLIP_ORIGIN, &s->clip_origin);
    gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &s->clip_depth);
}

static void put_clip_control(const glssao__gl *gl, gl_enum origin, gl_enum depth)
{
    if (gl->ClipControl)
        gl->ClipControl(origin, depth);
}

static void set_clip_control(const glssao__gl *gl)
{
    enum { NEGATIVE_ONE_TO_ONE = 0x935E };
    put_clip_control(gl, GL_LOWER_LEFT, NEGATIVE_ONE_TO_ONE); /* an upper left origin would flip the passes */
}

static void restore_clip_control(const glssao__gl *gl, const glssao__host_state *s)
{
    put_clip_control(gl, (gl_enum)s->clip_origin, (gl_enum)s->clip_depth);
}

static int color_mask_count(const glssao__gl *gl)
{
    return gl->max_draw_buffers < MAX_DRAW_BUFFERS ? gl->max_draw_buffers : MAX_DRAW_BUFFERS;
}

static void save_masks(const glssao__gl *gl, glssao__host_state *s)
{
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &s->depth_mask);
    for (gl_uint i = 0; i < (gl_uint)color_mask_count(gl); ++i)
        gl->GetBooleani_v(GL_COLOR_WRITEMASK, i, s->color_mask[i]);
}

static void set_masks(const glssao__gl *gl)
{
    gl->DepthMask(1);
    /* glssao_apply may draw into several buffers, of which the shader writes one: the rest would be undefined. */
    for (gl_uint i = 0; i < (gl_uint)color_mask_count(gl); ++i)
        gl->ColorMaski(i, i == 0, i == 0, i == 0, i == 0);
}

static void restore_masks(const glssao__gl *gl, const glssao__host_state *s)
{
    gl->DepthMask(s->depth_mask);
    for (gl_uint i = 0; i < (gl_uint)color_mask_count(gl); ++i)
        gl->ColorMaski(i, s->color_mask[i][0], s->color_mask[i][1], s->color_mask[i][2], s->color_mask[i][3]);
}

static const gl_enum blend_names[4] = {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA};

static void save_blend(const glssao__gl *gl, glssao__host_state *s)
{
    s->blend = gl->IsEnabledi(GL_BLEND, 0);
    for (int i = 0; i < 4; ++i)
        if (gl->BlendFuncSeparatei)
            gl->GetIntegeri_v(blend_names[i], 0, &s->blend_function[i]);
        else
            gl->GetIntegerv(blend_names[i], &s->blend_function[i]);
    if (gl->BlendEquationSeparatei) {
        gl->GetIntegeri_v(GL_BLEND_EQUATION_RGB, 0, &s->blend_equation[0]);
        gl->GetIntegeri_v(GL_BLEND_EQUATION_ALPHA, 0, &s->blend_equation[1]);
    } else {
        gl->GetIntegerv(GL_BLEND_EQUATION_RGB, &s->blend_equation[0]);
        gl->GetIntegerv(GL_BLEND_EQUATION_ALPHA, &s->blend_equation[1]);
    }
}

static void put_blend(const glssao__gl *gl, const gl_enum function[4], const gl_enum equation[2])
{
    if (gl->BlendFuncSeparatei)
        gl->BlendFuncSeparatei(0, function[0], function[1], function[2], function[3]);
    else
        gl->BlendFuncSeparate(function[0], function[1], function[2], function[3]);
    if (gl->BlendEquationSeparatei)
        gl->BlendEquationSeparatei(0, equation[0], equation[1]);
    else
        gl->BlendEquationSeparate(equation[0], equation[1]);
}

static void set_blend(const glssao__gl *gl)
{
    gl->Disablei(GL_BLEND, 0);
}

void glssao__state_set_blend(const glssao__gl *gl, gl_enum source, gl_enum destination)
{
    put_blend(gl, (const gl_enum[4]){source, destination, GL_ZERO, GL_ONE},
              (const gl_enum[2]){GL_FUNC_ADD, GL_FUNC_ADD});
    gl->Enablei(GL_BLEND, 0);
}

static void restore_blend(const glssao__gl *gl, const glssao__host_state *s)
{
    if (s->blend)
        gl->Enablei(GL_BLEND, 0);
    else
        gl->Disablei(GL_BLEND, 0);
    gl_enum function[4];
    for (int i = 0; i < 4; ++i)
        function[i] = (gl_enum)s->blend_function[i];
    put_blend(gl, function, (const gl_enum[2]){(gl_enum)s->blend_equation[0], (gl_enum)s->blend_equation[1]});
}

/* set is NULL where each pass sets its own. */
static const struct state {
    void (*save)(const glssao__gl *gl, glssao__host_state *s);
    void (*set)(const glssao__gl *gl);
    void (*restore)(const glssao__gl *gl, const glssao__host_state *s);
} states[] = {
    {save_program, NULL, restore_program},
    {save_vertex_array, NULL, restore_vertex_array},
    {save_framebuffers, NULL, restore_framebuffers},
    {save_viewport, NULL, restore_viewport},
    {save_textures, NULL, restore_textures},
    {save_image, NULL, restore_image},
    {save_uniform_buffers, NULL, restore_uniform_buffers},
    {save_transfer, set_transfer, restore_transfer},
    {save_polygon_mode, set_polygon_mode, restore_polygon_mode},
    {save_clip_control, set_clip_control, restore_clip_control},
    {save_masks, set_masks, restore_masks},
    {save_blend, set_blend, restore_blend},
    {save_scissor, set_scissor, restore_scissor},
    {save_toggles, set_toggles, restore_toggles},
};

void glssao__state_save(const glssao__gl *gl, glssao__host_state *out_state)
{
    for (size_t i = 0; i < sizeof states / sizeof *states; ++i)
        states[i].save(gl, out_state);
    for (size_t i = 0; i < sizeof states / sizeof *states; ++i)
        if (states[i].set)
            states[i].set(gl);
}

void glssao__state_restore(const glssao__gl *gl, const glssao__host_state *state)
{
    for (size_t i = 0; i < sizeof states / sizeof *states; ++i)
        states[i].restore(gl, state);
}
