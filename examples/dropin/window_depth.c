/* SPDX-License-Identifier: MIT
 *
 * A depth blit needs the same format on both sides, so the texture gets the window's format. Where the driver still
 * refuses the blit, glCopyTexSubImage2D converts; that works only without multisampling.
 */
#include "window_depth.h"

#include <GL/glcorearb.h>
#include <stdlib.h>
#include <string.h>

#define FUNCTIONS(X)                                                                                                   \
    X(BINDBUFFER, BindBuffer)                                                                                          \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                                                \
    X(BINDTEXTURE, BindTexture)                                                                                        \
    X(BLITFRAMEBUFFER, BlitFramebuffer)                                                                                \
    X(COPYTEXSUBIMAGE2D, CopyTexSubImage2D)                                                                            \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                                          \
    X(DELETETEXTURES, DeleteTextures)                                                                                  \
    X(DISABLE, Disable)                                                                                                \
    X(DRAWBUFFER, DrawBuffer)                                                                                          \
    X(ENABLE, Enable)                                                                                                  \
    X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                                                                      \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                                                \
    X(GENTEXTURES, GenTextures)                                                                                        \
    X(GETERROR, GetError)                                                                                              \
    X(GETFRAMEBUFFERATTACHMENTPARAMETERIV, GetFramebufferAttachmentParameteriv)                                        \
    X(GETINTEGERV, GetIntegerv)                                                                                        \
    X(ISENABLED, IsEnabled)                                                                                            \
    X(TEXIMAGE2D, TexImage2D)                                                                                          \
    X(TEXPARAMETERI, TexParameteri)

struct window_depth {
#define MEMBER(type, name) PFNGL##type##PROC name;
    FUNCTIONS(MEMBER)
#undef MEMBER
    GLuint texture, framebuffer;
    GLenum format;
    int width, height;
    bool blit_fails;
};

window_depth *window_depth_create(void *(*load)(const char *name, void *user), void *user)
{
    window_depth *d = calloc(1, sizeof *d);
    if (!d)
        return NULL;
    void *address;
#define LOAD(type, name)                                                                                               \
    address = load("gl" #name, user);                                                                                  \
    if (!address) {                                                                                                    \
        free(d);                                                                                                       \
        return NULL;                                                                                                   \
    }                                                                                                                  \
    memcpy(&d->name, &address, sizeof address);
    FUNCTIONS(LOAD)
#undef LOAD
    return d;
}

static GLint attachment(const window_depth *d, GLuint framebuffer, bool stencil, GLenum what)
{
    GLenum point =
        stencil ? (framebuffer ? GL_STENCIL_ATTACHMENT : GL_STENCIL) : (framebuffer ? GL_DEPTH_ATTACHMENT : GL_DEPTH);
    GLint value = 0;
    d->GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, point, what, &value);
    return value;
}

/* The depth format of the bound read framebuffer; 0 where it has no depth. */
static GLenum depth_format(const window_depth *d, GLuint framebuffer)
{
    if (attachment(d, framebuffer, false, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_NONE)
        return 0;
    GLint bits = attachment(d, framebuffer, false, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
    bool is_float = attachment(d, framebuffer, false, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
    bool has_stencil = attachment(d, framebuffer, true, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE &&
                       attachment(d, framebuffer, true, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0;
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

static void fit_texture(window_depth *d, GLenum format, int width, int height)
{
    if (d->texture && d->format == format && d->width == width && d->height == height)
        return;
    if (!d->texture) {
        d->GenTextures(1, &d->texture);
        d->GenFramebuffers(1, &d->framebuffer);
    }
    bool has_stencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    GLenum type = format == GL_DEPTH24_STENCIL8    ? GL_UNSIGNED_INT_24_8
                  : format == GL_DEPTH32F_STENCIL8 ? GL_FLOAT_32_UNSIGNED_INT_24_8_REV
                                                   : GL_FLOAT;
    d->BindTexture(GL_TEXTURE_2D, d->texture);
    d->TexImage2D(GL_TEXTURE_2D, 0, (GLint)format, width, height, 0,
                  has_stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT, type, NULL);
    d->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    d->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    d->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    d->BindFramebuffer(GL_DRAW_FRAMEBUFFER, d->framebuffer);
    d->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, 0,
                            0); /* detaches the old one */
    d->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, has_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                            GL_TEXTURE_2D, d->texture, 0);
    d->DrawBuffer(GL_NONE); /* OpenGL 3.3 calls it incomplete otherwise */
    d->format = format;
    d->width = width;
    d->height = height;
    d->blit_fails = false;
}

/* Tries the blit, then the copy. The read framebuffer and the texture are bound. */
static bool copy(window_depth *d, int width, int height)
{
    for (int i = 0; i < 16 && d->GetError() != GL_NO_ERROR; ++i) /* older errors say nothing about the copy */
        ;
    if (!d->blit_fails) {
        d->BindFramebuffer(GL_DRAW_FRAMEBUFFER, d->framebuffer);
        d->BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
        d->blit_fails = d->GetError() != GL_NO_ERROR;
    }
    if (d->blit_fails) {
        d->BindTexture(GL_TEXTURE_2D, d->texture);
        d->CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, width, height);
        return d->GetError() == GL_NO_ERROR;
    }
    return true;
}

unsigned window_depth_copy(window_depth *d, unsigned framebuffer, int width, int height, const char **out_why)
{
    GLint draw = 0, read = 0, texture = 0, unpack_buffer = 0;
    d->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
    d->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
    d->GetIntegerv(GL_TEXTURE_BINDING_2D, &texture);
    d->GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack_buffer);
    GLboolean scissor = d->IsEnabled(GL_SCISSOR_TEST);
    d->Disable(GL_SCISSOR_TEST); /* it would clip the blit */
    d->BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    d->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    GLenum format = depth_format(d, framebuffer);
    bool ok = format != 0;
    if (ok) {
        fit_texture(d, format, width, height);
        ok = copy(d, width, height);
    }
    if (out_why)
        *out_why = ok            ? NULL
                   : format == 0 ? "the framebuffer has no depth"
                                 : "the driver copies no depth from this framebuffer";
    d->BindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)unpack_buffer);
    d->BindTexture(GL_TEXTURE_2D, (GLuint)texture);
    d->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)draw);
    d->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)read);
    if (scissor)
        d->Enable(GL_SCISSOR_TEST);
    return ok ? d->texture : 0;
}

void window_depth_destroy(window_depth *d)
{
    if (!d)
        return;
    d->DeleteFramebuffers(1, &d->framebuffer); /* names of 0 are ignored */
    d->DeleteTextures(1, &d->texture);
    free(d);
}
