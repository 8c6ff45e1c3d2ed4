/* SPDX-License-Identifier: MIT
 *
 * glssao_compute_framebuffer: copies a depth buffer, follows its size, and computes.
 */
#include "effect.h"

#include "input/check.h"

#include <string.h>

/* What the copy will hold can't be told by the host. */
static glssao_result check_kind(const glssao_effect *effect, const glssao_frame *frame)
{
    const glssao__log *log = &effect->log;
    if (frame->depth_texture != 0)
        return glssao__log_refuse(log, "frame.depth_texture = %u: want 0, since depth is copied from the framebuffer",
                                  frame->depth_texture);
    if (frame->depth_kind != GLSSAO_DEPTH_WINDOW && frame->depth_kind != GLSSAO_DEPTH_LOGARITHMIC)
        return glssao__log_refuse(log, "frame.depth_kind = %d: a depth buffer holds window or logarithmic depth",
                                  (int)frame->depth_kind);
    if (frame->multisample)
        return glssao__log_refuse(log, "frame.multisample = true: want false, since the copy has one sample a pixel");
    return GLSSAO_OK;
}

/* The part of the framebuffer that holds the picture. */
static glssao_result find_part(const glssao_effect *effect, const glssao_frame *frame, int out[4])
{
    const glssao__gl *gl = &effect->gl;
    const int *v = frame->viewport;
    const bool is_given = v[0] || v[1] || v[2] || v[3];
    if (!is_given && effect->host_restores_state)
        return glssao__log_refuse(&effect->log,
                                  "frame.viewport is empty: config.host_restores_state asks for it, since "
                                  "glViewport is not looked at");
    memcpy(out, v, 4 * sizeof *out);
    if (!is_given)
        gl->GetIntegerv(GL_VIEWPORT, out);
    if (out[0] >= 0 && out[1] >= 0 && out[2] >= 1 && out[3] >= 1 && out[2] <= gl->max_size && out[3] <= gl->max_size &&
        out[0] <= gl->max_size - out[2] && out[1] <= gl->max_size - out[3])
        return GLSSAO_OK;
    return glssao__log_refuse(&effect->log, "%s = %d, %d, %d, %d: want x, y, width and height within 0 to %d",
                              is_given ? "frame.viewport" : "glViewport", out[0], out[1], out[2], out[3], gl->max_size);
}

static glssao_result copy_depth(glssao_effect *effect, gl_uint framebuffer, const int part[4])
{
    const glssao__gl *gl = &effect->gl;
    const glssao__state_need need = glssao__depth_copy_need();
    const bool host_restores = effect->host_restores_state;
    glssao__timers *timers = &effect->resources.timers;
    glssao__state state;
    if (!host_restores && framebuffer != 0 && !gl->IsFramebuffer(framebuffer))
        return glssao__log_refuse(&effect->log, "framebuffer = %u: no framebuffer of this context", framebuffer);
    glssao__state_save(gl, &need, host_restores, &state);
    glssao__timers_frame(timers, effect->last.number + 1);
    const glssao_result result =
        glssao__depth_copy_take(&effect->depth_copy, gl, timers, &effect->log, framebuffer, part, host_restores);
    glssao__state_restore(gl, &state);
    if (effect->depth_copy.is_new)
        glssao__host_textures_forget(&effect->known, effect->depth_copy.texture);
    glssao__resources_check(&effect->resources, "glssao_compute_framebuffer");
    return result;
}

glssao_result glssao_compute_framebuffer(glssao_effect *effect, uint32_t framebuffer, const glssao_frame *frame,
                                         const glssao_settings *settings)
{
    static const char name[] = "glssao_compute_framebuffer";
    if (!effect || !glssao__effect_is_closed(effect, name))
        return GLSSAO_INVALID_ARGUMENT;
    if (!frame || !settings)
        return glssao__log_refuse(&effect->log, "%s is NULL", frame ? "settings" : "frame");
    int part[4];
    glssao__projection projection;
    glssao_result result = check_kind(effect, frame);
    if (result == GLSSAO_OK)
        result = find_part(effect, frame, part);
    if (result != GLSSAO_OK)
        return result;
    glssao_frame copied = *frame;
    memset(copied.viewport, 0, sizeof copied.viewport);
    copied.depth_texture = ~0u; /* has a name once there is a copy */
    if (!glssao__check_frame(&copied, settings, part + 2, &effect->log, &projection))
        return GLSSAO_INVALID_ARGUMENT;
    result = glssao__effect_check_state(effect, name);
    if (result == GLSSAO_OK)
        result = copy_depth(effect, framebuffer, part);
    if (result == GLSSAO_OK)
        result = glssao_resize(effect, part[2], part[3]);
    copied.depth_texture = effect->depth_copy.texture;
    if (result == GLSSAO_OK)
        result = glssao_compute(effect, &copied, settings);
    if (result == GLSSAO_OK)
        memcpy(effect->last.viewport, part, sizeof part);
    else
        glssao__timers_drop(&effect->resources.timers, effect->last.number + 1);
    return result;
}
