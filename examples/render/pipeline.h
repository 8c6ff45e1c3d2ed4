/* SPDX-License-Identifier: MIT
 *
 * One frame: pre-pass, occlusion, main pass and read-back. Passes whose result is not used have no targets and no
 * shaders. The context is current in all calls.
 */
#pragma once

#include "draw.h"
#include "fault.h"
#include "gl.h"
#include "options.h"
#include "pixel_kind.h"
#include "progressive.h"
#include "rays.h"
#include "report.h"
#include "samples.h"
#include "scene.h"
#include "stage.h"
#include "truth.h"

/* What the command line calls for. */
typedef struct pipeline_wants {
    bool picture;    /* the main pass */
    bool ao_map;     /* accessibility is read back or shown */
    bool ao;         /* accessibility, from the occlusion passes or: */
    bool traced;     /* from rays through each pixel, without occlusion passes */
    bool rays;       /* a few rays from the pre-pass's surfaces go into the occlusion passes */
    bool motion;     /* the scene is posed anew for each frame, and the occlusion passes reuse earlier ones */
    bool prepass;    /* depth */
    bool maps;       /* a map is read back or shown in the picture's corner */
    int samples;     /* for each pixel of the picture */
    bool timers;     /* measure the occlusion passes */
    bool normals;    /* a normal map, for the occlusion passes or to be read back */
    bool normal_map; /* the normal map is read back or shown */
} pipeline_wants;

typedef struct pipeline {
    pipeline_wants wants;
    int width, height;        /* of the targets, including the margin */
    int margin;               /* pixels on each side that are drawn but not written */
    stage own;                /* only after pipeline_create */
    scene_renderer *renderer; /* belongs to the stage */
    scene_lighting lighting;
    scene_environment *environment; /* used by the lighting; NULL: the built-in one */
    char *environment_path;
    glssao_effect *effect; /* the kept effect, or NULL if the job needs no occlusion passes and no normals */
    glssao_effect *kept;   /* has these properties and the size of the targets */
    bool kept_timers;
    glssao_path kept_path;
    uint32_t seed;
    truth truth;     /* only if wants.traced */
    rays rays;       /* only if wants.rays, or where pipeline_read_surfaces was called */
    bool rays_ready; /* the texture has rays of the view that were traced elsewhere */
    const trace_scene *traced;
    bool adaptive_rays;
    int ray_count; /* from each traced pixel */
    glssao_settings settings;
    scene_view last_view;  /* of the last occlusion passes that may be reused */
    bool has_last;         /* false: none may */
    uint32_t frame_number; /* with a history, of the rays' pattern */
    bool is_posed;         /* the scene was posed anew since then, and scene_draw_motion knows how */
    progressive_goal goal; /* all 0: one estimate with the settings */
    progressive_report reached;
    scene_draw_options draw_options;
    options_map debug_map;
    float up[3];         /* of the sky */
    bool plain;          /* a background replaces the sky */
    bool transparent;    /* the background has alpha 0, and the picture straight alpha */
    float background[4]; /* linear colour and alpha */
    samples samples;     /* only with several samples or a transparent background */
    GLuint depth, depth_framebuffer, color, color_framebuffer;
    GLuint layers[2], layer_framebuffer; /* back faces and second front faces, only if draw_options.layers */
    GLuint motion, motion_framebuffer;   /* only if wants.motion */
    GLuint scratch, scratch_framebuffer; /* owned by map_view.c */
    GLuint maps[PIXEL_KIND_COUNT],
        map_framebuffers[PIXEL_KIND_COUNT]; /* maps are drawn here before they are read back */
} pipeline;

/* False, with one line in `why`, on failure. Call pipeline_destroy in either case. */
bool pipeline_create(pipeline *p, const scene *s, glssao_load_fn load, void *load_user, const options *o,
                     pipeline_wants wants, failure *why);

/* Prepares the pipeline, which is zero or has drawn something else, to draw a stage with these options. The effect, its
 * shaders and targets are kept where they fit. The stage must outlive its use. False, with one line in `why`, on
 * failure; then only pipeline_destroy may follow. */
bool pipeline_prepare(pipeline *p, stage *st, glssao_load_fn load, void *load_user, const options *o,
                      pipeline_wants wants, failure *why);

/* Lights the scene with the picture at `path`, or with the built-in light (NULL). A picture that is in use is not read
 * again. Call scene_renderer_configure afterwards. False, with one line in `why`, on failure; the light then stays. */
