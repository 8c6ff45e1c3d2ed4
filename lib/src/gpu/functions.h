/* SPDX-License-Identifier: MIT
 *
 * The part of OpenGL 3.3 that the library uses: types, constants, and a table of functions that the host's loader
 * fills. Each effect has a table of its own. No GL header is needed. Functions of later versions may be NULL.
 */
#ifndef GLSSAO_GPU_FUNCTIONS_H
#define GLSSAO_GPU_FUNCTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && !defined(_WIN64)
#define GLSSAO_GL_CALL __stdcall
#else
#define GLSSAO_GL_CALL
#endif

typedef unsigned int gl_enum;
typedef unsigned int gl_uint;
typedef int gl_int;
typedef int gl_sizei;
typedef unsigned char gl_boolean;
typedef unsigned int gl_bitfield;
typedef float gl_float;
typedef char gl_char;
typedef ptrdiff_t gl_intptr;
typedef ptrdiff_t gl_sizeiptr;
typedef void *gl_sync;

/* Values from the Khronos registry (gl.xml). */
enum {
    GL_ZERO = 0,
    GL_ONE = 1,
    GL_POINTS = 0x0000,
    GL_TRIANGLES = 0x0004,
    GL_SRC_COLOR = 0x0300,
    GL_ONE_MINUS_SRC_COLOR = 0x0301,
    GL_CONSTANT_COLOR = 0x8001,
    GL_BLEND_COLOR = 0x8005,
    GL_FRONT = 0x0404,
    GL_BACK = 0x0405,
    GL_FRONT_AND_BACK = 0x0408,
    GL_INVALID_ENUM = 0x0500,
    GL_INVALID_VALUE = 0x0501,
    GL_INVALID_OPERATION = 0x0502,
    GL_TRANSFORM_FEEDBACK_PAUSED = 0x8E23,
    GL_TRANSFORM_FEEDBACK_ACTIVE = 0x8E24,
    GL_DEPTH_BUFFER_BIT = 0x0100,
    GL_OUT_OF_MEMORY = 0x0505,
    GL_POLYGON_MODE = 0x0B40,
    GL_POINT_SMOOTH = 0x0B10,
    GL_POINT_SIZE_RANGE = 0x0B12,
    GL_POLYGON_SMOOTH = 0x0B41,
    GL_POLYGON_STIPPLE = 0x0B42,
    GL_CULL_FACE = 0x0B44,
    GL_DEPTH_TEST = 0x0B71,
    GL_DEPTH_WRITEMASK = 0x0B72,
    GL_DEPTH_CLEAR_VALUE = 0x0B73,
    GL_STENCIL_TEST = 0x0B90,
    GL_VIEWPORT = 0x0BA2,
    GL_ALPHA_TEST = 0x0BC0,
    GL_BLEND = 0x0BE2,
    GL_COLOR_LOGIC_OP = 0x0BF2,
    GL_SCISSOR_BOX = 0x0C10,
    GL_SCISSOR_TEST = 0x0C11,
    GL_COLOR_WRITEMASK = 0x0C23,
    GL_UNPACK_SWAP_BYTES = 0x0CF0,
    GL_UNPACK_LSB_FIRST = 0x0CF1,
    GL_UNPACK_ROW_LENGTH = 0x0CF2,
    GL_UNPACK_SKIP_ROWS = 0x0CF3,
    GL_UNPACK_SKIP_PIXELS = 0x0CF4,
    GL_UNPACK_ALIGNMENT = 0x0CF5,
    GL_PACK_SWAP_BYTES = 0x0D00,
    GL_PACK_LSB_FIRST = 0x0D01,
    GL_PACK_ROW_LENGTH = 0x0D02,
    GL_PACK_SKIP_ROWS = 0x0D03,
    GL_PACK_SKIP_PIXELS = 0x0D04,
    GL_PACK_ALIGNMENT = 0x0D05,
    GL_RENDER_MODE = 0x0C40,
    GL_MAP_COLOR = 0x0D10,
    GL_MAP_STENCIL = 0x0D11,
    GL_INDEX_SHIFT = 0x0D12,
    GL_INDEX_OFFSET = 0x0D13,
    GL_RED_SCALE = 0x0D14,
    GL_RED_BIAS = 0x0D15,
    GL_GREEN_SCALE = 0x0D18,
    GL_GREEN_BIAS = 0x0D19,
    GL_BLUE_SCALE = 0x0D1A,
    GL_BLUE_BIAS = 0x0D1B,
    GL_ALPHA_SCALE = 0x0D1C,
    GL_ALPHA_BIAS = 0x0D1D,
    GL_DEPTH_SCALE = 0x0D1E,
    GL_DEPTH_BIAS = 0x0D1F,
    GL_RENDER = 0x1C00,
    GL_ALPHA = 0x1906,
    GL_LUMINANCE = 0x1909,
    GL_INT = 0x1404,
    GL_UNSIGNED_INT = 0x1405,
    GL_DEPTH_COMPONENT = 0x1902,
    GL_TEXTURE_TARGET = 0x1006,
    GL_TEXTURE_BASE_LEVEL = 0x813C,
    GL_TEXTURE_SWIZZLE_RGBA = 0x8E46,
    GL_GREEN = 0x1904,
    GL_BLUE = 0x1905,
    GL_DEPTH_TEXTURE_MODE = 0x884B,
    GL_DEPTH_STENCIL_TEXTURE_MODE = 0x90EA,
    GL_CLAMP_FRAGMENT_COLOR = 0x891B,
    GL_DELETE_STATUS = 0x8B80,
    GL_MAX_TEXTURE_SIZE = 0x0D33,
    GL_MAX_VIEWPORT_DIMS = 0x0D3A,
    GL_TEXTURE = 0x1702,
    GL_TEXTURE_2D = 0x0DE1,
    GL_TEXTURE_WIDTH = 0x1000,
    GL_TEXTURE_HEIGHT = 0x1001,
    GL_TEXTURE_INTERNAL_FORMAT = 0x1003,
    GL_TEXTURE_BORDER_COLOR = 0x1004,
    GL_UNSIGNED_BYTE = 0x1401,
    GL_FLOAT = 0x1406,
    GL_COLOR = 0x1800,
    GL_DEPTH = 0x1801,
    GL_RED = 0x1903,
    GL_RG = 0x8227,
    GL_R11F_G11F_B10F = 0x8C3A,
    GL_RGB10_A2 = 0x8059,
    GL_DRAW_BUFFER0 = 0x8825,
    GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL = 0x8CD2,
    GL_SAMPLES = 0x80A9,
    GL_RGBA = 0x1908,
    GL_FILL = 0x1B02,
    GL_VENDOR = 0x1F00,
    GL_RENDERER = 0x1F01,
    GL_VERSION = 0x1F02,
    GL_NEAREST = 0x2600,
    GL_LINEAR = 0x2601,
    GL_TEXTURE_MAG_FILTER = 0x2800,
    GL_TEXTURE_MIN_FILTER = 0x2801,
    GL_TEXTURE_WRAP_S = 0x2802,
    GL_TEXTURE_WRAP_T = 0x2803,
    GL_REPEAT = 0x2901,
    GL_CLIP_DISTANCE0 = 0x3000,
    GL_FUNC_ADD = 0x8006,
    GL_BLEND_EQUATION_RGB = 0x8009,
    GL_RGBA8 = 0x8058,
    GL_TEXTURE_BINDING_2D = 0x8069,
    GL_SAMPLE_COVERAGE = 0x80A0,
    GL_BLEND_DST_RGB = 0x80C8,
    GL_BLEND_SRC_RGB = 0x80C9,
    GL_BLEND_DST_ALPHA = 0x80CA,
    GL_BLEND_SRC_ALPHA = 0x80CB,
    GL_CLAMP_TO_BORDER = 0x812D,
    GL_CLAMP_TO_EDGE = 0x812F,
    GL_TEXTURE_MAX_LEVEL = 0x813D,
    GL_DEPTH_STENCIL_ATTACHMENT = 0x821A,
    GL_MAJOR_VERSION = 0x821B,
    GL_MINOR_VERSION = 0x821C,
    GL_NUM_EXTENSIONS = 0x821D,
    GL_R16 = 0x822A,
    GL_R32F = 0x822E,
    GL_RG_INTEGER = 0x8228,
    GL_RG32F = 0x8230,
    GL_RG32UI = 0x823C,
    GL_TEXTURE0 = 0x84C0,
    GL_ACTIVE_TEXTURE = 0x84E0,
    GL_TEXTURE_COMPARE_MODE = 0x884C,
    GL_TEXTURE_RED_SIZE = 0x805C,
    GL_TEXTURE_ALPHA_SIZE = 0x805F,
    GL_TEXTURE_DEPTH_SIZE = 0x884A,
    GL_TEXTURE_RED_TYPE = 0x8C10,
    GL_TEXTURE_ALPHA_TYPE = 0x8C13,
    GL_TEXTURE_DEPTH_TYPE = 0x8C16,
    GL_QUERY_RESULT = 0x8866,
    GL_QUERY_RESULT_AVAILABLE = 0x8867,
    GL_MAX_DRAW_BUFFERS = 0x8824,
    GL_BLEND_EQUATION_ALPHA = 0x883D,
    GL_DEPTH_BOUNDS_TEST_EXT = 0x8890,
    GL_STREAM_DRAW = 0x88E0,
    GL_STREAM_READ = 0x88E1,
    GL_PIXEL_PACK_BUFFER = 0x88EB,
    GL_PIXEL_UNPACK_BUFFER = 0x88EC,
    GL_PIXEL_PACK_BUFFER_BINDING = 0x88ED,
    GL_PIXEL_UNPACK_BUFFER_BINDING = 0x88EF,
    GL_TEXTURE_STENCIL_SIZE = 0x88F1,
    GL_SAMPLER_BINDING = 0x8919,
    GL_RGBA16F = 0x881A,
    GL_RGBA16 = 0x805B,
    GL_RGBA32F = 0x8814,
    GL_UNIFORM_BUFFER = 0x8A11,
    GL_UNIFORM_BUFFER_BINDING = 0x8A28,
    GL_UNIFORM_BUFFER_START = 0x8A29,
    GL_UNIFORM_BUFFER_SIZE = 0x8A2A,
    GL_UNIFORM_OFFSET = 0x8A3B,
    GL_UNIFORM_BLOCK_DATA_SIZE = 0x8A40,
    GL_FRAGMENT_SHADER = 0x8B30,
    GL_VERTEX_SHADER = 0x8B31,
    GL_COMPILE_STATUS = 0x8B81,
    GL_LINK_STATUS = 0x8B82,
    GL_PROGRAM_BINARY_RETRIEVABLE_HINT = 0x8257,
    GL_PROGRAM_BINARY_LENGTH = 0x8741,
    GL_NUM_PROGRAM_BINARY_FORMATS = 0x87FE,
    GL_CURRENT_PROGRAM = 0x8B8D,
    GL_VERTEX_ARRAY_BINDING = 0x85B5,
    GL_RASTERIZER_DISCARD = 0x8C89,
    GL_LOWER_LEFT = 0x8CA1,
    GL_DRAW_FRAMEBUFFER_BINDING = 0x8CA6,
    GL_READ_FRAMEBUFFER = 0x8CA8,
    GL_DRAW_FRAMEBUFFER = 0x8CA9,
    GL_READ_FRAMEBUFFER_BINDING = 0x8CAA,
    GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE = 0x8CD0,
    GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME = 0x8CD1,
    GL_FRAMEBUFFER_COMPLETE = 0x8CD5,
    GL_MAX_COLOR_ATTACHMENTS = 0x8CDF,
    GL_COLOR_ATTACHMENT0 = 0x8CE0,
    GL_DEPTH_ATTACHMENT = 0x8D00,
    GL_STENCIL_ATTACHMENT = 0x8D20,
    GL_STENCIL = 0x1802,
    GL_DEPTH_STENCIL = 0x84F9,
    GL_UNSIGNED_INT_24_8 = 0x84FA,
    GL_FLOAT_32_UNSIGNED_INT_24_8_REV = 0x8DAD,
    GL_DEPTH_COMPONENT16 = 0x81A5,
    GL_DEPTH_COMPONENT24 = 0x81A6,
    GL_DEPTH_COMPONENT32 = 0x81A7,
    GL_DEPTH_COMPONENT32F = 0x8CAC,
    GL_DEPTH24_STENCIL8 = 0x88F0,
    GL_DEPTH32F_STENCIL8 = 0x8CAD,
    GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE = 0x8211,
    GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE = 0x8216,
    GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE = 0x8217,
    GL_MAX_CLIP_DISTANCES = 0x0D32,
    GL_TIMESTAMP = 0x8E28,
    GL_SAMPLE_MASK = 0x8E51,
    GL_EXTENSIONS = 0x1F03,
    GL_PROGRAM_POINT_SIZE = 0x8642,
    GL_PRIMITIVE_RESTART = 0x8F9D,
    GL_TEXTURE_2D_MULTISAMPLE = 0x9100,
    GL_TEXTURE_BINDING_2D_MULTISAMPLE = 0x9104,
    GL_TEXTURE_BINDING_CUBE_MAP = 0x8514,
    GL_TEXTURE_CUBE_MAP = 0x8513,
    GL_TEXTURE_BINDING_2D_ARRAY = 0x8C1D,
    GL_TEXTURE_2D_ARRAY = 0x8C1A,
    GL_TEXTURE_BINDING_RECTANGLE = 0x84F6,
    GL_TEXTURE_RECTANGLE = 0x84F5,
    GL_SIGNED_NORMALIZED = 0x8F9C,
    GL_TEXTURE_GREEN_SIZE = 0x805D,
    GL_TEXTURE_BLUE_SIZE = 0x805E,
    GL_READ_ONLY = 0x88B8,
    GL_WRITE_ONLY = 0x88B9,
    GL_READ_WRITE = 0x88BA,
    GL_COMPUTE_SHADER = 0x91B9,
    GL_IMAGE_BINDING_NAME = 0x8F3A,
    GL_IMAGE_BINDING_LEVEL = 0x8F3B,
    GL_IMAGE_BINDING_LAYERED = 0x8F3C,
    GL_IMAGE_BINDING_LAYER = 0x8F3D,
    GL_IMAGE_BINDING_ACCESS = 0x8F3E,
    GL_IMAGE_BINDING_FORMAT = 0x906E,
    GL_TEXTURE_FETCH_BARRIER_BIT = 0x0008,
    GL_SHADER_IMAGE_ACCESS_BARRIER_BIT = 0x0020,
    GL_TEXTURE_UPDATE_BARRIER_BIT = 0x0100,
    GL_FRAMEBUFFER_BARRIER_BIT = 0x0400,
    GL_CLIP_ORIGIN = 0x935C,
    GL_CLIP_DEPTH_MODE = 0x935D,
    GL_SYNC_GPU_COMMANDS_COMPLETE = 0x9117,
    GL_ALREADY_SIGNALED = 0x911A,
    GL_CONDITION_SATISFIED = 0x911C,
    GL_CONTEXT_PROFILE_MASK = 0x9126,
    GL_CONTEXT_COMPATIBILITY_PROFILE_BIT = 2
};
#define GL_INVALID_INDEX 0xFFFFFFFFu /* does not fit an enumerator, which is an int */

