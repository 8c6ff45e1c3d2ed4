/* SPDX-License-Identifier: MIT
 *
 * The shaders and their variants, in one table each: which exist, what each is compiled from, and what a work group
 * makes.
 */
#include "effect.h"
#include "shaders.h"

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
                            VARIANT_PAIRED | VARIANT_WIDE | VARIANT_PERSPECTIVE | VARIANT_BRANCHES,
                            {shader_view_glsl, shader_paired_glsl, shader_planar_blur_glsl, shader_planar_blur_frag,
                             shader_entry_glsl}},
    [SHADER_UPSAMPLE] = {"upsample",
                         NORMAL_FLAGS | DEPTH_FLAGS | VARIANT_PERSPECTIVE | VARIANT_BRANCHES,
                         {shader_view_glsl, shader_normal_map_glsl, shader_paired_glsl, shader_upsample_glsl,
                          shader_upsample_frag}},
    [SHADER_SPREAD] = {"spread", 0, {shader_view_glsl, shader_spread_frag}},
    [SHADER_PLANAR_TILE] = {"planar-tile",
                            NORMAL_FLAGS | DEPTH_FLAGS | VARIANT_PAIRED | VARIANT_COMPUTE | VARIANT_UPSAMPLE |
                                ROUND_FLAGS | VARIANT_WIDE | VARIANT_PERSPECTIVE | VARIANT_BRANCHES,
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

void glssao__program_group(enum glssao__shader shader, unsigned variant, int out[2])
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
    bool branches =
        (shaders[shader].flags & VARIANT_BRANCHES) && (variant & VARIANT_COMPUTE) && !(variant & VARIANT_BRANCHES);
    return !both_encodings && !branches && !is_sum && !drawn_alone && (steps & (steps - 1)) == 0 && !alpha_alone &&
           tile_known && (shader != SHADER_BLUR || edges_needed);
}

/* What the driver knows beyond GLSL 3.30; glsl/view.glsl says what the macros stand for. */
static const char *arithmetic(const glssao__gl *gl, enum glssao__shader shader)
{
#define EXACT "#extension GL_ARB_gpu_shader5 : require\n#define PRECISE precise\n"
#define PLAIN "#define FMA(a, b, c) ((a) * (b) + (c))\n#define ROOT(x) sqrt(x)\n#define ROUND(x) roundEven(x)\n"
    /* Classic and hemisphere are estimated one way only. */
    if (!gl || !gl->precise || shader == SHADER_CLASSIC || shader == SHADER_HEMISPHERE)
        return "#define PRECISE\n" PLAIN;
    if (gl->is_software)
        return EXACT PLAIN;
    return EXACT "#define FMA(a, b, c) fma(a, b, c)\n#define ROOT(x) ((x) * inversesqrt(x))\n"
                 "#define ROUND(x) ((x) + 12582912.0 - 12582912.0)\n";
#undef EXACT
#undef PLAIN
}

int glssao__program_sources(const glssao__gl *gl, enum glssao__shader shader, unsigned variant, gl_enum stage,
                            const char *out_sources[GLSSAO__PROGRAM_MAX_SOURCES])
{
    int n = 0;
    if (stage != GL_COMPUTE_SHADER)
        out_sources[n++] = "#version 330\n";
    else if (!gl || gl->version >= 43)
        out_sources[n++] = "#version 430\n";
    else
        out_sources[n++] = "#version 330\n#extension GL_ARB_compute_shader : require\n"
                           "#extension GL_ARB_shader_image_load_store : require\n";
    out_sources[n++] = arithmetic(gl, shader);
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

unsigned glssao__program_variant(enum glssao__shader shader, unsigned variant, bool is_software)
{
    /* A software rasteriser takes both sides of a branch. */
    if (!is_software || (variant & VARIANT_COMPUTE))
        variant |= VARIANT_BRANCHES;
    variant &= shaders[shader].flags;
    if (shader == SHADER_BLUR && !(variant & VARIANT_EDGE_AWARE))
        variant &= VARIANT_BOX | VARIANT_PAIRED | VARIANT_COMPUTE; /* it reads neither normals nor depth */
    if (shader == SHADER_PLANAR_TILE && !(variant & VARIANT_UPSAMPLE))
        variant &=
            VARIANT_PAIRED | VARIANT_COMPUTE | VARIANT_PERSPECTIVE | VARIANT_BRANCHES | ROUND_FLAGS | VARIANT_WIDE;
    return variant;
}
