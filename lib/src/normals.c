/* SPDX-License-Identifier: MIT
 *
 * Binding the normal map for the host.
 */
#include "normals.h"

#include "input/host_textures.h"

static gl_int level_parameter(const glssao__gl *gl, gl_enum name)
{
    gl_int value = 0;
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, name, &value);
    return value;
}

glssao__state_need glssao__normals_need(void)
{
    return (glssao__state_need){.parts = STATE_DRAW | STATE_DEPTH_MASK, .units = 1u};
}

/* Binds the texture and checks that it holds depth of the map's size. */
static glssao_result check_depth(const glssao__gl *gl, const glssao__log *log, const glssao__target *normal_map,
                                 gl_uint texture)
{
    if (!gl->IsTexture(texture))
        return glssao__log_refuse(log, "depth_texture = %u: no texture of this context", texture);
    gl->ActiveTexture(GL_TEXTURE0);
    if (!glssao__host_texture_bind(gl, GL_TEXTURE_2D, texture))
        return glssao__log_refuse(log, "depth_texture = %u: not a GL_TEXTURE_2D", texture);
    const int width = level_parameter(gl, GL_TEXTURE_WIDTH), height = level_parameter(gl, GL_TEXTURE_HEIGHT);
    if (width != normal_map->width || height != normal_map->height)
        return glssao__log_refuse(log, "depth_texture = %u: a GL_TEXTURE_2D of %d x %d, not of the full size, %d x %d",
                                  texture, width, height, normal_map->width, normal_map->height);
    if (level_parameter(gl, GL_TEXTURE_DEPTH_SIZE) == 0)
        return glssao__log_refuse(log, "depth_texture = %u: not a depth format", texture);
    return GLSSAO_OK;
}

glssao_result glssao__normals_begin(glssao__normals *normals, const glssao__gl *gl, const glssao__log *log,
                                    const glssao__target *normal_map, gl_uint depth_texture, bool host_restores)
{
    const bool is_known = host_restores && depth_texture != 0 && depth_texture == normals->known_depth;
    if (!is_known) {
        const glssao_result result = check_depth(gl, log, normal_map, depth_texture);
        if (result != GLSSAO_OK)
            return result;
        normals->known_stencil = level_parameter(gl, GL_TEXTURE_STENCIL_SIZE) > 0;
    }
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, normal_map->framebuffer);
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER,
                             normals->known_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                             depth_texture, 0);
    const gl_enum status = is_known ? GL_FRAMEBUFFER_COMPLETE : gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
        glssao__log_write(log, GLSSAO_LOG_ERROR,
                          "depth_texture = %u: the driver rejects it beside the normal map: 0x%04X", depth_texture,
                          status);
        return GLSSAO_FRAMEBUFFER_ERROR;
    }
    normals->known_depth = depth_texture;
    glssao__target_clear(gl, normal_map, (const gl_float[4]){0.0f, 0.0f, 1.0f, 0.0f});
    gl->Clear(GL_DEPTH_BUFFER_BIT); /* to the host's own value */
    return GLSSAO_OK;
}

void glssao__normals_open(glssao__normals *normals, const glssao__gl *gl, const glssao__target *normal_map,
                          bool host_restores)
{
    normals->is_open = true;
    if (!host_restores) {
        gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &normals->host_framebuffer);
        gl->GetFloatv(GL_VIEWPORT, normals->host_viewport);
    }
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, normal_map->framebuffer);
    glssao__state_viewport(gl,
                           (const gl_float[4]){0.0f, 0.0f, (gl_float)normal_map->width, (gl_float)normal_map->height});
}

bool glssao__normals_are_bound(const glssao__gl *gl, const glssao__target *normal_map)
{
    gl_int bound = 0;
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    return (gl_uint)bound == normal_map->framebuffer;
}

void glssao__normals_close(glssao__normals *normals, const glssao__gl *gl, const glssao__target *normal_map,
                           bool host_restores)
{
    /* Detached, the depth texture can be read by the passes, and deleted by the host. */
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, normal_map->framebuffer);
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
    normals->is_open = false;
    if (host_restores)
        return;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (gl_uint)normals->host_framebuffer);
    glssao__state_viewport(gl, normals->host_viewport);
}
