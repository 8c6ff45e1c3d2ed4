/* SPDX-License-Identifier: MIT
 *
 * The shaders and their variants, in one table each; compiled when first needed; the uniform blocks' layout checked
 * against the C structs by asking the driver.
 */
#include "effect.h"
#include "shaders.h"

#include <stdlib.h>

static const char *const macros[VARIANT_FLAGS] = {
    "UNSIGNED_NORMALS",
    "OCTAHEDRAL_NORMALS",
    "DEPTH_IS_DISTANCE",
    "DEPTH_IN_ALPHA",
    "NO_ANGLE_WEIGHT",
    "BOX",
    "EDGE_AWARE",
    "STEPS_8",
    "STEPS_12",
    "STEPS_16",
    "SLICES_2",
    "ACCUMULATE",
    "LAYERS",
    "PAIRED",
    "MULTISAMPLE",
    "LOGARITHMIC",
    "OPEN",
    "PLANES",
    "FROM_DEPTH",
    "COMPUTE",
    "UPSAMPLE",
    "ROUNDS_1",
    "ROUNDS_2",
    "WIDE",
    "PERSPECTIVE",
    "BRANCHES",
};

enum {
    NORMAL_FLAGS = VARIANT_UNSIGNED_NORMALS | VARIANT_OCTAHEDRAL_NORMALS,
    DEPTH_FLAGS = VARIANT_DEPTH_IS_DISTANCE | VARIANT_DEPTH_IN_ALPHA,
    TILE_FLAGS = NORMAL_FLAGS | DEPTH_FLAGS | VARIANT_PLANES | VARIANT_FROM_DEPTH,
    STEP_FLAGS = VARIANT_STEPS_8 | VARIANT_STEPS_12 | VARIANT_STEPS_16,
    ROUND_FLAGS = VARIANT_ROUNDS_1 | VARIANT_ROUNDS_2,
    FILES = 6
};

/* What each shader is compiled from, and which flags it tests. All flags are defined in all, as 0 or 1. */
static const struct shader {
    const char *name;
    unsigned flags;
    const char *files[FILES]; /* after the blocks, in order; the last ones are the pass itself, and its entry point
                                 where that is apart */
} shaders[SHADER_COUNT] = {
    [SHADER_INPUT] = {"input", VARIANT_MULTISAMPLE | VARIANT_LOGARITHMIC, {shader_view_glsl, shader_input_frag}},
    [SHADER_NORMALS] = {"normals", DEPTH_FLAGS, {shader_view_glsl, shader_normals_frag}},
    [SHADER_CLASSIC] = {"classic",
                        NORMAL_FLAGS | DEPTH_FLAGS | VARIANT_NO_ANGLE_WEIGHT | VARIANT_PAIRED | VARIANT_OPEN,
                        {shader_view_glsl, shader_normal_map_glsl, shader_paired_glsl, shader_classic_frag}},
    [SHADER_HEMISPHERE] = {"hemisphere",
                           NORMAL_FLAGS | DEPTH_FLAGS | VARIANT_PAIRED | VARIANT_OPEN,
                           {shader_view_glsl, shader_normal_map_glsl, shader_paired_glsl, shader_hemisphere_frag}},
    [SHADER_DISTANCE] = {"distance",
                         DEPTH_FLAGS | VARIANT_LAYERS | VARIANT_COMPUTE,
                         {shader_view_glsl, shader_distance_frag, shader_entry_glsl}},
    [SHADER_HORIZON] = {"horizon",
                        NORMAL_FLAGS | STEP_FLAGS | VARIANT_SLICES_2 | VARIANT_ACCUMULATE | VARIANT_LAYERS |
                            VARIANT_PAIRED | VARIANT_OPEN | VARIANT_COMPUTE | VARIANT_PERSPECTIVE | VARIANT_BRANCHES,
                        {shader_view_glsl, shader_normal_map_glsl, shader_paired_glsl, shader_horizon_frag,
                         shader_entry_glsl}},
    [SHADER_RESOLVE] = {"resolve",
                        NORMAL_FLAGS | VARIANT_PAIRED,
                        {shader_view_glsl, shader_normal_map_glsl, shader_paired_glsl, shader_resolve_frag}},
    [SHADER_PROBE] = {"probe", 0, {shader_view_glsl, shader_probe_frag}},
    [SHADER_PLANAR_BLUR] = {"planar-blur",
                            VARIANT_PAIRED | VARIANT_WIDE | VARIANT_BRANCHES,
                            {shader_view_glsl, shader_paired_glsl, shader_planar_blur_glsl, shader_planar_blur_frag,
                             shader_entry_glsl}},
    [SHADER_UPSAMPLE] = {"upsample",
                         NORMAL_FLAGS | DEPTH_FLAGS,
                         {shader_view_glsl, shader_normal_map_glsl, shader_paired_glsl, shader_upsample_glsl,
                          shader_upsample_frag}},
    [SHADER_SPREAD] = {"spread", 0, {shader_view_glsl, shader_spread_frag}},
    [SHADER_PLANAR_TILE] = {"planar-tile",
                            NORMAL_FLAGS | DEPTH_FLAGS | VARIANT_PAIRED | VARIANT_COMPUTE | VARIANT_UPSAMPLE |
                                ROUND_FLAGS | VARIANT_WIDE | VARIANT_BRANCHES,
                            {shader_view_glsl, shader_normal_map_glsl, shader_paired_glsl, shader_planar_blur_glsl,
                             shader_upsample_glsl, shader_planar_tile_comp}},
    [SHADER_BLUR] = {"blur",
                     NORMAL_FLAGS | DEPTH_FLAGS | VARIANT_BOX | VARIANT_EDGE_AWARE | VARIANT_PAIRED | VARIANT_COMPUTE,
                     {shader_view_glsl, shader_normal_map_glsl, shader_paired_glsl, shader_blur_frag,
                      shader_entry_glsl}},
    [SHADER_APPLY] = {"apply", 0, {shader_apply_frag}},
    [SHADER_TILE_ROWS] = {"tile-rows",
                          TILE_FLAGS,
                          {shader_view_glsl, shader_normal_map_glsl, shader_tile_map_glsl, shader_tile_rows_frag}},
    [SHADER_TILE_BOUNDS] = {"tile-bounds",
                            TILE_FLAGS,
                            {shader_view_glsl, shader_normal_map_glsl, shader_tile_map_glsl, shader_tile_bounds_frag}},
    [SHADER_TILE_CLASS] = {"tile-class",
                           TILE_FLAGS,
                           {shader_view_glsl, shader_normal_map_glsl, shader_tile_map_glsl, shader_tile_class_frag}},
    [SHADER_TILE_RINGS] = {"tile-rings", 0, {shader_tile_rings_frag}},
};

