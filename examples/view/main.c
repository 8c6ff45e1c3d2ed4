/* SPDX-License-Identifier: MIT
 *
 * glssao-view: opens a window and updates it when something happens.
 */
#include "gui.h"
#include "heap.h"
#include "statistics.h"
#include "streams.h"
#include "viewer.h"

#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_DONE = 0, EXIT_NOT_SHOWN = 1, EXIT_USAGE = 2 };
/* The panel reacts to an event one frame later, and its last movements end one frame after that. */
enum { UPDATES_AFTER_EVENT = 3 };
static const double blink_seconds = 0.6;

static void *load_function(const char *name, void *user)
{
    (void)user;
    GLFWglproc function = glfwGetProcAddress(name);
    void *address = NULL;
    memcpy(&address, &function, sizeof address); /* as in viewer.c */
    return address;
}

static void on_glfw_error(int code, const char *text)
{
    fprintf(stderr, "glssao-view: window system: %s (%d)\n", text, code);
}

static bool open_window(viewer *v)
{
    glfwSetErrorCallback(on_glfw_error);
    if (!glfwInit())
        return false;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    v->window = glfwCreateWindow(v->options.width, v->options.height, "glssao-view", NULL, NULL);
    if (!v->window)
        return false;
    glfwMakeContextCurrent(v->window);
    glfwSwapInterval(1);
    return gl_load(load_function, NULL, v->error, sizeof v->error);
}

/* A minimised window keeps its size on X11 and has none on Windows. */
static bool is_minimised(const viewer *v)
{
    int width, height;
    glfwGetFramebufferSize(v->window, &width, &height);
    return width < 1 || height < 1 || glfwGetWindowAttrib(v->window, GLFW_ICONIFIED);
}

static bool follow_size(viewer *v)
{
    int width, height;
    glfwGetFramebufferSize(v->window, &width, &height);
    return (width == v->width && height == v->height) || viewer_resize(v, width, height);
}

static void update(viewer *v)
{
    v->blink_off = fmod(glfwGetTime(), 2 * blink_seconds) > blink_seconds;
    viewer_display(v);
    gui_begin_frame();
    panel_draw(v);
    gui_end_frame();
    glfwSwapBuffers(v->window);
    v->updates++;
    const GLenum error = gl.GetError();
    if (error != GL_NO_ERROR)
        viewer_say(v, true, "OpenGL error 0x%04x", error);
}

/* How many seconds to wait for events: nothing changes by itself until then. */
static double quiet_time(const viewer *v, bool walking)
{
    if (is_minimised(v))
        return 3600; /* until the next event */
    double quiet = v->notice[0] && v->notice_until > glfwGetTime() ? v->notice_until - glfwGetTime() + 0.01 : 3600;
    if (v->mode == MODE_BLINK && v->shown == SHOWN_PICTURE)
        quiet = fmin(quiet, blink_seconds - fmod(glfwGetTime(), blink_seconds) + 0.01);
    return walking || rest_is_due(v) ? 0.001 : quiet;
}

/* Median of the frames in the graph. */
static double median_frame_ms(const viewer *v)
{
    const int count = v->frames < GRAPH_LENGTH ? (int)v->frames : GRAPH_LENGTH;
    double ms[GRAPH_LENGTH] = {0};
    for (int i = 0; i < count; i++)
        ms[i] = (double)v->frame_ms[i];
    return statistics_percentile(ms, count > 0 ? count : 1, 50);
}

static void run(viewer *v)
{
    bool walking = false;
    int due = UPDATES_AFTER_EVENT;
    double last = glfwGetTime(), shown[2] = {0}; /* times of the first picture, and of the first with occlusion */
    while (!glfwWindowShouldClose(v->window)) {
        const double now = glfwGetTime();
        walking = input_walk(v, fmin(now - last, 0.1));
        last = now;
        if (!is_minimised(v) && follow_size(v))
            update(v);
        if (v->updates == 1)
            shown[0] = glfwGetTime();
        if (shown[1] == 0 && v->updates > 0 && !v->frame_due) {
            shown[1] = glfwGetTime();
            glfwSetWindowTitle(v->window, v->scene->name); /* the title tells that the picture is complete */
        }
        if (--due > 0) {
            glfwPollEvents();
            continue;
        }
        glfwWaitEventsTimeout(quiet_time(v, walking));
        if (glfwGetTime() - last > 0.2)
            last = glfwGetTime(); /* do not walk for the time spent waiting */
        due = UPDATES_AFTER_EVENT;
    }
    fprintf(stderr,
            "glssao-view: shown after %.0f ms, with occlusion after %.0f ms; %u frames drawn, %u screen updates, "
            "a frame takes %.1f ms; %u frames with a history, %u steps at rest\n",
            1e3 * shown[0], 1e3 * shown[1], v->frames, v->updates, median_frame_ms(v), v->reused, v->rests);
}

int main(int argc, char **argv)
{
    static viewer v; /* too large for the stack; starts as 0 */
    streams_guard("glssao-view", EXIT_NOT_SHOWN);
    heap_keep_freed();
    switch (options_parse_for_viewer(argc, argv, &v.options, FAULT(v.error))) {
    case OPTIONS_DONE:
        return EXIT_DONE;
    case OPTIONS_WRONG:
        fprintf(stderr, "glssao-view: %s\n", v.error);
        return EXIT_USAGE;
    case OPTIONS_RUN:
        break;
    }
    v.split = 0.5f;
    v.panel_open = true;
    v.truth_rmse = -1;
    v.mode = v.options.no_ao ? MODE_OFF : MODE_ON;
    if (!open_window(&v)) {
        fprintf(stderr, "glssao-view: no window with OpenGL 3.3%s%s\n", v.error[0] ? ": " : "", v.error);
        glfwTerminate();
        return EXIT_NOT_SHOWN;
    }
    float scale = 1;
    int window_width = 1, window_height = 1;
    glfwGetWindowContentScale(v.window, &scale, NULL);
    glfwGetFramebufferSize(v.window, &v.width, &v.height);
    glfwGetWindowSize(v.window, &window_width, &window_height);
    v.width = v.width < 1 ? 1 : v.width;
    v.height = v.height < 1 ? 1 : v.height;
    /* If a screen coordinate spans several pixels, as on macOS, the window system scales already. */
    v.gui_scale = v.width > window_width ? 1 : scale;
    const bool opened = viewer_open(&v, v.options.scene_path, v.options.scene_name);
    if (opened) {
        input_start(&v);
        gui_start(v.window, v.gui_scale);
        run(&v);
        gui_stop();
    }
    viewer_close(&v);
    glfwDestroyWindow(v.window);
    /* glfwTerminate is not called: it would unload the driver, and a leak checker could not tell the driver's leaks
     * from ours. */
    return opened ? EXIT_DONE : EXIT_NOT_SHOWN;
}