/* X(returns, name without gl, arguments) */
#define GLSSAO_GL_FUNCTIONS(X)                                                                                         \
    X(void, ActiveTexture, (gl_enum unit))                                                                             \
    X(void, AttachShader, (gl_uint program, gl_uint shader))                                                           \
    X(void, BindBuffer, (gl_enum target, gl_uint buffer))                                                              \
    X(void, BindBufferBase, (gl_enum target, gl_uint index, gl_uint buffer))                                           \
    X(void, BindBufferRange, (gl_enum target, gl_uint index, gl_uint buffer, gl_intptr offset, gl_sizeiptr size))      \
    X(void, BindFramebuffer, (gl_enum target, gl_uint framebuffer))                                                    \
    X(void, BindSampler, (gl_uint unit, gl_uint sampler))                                                              \
    X(void, BindTexture, (gl_enum target, gl_uint texture))                                                            \
    X(void, BindVertexArray, (gl_uint array))                                                                          \
    X(void, BlendColor, (gl_float r, gl_float g, gl_float b, gl_float a))                                              \
    X(void, BlendEquationSeparate, (gl_enum rgb, gl_enum alpha))                                                       \
    X(void, BlendFuncSeparate, (gl_enum src_rgb, gl_enum dst_rgb, gl_enum src_alpha, gl_enum dst_alpha))               \
    X(void, BlitFramebuffer,                                                                                           \
      (gl_int x0, gl_int y0, gl_int x1, gl_int y1, gl_int to_x0, gl_int to_y0, gl_int to_x1, gl_int to_y1,             \
       gl_bitfield mask, gl_enum filter))                                                                              \
    X(void, BufferData, (gl_enum target, gl_sizeiptr size, const void *data, gl_enum usage))                           \
    X(void, BufferSubData, (gl_enum target, gl_intptr offset, gl_sizeiptr size, const void *data))                     \
    X(gl_enum, CheckFramebufferStatus, (gl_enum target))                                                               \
    X(void, Clear, (gl_bitfield mask))                                                                                 \
    X(void, ClearBufferfv, (gl_enum buffer, gl_int index, const gl_float *value))                                      \
    X(gl_enum, ClientWaitSync, (gl_sync sync, gl_bitfield flags, uint64_t timeout_ns))                                 \
    X(void, ColorMaski, (gl_uint index, gl_boolean r, gl_boolean g, gl_boolean b, gl_boolean a))                       \
    X(void, CompileShader, (gl_uint shader))                                                                           \
    X(void, CopyTexSubImage2D,                                                                                         \
      (gl_enum target, gl_int level, gl_int to_x, gl_int to_y, gl_int x, gl_int y, gl_sizei width, gl_sizei height))   \
    X(gl_uint, CreateProgram, (void))                                                                                  \
    X(gl_uint, CreateShader, (gl_enum type))                                                                           \
    X(void, DeleteBuffers, (gl_sizei n, const gl_uint *buffers))                                                       \
    X(void, DeleteFramebuffers, (gl_sizei n, const gl_uint *framebuffers))                                             \
    X(void, DeleteProgram, (gl_uint program))                                                                          \
    X(void, DeleteQueries, (gl_sizei n, const gl_uint *queries))                                                       \
    X(void, DeleteSamplers, (gl_sizei n, const gl_uint *samplers))                                                     \
    X(void, DeleteShader, (gl_uint shader))                                                                            \
    X(void, DeleteSync, (gl_sync sync))                                                                                \
    X(void, DeleteTextures, (gl_sizei n, const gl_uint *textures))                                                     \
    X(void, DeleteVertexArrays, (gl_sizei n, const gl_uint *arrays))                                                   \
    X(void, DepthMask, (gl_boolean flag))                                                                              \
    X(void, Disable, (gl_enum cap))                                                                                    \
    X(void, Disablei, (gl_enum cap, gl_uint index))                                                                    \
    X(void, DrawArrays, (gl_enum mode, gl_int first, gl_sizei count))                                                  \
    X(void, DrawBuffers, (gl_sizei n, const gl_enum *buffers))                                                         \
    X(void, Enable, (gl_enum cap))                                                                                     \
    X(void, Enablei, (gl_enum cap, gl_uint index))                                                                     \
    X(gl_sync, FenceSync, (gl_enum condition, gl_bitfield flags))                                                      \
    X(void, FramebufferTexture2D,                                                                                      \
      (gl_enum target, gl_enum attachment, gl_enum textarget, gl_uint texture, gl_int level))                          \
    X(void, GenBuffers, (gl_sizei n, gl_uint * buffers))                                                               \
    X(void, GenFramebuffers, (gl_sizei n, gl_uint * framebuffers))                                                     \
    X(void, GenQueries, (gl_sizei n, gl_uint * queries))                                                               \
    X(void, GenSamplers, (gl_sizei n, gl_uint * samplers))                                                             \
    X(void, GenTextures, (gl_sizei n, gl_uint * textures))                                                             \
    X(void, GenVertexArrays, (gl_sizei n, gl_uint * arrays))                                                           \
    X(void, GetActiveUniformBlockiv, (gl_uint program, gl_uint block, gl_enum name, gl_int * out))                     \
    X(void, GetActiveUniformsiv, (gl_uint program, gl_sizei n, const gl_uint *indices, gl_enum name, gl_int *out))     \
    X(void, GetBooleani_v, (gl_enum name, gl_uint index, gl_boolean * out))                                            \
    X(void, GetBooleanv, (gl_enum name, gl_boolean * out))                                                             \
    X(void, GetBufferSubData, (gl_enum target, gl_intptr offset, gl_sizeiptr size, void *data))                        \
    X(gl_enum, GetError, (void))                                                                                       \
    X(void, GetFloatv, (gl_enum name, gl_float * out))                                                                 \
    X(void, GetFramebufferAttachmentParameteriv, (gl_enum target, gl_enum attachment, gl_enum name, gl_int * out))     \
    X(void, GetInteger64i_v, (gl_enum name, gl_uint index, int64_t * out))                                             \
    X(void, GetIntegeri_v, (gl_enum name, gl_uint index, gl_int * out))                                                \
    X(void, GetIntegerv, (gl_enum name, gl_int * out))                                                                 \
    X(void, GetProgramInfoLog, (gl_uint program, gl_sizei size, gl_sizei * length, gl_char * log))                     \
    X(void, GetProgramiv, (gl_uint program, gl_enum name, gl_int * out))                                               \
    X(void, GetQueryObjectiv, (gl_uint query, gl_enum name, gl_int * out))                                             \
    X(void, GetQueryObjectui64v, (gl_uint query, gl_enum name, uint64_t * out))                                        \
    X(void, GetShaderInfoLog, (gl_uint shader, gl_sizei size, gl_sizei * length, gl_char * log))                       \
    X(void, GetShaderiv, (gl_uint shader, gl_enum name, gl_int * out))                                                 \
    X(const unsigned char *, GetString, (gl_enum name))                                                                \
    X(const unsigned char *, GetStringi, (gl_enum name, gl_uint index))                                                \
    X(void, GetTexLevelParameteriv, (gl_enum target, gl_int level, gl_enum name, gl_int * out))                        \
    X(gl_uint, GetUniformBlockIndex, (gl_uint program, const gl_char *name))                                           \
    X(void, GetUniformIndices, (gl_uint program, gl_sizei n, const gl_char *const *names, gl_uint *out))               \
    X(gl_int, GetUniformLocation, (gl_uint program, const gl_char *name))                                              \
    X(void, GetTexParameteriv, (gl_enum target, gl_enum name, gl_int * out))                                           \
    X(gl_boolean, IsEnabled, (gl_enum cap))                                                                            \
    X(gl_boolean, IsEnabledi, (gl_enum cap, gl_uint index))                                                            \
    X(gl_boolean, IsFramebuffer, (gl_uint framebuffer))                                                                \
    X(gl_boolean, IsTexture, (gl_uint texture))                                                                        \
    X(void, LinkProgram, (gl_uint program))                                                                            \
    X(void, PixelStorei, (gl_enum name, gl_int value))                                                                 \
    X(void, PolygonMode, (gl_enum face, gl_enum mode))                                                                 \
    X(void, QueryCounter, (gl_uint query, gl_enum target))                                                             \
    X(void, ReadPixels,                                                                                                \
      (gl_int x, gl_int y, gl_sizei width, gl_sizei height, gl_enum format, gl_enum type, void *pixels))               \
    X(void, SamplerParameterfv, (gl_uint sampler, gl_enum name, const gl_float *value))                                \
    X(void, SamplerParameteri, (gl_uint sampler, gl_enum name, gl_int value))                                          \
    X(void, Scissor, (gl_int x, gl_int y, gl_sizei width, gl_sizei height))                                            \
    X(void, ShaderSource, (gl_uint shader, gl_sizei n, const gl_char *const *text, const gl_int *lengths))             \
    X(void, TexImage2D,                                                                                                \
      (gl_enum target, gl_int level, gl_int internal_format, gl_sizei width, gl_sizei height, gl_int border,           \
       gl_enum format, gl_enum type, const void *pixels))                                                              \
    X(void, TexParameteri, (gl_enum target, gl_enum name, gl_int value))                                               \
    X(void, TexParameteriv, (gl_enum target, gl_enum name, const gl_int *values))                                      \
    X(void, Uniform2f, (gl_int location, gl_float x, gl_float y))                                                      \
    X(void, Uniform4f, (gl_int location, gl_float x, gl_float y, gl_float z, gl_float w))                              \
    X(void, Uniform1i, (gl_int location, gl_int value))                                                                \
    X(void, Uniform4i, (gl_int location, gl_int x, gl_int y, gl_int z, gl_int w))                                      \
    X(void, UniformBlockBinding, (gl_uint program, gl_uint block, gl_uint binding))                                    \
    X(void, UseProgram, (gl_uint program))                                                                             \
    X(void, Viewport, (gl_int x, gl_int y, gl_sizei width, gl_sizei height))

