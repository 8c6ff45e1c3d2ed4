/* SPDX-License-Identifier: MIT
 *
 * Switches and numbers that every draw depends on. One that already has the wanted value is not set.
 */
#include "gpu/state_pieces.h"

#include <string.h>

/* Toggles that must be off while the passes draw, since each could drop or change their fragments. */
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
    {GL_PRIMITIVE_RESTART, ALWAYS},  /* early specifications let the index cut glDrawArrays too */
    {GL_PROGRAM_POINT_SIZE, ALWAYS}, /* on only while tiles are drawn */
    {GL_POINT_SMOOTH, COMPATIBILITY},
    {GL_ALPHA_TEST, COMPATIBILITY},
    {GL_POLYGON_STIPPLE, COMPATIBILITY},
    {GL_DEPTH_BOUNDS_TEST_EXT, DEPTH_BOUNDS},
};
enum { TOGGLE_COUNT = sizeof toggles / sizeof *toggles };
_Static_assert(sizeof toggles / sizeof *toggles <= STATE_TOGGLES, "glssao__state has no room for all toggles");

static bool has_toggle(const glssao__gl *gl, int i)
{
    return toggles[i].where == ALWAYS || (toggles[i].where == COMPATIBILITY && gl->compatibility) ||
           (toggles[i].where == DEPTH_BOUNDS && gl->depth_bounds_test);
}

/* Left as the host has it. */
static bool is_kept(const glssao__state *s, int i)
{
    return s->need.keep_stencil && toggles[i].cap == GL_STENCIL_TEST;
}

bool glssao__state_was_on(const glssao__state *state, gl_enum toggle)
{
    for (int i = 0; i < TOGGLE_COUNT; ++i)
        if (toggles[i].cap == toggle)
            return state->toggles[i];
    return false;
}

static void set_enabled(const glssao__gl *gl, gl_enum cap, bool on)
{
    if (on)
        gl->Enable(cap);
    else
        gl->Disable(cap);
}

static void save_toggles(const glssao__gl *gl, glssao__state *s)
{
    for (int i = 0; i < TOGGLE_COUNT; ++i)
        s->toggles[i] = has_toggle(gl, i) && gl->IsEnabled(toggles[i].cap);
}

static void set_toggles(const glssao__gl *gl, const glssao__state *s)
{
    for (int i = 0; i < TOGGLE_COUNT; ++i)
        if (has_toggle(gl, i) && !is_kept(s, i) && (s->toggles[i] || !s->is_saved))
            gl->Disable(toggles[i].cap);
}

static void restore_toggles(const glssao__gl *gl, const glssao__state *s)
{
    for (int i = 0; i < TOGGLE_COUNT; ++i)
        if (s->toggles[i])
            gl->Enable(toggles[i].cap);
}

/* With viewport arrays, setting without an index would overwrite all sixteen. */
static void put_scissor(const glssao__gl *gl, bool on)
{
    if (!gl->ViewportIndexedf)
        set_enabled(gl, GL_SCISSOR_TEST, on);
    else if (on)
        gl->Enablei(GL_SCISSOR_TEST, 0);
    else
        gl->Disablei(GL_SCISSOR_TEST, 0);
}

static void put_scissor_box(const glssao__gl *gl, const gl_int box[4])
{
    if (gl->ScissorIndexed)
        gl->ScissorIndexed(0, box[0], box[1], box[2], box[3]);
    else
        gl->Scissor(box[0], box[1], box[2], box[3]);
}

static void save_scissor(const glssao__gl *gl, glssao__state *s)
{
    gl->GetIntegerv(GL_SCISSOR_BOX, s->scissor_box);
    s->scissor = gl->ViewportIndexedf ? gl->IsEnabledi(GL_SCISSOR_TEST, 0) : gl->IsEnabled(GL_SCISSOR_TEST);
}

static void set_scissor(const glssao__gl *gl, const glssao__state *s)
{
    if (!s->need.keep_scissor && (s->scissor || !s->is_saved))
        put_scissor(gl, false);
}

void glssao__state_scissor(const glssao__gl *gl, const gl_int box[4])
{
    put_scissor(gl, box != NULL);
    if (box)
        put_scissor_box(gl, box);
}

static void restore_scissor(const glssao__gl *gl, const glssao__state *s)
{
    put_scissor_box(gl, s->scissor_box);
    if (s->scissor)
        put_scissor(gl, true);
}

void glssao__state_viewport(const glssao__gl *gl, const gl_float viewport[4])
{
    if (gl->ViewportIndexedf)
        gl->ViewportIndexedf(0, viewport[0], viewport[1], viewport[2], viewport[3]);
    else
        gl->Viewport((gl_int)viewport[0], (gl_int)viewport[1], (gl_sizei)viewport[2], (gl_sizei)viewport[3]);
}

