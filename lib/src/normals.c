/* SPDX-License-Identifier: MIT
 *
 * The effect's normal map beside the host's depth, as a framebuffer for the host to draw into.
 */
#include "effect.h"

static void attach_depth(const glssao_effect *effect, gl_uint depth_texture)
{
    const glssao__gl *gl = &effect->gl;
    gl_int stencil_bits = 0;
    if (depth_texture) {
        gl->ActiveTexture(GL_TEXTURE0 + UNIT_DEPTH);
        gl->BindTexture(GL_TEXTURE_2D, depth_texture);
        gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_STENCIL_SIZE, &stencil_bits);
    }
    gl_enum attachment = stencil_bits > 0 ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, attachment, GL_TEXTURE_2D, depth_texture, 0);
}

static glssao_result begin_normals(glssao_effect *effect, gl_uint depth_texture)
{
    const glssao__gl *gl = &effect->gl;
    glssao_result result = glssao__maps_check_texture(effect, depth_texture, true, "depth_texture");
    if (result != GLSSAO_OK)
        return result;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, effect->normal_map.framebuffer);
    attach_depth(effect, depth_texture);
    gl_enum status = gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        attach_depth(effect, 0);
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "depth_texture = %u: refused beside the normal map: 0x%04X",
                          depth_texture, status);
        return GLSSAO_FRAMEBUFFER_ERROR;
    }
    gl_float clear_depth = 1.0f;
    gl->GetFloatv(GL_DEPTH_CLEAR_VALUE, &clear_depth);
    gl->ClearBufferfv(GL_COLOR, 0, (const gl_float[4]){0.0f, 0.0f, 1.0f, 0.0f});
    gl->ClearBufferfv(GL_DEPTH, 0, &clear_depth);
    return GLSSAO_OK;
}

glssao_result glssao_begin_normals(glssao_effect *effect, uint32_t depth_texture)
{
    if (!effect || glssao__draw_is_between_normals(effect, "glssao_begin_normals"))
        return GLSSAO_INVALID_ARGUMENT;
    const glssao__gl *gl = &effect->gl;
    glssao__host_state host;
    glssao__state_save(gl, &host);
    glssao_result result = begin_normals(effect, depth_texture);
    glssao__state_restore(gl, &host);
    glssao__draw_check(effect, "glssao_begin_normals");
    if (result != GLSSAO_OK)
        return result;
    effect->depth_texture = depth_texture;
    effect->between_normals = true;
    effect->host_framebuffer = host.draw_framebuffer;
    for (int i = 0; i < 4; ++i)
        effect->host_viewport[i] = host.viewport[i];
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, effect->normal_map.framebuffer);
    glssao__state_set_viewport(gl, (const gl_float[4]){0.0f, 0.0f, (gl_float)effect->width, (gl_float)effect->height});
    return GLSSAO_OK;
}

glssao_result glssao_end_normals(glssao_effect *effect)
{
    if (!effect)
        return GLSSAO_INVALID_ARGUMENT;
    if (!effect->between_normals) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "glssao_end_normals called without glssao_begin_normals");
        return GLSSAO_INVALID_ARGUMENT;
    }
    const glssao__gl *gl = &effect->gl;
    /* Detached, the depth texture can be read by the passes, and deleted by the host. */
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, effect->normal_map.framebuffer);
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (gl_uint)effect->host_framebuffer);
    glssao__state_set_viewport(gl, effect->host_viewport);
    effect->between_normals = false;
    glssao__draw_check(effect, "glssao_end_normals");
    return GLSSAO_OK;
}
