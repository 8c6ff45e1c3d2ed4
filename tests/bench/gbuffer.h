/* SPDX-License-Identifier: MIT
 *
 * Depth and view-space normals of one view, as textures: what a host hands to the effect. The scene is needed only
 * while they are drawn.
 */
#pragma once

#include "draw.h"
#include "gl.h"

#include <glssao/glssao.h>

typedef struct gbuffer {
    scene_view view;
    GLuint depth;     /* 24 bits, window depth */
    GLuint normals;   /* RGBA16F */
    GLuint layers[2]; /* where there is a margin: back faces and second fronts, as depth */
    int margin;       /* pixels on each side of the view proper; `view` has them on it */
} gbuffer;

/* With a margin, a second layer too. False, with one line in `error`; gbuffer_destroy is due in either case. */
bool gbuffer_draw(gbuffer *g, const scene *s, const scene_view *view, int margin, failure *fault);

/* The margin that is measured: a sixth of the width. */
int gbuffer_margin(int width);
void gbuffer_destroy(gbuffer *g);

/* What a host hands over; without normals where `depth_alone`. */
glssao_frame gbuffer_frame(const gbuffer *g, bool depth_alone);

/* View distances (0: nothing there) and normals (three floats a pixel), rows bottom to top; the caller frees both.
 * Both are NULL when memory is short. */
void gbuffer_read(const gbuffer *g, float **out_distance, float **out_normals);

/* Scene units of view distance that one step of the depth buffer stands for, at that view distance. */
double gbuffer_depth_step(const gbuffer *g, double distance);
