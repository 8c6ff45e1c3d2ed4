/* SPDX-License-Identifier: MIT
 *
 * Textures that the effect draws into, each with its framebuffer, and the samplers through which all are read.
 * Everything here runs between glssao__state_save and glssao__state_restore, so bindings are left as they fall.
 */
#ifndef GLSSAO_GPU_TEXTURES_H
#define GLSSAO_GPU_TEXTURES_H

#include "gpu/functions.h"
#include "log.h"

/* The static samplers of the D3D12 demo. */
enum glssao__sampler {
    SAMPLER_POINT_CLAMP = 0,
    SAMPLER_LINEAR_CLAMP,
    SAMPLER_DEPTH, /* linear; its border is the sky's depth, set for each frame */
    SAMPLER_LINEAR_WRAP,
    SAMPLER_COUNT
};

typedef struct glssao__target_spec {
    const char *name; /* for messages */
    gl_enum format;
    int width, height;
} glssao__target_spec;

/* A texture and the framebuffer that draws into it. All zero: not made. */
typedef struct glssao__target {
    gl_uint texture, framebuffer;
    int width, height;
    gl_enum format;
} glssao__target;

bool glssao__target_fits(const glssao__target *target, const glssao__target_spec *spec);
/* Makes a target whose contents are undefined. May fail with OUT_OF_MEMORY and FRAMEBUFFER_ERROR. */
glssao_result glssao__target_make(const glssao__gl *gl, const glssao__log *log, const glssao__target_spec *spec,
                                  glssao__target *out);
void glssao__target_delete(const glssao__gl *gl, glssao__target *target);
void glssao__target_clear(const glssao__gl *gl, const glssao__target *target, const gl_float color[4]);
void glssao__target_clear_to(const glssao__gl *gl, const glssao__target *target, gl_float value);

/* A texture of RGBA8 texels that repeats; 0 where there is no memory for it. */
gl_uint glssao__texture_make_rgba8(const glssao__gl *gl, int width, int height, const void *texels);

void glssao__samplers_make(const glssao__gl *gl, gl_uint out_samplers[SAMPLER_COUNT]);

#endif
