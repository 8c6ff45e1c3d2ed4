/* SPDX-License-Identifier: MIT
 *
 * The table of shaders, and the assembly of their sources.
 */
#include "frame/shaders.h"

#include "frame/unroll.h"
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
                                BIT(UPSAMPLE) | BIT(ROUNDS) | BIT(WIDE) | BIT(PERSPECTIVE) | BIT(BRANCHES) | BIT(BENT),
                            {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                             shader_bent_glsl, shader_paired_glsl, shader_planar_blur_glsl, shader_upsample_glsl,
                             shader_planar_tile_comp}},
    [SHADER_UPSAMPLE] = {"upsample",
                         BIT(RADIUS_GROWS) | BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(PERSPECTIVE) |
                             BIT(BRANCHES) | BIT(BENT),
                         {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                          shader_bent_glsl, shader_paired_glsl, shader_upsample_glsl, shader_upsample_frag}},
    [SHADER_SPREAD] = {"spread", BIT(BENT), {shader_pixel_glsl, shader_spread_frag}},
    [SHADER_RAYS] = {"rays",
                     BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(OUTPUT) | BIT(COMPUTE) | BIT(PERSPECTIVE) |
                         BIT(RAYS) | BIT(CORRECTS) | BIT(DENSE),
                     {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                      shader_paired_glsl, shader_rays_frag, shader_entry_glsl}},
    [SHADER_CORRECT] = {"correct",
                        BIT(OUTPUT) | BIT(COMPUTE) | BIT(RAYS),
                        {shader_pixel_glsl, shader_paired_glsl, shader_correct_frag, shader_entry_glsl}},
    [SHADER_HISTORY] = {"history",
                        BIT(DENSE) | BIT(NORMALS) | BIT(TURNED) | BIT(DEPTH) | BIT(PERSPECTIVE) | BIT(BRANCHES) |
                            BIT(COMPUTE) | BIT(UPSAMPLE) | BIT(MOTION) | BIT(RAYS),
                        {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                         shader_paired_glsl, shader_upsample_glsl, shader_history_glsl, shader_history_frag,
                         shader_entry_glsl}},
    [SHADER_STEADY] = {"steady",
                       BIT(PERSPECTIVE) | BIT(BRANCHES) | BIT(COMPUTE) | BIT(RAYS),
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
                               BIT(VARIES) | BIT(DENSE),
                           {shader_pixel_glsl, shader_depth_glsl, shader_inverse_depth_glsl, shader_normal_map_glsl,
                            shader_tile_map_glsl, shader_tile_class_frag}},
    [SHADER_TILE_RINGS] = {"tile-rings", 0, {shader_tile_rings_frag}},
};

/* Invocations of a work group, and the rows of a tile that they share (glsl/passes/planar_tile.comp). Found by
 * experiment, docs/decisions/0052. */
static const struct group {
    int x, y, rows;
} row_group = {32, 8, 0}, horizon_group = {8, 16, 0}, tile_group = {32, 14, 28};

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
    const int factor = variant->values[MACRO_UPSAMPLE] ? 2 : 1;
    out_pixels[0] = factor * (group->x - 2 * halo - factor + 1);
    out_pixels[1] = factor * (group->rows - 2 * halo - factor + 1);
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

char *glssao__shader_vertex_source(void)
{
    text t = {0};
    append_version(&t, 33, false);
    append(&t, shader_fullscreen_vert);
    return t.at;
}

char *glssao__shader_source(enum glssao__shader shader, const glssao__variant *variant, int gl_version)
{
    const struct group *group = group_of(shader);
    text t = {0};
    append_version(&t, gl_version, variant->values[MACRO_COMPUTE]);
    for (int i = 0; i < MACRO_COUNT; ++i)
        append_define(&t, macros[i].name, variant->values[i]);
    append_define(&t, "GROUP_X", group->x);
    append_define(&t, "GROUP_Y", group->y);
    append_define(&t, "GROUP_ROWS", group->rows);
    append(&t, shader_values_glsl);
    append(&t, shader_tuned_glsl);
    append(&t, shader_octahedral_glsl);
    append(&t, "#define UNROLL_IF_SHORT\nlayout(std140) uniform cbSsao {\n");
    append(&t, shader_cb_ssao_glsl);
    append(&t, "};\nlayout(std140) uniform cbFrame {\n");
    append(&t, shader_cb_frame_glsl);
    append(&t, "};\n");
    if (shader == SHADER_HEMISPHERE) {
        append(&t, "layout(std140) uniform cbHemisphere {\n");
        append(&t, shader_cb_hemisphere_glsl);
        append(&t, "};\n");
    }
    for (int i = 0; i < FILES && shaders[shader].files[i]; ++i)
        append(&t, shaders[shader].files[i]);
    char *const source = t.at;
    char *const unrolled = source ? glssao__unroll(source, !variant->values[MACRO_LOOPS]) : NULL;
    free(source);
    return unrolled;
}