/* Invocations of a work group, and the rows of a tile that they share (glsl/planar_tile.comp); found by experiment,
 * docs/decisions.md. */
#define SIZES(x, y, rows)                                                                                              \
    {                                                                                                                  \
        x, y, rows, "#define GROUP_X " #x "\n#define GROUP_Y " #y "\n#define HEIGHT " #rows "\n"                       \
    }
static const struct sizes {
    int x, y, rows;
    const char *macros;
} row_sizes = SIZES(32, 8, 0), horizon_sizes = SIZES(8, 16, 0), tile_sizes = SIZES(32, 14, 28);
#undef SIZES

static const struct sizes *sizes_of(enum glssao__shader shader)
{
    return shader == SHADER_PLANAR_TILE ? &tile_sizes : shader == SHADER_HORIZON ? &horizon_sizes : &row_sizes;
}

/* Pixels of the target that a work group makes. */
static void find_group(enum glssao__shader shader, unsigned variant, int out[2])
{
    const struct sizes *sizes = sizes_of(shader);
    const int first_reach = variant & VARIANT_WIDE ? 3 : 2, later_reach = 3;
    const int halo = variant & VARIANT_ROUNDS_2   ? first_reach + later_reach
                     : variant & VARIANT_ROUNDS_1 ? first_reach
                                                  : 0;
    const int factor = variant & VARIANT_UPSAMPLE ? 2 : 1;
    const bool tile = shader == SHADER_PLANAR_TILE;
    out[0] = tile ? factor * (sizes->x - 2 * halo - factor + 1) : sizes->x;
    out[1] = tile ? factor * (sizes->rows - 2 * halo - factor + 1) : sizes->y;
}

const char *glssao__program_shader_name(enum glssao__shader shader)
{
    return shaders[shader].name;
}

unsigned glssao__program_flags(enum glssao__shader shader)
{
    return shaders[shader].flags;
}

bool glssao__program_exists(enum glssao__shader shader, unsigned variant)
{
    if (variant & ~shaders[shader].flags)
        return false;
    bool both_encodings = (variant & NORMAL_FLAGS) == NORMAL_FLAGS;
    unsigned steps = variant & STEP_FLAGS;
    bool alpha_alone = (variant & VARIANT_DEPTH_IN_ALPHA) && !(variant & VARIANT_DEPTH_IS_DISTANCE);
    bool is_sum = (variant & VARIANT_ACCUMULATE) && (variant & VARIANT_PAIRED);
    /* What is added by blending, or drawn beside tiles. */
    bool drawn_alone = (variant & (VARIANT_ACCUMULATE | VARIANT_OPEN)) && (variant & VARIANT_COMPUTE);
    bool edges_needed = (variant & (NORMAL_FLAGS | DEPTH_FLAGS)) == 0 || (variant & VARIANT_EDGE_AWARE);
    /* Of a tile: its last step is the blur's or upsampling, and what upsampling reads counts for that alone. */
    bool tile_known =
        shader != SHADER_PLANAR_TILE ||
        ((variant & VARIANT_COMPUTE) && (variant & ROUND_FLAGS) != ROUND_FLAGS &&
         ((variant & ROUND_FLAGS) || !(variant & VARIANT_WIDE)) &&
         (variant & VARIANT_UPSAMPLE ? !(variant & VARIANT_PAIRED)
                                     : (variant & ROUND_FLAGS) && !(variant & (NORMAL_FLAGS | DEPTH_FLAGS))));
    /* The others ask the constants, since a branch that all pixels take alike costs them nothing to speak of. */
    bool projection_known = (variant & VARIANT_PERSPECTIVE) && !(variant & VARIANT_BRANCHES);
    bool branches =
        (shaders[shader].flags & VARIANT_BRANCHES) && (variant & VARIANT_COMPUTE) && !(variant & VARIANT_BRANCHES);
    return !both_encodings && !projection_known && !branches && !is_sum && !drawn_alone && (steps & (steps - 1)) == 0 &&
           !alpha_alone && tile_known && (shader != SHADER_BLUR || edges_needed);
}

