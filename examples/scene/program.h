/* SPDX-License-Identifier: MIT
 *
 * Programs of the scene's draw passes: compiling a variant, and the locations of every uniform any of them has.
 */
#ifndef GLSSAO_EXAMPLES_PROGRAM_H
#define GLSSAO_EXAMPLES_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>

/* Bits of a variant; each is a macro of that name, 0 or 1, in the shaders. */
enum {
    VARIANT_TEXTURED = 1,      /* base colour texture */
    VARIANT_COLORED = 2,       /* vertex colours other than white */
    VARIANT_MASKED = 4,        /* alpha test */
    VARIANT_LIT = 8,           /* normals wanted: all of the pre-pass, all but unlit materials in the main pass */
    VARIANT_DOUBLE_SIDED = 16, /* normals turn with gl_FrontFacing */
    VARIANT_BLENDED = 32,
    VARIANT_COUNT = 64
};

/* Texture units, fixed when a program is made. */
enum { UNIT_BASE_COLOR = 0, UNIT_MAP = 0, UNIT_AMBIENT = 1 };

/* Locations are -1 for uniforms that the program does not have; GL ignores what is set there. */
typedef struct draw_program {
    unsigned name; /* 0: not built */
    int view_from_world, clip_from_view, normal_view_from_world;
    int uv_row_u, uv_row_v;
    int base_color, alpha_cutoff;
    int ambient, directional, to_light_view;
    int pixel_uv;
    int scale, bias, red_only;
    int numerator, denominator, far_depth;
} draw_program;

/* Compiles and links. False on failure, with `what` and the driver's log in one line of `error`. */
bool draw_program_build(draw_program *p, const char *what, const char *vertex_source, const char *fragment_source,
                        unsigned variant, char *error, size_t error_size);

#endif
