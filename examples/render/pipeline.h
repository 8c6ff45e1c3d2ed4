/* SPDX-License-Identifier: MIT
 *
 * One frame of glssao-render: pre-pass, occlusion, main pass, and reading back what is wanted of them. Passes whose
 * result nobody wants have neither targets nor shaders. The context is current throughout.
 */
#ifndef GLSSAO_EXAMPLES_PIPELINE_H
#define GLSSAO_EXAMPLES_PIPELINE_H

#include "draw.h"
#include "fault.h"
#include "gl.h"
#include "options.h"
#include "pixel_kind.h"
#include "progressive.h"
#include "report.h"
#include "samples.h"
#include "scene.h"
#include "stage.h"
#include "truth.h"

/* What the command line makes necessary. */
typedef struct pipeline_wants {
    bool picture;    /* the main pass */
    bool ao_map;     /* accessibility for its own sake, not only for the picture */
    bool ao;         /* accessibility: the occlusion passes, or */
    bool traced;     /* rays */
    bool prepass;    /* depth, and with it: */
    bool maps;       /* something beside the picture: read back, or in its corner */
    int samples;     /* of a pixel of the picture */
    bool timers;     /* times of the occlusion passes */
    bool normals;    /* a normal map, for the occlusion passes where they run, or */
    bool normal_map; /* for its own sake */
} pipeline_wants;

typedef struct pipeline {
    pipeline_wants wants;
    int width, height;        /* of the targets, with the margin */
    int margin;               /* pixels on each side that are drawn but not delivered */
    stage own;                /* pipeline_create's */
    scene_renderer *renderer; /* of the stage */
    scene_lighting lighting;
    scene_environment *environment; /* of the lighting; NULL: the built-in one */
    char *environment_path;
    glssao_effect *effect; /* NULL where neither occlusion passes nor normals are wanted; else: */
    glssao_effect *kept;   /* of these, and of the targets' size */
    bool kept_timers;
    glssao_path kept_path;
    uint32_t seed;
    truth truth; /* where traced */
    glssao_settings settings;
    progressive_goal goal; /* zero: one frame as the settings say */
    progressive_report reached;
    scene_draw_options draw_options;
    options_map debug_map;
    bool plain;          /* background instead of a sky */
    bool transparent;    /* a background of alpha 0: the picture has straight alpha */
    float background[4]; /* linear, alpha */
    samples samples;     /* where sample_count is above 1, or transparent */
    GLuint depth, depth_framebuffer, color, color_framebuffer;
    GLuint layers[2], layer_framebuffer; /* back faces and second fronts, where draw_options.layers */
    GLuint scratch, scratch_framebuffer; /* map_view.c's */
    GLuint maps[PIXEL_KIND_COUNT], map_framebuffers[PIXEL_KIND_COUNT]; /* where maps are drawn to be read back */
} pipeline;

/* False, with one line in `why`; pipeline_destroy is due in either case. */
bool pipeline_create(pipeline *p, const scene *s, glssao_load_fn load, void *load_user, const options *o,
                     pipeline_wants wants, fault *why);

/* Makes it draw a stage, which must outlive that, as the options say, from zero or from whatever it drew before: what
 * fits of the effect, its shaders and the targets stays. False, with one line in `why`; only pipeline_destroy may
 * follow then. */
bool pipeline_prepare(pipeline *p, stage *st, glssao_load_fn load, void *load_user, const options *o,
                      pipeline_wants wants, fault *why);

/* Light from the picture in that file, or the built-in one (NULL); a picture that is there already is not read again.
 * scene_renderer_configure is due after it. False, with one line in `why`, on failure, where the light stays. */
bool pipeline_surround(pipeline *p, const stage *st, const char *path, fault *why);

/* The settings that the command line asks for. */
glssao_settings pipeline_settings(const options *o, const scene *s);

/* Makes the targets anew; pipeline_destroy is due in either case. Not where rays are traced. */
bool pipeline_resize(pipeline *p, int width, int height, fault *why);

/* The accessibility map of the last frame. */
GLuint pipeline_ambient_map(const pipeline *p);

/* Leaves zero. */
void pipeline_destroy(pipeline *p);

/* Draws all that is wanted, and ends the phases of `times` as it goes. `view` has the margin on it. */
bool pipeline_draw(pipeline *p, const scene_view *view, stopwatch *times, fault *why);

/* The picture of the frame last drawn once more, with another accessibility map (0: none), into another framebuffer of
 * the pipeline's size whose depth attachment is the pipeline's `depth`. */
void pipeline_shade(pipeline *p, const scene_view *view, GLuint ambient_map, GLuint framebuffer);

/* What can be read back of the frame last drawn, as: */
typedef enum pipeline_output {
    PIPELINE_PICTURE,      /* PIXELS_RGBA8, sRGB */
    PIPELINE_AO,           /* PIXELS_GREY8 or PIXELS_FLOAT */
    PIPELINE_NORMALS,      /* PIXELS_RGBA8, n * 0.5 + 0.5 */
    PIPELINE_VIEW_DISTANCE /* PIXELS_FLOAT */
} pipeline_output;

/* Bytes of an output without the margin. */
size_t pipeline_output_size(const pipeline *p, pixel_kind kind);

/* Calls glReadPixels for an output, bottom to top, without the margin and without padding: to `pixels`, or to that
 * offset in the buffer bound to GL_PIXEL_PACK_BUFFER. Reads what was traced from memory, and then needs `pixels`; see
 * pipeline_is_in_memory. False where GL has no framebuffer for it. */
bool pipeline_read(pipeline *p, pipeline_output output, pixel_kind kind, const scene_view *view, void *pixels);
bool pipeline_is_in_memory(const pipeline *p, pipeline_output output, pixel_kind kind);

/* Accessibility, PIXELS_GREY8 or PIXELS_FLOAT, of malloc; NULL where memory is short. */
void *pipeline_read_ao(pipeline *p, pixel_kind kind);

/* Prints what a frame runs and skips, as a table, to stdout. */
void pipeline_print_plan(const pipeline *p, const scene_view *view);

/* ---- Between the pipeline's own files: pipeline_targets.c, pipeline.c */

/* False, with what failed and the library's last error in `error`, where the result is not GLSSAO_OK. */
bool pipeline_check(glssao_result result, const char *what, fault *why);
/* Frees the targets. False, with one line in `why`, where the context has no framebuffers of that size. */
bool pipeline_change_size(pipeline *p, int width, int height, fault *why);
/* Makes those that are wanted and not there. */
bool pipeline_make_targets(pipeline *p, fault *why);
void pipeline_free_targets(pipeline *p);
/* Where a map is drawn to be read back; 0 where GL has none. */
GLuint pipeline_map_framebuffer(pipeline *p, pixel_kind kind);
/* What the effect takes. */
glssao_frame pipeline_frame(const pipeline *p, const scene_view *view);
/* Whether the effect has anything to do in this view. */
bool pipeline_runs_occlusion(const pipeline *p, const scene_view *view);
/* Whether anyone reads the normals of this view. */
bool pipeline_reads_normals(const pipeline *p, const scene_view *view);

#endif
