/* SPDX-License-Identifier: MIT
 *
 * Programs of the scene's draw passes: compiling a variant, and the locations of every uniform any of them has.
 */
#pragma once

#include "fault.h"

#include <stdbool.h>

/* Bits of a variant; each is a macro of that name, 0 or 1, in the shaders. */
enum {
    VARIANT_TEXTURED = 1,      /* any map is read */
    VARIANT_COLORED = 2,       /* vertex colours other than white */
    VARIANT_MASKED = 4,        /* alpha test */
    VARIANT_LIT = 8,           /* normals wanted: all of the pre-pass, all but unlit materials in the main pass */
    VARIANT_DOUBLE_SIDED = 16, /* normals turn with gl_FrontFacing */
    VARIANT_BLENDED = 32,
    VARIANT_NORMAL_MAPPED = 64,
    VARIANT_REFLECTIVE = 128,       /* metallic-roughness reflection; without: matte */
    VARIANT_ROUGHNESS_MAPPED = 256, /* where REFLECTIVE */
    VARIANT_BAKED = 512,            /* an occlusion texture */
    VARIANT_EMISSIVE = 1024,
    VARIANT_EMISSION_MAPPED = 2048, /* where EMISSIVE */
    VARIANT_SHADOWED = 4096,
    VARIANT_LIGHTS = 8192,              /* more lights than the first directional one */
    VARIANT_SPECULAR_OCCLUSION = 16384, /* where REFLECTIVE and not BLENDED */
    VARIANT_MULTI_BOUNCE = 32768,       /* where not BLENDED */
    VARIANT_BASE_MAPPED = 65536,        /* base colour texture */
    VARIANT_BEHIND = 131072,            /* a layer: depth of the surfaces behind those of the pre-pass */
    VARIANT_ENVIRONMENT = 262144,       /* ambient light, or the sky, from a picture */
    VARIANT_FLAT = 524288,              /* normals from the triangle itself */
    VARIANT_MORE_UVS = 1048576,         /* a map reads the third or fourth uv set */
    VARIANT_MOVES = 2097152,            /* the motion pass: where each point was in the last frame */
    VARIANT_BENT = 4194304              /* where not BLENDED: ambient light by bent normals */
};

/* Every bit that a material and its light can need, except those of other kinds of surface. */
enum {
    VARIANT_EVERYTHING = VARIANT_TEXTURED | VARIANT_COLORED | VARIANT_MASKED | VARIANT_LIT | VARIANT_DOUBLE_SIDED |
                         VARIANT_NORMAL_MAPPED | VARIANT_REFLECTIVE | VARIANT_ROUGHNESS_MAPPED | VARIANT_BAKED |
                         VARIANT_EMISSIVE | VARIANT_EMISSION_MAPPED | VARIANT_SHADOWED | VARIANT_LIGHTS |
                         VARIANT_SPECULAR_OCCLUSION | VARIANT_MULTI_BOUNCE | VARIANT_BASE_MAPPED
};

/* Texture units, fixed when a program is made. */
enum {
    UNIT_BASE_COLOR = 0,
    UNIT_MAP = 0,
    UNIT_AMBIENT,
    UNIT_FIRST_DEPTH = UNIT_AMBIENT,
    UNIT_SHADOW,
    UNIT_NORMAL,
    UNIT_METALLIC_ROUGHNESS,
    UNIT_OCCLUSION,
    UNIT_EMISSION,
    UNIT_ENVIRONMENT,
    UNIT_COUNT
};

enum { MOST_LIGHTS = 16 }; /* in main.frag too */

/* A location is -1 if the program lacks the uniform; GL ignores values set there. */
typedef struct draw_program {
    unsigned name; /* 0: not built */
    int view_from_world, clip_from_view, normal_view_from_world;
    int last_view_from_world, last_clip_from_view;
    int base_color_uv, normal_uv, metallic_roughness_uv, occlusion_uv, emission_uv;
    int base_color, alpha_cutoff;
    int handedness, normal_scale, metallic_roughness, occlusion_strength, emission;
    int intensity, ambient, ambient_tilt, up_view, directional, to_light_view, is_orthographic;
    int shadow_from_world, lights, light_count;
    int pixel_uv, origin, depth_offset;
    int sky_from_clip, sky, sky_tilt;
    int irradiance, sky_from_view;
    int scale, bias, red_only;
    int numerator, denominator, far_depth, offset;
} draw_program;

/* Compiles and links; `shared_source` (may be "") comes before the fragment shader's own, and environment.glsl where
 * the variant has an environment. False on failure, with `what`
 * and the driver's log in one line of `error`. */
bool draw_program_build(draw_program *p, const char *what, const char *vertex_source, const char *shared_source,
                        const char *fragment_source, unsigned variant, failure *fault);
