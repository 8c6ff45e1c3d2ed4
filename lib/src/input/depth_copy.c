/* SPDX-License-Identifier: MIT
 *
 * Copies depth by a blit, which also resolves samples. It needs the same format on both sides, so the texture gets the
 * format of the framebuffer. Where a driver still refuses the blit, texels are copied.
 */
#include "input/depth_copy.h"

#include "input/formats.h"

#include <string.h>

glssao__state_need glssao__depth_copy_need(void)
{
    return (glssao__state_need){.parts = STATE_DRAW | STATE_READ | STATE_TRANSFER, .units = 1u};
}

static gl_int attachment(const glssao__gl *gl, gl_uint framebuffer, bool stencil, gl_enum what)
{
    const gl_enum own = stencil ? GL_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, window = stencil ? GL_STENCIL : GL_DEPTH;
    gl_int value = 0;
    gl->GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, framebuffer ? own : window, what, &value);
    return value;
}

/* The depth format of the bound read framebuffer; 0 where it has no depth. */
static gl_enum depth_format(const glssao__gl *gl, gl_uint framebuffer)
{
    if (attachment(gl, framebuffer, false, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == 0)
        return 0;
    const gl_int bits = attachment(gl, framebuffer, false, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
    const bool is_float =
        attachment(gl, framebuffer, false, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == (gl_int)GL_FLOAT;
    const bool has_stencil = attachment(gl, framebuffer, true, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != 0 &&
                             attachment(gl, framebuffer, true, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0;
    if (bits == 0)
        return 0;
    if (bits == 16)
        return GL_DEPTH_COMPONENT16;
    if (is_float)
        return has_stencil ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F;
    if (bits == 32)
        return GL_DEPTH_COMPONENT32;
    return has_stencil ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT24;
}

/* False where the driver has no memory: the texture is then empty. */
static bool give_storage(const glssao__gl *gl, gl_enum format, bool has_stencil, int width, int height)
{
    const gl_enum type = format == GL_DEPTH24_STENCIL8    ? GL_UNSIGNED_INT_24_8
                         : format == GL_DEPTH32F_STENCIL8 ? GL_FLOAT_32_UNSIGNED_INT_24_8_REV
                                                          : GL_FLOAT;
    gl_int got = 0;
    gl->TexImage2D(GL_TEXTURE_2D, 0, (gl_int)format, width, height, 0,
                   has_stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT, type, NULL);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &got);
    return got == width || (glssao__gl_take_error(gl, GL_OUT_OF_MEMORY), false);
}

/* Gives the texture its format and size, and attaches it. The read framebuffer stays bound. */
static glssao_result fit(glssao__depth_copy *c, const glssao__gl *gl, const glssao__log *log, gl_enum format, int width,
                         int height)
{
    const bool has_stencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    if (!c->texture) {
        gl->GenTextures(1, &c->texture);
        gl->GenFramebuffers(1, &c->framebuffer);
    }
    c->width = c->height = 0; /* until all is done */
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, c->texture);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, c->framebuffer);
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
    if (!give_storage(gl, format, has_stencil, width, height)) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "no memory for the copy of a depth buffer of %d x %d", width, height);
        return GLSSAO_OUT_OF_MEMORY;
    }
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, has_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                             GL_TEXTURE_2D, c->texture, 0);
    const gl_enum none = 0; /* OpenGL 3.3 calls it incomplete otherwise */
    gl->DrawBuffers(1, &none);
    const gl_enum status = gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        glssao__log_write(log, GLSSAO_LOG_ERROR,
                          "the driver rejects the framebuffer of a depth copy of %d x %d: 0x%04X", width, height,
                          status);
        return GLSSAO_FRAMEBUFFER_ERROR;
    }
    c->format = format;
    c->width = width;
    c->height = height;
    return GLSSAO_OK;
}

