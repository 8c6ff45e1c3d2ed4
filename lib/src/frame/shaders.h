/* SPDX-License-Identifier: MIT
 *
 * The shaders, the macros that make variants of them, and the source of each variant. No OpenGL.
 */
#ifndef GLSSAO_FRAME_SHADERS_H
#define GLSSAO_FRAME_SHADERS_H

#include "values.glsl"

#include <stdbool.h>
#include <stdint.h>

enum glssao__shader {
    SHADER_INPUT = 0,
    SHADER_NORMALS,
    SHADER_DISTANCE,
    SHADER_OPEN,
    SHADER_CLASSIC,
    SHADER_HEMISPHERE,
    SHADER_HORIZON,
    SHADER_RESOLVE,
    SHADER_PROBE,
    SHADER_BLUR,
    SHADER_PLANAR_BLUR,
    SHADER_PLANAR_TILE, /* rounds of the planar blur and upsampling in one compute shader */
    SHADER_UPSAMPLE,
    SHADER_SPREAD,
    SHADER_HISTORY,
    SHADER_STEADY,
    SHADER_APPLY,
    SHADER_RAYS,
    SHADER_TILE_ROWS,
    SHADER_TILE_BOUNDS,
    SHADER_TILE_CLASS,
    SHADER_TILE_VALUES,
    SHADER_TILE_RINGS,
    SHADER_TILE_BLOCKS,
    SHADER_TILE_NEAR,
    SHADER_TILE_FILL,
    SHADER_COUNT
};

/* X(macro, its largest value). Every macro is defined in every shader, as 0 where the shader does not test it. */
#define GLSSAO__MACROS(X)                                                                                              \
    X(COMPUTE, 1)         /* the pass is dispatched, not drawn */                                                      \
    X(NORMALS, 3)         /* how normals are stored: signed, unsigned, octahedral, rebuilt */                          \
    X(DEPTH, 2)           /* how it stores depth: window depth, view distance, view distance in alpha */               \
    X(TURNED, 1)          /* stored normals lie in another space than the passes compute in */                         \
    X(RADIUS_GROWS, 1)    /* the radius grows with view distance: it counts pixels, in perspective */                  \
    X(PERSPECTIVE, 1)     /* the projection is known not to be orthographic */                                         \
    X(BRANCHES, 1)        /* branches that spare a GPU work are taken */                                               \
    X(LOOPS, 1)           /* loops marked UNROLL_IF_SHORT stay loops, which keeps a GPU's program small */             \
    X(OUTPUT, 3)          /* accessibility, paired value, sum of estimates, with bent normal */                        \
    X(BENT, 1)            /* hidden vectors go along with accessibility */                                             \
    X(SLICES, 2)          /* horizon: slices of a pixel */                                                             \
    X(STEPS, 16)          /* horizon: samples on each side of a slice */                                               \
    X(LAYERS, 1)          /* horizon: there is a second layer */                                                       \
    X(NO_ANGLE_WEIGHT, 1) /* classic */                                                                                \
    X(FILTER, 2)          /* blur: Gaussian, bilateral, box */                                                         \
    X(WIDE, 1)            /* planar blur: the first round is not the blur's first */                                   \
    X(STRIDE, 3)          /* planar blur: the neighbours are 2 to that power of pixels apart */                        \
    X(RAYS, 2)            /* values come from the host's rays: they may be missing, and the power waits; no longer */  \
    X(CORRECTS, 2)        /* rays: the difference to another technique's estimate; 2: its sum with that */             \
    X(ROUNDS, 2)          /* planar blur: rounds of one dispatch */                                                    \
    X(UPSAMPLE, 1)        /* planar tile: brings the result to full size */                                            \
    X(RAW, 1)             /* upsampling: for the history, with the estimate as it was before the blur */               \
    X(MULTISAMPLE, 1)     /* input: of several samples */                                                              \
    X(LOGARITHMIC, 1)     /* input: logarithmic depth */                                                               \
    X(OBLIQUE, 1)         /* input: window depth under an oblique near plane */                                        \
    X(PLANES, 1)          /* tiles: those that lie in a plane are open too */                                          \
    X(MIDDLES, 1)         /* tiles: their middles stand for them */                                                    \
    X(FROM_DEPTH, 1)      /* tiles, open: occluders are looked up in the depth map, not in the distance map */         \
    X(VARIES, 1)          /* noise, and at half size the texels that are estimated, differ from frame to frame */      \
    X(DENSE, 1)           /* distances and rebuilt normals have the full size, the estimate half of it */              \
    X(MOTION, 1)          /* history: there is a motion texture */                                                     \
    X(STRENGTH, 2)        /* apply: what weights occlusion: nothing, a uniform, a texture too */                       \
    X(ALBEDO, 1)          /* apply: light that bounces between surfaces is added */                                    \
    X(TINTED, 1)          /* apply: the blender needs the occluded part, not the open one */                           \
    X(IMAGE, 6)           /* apply, dispatched: the format of the target, IMAGE_RGBA8 and so on */

enum glssao__macro {
#define GLSSAO__ENUMERATE(name, most) MACRO_##name,
    GLSSAO__MACROS(GLSSAO__ENUMERATE)
#undef GLSSAO__ENUMERATE
        MACRO_COUNT
};

typedef struct glssao__variant {
    uint8_t values[MACRO_COUNT];
} glssao__variant;

/* Sets macros that the shader does not test to 0, so that variants with the same source compare equal. */
glssao__variant glssao__shader_variant(enum glssao__shader shader, glssao__variant wanted);
/* Whether the shader tests the macro. */
bool glssao__shader_tests(enum glssao__shader shader, enum glssao__macro macro);

const char *glssao__shader_name(enum glssao__shader shader);
/* "horizon STEPS=12 SLICES=2 ...", for messages. */
void glssao__shader_describe(enum glssao__shader shader, const glssao__variant *variant, char *out, int size);

/* Pixels of the target that a work group makes. */
void glssao__shader_group(enum glssao__shader shader, const glssao__variant *variant, int out_pixels[2]);

/* The source of a stage: fragment or compute, whichever the variant asks for, or the vertex stage that all draws share.
 * `gl_version`: 10 major + minor. `flat`: in draws, uniforms come from the vertex stage as flat inputs; both stages of
 * a program must agree. NULL where there is no memory; the caller frees. */
char *glssao__shader_source(enum glssao__shader shader, const glssao__variant *variant, int gl_version, bool flat);
char *glssao__shader_vertex_source(bool flat);

#endif
