/* SPDX-License-Identifier: MIT
 *
 * Multiplies the result into what a framebuffer holds.
 */
#include "effect.h"

/* Whether the bound framebuffer has the texture for a colour, drawn into or not: OpenGL calls it a feedback loop to
 * read it then (OpenGL 3.3, section 4.4.3). */
static bool is_attached(const glssao__gl *gl, gl_uint framebuffer, gl_uint texture)
{
    for (int i = 0; framebuffer != 0 && i < gl->max_color_attachments; ++i) {
        const gl_enum attachment = GL_COLOR_ATTACHMENT0 + (gl_enum)i;
        gl_int type = 0, name = 0;
        gl->GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE,
                                                &type);
        if (type != GL_TEXTURE)
            continue;
        gl->GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME,
                                                &name);
        if ((gl_uint)name == texture)
            return true;
    }
    return false;
}

static glssao_result apply(glssao_effect *effect, gl_uint framebuffer)
{
    const glssao__gl *gl = &effect->gl;
    glssao__program_object program;
    glssao_result result = glssao__program_get(effect, SHADER_APPLY, 0, &program);
    if (result != GLSSAO_OK)
        return result;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl_enum status = gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "framebuffer = %u: not complete: 0x%04X", framebuffer,
                          status);
        return GLSSAO_FRAMEBUFFER_ERROR;
    }
    int width, height;
    const gl_uint map = glssao__maps_result(effect, &width, &height);
    if (is_attached(gl, framebuffer, map)) {
        glssao__log_write(
            &effect->log, GLSSAO_LOG_ERROR,
            "framebuffer = %u: has the accessibility map itself attached, which would be read and written",
            framebuffer);
        return GLSSAO_INVALID_ARGUMENT;
    }
    glssao__stats_begin_pass(effect, GLSSAO_PASS_APPLY);
    glssao__state_set_blend(gl, GL_ZERO, GL_SRC_COLOR);
    glssao__draw_use(effect, &program);
    glssao__draw_bind(effect, UNIT_AMBIENT, map, SAMPLER_LINEAR_CLAMP);
    glssao__draw(effect, framebuffer, effect->width - 2 * effect->margin, effect->height - 2 * effect->margin);
    glssao__stats_end_pass(effect, GLSSAO_PASS_APPLY, 1);
    return GLSSAO_OK;
}

glssao_result glssao_apply(glssao_effect *effect, uint32_t framebuffer)
{
    if (!effect || glssao__draw_is_between_normals(effect, "glssao_apply"))
        return GLSSAO_INVALID_ARGUMENT;
    if (effect->frame == 0) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "glssao_apply called before glssao_compute");
        return GLSSAO_INVALID_ARGUMENT;
    }
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    glssao_result result = apply(effect, framebuffer);
    glssao__state_restore(&effect->gl, &host);
    glssao__draw_check(effect, "glssao_apply");
    return result;
}
