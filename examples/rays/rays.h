/* SPDX-License-Identifier: MIT
 *
 * What a host with a ray tracer on the processor does for frame.rays_texture: reads depth and normals back through
 * pixel buffers, traces a few rays from each surface, and uploads the shares that got through. Tracing starts while
 * later strips of the picture are still on their way. The context is current in all calls.
 */
#pragma once

#include "draw.h"
#include "fault.h"
#include "gl.h"
#include "trace.h"

enum { RAYS_STRIPS = 8 };

typedef struct rays {
    int width, height; /* of the textures below */
    GLuint surfaces, framebuffer, buffers[RAYS_STRIPS];
    GLuint texture; /* the result: R32F, negative where there are no rays */
    int offset[2];  /* of the pixels that its texels belong to, for frame.rays_offset */
    float *accessibility;
    const float (**rows)[4]; /* of the surfaces, in the mapped buffers */
    trace_stats stats;       /* sum over the frames */
} rays;

typedef struct rays_job {
    scene_renderer *renderer; /* any; it draws a full-screen pass */
    GLuint depth, normals;    /* of the size of the view */
    const scene_view *view;   /* with its margin */
    int margin;               /* pixels on each side where no rays are wanted */
    int step;                 /* 1: rays for every pixel, 2: for one of each 2 x 2 */
    int offset[2];            /* which one: x, y, 0 or 1 */
    trace_options options;
} rays_job;

/* Makes the textures for a view of that size, unless they are there. `r` is zero, or has traced other frames. */
bool rays_open(rays *r, int width, int height, int step, failure *why);

/* Fills r->texture. `r` is zero, or has traced other frames. False, with one line in `why`, on failure. */
bool rays_trace(rays *r, const trace_scene *s, const rays_job *job, failure *why);

/* Which pixel of each 2 x 2 frame `n` of a history should take, so that four frames take all: x, y, 0 or 1. */
void rays_choose_offset(uint32_t n, int out_offset[2]);

/* For who traces elsewhere: the surfaces, r->width x r->height texels that the caller frees, or NULL with one line in
 * `why`; and r->accessibility into r->texture. */
float (*rays_read_surfaces(rays *r, const rays_job *job, failure *why))[4];
void rays_upload(const rays *r);
void rays_close(rays *r);
