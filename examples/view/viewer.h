/* SPDX-License-Identifier: MIT
 *
 * The state of the viewer, and the functions of its parts: scene and frame pipeline (viewer.c), the screen (display.c),
 * the mouse (input.c), keys (keys.c), the panel (panel.c, panel_settings.c), pictures and command lines (save.c).
 */
#pragma once

#include "options.h"
#include "pipeline.h"
#include "ray_worker.h"
#include "viewpoint.h"

struct GLFWwindow;

typedef enum viewer_mode { MODE_ON = 0, MODE_OFF, MODE_SPLIT, MODE_BLINK, MODE_COUNT } viewer_mode;
#define VIEWER_MODES "occlusion on|occlusion off|split|blink"

typedef enum viewer_shown {
    SHOWN_PICTURE = 0,
    SHOWN_AO,
    SHOWN_RAW, /* the estimate before blur and upsampling */
    SHOWN_NORMALS,
    SHOWN_DISTANCE,
    SHOWN_RANDOM,
    SHOWN_SHADOW,
    SHOWN_TILES, /* white: skipped */
    SHOWN_TRUTH,
    SHOWN_DIFFERENCE, /* to ray-traced accessibility */
    SHOWN_COUNT
} viewer_shown;
#define VIEWER_SHOWN                                                                                                   \
    "picture|accessibility|raw estimate|normals|view distance|random vectors|shadow map|skipped tiles|"                \
    "ray-traced accessibility|error against ray-traced"

enum { GRAPH_LENGTH = 120, GRAPH_COUNT = GLSSAO_PASS_COUNT + 2, GRAPH_PREPASS = GLSSAO_PASS_COUNT, GRAPH_MAIN };

typedef struct viewer {
    struct GLFWwindow *window;
    options options;             /* the command line and later changes, except for the settings */
    char scene_path[4096];       /* "": the built-in scene options.scene_name */
    char environment_path[4096]; /* "": the built-in light or that of the command line */
    scene *scene;
    inputs inputs; /* files that the scene was read from */
    pipeline pipeline;
    viewpoint viewpoint;
    bool moved; /* the user moved the camera */
    glssao_settings settings;
    scene_view view;   /* of the last frame */
    int width, height; /* of the framebuffer in pixels */

    viewer_mode mode;
    viewer_shown shown;
    float split;     /* position of the line, as a share of the width */
    bool blink_off;  /* the blink shows the picture without occlusion */
    float gui_scale; /* number of pixels for a pixel of a screen of usual density */
    bool panel_open, panel_focus_due, help_open, opening, about_to_open;
    char typed_path[4096];

    bool frame_due;   /* the frame must be drawn again */
    int still_frames; /* with a history, of the same view after the last frame */
    bool rested;      /* nothing more comes of a view that rests */
    GLuint off_color, off_framebuffer, map, map_framebuffer;
    ray_worker *ray_worker; /* NULL: none yet */
    bool rays_asked;        /* it was asked for the rays of this view */
    bool rays_failed;
    int rays_rounds; /* that are shown */
    ray_worker *truth;
    int truth_rounds, truth_shown_rounds;
    float *truth_mean; /* mean of the rounds that were read last */
    double truth_rmse; /* of accessibility; negative: unknown */

    char notice[1024];
    bool notice_is_error;
    double notice_until;                    /* seconds of glfwGetTime; 0: until the next notice */
    float graph[GRAPH_COUNT][GRAPH_LENGTH]; /* milliseconds */
    float frame_ms[GRAPH_LENGTH];           /* pre-pass, occlusion and main pass together */
    int graph_next;
    unsigned frames, updates; /* frames drawn, and updates of the screen */
    unsigned reused, rests;   /* frames that could reuse earlier ones, and steps of a view at rest */
    char error[1024];
} viewer;

/* ---- viewer.c ---- */

/* Opens a file, or the built-in scene `name` if `path` is NULL. If that fails, the old scene stays and the reason is
 * shown. */
