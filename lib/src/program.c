/* SPDX-License-Identifier: MIT
 *
 * Programs, compiled when first needed; the uniform blocks' layout checked against the C structs by asking the driver.
 */
#include "effect.h"

#include <stdlib.h>

/* The source with line numbers as the driver counts them, a log line each. */
static void log_source(const glssao_effect *effect, const char *const *sources, int count)
{
    char line[160];
    size_t length = 0;
    int number = 1;
    for (int i = 0; i < count; ++i)
        for (const char *at = sources[i]; *at; ++at) {
            if (*at != '\n') {
                if (length + 1 < sizeof line)
                    line[length++] = *at;
                continue;
            }
            line[length] = '\0';
            glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%4d  %s", number++, line);
            length = 0;
        }
}

static gl_uint compile(const glssao_effect *effect, enum glssao__shader id, unsigned variant, gl_enum stage)
{
    const glssao__gl *gl = &effect->gl;
    const char *sources[GLSSAO__PROGRAM_MAX_SOURCES];
    int count = glssao__program_sources(gl, id, variant, stage, sources);
    gl_uint shader = gl->CreateShader(stage);
    gl->ShaderSource(shader, count, sources, NULL);
    gl->CompileShader(shader);
    gl_int ok = 0;
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok)
        return shader;
    char text[400] = "";
    gl->GetShaderInfoLog(shader, sizeof text, NULL, text);
    glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s shader of %s, variant %u: %s",
                      stage == GL_VERTEX_SHADER     ? "vertex"
                      : stage == GL_FRAGMENT_SHADER ? "fragment"
                                                    : "compute",
                      glssao__program_shader_name(id), variant, text);
    log_source(effect, sources, count);
    gl->DeleteShader(shader);
    return 0;
}

/* Where the driver puts a block's members against where C does; every member is active in a std140 block. */
static const struct member {
    enum glssao__block block;
    const char *name;
    size_t offset;
} members[] = {
#define SSAO(member)                                                                                                   \
    {                                                                                                                  \
        BLOCK_SSAO, #member, offsetof(glssao_constants, member)                                                        \
    }
    SSAO(gProj),
    SSAO(gInvProj),
    SSAO(gProjTex),
    SSAO(gOffsetVectors),
    SSAO(gBlurWeights),
    SSAO(gInvRenderTargetSize),
    SSAO(gOcclusionRadius),
    SSAO(gOcclusionFadeStart),
    SSAO(gOcclusionFadeEnd),
    SSAO(gSurfaceEpsilon),
#undef SSAO
#define FRAME(member)                                                                                                  \
    {                                                                                                                  \
        BLOCK_FRAME, #member, offsetof(glssao__frame_constants, member)                                                \
    }
    FRAME(gDistanceFromDepth),
    FRAME(gRayOrigin),
    FRAME(gRayDirection),
    FRAME(gSkyDepth),
    FRAME(gPower),
    FRAME(gBlurNormalThreshold),
    FRAME(gBlurDepthThreshold),
    FRAME(gSampleCount),
    FRAME(gFactor),
    FRAME(gNoise),
    FRAME(gAccumulation),
    FRAME(gProbe),
    FRAME(gDepthStep),
    FRAME(gLogDepth),
    FRAME(gTiles),
    FRAME(gPixel),
    FRAME(gEstimateSize),
    FRAME(gFullTexel),
    FRAME(gTileRings),
    FRAME(gPerRadius),
#undef FRAME
    {BLOCK_HEMISPHERE, "gKernel", offsetof(glssao__hemisphere_constants, gKernel)},
    {BLOCK_HEMISPHERE, "gRotations", offsetof(glssao__hemisphere_constants, gRotations)},
};

static const struct block {
    const char *name;
    size_t size;
} blocks[BLOCK_COUNT] = {{"cbSsao", sizeof(glssao_constants)},
                         {"cbFrame", sizeof(glssao__frame_constants)},
                         {"cbHemisphere", sizeof(glssao__hemisphere_constants)}};

/* Ties the blocks that the program has to their binding points; false where the driver lays one out otherwise. */
static bool bind_blocks(const glssao_effect *effect, gl_uint program)
{
    const glssao__gl *gl = &effect->gl;
    bool active[BLOCK_COUNT];
    for (gl_uint i = 0; i < BLOCK_COUNT; ++i) {
        gl_uint index = gl->GetUniformBlockIndex(program, blocks[i].name);
        active[i] = index != GL_INVALID_INDEX;
        if (!active[i])
            continue;
        gl->UniformBlockBinding(program, index, i);
        gl_int size = 0;
        gl->GetActiveUniformBlockiv(program, index, GL_UNIFORM_BLOCK_DATA_SIZE, &size);
        if (size < 0 || (size_t)size > blocks[i].size) {
            glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "block %s: %d bytes in the driver, %zu in C",
                              blocks[i].name, size, blocks[i].size);
            return false;
        }
    }
    for (size_t i = 0; i < sizeof members / sizeof *members; ++i) {
        if (!active[members[i].block])
            continue;
        gl_uint index = GL_INVALID_INDEX;
        gl_int offset = -1;
        gl->GetUniformIndices(program, 1, &members[i].name, &index);
        if (index != GL_INVALID_INDEX)
            gl->GetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, &offset);
        if (offset < 0 || (size_t)offset != members[i].offset) {
            glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "block %s: %s lies at %d in the driver, at %zu in C",
                              blocks[members[i].block].name, members[i].name, offset, members[i].offset);
            return false;
        }
    }
    return true;
}