static void blit(const glssao__depth_copy *c, const glssao__gl *gl, const int r[4])
{
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, c->framebuffer);
    gl->BlitFramebuffer(r[0], r[1], r[0] + r[2], r[1] + r[3], 0, 0, r[2], r[3], GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

static void copy_texels(const glssao__depth_copy *c, const glssao__gl *gl, const int r[4])
{
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, c->texture);
    gl->CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, r[0], r[1], r[2], r[3]);
}

/* Tries the blit, then the copy of texels, which can't resolve samples; an error tells that a driver refuses. */
static bool try_both(glssao__depth_copy *c, const glssao__gl *gl, const int r[4])
{
    const bool host_had_error = glssao__gl_take_error(gl, GL_INVALID_OPERATION);
    blit(c, gl, r);
    c->blit_fails = glssao__gl_take_error(gl, GL_INVALID_OPERATION);
    if (c->blit_fails)
        copy_texels(c, gl, r);
    c->is_checked = !c->blit_fails || !glssao__gl_take_error(gl, GL_INVALID_OPERATION);
    if (host_had_error) {
        gl->UseProgram(0);
        gl->Uniform1i(0, 0); /* causes it again: there is no program */
    }
    return c->is_checked;
}

/* Looks at the bound read framebuffer. */
static glssao_result look_at(const glssao__depth_copy *c, const glssao__gl *gl, const glssao__log *log,
                             gl_uint framebuffer, gl_enum *out_format)
{
    const gl_enum status = gl->CheckFramebufferStatus(GL_READ_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "framebuffer = %u: not complete: 0x%04X %s", framebuffer, status,
                          glssao__format_status_name(status));
        return GLSSAO_FRAMEBUFFER_ERROR;
    }
    *out_format = depth_format(gl, framebuffer);
    if (*out_format == 0)
        return glssao__log_refuse(log, "framebuffer = %u: it has no depth buffer", framebuffer);
    if (framebuffer && attachment(gl, framebuffer, false, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_TEXTURE &&
        (gl_uint)attachment(gl, framebuffer, false, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME) == c->texture)
        return glssao__log_refuse(log, "framebuffer = %u: its depth buffer is the effect's own copy", framebuffer);
    return GLSSAO_OK;
}

/* As the last copy went, or by trying. */
static bool copy(glssao__depth_copy *c, const glssao__gl *gl, const int r[4], bool is_like_last)
{
    if (!is_like_last)
        return try_both(c, gl, r);
    if (c->blit_fails)
        copy_texels(c, gl, r);
    else
        blit(c, gl, r);
    return true;
}

glssao_result glssao__depth_copy_take(glssao__depth_copy *c, const glssao__gl *gl, glssao__timers *timers,
                                      const glssao__log *log, gl_uint framebuffer, const int r[4], bool host_restores)
{
    const bool has_size = c->width == r[2] && c->height == r[3],
               is_like_last = has_size && c->source == framebuffer && c->is_checked;
    gl_enum format = c->format;
    c->is_new = false;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    if (!(is_like_last && host_restores)) {
        const glssao_result result = look_at(c, gl, log, framebuffer, &format);
        if (result != GLSSAO_OK)
            return result;
    }
    if (!has_size || c->format != format) {
        c->is_new = true;
        const glssao_result result = fit(c, gl, log, format, r[2], r[3]);
        if (result != GLSSAO_OK)
            return result;
    }
    c->source = framebuffer;
    glssao__timers_begin(timers, gl, SECTION_DEPTH_COPY);
    const bool is_copied = copy(c, gl, r, is_like_last && !c->is_new);
    glssao__timers_end(timers, gl, SECTION_DEPTH_COPY);
    return is_copied ? GLSSAO_OK
                     : glssao__log_refuse(log, "framebuffer = %u: the driver copies no depth from it", framebuffer);
}

void glssao__depth_copy_destroy(glssao__depth_copy *c, const glssao__gl *gl)
{
    gl->DeleteFramebuffers(1, &c->framebuffer); /* OpenGL ignores the name 0 */
    gl->DeleteTextures(1, &c->texture);
    *c = (glssao__depth_copy){0};
}
