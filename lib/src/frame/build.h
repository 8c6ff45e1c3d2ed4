/* SPDX-License-Identifier: MIT
 *
 * Building the steps of a schedule.
 */
#ifndef GLSSAO_FRAME_BUILD_H
#define GLSSAO_FRAME_BUILD_H

#include "frame/choose.h"

typedef struct glssao__builder {
    glssao__schedule *s;
    glssao__choice c;
    const glssao_frame *frame;
    const glssao_settings *settings;
    int estimates, frames; /* as in glssao__request */
} glssao__builder;

/* A map without its margin. */
glssao__region glssao__region_inner(const int size[2], int margin);
/* What a pass must draw of its map for the result to come out: all but the margin, and what later passes read there. */
glssao__region glssao__region_of(const glssao__choice *c, glssao_pass pass);

/* Names a map that must be there. */
void glssao__build_map(glssao__builder *b, enum glssao__map map, const char *name, gl_enum format, const int size[2]);
/* Adds a draw over the whole of a target, whose map must have been named. */
glssao__step *glssao__build_step(glssao__builder *b, glssao_pass pass, enum glssao__shader shader,
                                 enum glssao__map target);
/* Adds a draw of the `number`-th of the passes that draw by turns into two maps, or of the result. */
glssao__step *glssao__build_turn(glssao__builder *b, glssao_pass pass, enum glssao__shader shader, int number,
                                 bool is_result);
/* Whether later passes read what the estimate, and the technique's own blur, leave in the maps that are drawn by turns.
 */
bool glssao__build_has_more(const glssao__builder *b);
/* The map that holds the value after so many of these passes. */
enum glssao__map glssao__build_turn_map(const glssao__builder *b, int number);
void glssao__build_clear(glssao__builder *b, glssao_pass pass, enum glssao__map map, enum glssao__step_kind kind);

void glssao__build_read(glssao__step *step, enum glssao__unit unit, enum glssao__map map, enum glssao__sampler sampler);
/* The same by the sampler that does not filter. */
void glssao__build_point(glssao__step *step, enum glssao__unit unit, enum glssao__map map);
/* Depth as the estimates read it: horizon takes texels of the distance map, the others filter depth. */
void glssao__build_surfaces(const glssao__builder *b, glssao__step *step);

void glssao__build_set(glssao__step *step, enum glssao__macro macro, int value);
/* Completes the variant by what all passes have in common, and turns the draw into a dispatch where it can be one. */
void glssao__build_finish(const glssao__builder *b, glssao__step *step);
/* Makes the step cover only tiles that lie so far from one that needs an estimate, where tiles are sorted. `factor`:
 * pixels of the target to one of the estimate. */
void glssao__build_tiles(const glssao__builder *b, glssao__step *step, int factor, int least, int most);

#endif
