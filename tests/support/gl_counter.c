/* SPDX-License-Identifier: MIT */
#include "gl_counter.h"

#include "gl.h"

#include <string.h>

static struct {
    glssao_load_fn load;
    void *user;
    gl_counts counts;
    GLbitfield lacking; /* barriers since the last dispatch */
    void(APIENTRY *draw_arrays)(GLenum, GLint, GLsizei);
    void(APIENTRY *draw_elements)(GLenum, GLsizei, GLenum, const void *, GLsizei);
    void(APIENTRY *dispatch)(GLuint, GLuint, GLuint);
    void(APIENTRY *memory_barrier)(GLbitfield);
    void(APIENTRY *compile_shader)(GLuint);
    void(APIENTRY *link_program)(GLuint);
    void(APIENTRY *program_binary)(GLuint, GLenum, const void *, GLsizei);
    void(APIENTRY *tex_image)(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *);
    void(APIENTRY *clear_buffer)(GLenum, GLint, const GLfloat *);
} counter;

/* The barrier bits that must be issued before shaders read or overwrite textures that compute shaders wrote, and, at
 * the end of a frame, before the host uses them. */
enum {
    TO_READ = GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT,
    TO_END = TO_READ | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT
};

static void APIENTRY dispatch(GLuint x, GLuint y, GLuint z)
{
    counter.counts.dispatches++;
    counter.counts.unordered += (counter.lacking & TO_READ) != 0;
    counter.lacking = TO_END;
    counter.dispatch(x, y, z);
}

static void APIENTRY memory_barrier(GLbitfield barriers)
{
    counter.lacking &= ~barriers;
    counter.memory_barrier(barriers);
}

static void APIENTRY draw_arrays(GLenum mode, GLint first, GLsizei count)
{
    counter.counts.draws++;
    counter.counts.unordered += counter.lacking != 0;
    counter.draw_arrays(mode, first, count);
}

static void APIENTRY draw_elements(GLenum mode, GLsizei count, GLenum type, const void *indices, GLsizei instances)
{
    counter.counts.elements++;
    counter.draw_elements(mode, count, type, indices, instances);
}

static void APIENTRY compile_shader(GLuint shader)
{
    counter.counts.shaders++;
    counter.compile_shader(shader);
}

static void APIENTRY link_program(GLuint program)
{
    counter.counts.programs++;
    counter.link_program(program);
}

static void APIENTRY program_binary(GLuint program, GLenum format, const void *binary, GLsizei length)
{
    counter.counts.binaries++;
    counter.program_binary(program, format, binary, length);
}

static int bytes_of(GLint internal_format)
{
    switch (internal_format) {
    case GL_RGBA32F:
        return 16;
    case GL_RGBA16F:
    case GL_RG32F:
    case GL_RG32UI:
        return 8;
    case GL_RGB16F:
        return 6;
    case GL_R16:
        return 2;
    case GL_R8:
        return 1;
    default:
        return 4; /* R32F, RGBA8 */
    }
}

static void APIENTRY tex_image(GLenum target, GLint level, GLint internal_format, GLsizei width, GLsizei height,
                               GLint border, GLenum format, GLenum type, const void *data)
{
    counter.counts.textures++;
    counter.counts.bytes += (int64_t)width * height * bytes_of(internal_format);
    counter.tex_image(target, level, internal_format, width, height, border, format, type, data);
}

static void APIENTRY clear_buffer(GLenum buffer, GLint index, const GLfloat *value)
{
    counter.counts.clears++;
    counter.clear_buffer(buffer, index, value);
}

void gl_counter_start(glssao_load_fn load, void *load_user)
{
    memset(&counter, 0, sizeof counter);
    counter.load = load;
    counter.user = load_user;
}

/* ISO C has no cast between object and function pointers; every platform with OpenGL gives them the same size. */
#define COUNTED(name, member, function)                                                                                \
    if (strcmp(wanted, name) == 0 && address) {                                                                        \
        memcpy(&counter.member, &address, sizeof address);                                                             \
        __typeof__(&function) own = function;                                                                          \
        memcpy(&address, &own, sizeof address);                                                                        \
    }

void *gl_counter_load(const char *wanted, void *user)
{
    (void)user;
    void *address = counter.load(wanted, counter.user);
    COUNTED("glDrawArrays", draw_arrays, draw_arrays)
    COUNTED("glDrawElementsInstanced", draw_elements, draw_elements)
    COUNTED("glDispatchCompute", dispatch, dispatch)
    COUNTED("glMemoryBarrier", memory_barrier, memory_barrier)
    COUNTED("glCompileShader", compile_shader, compile_shader)
    COUNTED("glLinkProgram", link_program, link_program)
    COUNTED("glProgramBinary", program_binary, program_binary)
    COUNTED("glTexImage2D", tex_image, tex_image)
    COUNTED("glClearBufferfv", clear_buffer, clear_buffer)
    return address;
}

gl_counts gl_counter_take(void)
{
    gl_counts taken = counter.counts;
    taken.unordered += counter.lacking != 0;
    counter.counts = (gl_counts){0};
    return taken;
}