/* `second` is 0 where the first is a program of its own. */
static gl_uint link(const glssao_effect *effect, enum glssao__shader id, gl_uint first, gl_uint second)
{
    const glssao__gl *gl = &effect->gl;
    gl_uint program = gl->CreateProgram();
    gl->AttachShader(program, first);
    if (second)
        gl->AttachShader(program, second);
    if (effect->cache_folder && gl->program_binaries)
        gl->ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, 1);
    gl->LinkProgram(program);
    gl_int ok = 0;
    gl->GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok) {
        char text[400] = "";
        gl->GetProgramInfoLog(program, sizeof text, NULL, text);
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "program %s does not link: %s",
                          glssao__program_shader_name(id), text);
    }
    if (ok && bind_blocks(effect, program))
        return program;
    gl->DeleteProgram(program);
    return 0;
}

static void tie_samplers(const glssao__gl *gl, gl_uint program)
{
    static const struct {
        const char *name;
        enum glssao__unit unit;
    } samplers[] = {
        {"u_normal_map", UNIT_NORMAL},   {"u_depth_map", UNIT_DEPTH},       {"u_random_vector_map", UNIT_RANDOM_VECTOR},
        {"u_ambient_map", UNIT_AMBIENT}, {"u_distance_map", UNIT_DISTANCE}, {"u_back_map", UNIT_BACK},
        {"u_second_map", UNIT_SECOND},   {"u_input_map", UNIT_DEPTH},       {"u_tile_map", UNIT_TILES},
    };
    gl->UseProgram(program);
    for (size_t i = 0; i < sizeof samplers / sizeof *samplers; ++i)
        gl->Uniform1i(gl->GetUniformLocation(program, samplers[i].name), (gl_int)samplers[i].unit); /* -1 is ignored */
}

static const glssao__program_object *find(const glssao_effect *effect, enum glssao__shader shader, unsigned variant)
{
    for (int i = 0; i < effect->program_count; ++i)
        if (effect->programs[i].shader == shader && effect->programs[i].variant == variant)
            return &effect->programs[i].object;
    return NULL;
}

/* From source. The name stays 0 where it fails. */
static void build(glssao_effect *effect, enum glssao__shader shader, unsigned variant, glssao__program_object *out)
{
    const glssao__gl *gl = &effect->gl;
    const bool drawn = !(variant & VARIANT_COMPUTE);
    gl_uint first = compile(effect, shader, variant, drawn ? GL_VERTEX_SHADER : GL_COMPUTE_SHADER);
    gl_uint second = first && drawn ? compile(effect, shader, variant, GL_FRAGMENT_SHADER) : 0;
    out->name = first && (second || !drawn) ? link(effect, shader, first, second) : 0;
    gl->DeleteShader(first); /* names of 0 are ignored; an attached shader lives as long as its program */
    gl->DeleteShader(second);
    if (out->name)
        glssao__cache_write(effect, shader, variant, out->name);
}

static glssao_result make(glssao_effect *effect, enum glssao__shader shader, unsigned variant,
                          glssao__program_object *out)
{
    const glssao__gl *gl = &effect->gl;
    *out = (glssao__program_object){.name = glssao__cache_read(effect, shader, variant)};
    /* Bindings are no part of what was kept. */
    if (out->name && !bind_blocks(effect, out->name)) {
        gl->DeleteProgram(out->name);
        out->name = 0;
    }
    if (!out->name)
        build(effect, shader, variant, out);
    if (!out->name)
        return GLSSAO_SHADER_ERROR;
    tie_samplers(gl, out->name);
    out->horizontal_location = gl->GetUniformLocation(out->name, "gHorizontalBlur");
    out->tile_range_location = gl->GetUniformLocation(out->name, "gTileRange");
    out->compute = variant & VARIANT_COMPUTE;
    glssao__program_group(shader, variant, out->group);
    out->region_location = gl->GetUniformLocation(out->name, "gRegion");
    out->origin_location = gl->GetUniformLocation(out->name, "gOrigin");
    return GLSSAO_OK;
}

glssao_result glssao__program_get(glssao_effect *effect, enum glssao__shader shader, unsigned variant,
                                  glssao__program_object *out)
{
    variant = glssao__program_variant(shader, variant, effect->gl.is_software);
    const glssao__program_object *found = find(effect, shader, variant);
    if (found) {
        *out = *found;
        return GLSSAO_OK;
    }
    struct glssao__compiled *grown =
        realloc(effect->programs, ((size_t)effect->program_count + 1) * sizeof *effect->programs);
    if (!grown) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "no memory for another program");
        return GLSSAO_OUT_OF_MEMORY;
    }
    effect->programs = grown;
    glssao_result result = make(effect, shader, variant, out);
    if (result == GLSSAO_OK)
        grown[effect->program_count++] = (struct glssao__compiled){shader, variant, *out};
    return result;
}