bool pipeline_surround(pipeline *p, const stage *st, const char *path, failure *why);

/* The settings that the command line asks for. */
glssao_settings pipeline_settings(const options *o, const scene *s);

/* Makes the targets again for another size. Call pipeline_destroy in either case. Not for traced frames. */
bool pipeline_resize(pipeline *p, int width, int height, failure *why);

/* What rays start from, for who traces them elsewhere (rays.h): one texel of each `step` x `step` pixels of the last
 * frame's pre-pass. The caller frees it. NULL, with one line in `why`, on failure. */
float (*pipeline_read_surfaces(pipeline *p, const scene_view *view, int step, failure *why))[4];

/* Texture name of the accessibility map of the last frame. */
GLuint pipeline_ambient_map(const pipeline *p);

/* Frees everything and sets all members to 0. */
void pipeline_destroy(pipeline *p);

/* Draws everything that is wanted and records the phases in `times`. `view` includes the margin. */
bool pipeline_draw(pipeline *p, const scene_view *view, stopwatch *times, failure *why);

/* Finds the accessibility of the last frame anew; or one more estimate for its mean, whose count is p->reached. */
bool pipeline_occlude(pipeline *p, const scene_view *view, failure *why);
bool pipeline_accumulate(pipeline *p, const scene_view *view, const progressive_goal *goal, failure *why);

/* Draws the picture of the last frame again, with another accessibility map (0: none), into a framebuffer of the
 * pipeline's size whose depth attachment is the pipeline's `depth`. */
void pipeline_shade(pipeline *p, const scene_view *view, GLuint ambient_map, GLuint framebuffer);

/* What can be read back of the last frame, and the kinds of pixels. */
typedef enum pipeline_output {
    PIPELINE_PICTURE,      /* PIXELS_RGBA8, sRGB */
    PIPELINE_AO,           /* PIXELS_GREY8 or PIXELS_FLOAT */
    PIPELINE_NORMALS,      /* PIXELS_RGBA8, n * 0.5 + 0.5 */
    PIPELINE_VIEW_DISTANCE /* PIXELS_FLOAT */
} pipeline_output;

/* Size of an output in bytes, without the margin. */
size_t pipeline_output_size(const pipeline *p, pixel_kind kind);

/* Calls glReadPixels for an output: rows bottom to top, without margin and padding. `pixels` is an address, or an
 * offset if a buffer is bound to GL_PIXEL_PACK_BUFFER. An output that is in memory (pipeline_is_in_memory) needs an
 * address. False if OpenGL offers no framebuffer for the output. */
bool pipeline_read(pipeline *p, pipeline_output output, pixel_kind kind, const scene_view *view, void *pixels);
bool pipeline_is_in_memory(const pipeline *p, pipeline_output output, pixel_kind kind);

/* Accessibility as PIXELS_GREY8 or PIXELS_FLOAT. The caller frees it. NULL if memory is short. */
void *pipeline_read_ao(pipeline *p, pixel_kind kind);

/* The settings that the options ask for, with this radius unless they name one; 0: that of the level. */
glssao_settings pipeline_settings_at(const options *o, float radius);

/* Prints a table of the passes that a frame runs and skips to stdout. */
void pipeline_print_plan(const pipeline *p, const scene_view *view);

/* ---- Used only by the pipeline's own files */

/* False, with the failed call and the library's last error in `why`, if the result is not GLSSAO_OK. */
bool pipeline_check(glssao_result result, const char *what, failure *why);
/* Frees the targets. False, with one line in `why`, if the context has no framebuffers of that size. */
bool pipeline_change_size(pipeline *p, int width, int height, failure *why);
/* Makes the targets that are wanted and missing. */
bool pipeline_make_targets(pipeline *p, failure *why);
void pipeline_free_targets(pipeline *p);
/* The framebuffer for maps that are read back; 0 if OpenGL offers none. */
GLuint pipeline_map_framebuffer(pipeline *p, pixel_kind kind);
/* The frame as the effect takes it. */
glssao_frame pipeline_frame(const pipeline *p, const scene_view *view);
/* Whether the effect runs for this view. */
bool pipeline_runs_occlusion(const pipeline *p, const scene_view *view);
/* Whether any pass or output reads the normals of this view. */
bool pipeline_reads_normals(const pipeline *p, const scene_view *view);