static void save_polygon_mode(const glssao__gl *gl, glssao__state *s)
{
    s->polygon_mode[1] = 0;
    gl->GetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
    if (s->polygon_mode[1] == 0) /* drivers of the core profile may give one value */
        s->polygon_mode[1] = s->polygon_mode[0];
}

static bool is_filled(const glssao__state *s)
{
    return s->is_saved && s->polygon_mode[0] == GL_FILL && s->polygon_mode[1] == GL_FILL;
}

static void set_polygon_mode(const glssao__gl *gl, const glssao__state *s)
{
    if (!is_filled(s))
        gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

static void restore_polygon_mode(const glssao__gl *gl, const glssao__state *s)
{
    if (is_filled(s))
        return;
    if (s->polygon_mode[0] == s->polygon_mode[1]) {
        gl->PolygonMode(GL_FRONT_AND_BACK, (gl_enum)s->polygon_mode[0]);
        return;
    }
    gl->PolygonMode(GL_FRONT, (gl_enum)s->polygon_mode[0]); /* compatibility profile only */
    gl->PolygonMode(GL_BACK, (gl_enum)s->polygon_mode[1]);
}

/* The defaults of OpenGL. An upper left origin would flip the passes. */
enum { NEGATIVE_ONE_TO_ONE = 0x935E };

static bool has_default_clipping(const glssao__state *s)
{
    return s->is_saved && s->clip_origin == GL_LOWER_LEFT && s->clip_depth == NEGATIVE_ONE_TO_ONE;
}

static void save_clip_control(const glssao__gl *gl, glssao__state *s)
{
    s->clip_origin = GL_LOWER_LEFT;
    s->clip_depth = NEGATIVE_ONE_TO_ONE;
    if (!gl->ClipControl)
        return;
    gl->GetIntegerv(GL_CLIP_ORIGIN, &s->clip_origin);
    gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &s->clip_depth);
}

static void set_clip_control(const glssao__gl *gl, const glssao__state *s)
{
    if (gl->ClipControl && !has_default_clipping(s))
        gl->ClipControl(GL_LOWER_LEFT, NEGATIVE_ONE_TO_ONE);
}

static void restore_clip_control(const glssao__gl *gl, const glssao__state *s)
{
    if (gl->ClipControl && !has_default_clipping(s))
        gl->ClipControl((gl_enum)s->clip_origin, (gl_enum)s->clip_depth);
}

/* Compatibility contexts may clamp what fragment shaders write to 0..1, and view distances with it. */
static void save_clamp(const glssao__gl *gl, glssao__state *s)
{
    if (gl->ClampColor)
        gl->GetIntegerv(GL_CLAMP_FRAGMENT_COLOR, &s->clamp_fragment_color);
}

static void set_clamp(const glssao__gl *gl, const glssao__state *s)
{
    (void)s;
    if (gl->ClampColor)
        gl->ClampColor(GL_CLAMP_FRAGMENT_COLOR, 0);
}

static void restore_clamp(const glssao__gl *gl, const glssao__state *s)
{
    if (gl->ClampColor)
        gl->ClampColor(GL_CLAMP_FRAGMENT_COLOR, (gl_enum)s->clamp_fragment_color);
}

static void save_depth_mask(const glssao__gl *gl, glssao__state *s)
{
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &s->depth_mask);
}

static void set_depth_mask(const glssao__gl *gl, const glssao__state *s)
{
    (void)s;
    gl->DepthMask(1);
}

static void restore_depth_mask(const glssao__gl *gl, const glssao__state *s)
{
    gl->DepthMask(s->depth_mask);
}

/* Colour attachments of our own framebuffers. */
static gl_uint own_count(const glssao__state *s)
{
    return s->need.parts & STATE_SECOND ? 2 : 1;
}

/* A framebuffer of the host may have several attachments, of which the shader writes the first: the others are masked,
 * since they would be undefined. */
static gl_uint mask_count(const glssao__gl *gl, const glssao__state *s)
{
    if (!(s->need.parts & STATE_ALL_MASKS))
        return own_count(s);
    return gl->max_draw_buffers < STATE_DRAW_BUFFERS ? (gl_uint)gl->max_draw_buffers : STATE_DRAW_BUFFERS;
}

static bool has_mask(const glssao__state *s, gl_uint i, gl_boolean on)
{
    const gl_boolean wanted[4] = {on, on, on, on};
    return s->is_saved && memcmp(s->color_masks[i], wanted, sizeof wanted) == 0;
}

static void save_color_masks(const glssao__gl *gl, glssao__state *s)
{
    for (gl_uint i = 0; i < mask_count(gl, s); ++i)
        gl->GetBooleani_v(GL_COLOR_WRITEMASK, i, s->color_masks[i]);
}