bool viewer_open(viewer *v, const char *path, const char *name);
/* Opens a file that was dropped or named: a scene, or a picture that lights it. */
bool viewer_open_file(viewer *v, const char *path);
void viewer_close(viewer *v);
void viewer_say(viewer *v, bool is_error, const char *format, ...);
/* Chooses the camera of the command line, or fits the view to the scene if the user has moved the camera. */
void viewer_frame_scene(viewer *v);
void viewer_toggle_panel(viewer *v);
/* The default settings of the current technique, quality and radius. */
glssao_settings viewer_standard(const viewer *v);
void viewer_set_technique(viewer *v, int technique, int quality);
/* Call it after a change of options that configure the renderer. */
void viewer_configure(viewer *v);
/* Call it after a change that the frame shows. */
void viewer_change(viewer *v);
/* Call it after moving the camera. */
void viewer_camera_moved(viewer *v);

/* ---- display.c ---- */

bool viewer_resize(viewer *v, int width, int height);
void viewer_free_targets(viewer *v);
/* Draws the frame if it is due, and what the user sees of it into framebuffer 0. The panel is drawn afterwards. */
void viewer_display(viewer *v);
/* What the user sees without the panel: RGBA, rows bottom to top. The caller frees it. */
void *viewer_read_shown(viewer *v);

/* Whether ambient light comes from where surfaces are open. */
bool viewer_lights_bent(const viewer *v);
/* Whether a frame is averaged from several, each of which needs its own depth. */
bool viewer_averages(const viewer *v);

/* ---- rest.c ---- */

/* Whether frames reuse earlier ones. */
bool rest_reuses(const viewer *v);
/* The sampling error that the picture has at last; 0: none is aimed at. */
double rest_error(const viewer *v);
/* Whether there is more to do for the frame that is shown. */
bool rest_is_due(const viewer *v);
/* Does a part of it. */
bool rest_step(viewer *v);
/* Whether the map of accessibility is not yet as good as the last one that was shown. */
bool rest_hides(const viewer *v);

/* ---- rays_view.c ---- */

/* Whether rays are traced for what is shown. */
bool rays_view_applies(const viewer *v);
/* A round has come that is not shown. */
bool rays_view_is_due(const viewer *v);
/* Before a frame: uploads what has come. */
void rays_view_take(viewer *v);
/* After a frame: starts the tracing unless it runs. */
void rays_view_ask(viewer *v);
/* Makes the settings those of the frame: screen space where no rays have come yet. */
void rays_view_adjust(const viewer *v, glssao_settings *settings);
/* The view has changed. */
void rays_view_drop(viewer *v);
/* The scene goes. */
void rays_view_stop(viewer *v);

/* ---- truth_view.c ---- */

#define VIEWER_ERROR_RANGE 0.25 /* error of accessibility that gets the full colour */
bool viewer_shows_truth(const viewer *v);
/* Starts the tracing unless it runs, reads new rounds and draws them into v->map. */
void viewer_draw_truth(viewer *v);
void viewer_drop_truth(viewer *v);

/* ---- input.c ---- */

void input_start(viewer *v);
/* Walks while keys are held. True if the camera moved. */
bool input_walk(viewer *v, double seconds);

/* ---- keys.c ---- */

/* Handles a key that was pressed or repeats, in GLFW's numbers. */
void keys_press(viewer *v, int key, int modifiers);
extern const char *const keys_help[][2]; /* key and what it does; ends with NULL */

/* ---- panel.c, panel_settings.c ---- */

void panel_draw(viewer *v);
/* Draws the section with all settings of the technique. */
void panel_draw_settings(viewer *v);

/* ---- save.c ---- */

void viewer_save_picture(viewer *v);
/* Writes the glssao-render command line that makes this picture. False if it does not fit. */
bool viewer_command_line(const viewer *v, char *out, size_t out_size);
void viewer_copy_command_line(viewer *v);
