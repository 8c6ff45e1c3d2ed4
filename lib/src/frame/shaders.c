/* SPDX-License-Identifier: MIT
 *
 * The table of shaders, and the assembly of their sources.
 */
#include "frame/shaders.h"

#include "frame/unroll.h"
#include "gpu/programs.h"
#include "shaders_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct macro {
    const char *name;
    int most;
} macros[MACRO_COUNT] = {
#define ROW(name, most) {#name, most},
    GLSSAO__MACROS(ROW)
#undef ROW
};

#define BIT(macro) (UINT64_C(1) << MACRO_##macro)

enum { FILES = 10 };

/* What each shader is assembled from, in order, and which macros it tests. */
static const struct shader {
    const char *name;
    uint64_t tests;
    const char *files[FILES];
} shaders[SHADER_COUNT] = {
    [SHADER_INPUT] = {"input",
                      BIT(MULTISAMPLE) | BIT(LOGARITHMIC) | BIT(OBLIQUE),
                      {shader_pixel_glsl, shader_input_frag}},
    [SHADER_NORMALS] = {"normals",
                        BIT(DENSE) | BIT(DEPTH) | BIT(PERSPECTIVE) | BIT(COMPUTE) | BIT(TURNED),
                        {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normals_frag,
                         shader_entry_glsl}},
    [SHADER_DISTANCE] = {"distance",
                         BIT(RADIUS_GROWS) | BIT(DEPTH) | BIT(LAYERS) | BIT(COMPUTE) | BIT(VARIES) | BIT(DENSE),
                         {shader_pixel_glsl, shader_depth_glsl, shader_distance_frag, shader_entry_glsl}},
    [SHADER_OPEN] = {"open",
                     BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(FROM_DEPTH) | BIT(BENT) | BIT(VARIES) | BIT(DENSE),
                     {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                      shader_paired_glsl, shader_open_frag}},
    [SHADER_CLASSIC] = {"classic",
                        BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(NO_ANGLE_WEIGHT) |
                            BIT(OUTPUT) | BIT(VARIES) | BIT(DENSE),
                        {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_depth_filter_glsl,
                         shader_normal_map_glsl, shader_paired_glsl, shader_classic_frag}},
    [SHADER_HEMISPHERE] = {"hemisphere",
                           BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(OUTPUT) | BIT(VARIES) |
                               BIT(DENSE),
                           {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_depth_filter_glsl,
                            shader_normal_map_glsl, shader_paired_glsl, shader_hemisphere_frag}},
    [SHADER_HORIZON] = {"horizon",
                        BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(STEPS) | BIT(SLICES) | BIT(OUTPUT) |
                            BIT(LAYERS) | BIT(COMPUTE) | BIT(PERSPECTIVE) | BIT(BRANCHES) | BIT(LOOPS) | BIT(BENT) |
                            BIT(VARIES) | BIT(DENSE),
                        {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                         shader_bent_glsl, shader_paired_glsl, shader_horizon_frag, shader_entry_glsl}},
    [SHADER_RESOLVE] = {"resolve",
                        BIT(NORMALS) | BIT(TURNED) | BIT(OUTPUT) | BIT(BENT),
                        {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                         shader_bent_glsl, shader_paired_glsl, shader_resolve_frag, shader_entry_glsl}},
    [SHADER_PROBE] = {"probe", BIT(BENT), {shader_pixel_glsl, shader_depth_glsl, shader_probe_frag}},
    [SHADER_BLUR] = {"blur",
                     BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(FILTER) | BIT(OUTPUT) | BIT(COMPUTE) | BIT(BENT) |
                         BIT(VARIES) | BIT(DENSE),
                     {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                      shader_bent_glsl, shader_paired_glsl, shader_blur_frag, shader_entry_glsl}},
    [SHADER_PLANAR_BLUR] = {"planar-blur",
                            BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(OUTPUT) | BIT(WIDE) |
                                BIT(PERSPECTIVE) | BIT(BRANCHES) | BIT(COMPUTE) | BIT(STRIDE) | BIT(RAYS) |
                                BIT(CORRECTS) | BIT(BENT),
                            {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                             shader_bent_glsl, shader_paired_glsl, shader_planar_blur_glsl, shader_planar_blur_frag,
                             shader_entry_glsl}},
    [SHADER_PLANAR_TILE] = {"planar-tile",
                            BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(OUTPUT) | BIT(COMPUTE) |
                                BIT(UPSAMPLE) | BIT(ROUNDS) | BIT(WIDE) | BIT(PERSPECTIVE) | BIT(BRANCHES) | BIT(BENT) |
                                BIT(RAW) | BIT(RAYS),
                            {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                             shader_bent_glsl, shader_paired_glsl, shader_planar_blur_glsl, shader_upsample_glsl,
                             shader_planar_tile_comp}},
    [SHADER_UPSAMPLE] = {"upsample",
                         BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(PERSPECTIVE) |
                             BIT(BRANCHES) | BIT(BENT) | BIT(RAW) | BIT(RAYS),
                         {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                          shader_bent_glsl, shader_paired_glsl, shader_upsample_glsl, shader_upsample_frag}},
    [SHADER_SPREAD] = {"spread", BIT(BENT), {shader_pixel_glsl, shader_spread_frag}},
    [SHADER_RAYS] = {"rays",
                     BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(OUTPUT) | BIT(COMPUTE) | BIT(PERSPECTIVE) |
                         BIT(RAYS) | BIT(CORRECTS) | BIT(DENSE) | BIT(VARIES),
                     {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                      shader_paired_glsl, shader_rays_map_glsl, shader_rays_frag, shader_entry_glsl}},
    [SHADER_HISTORY] = {"history",
                        BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(PERSPECTIVE) | BIT(COMPUTE) |
                            BIT(RAW) | BIT(MOTION) | BIT(RAYS),
                        {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                         shader_paired_glsl, shader_history_glsl, shader_history_frag, shader_entry_glsl}},
    [SHADER_STEADY] = {"steady",
                       BIT(RADIUS_GROWS) | BIT(PERSPECTIVE) | BIT(COMPUTE) | BIT(RAYS) | BIT(BRANCHES),
                       {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_paired_glsl,
                        shader_history_glsl, shader_steady_frag, shader_entry_glsl}},
    [SHADER_APPLY] = {"apply",
                      BIT(COMPUTE) | BIT(STRENGTH) | BIT(ALBEDO) | BIT(TINTED) | BIT(IMAGE),
                      {shader_apply_frag}},
    [SHADER_TILE_ROWS] = {"tile-rows",
                          BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(PLANES) | BIT(FROM_DEPTH) | BIT(VARIES) |
                              BIT(DENSE),
                          {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                           shader_tile_map_glsl, shader_tile_rows_frag}},
    [SHADER_TILE_BOUNDS] = {"tile-bounds",
                            BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(PLANES) | BIT(FROM_DEPTH) | BIT(VARIES) |
                                BIT(DENSE),
                            {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                             shader_tile_map_glsl, shader_tile_bounds_frag}},
    [SHADER_TILE_CLASS] = {"tile-class",
                           BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(PLANES) | BIT(FROM_DEPTH) |
                               BIT(VARIES) | BIT(DENSE) | BIT(MIDDLES),
                           {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                            shader_tile_map_glsl, shader_tile_class_frag}},
    [SHADER_TILE_VALUES] = {"tile-values",
                            BIT(DEPTH) | BIT(CORRECTS),
                            {shader_depth_glsl, shader_rays_map_glsl, shader_tile_values_frag}},
    [SHADER_TILE_RINGS] = {"tile-rings", 0, {shader_tile_rings_frag}},
    [SHADER_TILE_BLOCKS] = {"tile-blocks", 0, {shader_tile_blocks_frag}},
    [SHADER_TILE_NEAR] = {"tile-near", 0, {shader_tile_near_frag}},
    [SHADER_TILE_FILL] = {"tile-fill", 0, {shader_tile_fill_frag}},
};