static void set_color_masks(const glssao__gl *gl, const glssao__state *s)
{
    for (gl_uint i = 0; i < mask_count(gl, s); ++i)
        if (!has_mask(s, i, i < own_count(s))) {
            const gl_boolean on = i < own_count(s);
            gl->ColorMaski(i, on, on, on, on);
        }
}

static void restore_color_masks(const glssao__gl *gl, const glssao__state *s)
{
    for (gl_uint i = 0; i < mask_count(gl, s); ++i)
        if (!has_mask(s, i, i < own_count(s)))
            gl->ColorMaski(i, s->color_masks[i][0], s->color_masks[i][1], s->color_masks[i][2], s->color_masks[i][3]);
}

static void put_blend_switch(const glssao__gl *gl, gl_uint i, bool on)
{
    if (on)
        gl->Enablei(GL_BLEND, i);
    else
        gl->Disablei(GL_BLEND, i);
}

static void save_blend_switches(const glssao__gl *gl, glssao__state *s)
{
    for (gl_uint i = 0; i < own_count(s); ++i)
        s->blend[i] = gl->IsEnabledi(GL_BLEND, i);
}

static void set_blend_switches(const glssao__gl *gl, const glssao__state *s)
{
    for (gl_uint i = 0; i < own_count(s); ++i)
        if (s->blend[i] || !s->is_saved)
            put_blend_switch(gl, i, false);
}

static void restore_blend_switches(const glssao__gl *gl, const glssao__state *s)
{
    for (gl_uint i = 0; i < own_count(s); ++i)
        if (s->blend[i] || (i == 0 && (s->need.parts & STATE_BLEND)))
            put_blend_switch(gl, i, s->blend[i]);
}

static const gl_enum blend_names[4] = {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA};

static void save_blend(const glssao__gl *gl, glssao__state *s)
{
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

static void put_blend(const glssao__gl *gl, const gl_int function[4], const gl_int equation[2])
{
    const gl_enum f[4] = {(gl_enum)function[0], (gl_enum)function[1], (gl_enum)function[2], (gl_enum)function[3]};
    if (gl->BlendFuncSeparatei)
        gl->BlendFuncSeparatei(0, f[0], f[1], f[2], f[3]);
    else
        gl->BlendFuncSeparate(f[0], f[1], f[2], f[3]);
    if (gl->BlendEquationSeparatei)
        gl->BlendEquationSeparatei(0, (gl_enum)equation[0], (gl_enum)equation[1]);
    else
        gl->BlendEquationSeparate((gl_enum)equation[0], (gl_enum)equation[1]);
}

void glssao__state_blend(const glssao__gl *gl, gl_enum source, gl_enum destination)
{
    put_blend(gl, (const gl_int[4]){(gl_int)source, (gl_int)destination, GL_ZERO, GL_ONE},
              (const gl_int[2]){GL_FUNC_ADD, GL_FUNC_ADD});
    put_blend_switch(gl, 0, true);
}

void glssao__state_add(const glssao__gl *gl)
{
    put_blend(gl, (const gl_int[4]){GL_ONE, GL_ONE, GL_ONE, GL_ONE}, (const gl_int[2]){GL_FUNC_ADD, GL_FUNC_ADD});
    put_blend_switch(gl, 0, true);
}

static void restore_blend(const glssao__gl *gl, const glssao__state *s)
{
    put_blend(gl, s->blend_function, s->blend_equation);
}

static void save_blend_color(const glssao__gl *gl, glssao__state *s)
{
    gl->GetFloatv(GL_BLEND_COLOR, s->blend_color);
}

static void restore_blend_color(const glssao__gl *gl, const glssao__state *s)
{
    gl->BlendColor(s->blend_color[0], s->blend_color[1], s->blend_color[2], s->blend_color[3]);
}

const glssao__state_piece glssao__state_switches[] = {
    {STATE_DRAW, save_polygon_mode, set_polygon_mode, restore_polygon_mode},
    {STATE_DRAW, save_clip_control, set_clip_control, restore_clip_control},
    {STATE_DRAW, save_clamp, set_clamp, restore_clamp},
    {STATE_DRAW, save_color_masks, set_color_masks, restore_color_masks},
    {STATE_DRAW, save_blend_switches, set_blend_switches, restore_blend_switches},
    {STATE_DRAW, save_scissor, set_scissor, restore_scissor},
    {STATE_DRAW, save_toggles, set_toggles, restore_toggles},
    {STATE_DEPTH_MASK, save_depth_mask, set_depth_mask, restore_depth_mask},
    {STATE_BLEND, save_blend, NULL, restore_blend},
    {STATE_BLEND_COLOR, save_blend_color, NULL, restore_blend_color},
    {0, NULL, NULL, NULL},
};
