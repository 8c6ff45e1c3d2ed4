/* SPDX-License-Identifier: MIT
 *
 * Fills the table of GL functions from the host's loader and looks at what the context is.
 */
#include "gpu/functions.h"

#include <string.h>

/* By what rasterisers on the processor call themselves. */
static bool names_software(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader", "SWR"};
    bool any = false;
    for (size_t i = 0; renderer && i < sizeof names / sizeof *names; ++i)
        any = any || strstr(renderer, names[i]) != NULL;
    return any;
}

static bool has_extension(const glssao__gl *gl, const char *name)
{
    gl_int count = 0;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (gl_int i = 0; i < count; ++i) {
        const unsigned char *extension = gl->GetStringi(GL_EXTENSIONS, (gl_uint)i);
        if (extension && strcmp((const char *)extension, name) == 0)
            return true;
    }
    return false;
}

static int read_version(const glssao__gl *gl)
{
    /* Embedded contexts answer the same queries with numbers of their own. */
    const char *text = (const char *)gl->GetString(GL_VERSION);
    if (!text || strncmp(text, "OpenGL ES", 9) == 0)
        return 0;
    gl_int major = 0, minor = 0;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    return 10 * major + minor;
}

static bool offers_compute(const glssao__gl *gl)
{
    const bool shaders = gl->version >= 43 || has_extension(gl, "GL_ARB_compute_shader");
    const bool images = gl->version >= 42 || has_extension(gl, "GL_ARB_shader_image_load_store");
    return shaders && images && gl->BindImageTexture && gl->DispatchCompute && gl->MemoryBarrier;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

typedef void (*any_function)(void);

/* ISO C has no cast from an object pointer to a function pointer; every platform with OpenGL stores them alike. */
static any_function find(const glssao__gl_loader *loader, const char *name)
{
    if (!loader->load)
        return loader->get_proc(name);
    void *const address = loader->load(name, loader->user);
    any_function function;
    memcpy(&function, &address, sizeof function);
    return function;
}

bool glssao__gl_load(glssao__gl *gl, const glssao__gl_loader *loader, const char **out_missing)
{
    memset(gl, 0, sizeof *gl);
    any_function function;
#define LOAD(returns, name, arguments)                                                                                 \
    function = find(loader, "gl" #name);                                                                               \
    memcpy(&gl->name, &function, sizeof function);
#define LOAD_REQUIRED(returns, name, arguments)                                                                        \
    LOAD(returns, name, arguments)                                                                                     \
    if (!gl->name) {                                                                                                   \
        *out_missing = "gl" #name;                                                                                     \
        return false;                                                                                                  \
    }
    GLSSAO_GL_FUNCTIONS(LOAD_REQUIRED)
    gl->version = read_version(gl);
    if (gl->version < 33) {
        *out_missing = "OpenGL 3.3";
        return false;
    }
    GLSSAO_GL_OPTIONAL_FUNCTIONS(LOAD)
#undef LOAD_REQUIRED
#undef LOAD

    /* A loader may hand out a stub for a name that the context lacks, so the version or extension decides. */
    if (gl->version < 40 && !has_extension(gl, "GL_ARB_draw_buffers_blend")) {
        gl->BlendEquationSeparatei = NULL;
        gl->BlendFuncSeparatei = NULL;
    }
    if (gl->version < 41 && !has_extension(gl, "GL_ARB_viewport_array"))
        gl->ViewportIndexedf = NULL;
    if (gl->version < 45 && !has_extension(gl, "GL_ARB_clip_control"))
        gl->ClipControl = NULL;
    gl->compute = offers_compute(gl);
    gl_int formats = 0;
    if ((gl->version >= 41 || has_extension(gl, "GL_ARB_get_program_binary")) && gl->GetProgramBinary &&
        gl->ProgramBinary && gl->ProgramParameteri)
        gl->GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    gl->program_binaries = formats > 0;
    gl->is_software = names_software((const char *)gl->GetString(GL_RENDERER));
    gl->depth_bounds_test = has_extension(gl, "GL_EXT_depth_bounds_test");
    gl->stencil_texturing = gl->version >= 43 || has_extension(gl, "GL_ARB_stencil_texturing");
    gl->feedback_query = gl->version >= 40 || has_extension(gl, "GL_ARB_transform_feedback2");

    gl_int mask = 0, texture_size = 0, viewport[2] = {0, 0};
    gl->GetIntegerv(GL_CONTEXT_PROFILE_MASK, &mask);
    gl->compatibility = (mask & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
    if (!gl->compatibility)
        gl->ClampColor = NULL, gl->PixelTransferf = NULL;
    if (gl->compatibility || gl->version < 45) /* Mesa knows GL_TEXTURE_TARGET in core contexts alone */
        gl->GetTextureParameteriv = NULL;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture_size);
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    gl->max_size = smaller(texture_size, smaller(viewport[0], viewport[1]));
    gl_float point_sizes[2] = {1.0f, 1.0f};
    gl->GetFloatv(GL_POINT_SIZE_RANGE, point_sizes);
    gl->max_point_size = point_sizes[1];
    gl->GetIntegerv(GL_MAX_DRAW_BUFFERS, &gl->max_draw_buffers);
    gl->GetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &gl->max_color_attachments);
    gl->GetIntegerv(GL_MAX_CLIP_DISTANCES, &gl->max_clip_distances);
    return true;
}

bool glssao__gl_take_error(const glssao__gl *gl, gl_enum error)
{
    /* A driver has one flag in all, or one for each kind of error. */
    bool is_enum = false, is_value = false;
    gl_enum found = gl->GetError();
    for (int i = 0; i < 8 && found != error && found != 0; ++i) {
        is_enum = is_enum || found == GL_INVALID_ENUM;
        is_value = is_value || found == GL_INVALID_VALUE;
        found = gl->GetError();
    }
    if (is_enum)
        gl->Enable(GL_INVALID_ENUM); /* no such capability */
    if (is_value)
        gl->Clear(~0u); /* no such buffers */
    return found == error;
}