/* Invocations of a work group, and the rows of a tile that they share (glsl/passes/planar_tile.comp). Found by
 * experiment, docs/decisions/0052 and 0225. */
static const struct group {
    int x, y, rows; /* `rows` is a multiple of `y` */
} row_group = {32, 8, 0}, horizon_group = {8, 16, 0}, tile_group = {32, 12, 24};

static const struct group *group_of(enum glssao__shader shader)
{
    return shader == SHADER_PLANAR_TILE ? &tile_group : shader == SHADER_HORIZON ? &horizon_group : &row_group;
}

void glssao__shader_group(enum glssao__shader shader, const glssao__variant *variant, int out_pixels[2])
{
    const struct group *group = group_of(shader);
    if (shader != SHADER_PLANAR_TILE) {
        out_pixels[0] = group->x;
        out_pixels[1] = group->y;
        return;
    }
    /* As in planar_tile.comp: each round reads farther than it writes, and upsampling one texel more. */
    const int rounds = variant->values[MACRO_ROUNDS], first_reach = variant->values[MACRO_WIDE] ? 3 : 2;
    const int later_reach = 3, halo = rounds == 0 ? 0 : first_reach + (rounds - 1) * later_reach;
    const int upsamples = variant->values[MACRO_UPSAMPLE];
    const int factor = upsamples && !variant->values[MACRO_RAW] ? 2 : 1;
    out_pixels[0] = factor * (group->x - 2 * halo - upsamples);
    out_pixels[1] = factor * (group->rows - 2 * halo - upsamples);
}

