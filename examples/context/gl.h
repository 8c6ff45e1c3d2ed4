/* SPDX-License-Identifier: MIT
 *
 * The OpenGL 3.3 functions that examples and tests call, loaded by name from the current context: gl.BindTexture(...)
 * and so on. Add the name of each function that you need, from 3.3 core only. The library has its own table.
 */
#pragma once

/* The prototypes give the types of the functions; nothing calls them. */
#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#endif
#include <GL/glcorearb.h>
#include <stdbool.h>
#include <stddef.h>

/* X(name without gl) */
/* clang-format off */
#define GL_FUNCTIONS(X) \
    X(ActiveTexture) X(AttachShader) X(BeginQuery) X(BindAttribLocation) X(BindBuffer) X(BindBufferBase) \
    X(BindBufferRange) X(BindFramebuffer) X(BindRenderbuffer) X(BindSampler) X(BindTexture) X(BindVertexArray) \
    X(BlendEquation) X(BlendEquationSeparate) X(BlendFunc) X(BlendFuncSeparate) X(BlitFramebuffer) X(BufferData) \
    X(BufferSubData) X(CheckFramebufferStatus) X(Clear) X(ClearBufferfv) X(ClearColor) X(ClearDepth) \
    X(ClientWaitSync) X(ColorMask) X(ColorMaski) X(CompileShader) X(CreateProgram) X(CreateShader) X(CullFace) \
    X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteQueries) X(DeleteRenderbuffers) X(DeleteSamplers) \
    X(DeleteShader) X(DeleteSync) X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(Disable) \
    X(Disablei) X(DrawArrays) X(DrawBuffer) X(DrawBuffers) X(DrawElements) X(DrawElementsBaseVertex) \
    X(DrawElementsInstanced) X(DrawElementsInstancedBaseVertex) X(Enable) X(EnableVertexAttribArray) X(Enablei) \
    X(EndQuery) X(FenceSync) X(Finish) X(FramebufferRenderbuffer) X(FramebufferTexture2D) X(FrontFace) X(GenBuffers) \
    X(GenFramebuffers) X(GenQueries) X(GenRenderbuffers) X(GenSamplers) X(GenTextures) X(GenVertexArrays) \
    X(GenerateMipmap) X(GetBooleani_v) X(GetBooleanv) X(GetBufferParameteriv) X(GetDoublev) X(GetError) X(GetFloatv) \
    X(GetInteger64i_v) X(GetIntegeri_v) X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv) X(GetQueryObjectui64v) \
    X(GetQueryObjectuiv) X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetStringi) X(GetTexImage) \
    X(GetTexLevelParameteriv) X(GetUniformBlockIndex) X(GetUniformLocation) X(IsEnabled) X(IsEnabledi) X(IsTexture) \
    X(LinkProgram) X(LogicOp) X(MapBufferRange) X(PixelStorei) X(PolygonMode) X(PolygonOffset) \
    X(PrimitiveRestartIndex) X(QueryCounter) X(ReadBuffer) X(ReadPixels) X(RenderbufferStorage) \
    X(RenderbufferStorageMultisample) X(SampleCoverage) X(SampleMaski) X(SamplerParameterf) X(SamplerParameterfv) \
    X(SamplerParameteri) X(Scissor) X(ShaderSource) X(StencilFunc) X(TexImage2D) X(TexImage2DMultisample) \
    X(TexImage3D) X(TexParameteri) X(TexSubImage2D) X(Uniform1f) X(Uniform1i) X(Uniform2f) X(Uniform2fv) X(Uniform3f) \
    X(Uniform3fv) X(Uniform4f) X(Uniform4fv) X(UniformBlockBinding) X(UniformMatrix3fv) X(UniformMatrix4fv) \
    X(UnmapBuffer) X(UseProgram) X(VertexAttrib4f) X(VertexAttribDivisor) X(VertexAttribPointer) X(Viewport)
/* clang-format on */

struct gl_functions {
#define GL_MEMBER(name) __typeof__(gl##name) *name;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
};

extern struct gl_functions gl; /* functions of the context that gl_load was last called for */

/* Fills a table. False, with the name in `error`, if `load` does not find a function. */
bool gl_load_table(struct gl_functions *table, void *(*load)(const char *name, void *user), void *user, char *error,
                   size_t error_size);
/* Fills `gl`. */
bool gl_load(void *(*load)(const char *name, void *user), void *user, char *error, size_t error_size);

/* A texture of one level, read without filtering; `data` may be NULL. Leaves no texture bound. */
GLuint gl_make_texture(GLenum internal_format, GLenum format, GLenum type, int width, int height, const void *data);
/* A framebuffer of these textures, either of which may be 0; leaves it bound. False if it is not complete. */
bool gl_make_framebuffer(GLuint color, GLuint depth, GLuint *out);
