/* SPDX-License-Identifier: MIT
 *
 * Turns settings, frame and capabilities into the steps of a frame, without OpenGL.
 */
#ifndef GLSSAO_FRAME_SCHEDULE_H
#define GLSSAO_FRAME_SCHEDULE_H

#include "frame/steps.h"

void glssao__schedule_make(glssao__schedule *out, const glssao__request *request);

/* The settings that one estimate of glssao_accumulate is computed with. */
glssao_settings glssao__schedule_accumulated(const glssao_settings *settings);

#endif
