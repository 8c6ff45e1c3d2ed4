/* SPDX-License-Identifier: MIT
 *
 * The draw or dispatch that multiplies accessibility into the host's picture.
 */
#ifndef GLSSAO_FRAME_APPLY_H
#define GLSSAO_FRAME_APPLY_H

#include "frame/resources.h"
#include "gpu/state.h"
#include "input/destination.h"

typedef struct glssao__apply_job {
    gl_uint framebuffer;
    glssao__image image; /* what to dispatch over; without a texture the framebuffer is drawn into */
    enum glssao__map map;
    int destination[4]; /* x, y, width, height, pixels of the framebuffer */
    int picture[4];     /* the same of the textures below: where the picture lies */
    gl_uint strength_texture, albedo_texture;
    float intensity, color[3];
    bool show; /* accessibility replaces the picture */
} glssao__apply_job;

glssao__variant glssao__apply_variant(const glssao__apply_job *job);

/* The parts of the state that running the job changes, where `may_dispatch`, by either way. */
glssao__state_need glssao__apply_need(const glssao__apply_job *job, bool may_dispatch);

/* Runs a job whose program was prepared. */
void glssao__apply_run(glssao__resources *resources, const glssao__apply_job *job);

#endif
