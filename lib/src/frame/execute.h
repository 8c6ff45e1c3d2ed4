/* SPDX-License-Identifier: MIT
 *
 * Runs the steps of a schedule.
 */
#ifndef GLSSAO_FRAME_EXECUTE_H
#define GLSSAO_FRAME_EXECUTE_H

#include "frame/resources.h"
#include "gpu/state.h"
#include "input/host_textures.h"

/* The parts of the host's state that preparing and running the schedule changes. */
glssao__state_need glssao__execute_need(const glssao__resources *resources, const glssao__schedule *schedule);

/* Runs a schedule that was prepared. `sky_depth`: what the depth sampler returns beyond the border. */
void glssao__execute(glssao__resources *resources, const glssao__schedule *schedule, const glssao__host_inputs *host,
                     const glssao__uniforms *uniforms, float sky_depth);

#endif