/* Functions of later versions or of the compatibility profile. They give a host that uses them its exact state back,
 * keep linked programs, and run passes as compute shaders. */
#define GLSSAO_GL_OPTIONAL_FUNCTIONS(X)                                                                                \
    X(void, BindImageTexture,                                                                                          \
      (gl_uint unit, gl_uint texture, gl_int level, gl_boolean layered, gl_int layer, gl_enum access, gl_enum format)) \
    X(void, ClampColor, (gl_enum target, gl_enum clamp))                                                               \
    X(void, GetTextureParameteriv, (gl_uint texture, gl_enum name, gl_int * out))                                      \
    X(void, PixelTransferf, (gl_enum name, gl_float value))                                                            \
    X(void, BlendEquationSeparatei, (gl_uint index, gl_enum rgb, gl_enum alpha))                                       \
    X(void, BlendFuncSeparatei,                                                                                        \
      (gl_uint index, gl_enum src_rgb, gl_enum dst_rgb, gl_enum src_alpha, gl_enum dst_alpha))                         \
    X(void, GetProgramBinary, (gl_uint program, gl_sizei size, gl_sizei * length, gl_enum * format, void *binary))     \
    X(void, DispatchCompute, (gl_uint x, gl_uint y, gl_uint z))                                                        \
    X(void, MemoryBarrier, (gl_bitfield barriers))                                                                     \
    X(void, ProgramBinary, (gl_uint program, gl_enum format, const void *binary, gl_sizei length))                     \
    X(void, ProgramParameteri, (gl_uint program, gl_enum name, gl_int value))                                          \
    X(void, ClipControl, (gl_enum origin, gl_enum depth))                                                              \
    X(void, ScissorIndexed, (gl_uint index, gl_int x, gl_int y, gl_sizei width, gl_sizei height))                      \
    X(void, ViewportIndexedf, (gl_uint index, gl_float x, gl_float y, gl_float width, gl_float height))

