/* SPDX-License-Identifier: MIT
 *
 * The reuse of earlier frames: what is remembered of the last one, and when it still holds.
 */
#ifndef GLSSAO_HISTORY_H
#define GLSSAO_HISTORY_H

#include "frame/steps.h"
#include "frame/uniforms.h"

/* All zero: there is no history. */
typedef struct glssao__history {
    int frames; /* it has seen so far; 0: none */
    int margin;
    bool is_orthographic, has_rays;
    int rays_offset[2]; /* of the frame */
    glssao_settings settings;
    double view[16];                       /* the passes' view space from world space */
    float ray_origin[4], ray_direction[4]; /* as in cbFrame */
    glssao__region region;                 /* pixels of the full size that the maps hold */
} glssao__history;

/* How many frames a history has seen that holds for this one too; 0: it begins. */
int glssao__history_frames(const glssao__history *h, const glssao_frame *frame, const glssao_settings *settings,
                           const glssao__projection *projection);

/* The members of cbFrame that the history reads, and which texels are estimated. `frames`: as above. */
void glssao__history_fill(const glssao__history *h, const glssao__uniforms_source *source, int frames,
                          glssao__frame_block *block);

/* Remembers a frame that was computed from so many earlier ones, or, with settings.history 0, forgets all. */
void glssao__history_keep(glssao__history *h, const glssao__uniforms_source *source, int frames,
                          const glssao__region *region);

#endif
