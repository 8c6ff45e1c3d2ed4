/* SPDX-License-Identifier: MIT
 *
 * The table of OpenGL functions for examples and tests, and what most of them make with it.
 */
#include "gl.h"

#include <stdio.h>
#include <string.h>

struct gl_functions gl;

bool gl_load_table(struct gl_functions *table, void *(*load)(const char *name, void *user), void *user, char *error,
                   size_t error_size)
{
    void *address;
/* ISO C has no cast from an object pointer to a function pointer; POSIX guarantees the same representation. */
#define GL_LOAD(name)                                                                                                  \
    address = load("gl" #name, user);                                                                                  \
    if (!address) {                                                                                                    \
        snprintf(error, error_size, "the context has no function gl" #name);                                           \
        return false;                                                                                                  \
    }                                                                                                                  \
    memcpy(&table->name, &address, sizeof address);
    GL_FUNCTIONS(GL_LOAD)
#undef GL_LOAD
    return true;
}

bool gl_load(void *(*load)(const char *name, void *user), void *user, char *error, size_t error_size)
{
    return gl_load_table(&gl, load, user, error, error_size);
}

GLuint gl_make_texture(GLenum internal_format, GLenum format, GLenum type, int width, int height, const void *data)
{
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal_format, width, height, 0, format, type, data);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST); /* the default filter needs mipmaps */
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

bool gl_make_framebuffer(GLuint color, GLuint depth, GLuint *out)
{
    gl.GenFramebuffers(1, out);
    gl.BindFramebuffer(GL_FRAMEBUFFER, *out);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color, 0);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    if (!color) {
        gl.DrawBuffer(GL_NONE);
        gl.ReadBuffer(GL_NONE);
    }
    return gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}