int glssao__program_sources(enum glssao__shader shader, unsigned variant, gl_enum stage,
                            const char *out_sources[GLSSAO__PROGRAM_MAX_SOURCES])
{
    int n = 0;
    /* The driver may be told two other first lines, see `compile`. */
    out_sources[n++] = stage == GL_COMPUTE_SHADER ? "#version 430\n" : "#version 330\n";
    out_sources[n++] = "#define PRECISE\n#define FMA(a, b, c) ((a) * (b) + (c))\n";
    if (stage == GL_VERTEX_SHADER) {
        out_sources[n++] = shader_fullscreen_vert;
        return n;
    }
    for (int i = 0; i < VARIANT_FLAGS; ++i) {
        out_sources[n++] = "#define ";
        out_sources[n++] = macros[i];
        out_sources[n++] = variant & 1u << i ? " 1\n" : " 0\n";
    }
    out_sources[n++] = "layout(std140) uniform cbSsao {\n";
    out_sources[n++] = shader_cb_ssao_glsl;
    out_sources[n++] = "};\nlayout(std140) uniform cbFrame {\n";
    out_sources[n++] = shader_cb_frame_glsl;
    if (shader == SHADER_HEMISPHERE) {
        out_sources[n++] = "};\nlayout(std140) uniform cbHemisphere {\n";
        out_sources[n++] = shader_cb_hemisphere_glsl;
    }
    out_sources[n++] = "};\n";
    if (stage == GL_COMPUTE_SHADER)
        out_sources[n++] = sizes_of(shader)->macros;
    for (int i = 0; i < FILES && shaders[shader].files[i]; ++i)
        out_sources[n++] = shaders[shader].files[i];
    return n;
}

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
    int count = glssao__program_sources(id, variant, stage, sources);
    if (stage == GL_COMPUTE_SHADER && gl->version < 43)
        sources[0] = "#version 330\n#extension GL_ARB_compute_shader : require\n"
                     "#extension GL_ARB_shader_image_load_store : require\n";
    /* Classic and hemisphere are estimated one way only. */
    if (gl->precise && id != SHADER_CLASSIC && id != SHADER_HEMISPHERE)
        sources[1] = gl->is_software ? "#extension GL_ARB_gpu_shader5 : require\n"
                                       "#define PRECISE precise\n#define FMA(a, b, c) ((a) * (b) + (c))\n"
                                     : "#extension GL_ARB_gpu_shader5 : require\n"
                                       "#define PRECISE precise\n#define FMA(a, b, c) fma(a, b, c)\n";
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
                      shaders[id].name, variant, text);
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
    FRAME(gTileRings),
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
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "program %s does not link: %s", shaders[id].name, text);
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
    find_group(shader, variant, out->group);
    out->region_location = gl->GetUniformLocation(out->name, "gRegion");
    out->origin_location = gl->GetUniformLocation(out->name, "gOrigin");
    return GLSSAO_OK;
}

glssao_result glssao__program_get(glssao_effect *effect, enum glssao__shader shader, unsigned variant,
                                  glssao__program_object *out)
{
    /* A software rasteriser takes both sides of a branch. */
    if (!effect->gl.is_software || (variant & VARIANT_COMPUTE))
        variant |= VARIANT_BRANCHES;
    else
        variant &= ~(unsigned)VARIANT_PERSPECTIVE;
    variant &= shaders[shader].flags;
    if (shader == SHADER_BLUR && !(variant & VARIANT_EDGE_AWARE))
        variant &= VARIANT_BOX | VARIANT_PAIRED | VARIANT_COMPUTE; /* it reads neither normals nor depth */
    if (shader == SHADER_PLANAR_TILE && !(variant & VARIANT_UPSAMPLE))
        variant &= VARIANT_PAIRED | VARIANT_COMPUTE | VARIANT_BRANCHES | ROUND_FLAGS | VARIANT_WIDE;
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
