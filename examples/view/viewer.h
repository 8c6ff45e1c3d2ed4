/* SPDX-License-Identifier: MIT
 *
 * The viewer's state, and what its parts do with it: a scene and a frame pipeline (viewer.c), what is on the screen
 * (display.c), mouse (input.c) and keys (keys.c), the panel (panel.c, panel_settings.c), files and command lines
 * (save.c).
 */
#ifndef GLSSAO_EXAMPLES_VIEWER_H
#define GLSSAO_EXAMPLES_VIEWER_H

#include "options.h"
#include "pipeline.h"
#include "truth_job.h"
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
    SHOWN_TILES, /* white where nothing is estimated */
    SHOWN_TRUTH,
    SHOWN_DIFFERENCE, /* to the truth */
    SHOWN_COUNT
} viewer_shown;
#define VIEWER_SHOWN                                                                                                   \
    "picture|accessibility|raw estimate|normals|view distance|random vectors|shadow map|tiles left out|"               \
    "ray-traced accessibility|difference to ray-traced"

enum { GRAPH_LENGTH = 120, GRAPH_COUNT = GLSSAO_PASS_COUNT + 2, GRAPH_PREPASS = GLSSAO_PASS_COUNT, GRAPH_MAIN };

typedef struct viewer {
    struct GLFWwindow *window;
    options options;             /* of the command line, with what was changed since, the settings aside */
    char scene_path[4096];       /* "": the built-in scene options.scene_name */
    char environment_path[4096]; /* "": the built-in light, or the command line's */
    scene *scene;
    inputs inputs; /* files that it was read from */
    pipeline pipeline;
    viewpoint viewpoint;
    bool moved; /* the camera is no longer the command line's */
    glssao_settings settings;
    scene_view view;   /* of the frame last drawn */
    int width, height; /* of the framebuffer, pixels */

    viewer_mode mode;
    viewer_shown shown;
    float split;     /* of the width, from the left */
    bool blink_off;  /* this half of the blink shows no occlusion */
    float gui_scale; /* pixels a point of a screen of usual density */
    bool panel_open, panel_focus_due, help_open, opening, about_to_open;
    char typed_path[4096];

    bool frame_due; /* the frame has to be drawn again */
    GLuint off_color, off_framebuffer, map, map_framebuffer;
    truth_job *truth;
    int truth_rounds, truth_shown_rounds;
    float *truth_mean; /* of the last rounds read */
    double truth_rmse; /* against accessibility; negative: not known */

    char notice[1024];
    bool notice_is_error;
    double notice_until;                    /* seconds of glfwGetTime; 0: stays until the next */
    float graph[GRAPH_COUNT][GRAPH_LENGTH]; /* milliseconds */
    float frame_ms[GRAPH_LENGTH];           /* pre-pass, occlusion and main together */
    int graph_next;
    unsigned frames, updates; /* frames drawn; times the screen was updated */
    char error[1024];
} viewer;

/* ---- viewer.c ---- */

/* Opens a file (NULL: the built-in scene `name`) in place of the scene there is, which stays where that fails; the
 * reason is shown. */
bool viewer_open(viewer *v, const char *path, const char *name);
/* A file that was dropped or named: a scene, or a picture that lights it. */
bool viewer_open_file(viewer *v, const char *path);
void viewer_close(viewer *v);
void viewer_say(viewer *v, bool is_error, const char *format, ...);
/* The camera that frames the scene, or the command line's. */
void viewer_frame_scene(viewer *v);
void viewer_toggle_panel(viewer *v);
/* The settings that the technique, quality and radius of the moment come with. */
glssao_settings viewer_standard(const viewer *v);
void viewer_set_technique(viewer *v, int technique, int quality);
/* Passes a change of options that the renderer is configured by. */
void viewer_configure(viewer *v);
/* Something changed that the frame shows. */
void viewer_change(viewer *v);
/* The camera is no longer the command line's or the file's. */
void viewer_camera_moved(viewer *v);

/* ---- display.c ---- */

bool viewer_resize(viewer *v, int width, int height);
void viewer_free_targets(viewer *v);
/* Draws the frame where it is due, and what is shown of it into framebuffer 0; the panel comes after. */
void viewer_display(viewer *v);
/* What is shown, without the panel; RGBA of malloc, bottom to top. */
void *viewer_read_shown(viewer *v);

/* ---- truth_view.c ---- */

#define VIEWER_ERROR_RANGE 0.25 /* of accessibility: full colour */
bool viewer_shows_truth(const viewer *v);
/* Starts the tracing where it is shown and not there, takes what is new of it, and draws it into v->map. */
void viewer_draw_truth(viewer *v);
void viewer_drop_truth(viewer *v);

/* ---- input.c ---- */

void input_start(viewer *v);
/* Keys that are held: walking. True where the camera moved. */
bool input_walk(viewer *v, double seconds);

/* ---- keys.c ---- */

/* A key that was pressed, or repeats, in GLFW's numbers. */
void keys_press(viewer *v, int key, int modifiers);
extern const char *const keys_help[][2]; /* key, what it does; ends with NULL */

/* ---- panel.c, panel_settings.c ---- */

void panel_draw(viewer *v);
/* The section with every setting of the technique. */
void panel_draw_settings(viewer *v);

/* ---- save.c ---- */

void viewer_save_picture(viewer *v);
/* The glssao-render command line that makes this picture; true where it fits. */
bool viewer_command_line(const viewer *v, char *out, size_t out_size);
void viewer_copy_command_line(viewer *v);

#endif