const char *glssao__shader_name(enum glssao__shader shader)
{
    return shaders[shader].name;
}

bool glssao__shader_tests(enum glssao__shader shader, enum glssao__macro macro)
{
    return shaders[shader].tests & UINT64_C(1) << macro;
}

glssao__variant glssao__shader_variant(enum glssao__shader shader, glssao__variant wanted)
{
    for (int i = 0; i < MACRO_COUNT; ++i)
        if (!glssao__shader_tests(shader, (enum glssao__macro)i))
            wanted.values[i] = 0;
    return wanted;
}

void glssao__shader_describe(enum glssao__shader shader, const glssao__variant *variant, char *out, int size)
{
    int length = snprintf(out, (size_t)size, "%s", shaders[shader].name);
    for (int i = 0; i < MACRO_COUNT && length < size; ++i)
        if (variant->values[i] > 0)
            length += snprintf(out + length, (size_t)(size - length), " %s=%d", macros[i].name, variant->values[i]);
}

/* A text that grows. Once there is no memory, it has failed and `at` is NULL. */
typedef struct text {
    char *at;
    size_t length, room;
    bool failed;
} text;

static void append(text *t, const char *more)
{
    const size_t length = strlen(more);
    if (!t->failed && t->length + length + 1 > t->room) {
        const size_t room = 2 * (t->length + length + 1);
        char *grown = realloc(t->at, room);
        if (!grown)
            free(t->at);
        t->failed = !grown;
        t->at = grown;
        t->room = room;
    }
    if (t->failed)
        return;
    memcpy(t->at + t->length, more, length + 1);
    t->length += length;
}

static void append_define(text *t, const char *name, int value)
{
    char line[64];
    snprintf(line, sizeof line, "#define %s %d\n", name, value);
    append(t, line);
}

static void append_version(text *t, int gl_version, bool compute)
{
    if (!compute)
        append(t, "#version 330\n");
    else if (gl_version >= 43)
        append(t, "#version 430\n");
    else
        append(t, "#version 330\n#extension GL_ARB_compute_shader : require\n"
                  "#extension GL_ARB_shader_image_load_store : require\n");
}

static void append_block(text *t, const char *name, const char *members)
{
    append(t, "layout(std140) uniform ");
    append(t, name);
    append(t, " {\n");
    append(t, members);
    append(t, "};\n");
}

