/* SPDX-License-Identifier: MIT
 *
 * The steps after the estimate: blur and upsampling.
 */
#ifndef GLSSAO_FRAME_FILTERS_H
#define GLSSAO_FRAME_FILTERS_H

#include "frame/build.h"

/* Completes a step that takes the host's rays; the last before a result or before upsampling leaves no value out. */
void glssao__build_rays(glssao__builder *b, glssao__step *step, bool is_last);

void glssao__add_blur(glssao__builder *b);
void glssao__add_correction(glssao__builder *b);
/* The last map that the passes by turns drew into. */
enum glssao__map glssao__last_turn(const glssao__builder *b);
void glssao__add_upsample(glssao__builder *b);

#endif
