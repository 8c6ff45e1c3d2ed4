/* SPDX-License-Identifier: MIT
 *
 * The uniform blocks in C, made from the same files as in GLSL, and how their members follow from frame and settings.
 */
#ifndef GLSSAO_FRAME_UNIFORMS_H
#define GLSSAO_FRAME_UNIFORMS_H

#include "input/projection.h"

#include "glssao/glssao.h"

enum { BLOCK_SSAO = 0, BLOCK_FRAME, BLOCK_HEMISPHERE, BLOCK_COUNT }; /* also the binding points */

/* Border of maps that hold view distance, as the D3D11 demo has it: beyond it nothing occludes. */
#define SKY_DISTANCE 1e5f

/* GLSL's types for the files that both compilers read. */
typedef float glssao__mat4[16];
typedef float glssao__vec4[4];
typedef float glssao__vec2[2];
#define mat4 glssao__mat4
#define vec4 glssao__vec4
#define vec2 glssao__vec2
typedef struct glssao__ssao_block {
#include "cb_ssao.glsl"
} glssao__ssao_block;

typedef struct glssao__frame_block {
#include "cb_frame.glsl"
} glssao__frame_block;

typedef struct glssao__hemisphere_block {
#include "cb_hemisphere.glsl"
} glssao__hemisphere_block;
#undef mat4
#undef vec4
#undef vec2

typedef struct glssao__uniforms {
    glssao_constants ssao; /* glssao__ssao_block, as the public header has it */
    glssao__frame_block frame;
    glssao__hemisphere_block hemisphere;
} glssao__uniforms;

/* Fills what depends on the seed alone. */
void glssao__uniforms_init(glssao__uniforms *u, uint32_t seed);

/* What one frame's blocks depend on. */
typedef struct glssao__uniforms_source {
    const glssao_frame *frame;
    const glssao_settings *settings;
    const glssao__projection *projection;
    glssao__precision precision; /* of stored depth */
    int size[2], estimate_size[2];
    int map_factor; /* full-size pixels to one of the distance map: 1 or 2 */
    int tile_rings; /* of the schedule */
    uint32_t seed, noise_index;
} glssao__uniforms_source;

/* Fills all that a frame changes. cbHemisphere is filled for its own technique alone. */
void glssao__uniforms_fill(glssao__uniforms *u, const glssao__uniforms_source *source);

/* weight(i) ~ exp(-i^2 / (2 sigma^2)) for i = -radius..radius with radius = ceil(2 sigma), stored about slot 5. */
void glssao__uniforms_gauss_weights(float sigma, float out_weights[3][4]);
/* Directions uniform over the hemisphere; the i-th of n is 0.1 + 0.9 (i / n)^2 long. */
void glssao__uniforms_kernel(glssao__hemisphere_block *block, uint32_t seed, int sample_count);

#endif