/* ---- uniforms as flat inputs ----
 *
 * Mesa's software rasteriser loads every component of a uniform one pixel after the other, which takes longer than most
 * arithmetic. A flat input is one load for all of them, so the vertex stage hands uniforms on. The linker leaves out
 * those that a program does not read. */

/* Uniforms of single draws, written as the members of a block. */
static const char step_uniforms[] = "vec2 gOrigin;\nint gHorizontalBlur;\n";
static const char *const handed_on[] = {step_uniforms, shader_cb_ssao_glsl, shader_cb_frame_glsl};

enum flat_line { FLAT_OUTPUT, FLAT_HANDED_ON, FLAT_INPUT };

/* Longer arrays are indexed by loops, which gains nothing and may exceed the number of inputs. */
enum { MOST_FLAT_ELEMENTS = 4 };

/* For each of these uniforms its line of the vertex or fragment stage. */
static void append_flat(text *t, enum flat_line line)
{
    for (size_t i = 0; i < sizeof handed_on / sizeof *handed_on; ++i) {
        glssao__block_member m;
        size_t offset = 0;
        for (const char *rest = handed_on[i]; glssao__block_next(&rest, &offset, &m);) {
            char words[160], array[8] = "";
            if (m.count > MOST_FLAT_ELEMENTS)
                continue;
            if (m.count > 0)
                snprintf(array, sizeof array, "[%d]", (int)m.count);
            if (line == FLAT_OUTPUT)
                snprintf(words, sizeof words, "flat out %s v_%s%s;\n", m.type, m.name, array);
            else if (line == FLAT_HANDED_ON)
                snprintf(words, sizeof words, "    v_%s = %s;\n", m.name, m.name);
            else
                snprintf(words, sizeof words, "flat in %s v_%s%s;\n#define %s v_%s\n", m.type, m.name, array, m.name,
                         m.name);
            append(t, words);
        }
    }
}

char *glssao__shader_vertex_source(bool flat)
{
    text t = {0};
    append_version(&t, 33, false);
    append_define(&t, "FLAT", flat);
    if (flat) {
        append_block(&t, "cbSsao", shader_cb_ssao_glsl);
        append_block(&t, "cbFrame", shader_cb_frame_glsl);
        append(&t, "uniform vec2 gOrigin;\nuniform int gHorizontalBlur;\n");
        append_flat(&t, FLAT_OUTPUT);
        append(&t, "void hand_on()\n{\n");
        append_flat(&t, FLAT_HANDED_ON);
        append(&t, "}\n");
    }
    append(&t, shader_fullscreen_vert);
    return t.at;
}

char *glssao__shader_source(enum glssao__shader shader, const glssao__variant *variant, int gl_version, bool flat)
{
    const struct group *group = group_of(shader);
    text t = {0};
    flat = flat && !variant->values[MACRO_COMPUTE];
    append_version(&t, gl_version, variant->values[MACRO_COMPUTE]);
    for (int i = 0; i < MACRO_COUNT; ++i)
        append_define(&t, macros[i].name, variant->values[i]);
    append_define(&t, "GROUP_X", group->x);
    append_define(&t, "GROUP_Y", group->y);
    append_define(&t, "GROUP_ROWS", group->rows);
    append_define(&t, "FLAT", flat);
    append(&t, shader_values_glsl);
    append(&t, shader_tuned_glsl);
    append(&t, shader_octahedral_glsl);
    append(&t, "#define UNROLL_IF_SHORT\n");
    append_block(&t, "cbSsao", shader_cb_ssao_glsl);
    append_block(&t, "cbFrame", shader_cb_frame_glsl);
    if (shader == SHADER_HEMISPHERE)
        append_block(&t, "cbHemisphere", shader_cb_hemisphere_glsl);
    if (flat)
        append_flat(&t, FLAT_INPUT);
    for (int i = 0; i < FILES && shaders[shader].files[i]; ++i)
        append(&t, shaders[shader].files[i]);
    char *const source = t.at;
    char *const unrolled = source ? glssao__unroll(source, !variant->values[MACRO_LOOPS]) : NULL;
    free(source);
    return unrolled;
}
