/* SPDX-License-Identifier: MIT
 *
 * The steps that sort tiles.
 */
#ifndef GLSSAO_FRAME_TILES_H
#define GLSSAO_FRAME_TILES_H

#include "frame/build.h"

/* Whether tiles look occluders up in the depth map: the distance map has other texels, or there is none. */
bool glssao__tiles_read_depth(const glssao__builder *b);

void glssao__add_tiles(glssao__builder *b);

/* Sorts tiles again, by the estimate that is to be corrected and by the rays, and opens what later passes leave out of
 * the maps of differences, of the corrected map and of the result. */
void glssao__add_correction_tiles(glssao__builder *b, enum glssao__map estimate, enum glssao__map corrected);

#endif
