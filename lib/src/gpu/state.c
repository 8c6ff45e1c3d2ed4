/* SPDX-License-Identifier: MIT
 *
 * Saving, setting and restoring the host's GL state: loops over the pieces that a call needs.
 */
#include "gpu/state.h"

#include "gpu/state_pieces.h"

#include <string.h>

static const glssao__state_piece *const tables[] = {glssao__state_bindings, glssao__state_switches};
enum { TABLES = sizeof tables / sizeof *tables };

static bool is_needed(const glssao__state_need *need, const glssao__state_piece *piece)
{
    return piece->part == 0 ? need->units != 0 : (need->parts & piece->part) != 0;
}

glssao_result glssao__state_check(const glssao__gl *gl, const glssao__log *log, const char *function)
{
    gl_int mode = GL_RENDER, program = 0, is_deleted = 0;
    if (gl->compatibility)
        gl->GetIntegerv(GL_RENDER_MODE, &mode);
    if (mode != GL_RENDER)
        return glssao__log_refuse(log, "%s: GL_RENDER_MODE is GL_FEEDBACK or GL_SELECT, which draws nothing", function);
    if (gl->feedback_query) {
        gl_int active = 0, paused = 0;
        gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
        if (active)
            gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
        if (active && !paused)
            return glssao__log_refuse(log, "%s: transform feedback is active; pause or end it first", function);
    }
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &program);
    if (program)
        gl->GetProgramiv((gl_uint)program, GL_DELETE_STATUS, &is_deleted);
    if (is_deleted)
        return glssao__log_refuse(log, "%s: the current program %d was deleted and would be lost; unbind it first",
                                  function, program);
    return GLSSAO_OK;
}

void glssao__state_save(const glssao__gl *gl, const glssao__state_need *need, bool host_restores, glssao__state *out)
{
    memset(out, 0, sizeof *out);
    out->need = *need;
    out->is_saved = !host_restores;
    for (int i = 0; i < TABLES && out->is_saved; ++i)
        for (const glssao__state_piece *piece = tables[i]; piece->save; ++piece)
            if (is_needed(need, piece))
                piece->save(gl, out);
    for (int i = 0; i < TABLES; ++i)
        for (const glssao__state_piece *piece = tables[i]; piece->save; ++piece)
            if (piece->set && is_needed(need, piece))
                piece->set(gl, out);
}

void glssao__state_restore(const glssao__gl *gl, const glssao__state *state)
{
    for (int i = 0; i < TABLES && state->is_saved; ++i)
        for (const glssao__state_piece *piece = tables[i]; piece->save; ++piece)
            if (is_needed(&state->need, piece))
                piece->restore(gl, state);
}