typedef struct glssao__gl {
#define GLSSAO_GL_MEMBER(returns, name, arguments) returns(GLSSAO_GL_CALL *name) arguments;
    GLSSAO_GL_FUNCTIONS(GLSSAO_GL_MEMBER)
    GLSSAO_GL_OPTIONAL_FUNCTIONS(GLSSAO_GL_MEMBER)
#undef GLSSAO_GL_MEMBER
    int version;            /* 10 * major + minor: 33 for 3.3 */
    bool compatibility;     /* a compatibility profile: fixed-function toggles exist */
    bool compute;           /* compute shaders that write images, by version or extensions */
    bool program_binaries;  /* linked programs can be read back */
    bool depth_bounds_test; /* GL_EXT_depth_bounds_test */
    bool is_software;       /* the processor rasterises */
    bool feedback_query;    /* the driver can be asked whether transform feedback is active */
    bool stencil_texturing; /* a depth-stencil texture may be set to give its stencil values */
    int max_size;           /* largest texture and viewport side, pixels */
    int max_draw_buffers;
    float max_point_size; /* pixels */
    int max_color_attachments;
    int max_clip_distances;
} glssao__gl;

/* Finds a GL function by either of the host's loaders; the one that is not used is NULL. */
typedef struct glssao__gl_loader {
    void *(*load)(const char *name, void *user);
    void *user;
    void (*(*get_proc)(const char *name))(void);
} glssao__gl_loader;

/* Fills the table and reads the limits of the current context. On failure returns false, and *out_missing names what
 * the context lacks, in static text ("glClear", "OpenGL 3.3"). */
bool glssao__gl_load(glssao__gl *gl, const glssao__gl_loader *loader, const char **out_missing);

/* For calls that are known to have failed: removes the GL error that they left, and says whether it was there. Errors
 * that the host had left are put back, as far as a call can cause them again. */
bool glssao__gl_take_error(const glssao__gl *gl, gl_enum error);

#endif
