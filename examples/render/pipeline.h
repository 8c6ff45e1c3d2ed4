/* SPDX-License-Identifier: MIT
 *
 * One frame of glssao-render: pre-pass, occlusion, main pass, and reading back what is wanted of them. Passes whose
 * result nobody wants have neither targets nor shaders. The context is current throughout.
 */
#ifndef GLSSAO_EXAMPLES_PIPELINE_H
#define GLSSAO_EXAMPLES_PIPELINE_H

#include "draw.h"
#include "gl.h"
#include "options.h"
#include "progressive.h"
#include "report.h"
#include "scene.h"
#include "truth.h"
#include "writer.h"

/* What the command line makes necessary. */
typedef struct pipeline_wants {
    bool picture; /* the main pass */
    bool ao_map;  /* accessibility for its own sake, not only for the picture */
    bool ao;      /* accessibility: the occlusion passes, or */
    bool traced;  /* rays */
    bool prepass; /* depth, and with it: */
    bool timers;  /* times of the occlusion passes */
    bool normals; /* a normal map, for --normals or the occlusion passes */
} pipeline_wants;

typedef struct pipeline {
    pipeline_wants wants;
    int width, height; /* of the targets, with the margin */
    int margin;        /* pixels on each side that are drawn but not delivered */
    scene_renderer *renderer;
    glssao_effect *effect; /* NULL where neither occlusion passes nor normals are wanted */
    truth truth;           /* where traced */
    glssao_settings settings;
    progressive_goal goal; /* zero: one frame as the settings say */
    progressive_report reached;
    uint32_t seed;
    scene_lighting lighting;
    scene_light *lights; /* of lighting */
    scene_draw_options draw_options;
    options_map debug_map;
    GLuint depth, depth_framebuffer, color, color_framebuffer;
    GLuint layers[2], layer_framebuffer; /* back faces and second fronts, where draw_options.layers */
    GLuint scratch, scratch_framebuffer; /* map_view.c's */
} pipeline;

/* False, with one line in `error`; pipeline_destroy is due in either case. */
bool pipeline_create(pipeline *p, const scene *s, glssao_load_fn load, void *load_user, const options *o,
                     pipeline_wants wants, char *error, size_t error_size);

/* The settings that the command line asks for. */
glssao_settings pipeline_settings(const options *o, const scene *s);

/* Makes the targets anew; pipeline_destroy is due in either case. Not where rays are traced. */
bool pipeline_resize(pipeline *p, int width, int height, char *error, size_t error_size);

/* The accessibility map of the last frame. */
GLuint pipeline_ambient_map(const pipeline *p);
void pipeline_destroy(pipeline *p);

/* Draws all that is wanted, and ends the phases of `times` as it goes. `view` has the margin on it. */
bool pipeline_draw(pipeline *p, const scene_view *view, stopwatch *times, char *error, size_t error_size);

/* The picture of the frame last drawn once more, with another accessibility map (0: none), into another framebuffer of
 * the pipeline's size whose depth attachment is the pipeline's `depth`. */
void pipeline_shade(pipeline *p, const scene_view *view, GLuint ambient_map, GLuint framebuffer);

/* Pixels of malloc, bottom to top, without the margin; NULL where memory is short. */
void *pipeline_read_picture(pipeline *p);                               /* PIXELS_RGBA8, sRGB */
void *pipeline_read_ao(pipeline *p, pixel_kind kind);                   /* PIXELS_GREY8 or PIXELS_FLOAT */
void *pipeline_read_normals(pipeline *p);                               /* PIXELS_RGBA8, n * 0.5 + 0.5 */
void *pipeline_read_view_distance(pipeline *p, const scene_view *view); /* PIXELS_FLOAT */

/* Prints what a frame runs and skips, as a table, to stdout. */
void pipeline_print_plan(const pipeline *p, const scene_view *view);

#endif
