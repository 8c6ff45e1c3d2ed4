/* SPDX-License-Identifier: MIT
 *
 * The OpenGL 3.3 functions that examples and tests call, loaded by name from the current context: gl.BindTexture(...)
 * and so on. Add a line for each function that you need, from 3.3 core only. The library has its own table.
 */
#ifndef GLSSAO_EXAMPLES_GL_H
#define GLSSAO_EXAMPLES_GL_H

#include <GL/glcorearb.h>
#include <stdbool.h>
#include <stddef.h>

/* X(type suffix of PFNGL...PROC, name without gl) */
#define GL_FUNCTIONS(X)                                                                                                \
    X(ACTIVETEXTURE, ActiveTexture)                                                                                    \
    X(ATTACHSHADER, AttachShader)                                                                                      \
    X(BINDATTRIBLOCATION, BindAttribLocation)                                                                          \
    X(BEGINQUERY, BeginQuery)                                                                                          \
    X(BINDBUFFER, BindBuffer)                                                                                          \
    X(BINDBUFFERBASE, BindBufferBase)                                                                                  \
    X(BINDBUFFERRANGE, BindBufferRange)                                                                                \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                                                \
    X(BINDRENDERBUFFER, BindRenderbuffer)                                                                              \
    X(BINDSAMPLER, BindSampler)                                                                                        \
    X(BINDTEXTURE, BindTexture)                                                                                        \
    X(BINDVERTEXARRAY, BindVertexArray)                                                                                \
    X(BLENDEQUATION, BlendEquation)                                                                                    \
    X(BLENDEQUATIONSEPARATE, BlendEquationSeparate)                                                                    \
    X(BLENDFUNC, BlendFunc)                                                                                            \
    X(BLENDFUNCSEPARATE, BlendFuncSeparate)                                                                            \
    X(BLITFRAMEBUFFER, BlitFramebuffer)                                                                                \
    X(BUFFERDATA, BufferData)                                                                                          \
    X(BUFFERSUBDATA, BufferSubData)                                                                                    \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                                                  \
    X(CLEAR, Clear)                                                                                                    \
    X(CLEARBUFFERFV, ClearBufferfv)                                                                                    \
    X(CLEARCOLOR, ClearColor)                                                                                          \
    X(CLEARDEPTH, ClearDepth)                                                                                          \
    X(CLIENTWAITSYNC, ClientWaitSync)                                                                                  \
    X(COLORMASK, ColorMask)                                                                                            \
    X(COLORMASKI, ColorMaski)                                                                                          \
    X(COMPILESHADER, CompileShader)                                                                                    \
    X(CREATEPROGRAM, CreateProgram)                                                                                    \
    X(CREATESHADER, CreateShader)                                                                                      \
    X(CULLFACE, CullFace)                                                                                              \
    X(DELETEBUFFERS, DeleteBuffers)                                                                                    \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                                          \
    X(DELETEPROGRAM, DeleteProgram)                                                                                    \
    X(DELETEQUERIES, DeleteQueries)                                                                                    \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                                        \
    X(DELETESAMPLERS, DeleteSamplers)                                                                                  \
    X(DELETESHADER, DeleteShader)                                                                                      \
    X(DELETESYNC, DeleteSync)                                                                                          \
    X(DELETETEXTURES, DeleteTextures)                                                                                  \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                                          \
    X(DEPTHFUNC, DepthFunc)                                                                                            \
    X(DEPTHMASK, DepthMask)                                                                                            \
    X(DISABLE, Disable)                                                                                                \
    X(DISABLEI, Disablei)                                                                                              \
    X(DRAWARRAYS, DrawArrays)                                                                                          \
    X(DRAWBUFFER, DrawBuffer)                                                                                          \
    X(DRAWBUFFERS, DrawBuffers)                                                                                        \
    X(DRAWELEMENTS, DrawElements)                                                                                      \
    X(DRAWELEMENTSINSTANCED, DrawElementsInstanced)                                                                    \
    X(DRAWELEMENTSBASEVERTEX, DrawElementsBaseVertex)                                                                  \
    X(DRAWELEMENTSINSTANCEDBASEVERTEX, DrawElementsInstancedBaseVertex)                                                \
    X(ENABLE, Enable)                                                                                                  \
    X(ENABLEI, Enablei)                                                                                                \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                                                \
    X(ENDQUERY, EndQuery)                                                                                              \
    X(FENCESYNC, FenceSync)                                                                                            \
    X(FINISH, Finish)                                                                                                  \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                                                \
    X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                                                                      \
    X(FRONTFACE, FrontFace)                                                                                            \
    X(GENBUFFERS, GenBuffers)                                                                                          \
    X(GENERATEMIPMAP, GenerateMipmap)                                                                                  \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                                                \
    X(GENQUERIES, GenQueries)                                                                                          \
    X(GENRENDERBUFFERS, GenRenderbuffers)                                                                              \
    X(GENSAMPLERS, GenSamplers)                                                                                        \
    X(GENTEXTURES, GenTextures)                                                                                        \
    X(GENVERTEXARRAYS, GenVertexArrays)                                                                                \
    X(GETBOOLEANI_V, GetBooleani_v)                                                                                    \
    X(GETBOOLEANV, GetBooleanv)                                                                                        \
    X(GETBUFFERPARAMETERIV, GetBufferParameteriv)                                                                      \
    X(GETDOUBLEV, GetDoublev)                                                                                          \
    X(GETERROR, GetError)                                                                                              \
    X(GETFLOATV, GetFloatv)                                                                                            \
    X(GETINTEGER64I_V, GetInteger64i_v)                                                                                \
    X(GETINTEGERI_V, GetIntegeri_v)                                                                                    \
    X(GETINTEGERV, GetIntegerv)                                                                                        \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                                            \
    X(GETPROGRAMIV, GetProgramiv)                                                                                      \
    X(GETQUERYOBJECTUIV, GetQueryObjectuiv)                                                                            \
    X(GETQUERYOBJECTUI64V, GetQueryObjectui64v)                                                                        \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                                              \
    X(GETSHADERIV, GetShaderiv)                                                                                        \
    X(GETSTRING, GetString)                                                                                            \
    X(GETSTRINGI, GetStringi)                                                                                          \
    X(GETTEXIMAGE, GetTexImage)                                                                                        \
    X(GETTEXLEVELPARAMETERIV, GetTexLevelParameteriv)                                                                  \
    X(GETUNIFORMBLOCKINDEX, GetUniformBlockIndex)                                                                      \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                                          \
    X(ISENABLED, IsEnabled)                                                                                            \
    X(ISENABLEDI, IsEnabledi)                                                                                          \
    X(ISTEXTURE, IsTexture)                                                                                            \
    X(LINKPROGRAM, LinkProgram)                                                                                        \
    X(LOGICOP, LogicOp)                                                                                                \
    X(MAPBUFFERRANGE, MapBufferRange)                                                                                  \
    X(PIXELSTOREI, PixelStorei)                                                                                        \
    X(POLYGONMODE, PolygonMode)                                                                                        \
    X(POLYGONOFFSET, PolygonOffset)                                                                                    \
    X(PRIMITIVERESTARTINDEX, PrimitiveRestartIndex)                                                                    \
    X(QUERYCOUNTER, QueryCounter)                                                                                      \
    X(READBUFFER, ReadBuffer)                                                                                          \
    X(READPIXELS, ReadPixels)                                                                                          \
    X(RENDERBUFFERSTORAGE, RenderbufferStorage)                                                                        \
    X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample)                                                  \
    X(SAMPLECOVERAGE, SampleCoverage)                                                                                  \
    X(SAMPLEMASKI, SampleMaski)                                                                                        \
    X(SAMPLERPARAMETERF, SamplerParameterf)                                                                            \
    X(SAMPLERPARAMETERFV, SamplerParameterfv)                                                                          \
    X(SAMPLERPARAMETERI, SamplerParameteri)                                                                            \
    X(SCISSOR, Scissor)                                                                                                \
    X(SHADERSOURCE, ShaderSource)                                                                                      \
    X(STENCILFUNC, StencilFunc)                                                                                        \
    X(TEXIMAGE2D, TexImage2D)                                                                                          \
    X(TEXIMAGE2DMULTISAMPLE, TexImage2DMultisample)                                                                    \
    X(TEXIMAGE3D, TexImage3D)                                                                                          \
    X(TEXPARAMETERI, TexParameteri)                                                                                    \
    X(TEXSUBIMAGE2D, TexSubImage2D)                                                                                    \
    X(UNIFORM1F, Uniform1f)                                                                                            \
    X(UNIFORM1I, Uniform1i)                                                                                            \
    X(UNIFORM2F, Uniform2f)                                                                                            \
    X(UNIFORM3F, Uniform3f)                                                                                            \
    X(UNIFORM3FV, Uniform3fv)                                                                                          \
    X(UNIFORM2FV, Uniform2fv)                                                                                          \
    X(UNIFORM4F, Uniform4f)                                                                                            \
    X(UNIFORM4FV, Uniform4fv)                                                                                          \
    X(UNIFORMBLOCKBINDING, UniformBlockBinding)                                                                        \
    X(UNIFORMMATRIX3FV, UniformMatrix3fv)                                                                              \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                                                                              \
    X(UNMAPBUFFER, UnmapBuffer)                                                                                        \
    X(USEPROGRAM, UseProgram)                                                                                          \
    X(VERTEXATTRIB4F, VertexAttrib4f)                                                                                  \
    X(VERTEXATTRIBDIVISOR, VertexAttribDivisor)                                                                        \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                                        \
    X(VIEWPORT, Viewport)

struct gl_functions {
#define GL_MEMBER(type, name) PFNGL##type##PROC name;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
};

extern struct gl_functions gl; /* functions of the context that gl_load was last called for */

/* Fills the table. False, with the name in `error`, if `load` does not find a function. */
bool gl_load(void *(*load)(const char *name, void *user), void *user, char *error, size_t error_size);

/* A texture of one level, read without filtering; `data` may be NULL. Leaves no texture bound. */
GLuint gl_make_texture(GLenum internal_format, GLenum format, GLenum type, int width, int height, const void *data);
/* A framebuffer of these textures, either of which may be 0; leaves it bound. False if it is not complete. */
bool gl_make_framebuffer(GLuint color, GLuint depth, GLuint *out);

#endif
