/* SPDX-License-Identifier: MIT
 *
 * Checks of settings and frames that need no OpenGL. Each names the field and its value in the log.
 */
#ifndef GLSSAO_INPUT_CHECK_H
#define GLSSAO_INPUT_CHECK_H

#include "input/projection.h"
#include "log.h"

/* False where a setting is out of range. */
bool glssao__check_settings(const glssao_settings *settings, const glssao__log *log);

/* False where settings or frame are NULL, hold something out of range, or the projection can't be used. `size`: full
 * size of the effect in pixels. */
bool glssao__check_frame(const glssao_frame *frame, const glssao_settings *settings, const int size[2],
                         const glssao__log *log, glssao__projection *out_projection);

#endif
