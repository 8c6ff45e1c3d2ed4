/* SPDX-License-Identifier: MIT
 *
 * Handles events of the window: mouse, dropped files and keys that are held. The panel gets its events first; the
 * others move the camera. keys.c handles single keys.
 */
#include "gui.h"
#include "navigate.h"
#include "viewer.h"

#include <GLFW/glfw3.h>

#include <math.h>

static const float turn_rad_per_height = 3.0f; /* for each height of the window */
static const double zoom_per_step = 0.9;
static const float split_reach = 8; /* distance at which the pointer takes hold of the line, in screen coordinates */

typedef struct drag {
    int button; /* -1: none */
    bool on_line, across;
    double x, y; /* pointer position after the events so far; glfwGetCursorPos would give a later one */
} drag;
static drag dragging = {.button = -1}; /* one pointer, one window */

/* Keys that are still down after they were pressed with Ctrl. They do not walk: Ctrl may be released before S. */
static bool commands[GLFW_KEY_LAST + 1];

static viewer *of_window(GLFWwindow *window)
{
    return glfwGetWindowUserPointer(window);
}

static void on_key(GLFWwindow *window, int key, int scancode, int action, int modifiers)
{
    (void)scancode;
    viewer *v = of_window(window);
    if (key >= 0 && action != GLFW_REPEAT)
        commands[key] = action == GLFW_PRESS && modifiers & GLFW_MOD_CONTROL;
    if (action != GLFW_RELEASE && v->scene)
        keys_press(v, key, modifiers);
}

static void on_button(GLFWwindow *window, int button, int action, int modifiers)
{
    viewer *v = of_window(window);
    int width = 1, height = 1;
    if (action == GLFW_RELEASE) {
        dragging.button = button == dragging.button ? -1 : dragging.button;
        return;
    }
    if (gui_wants_mouse() || dragging.button >= 0)
        return;
    gui_leave();
    glfwGetWindowSize(window, &width, &height);
    dragging.button = button;
    dragging.across = button == GLFW_MOUSE_BUTTON_MIDDLE || modifiers & GLFW_MOD_SHIFT;
    dragging.on_line = button == GLFW_MOUSE_BUTTON_LEFT && v->mode == MODE_SPLIT && v->shown == SHOWN_PICTURE &&
                       fabs(dragging.x - (double)v->split * width) < (double)split_reach;
}

static void on_pointer(GLFWwindow *window, double x, double y)
{
    viewer *v = of_window(window);
    int width = 1, height = 1;
    glfwGetWindowSize(window, &width, &height);
    const float right = (float)((x - dragging.x) / height), up = (float)((dragging.y - y) / height);
    dragging.x = x;
    dragging.y = y;
    if (dragging.button < 0 || (right == 0 && up == 0))
        return;
    if (dragging.on_line) {
        v->split = fminf(fmaxf((float)(x / width), 0), 1);
        return;
    }
    if (dragging.across)
        navigate_pan(&v->viewpoint.base, -right, -up);
    else if (dragging.button == GLFW_MOUSE_BUTTON_LEFT)
        navigate_orbit(&v->viewpoint.base, v->viewpoint.axis, -turn_rad_per_height * right, -turn_rad_per_height * up);
    else
        navigate_look(&v->viewpoint.base, v->viewpoint.axis, turn_rad_per_height * right, turn_rad_per_height * up);
    viewer_camera_moved(v);
}

static void on_scroll(GLFWwindow *window, double x, double y)
{
    (void)x;
    viewer *v = of_window(window);
    if (gui_wants_mouse() || !v->scene)
        return;
    navigate_zoom(&v->viewpoint.base, (float)pow(zoom_per_step, y));
    viewer_camera_moved(v);
}

static void on_drop(GLFWwindow *window, int count, const char **paths)
{
    if (count > 0)
        viewer_open_file(of_window(window), paths[0]);
}

void input_start(viewer *v)
{
    glfwSetWindowUserPointer(v->window, v);
    glfwSetKeyCallback(v->window, on_key);
    glfwSetMouseButtonCallback(v->window, on_button);
    glfwSetCursorPosCallback(v->window, on_pointer);
    glfwSetScrollCallback(v->window, on_scroll);
    glfwSetDropCallback(v->window, on_drop);
}

static float held(const viewer *v, int more, int less)
{
    const bool ahead = !commands[more] && glfwGetKey(v->window, more) == GLFW_PRESS;
    const bool back = !commands[less] && glfwGetKey(v->window, less) == GLFW_PRESS;
    return (float)ahead - (float)back;
}

bool input_walk(viewer *v, double seconds)
{
    const bool control = glfwGetKey(v->window, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                         glfwGetKey(v->window, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
    const float ahead = held(v, GLFW_KEY_W, GLFW_KEY_S), right = held(v, GLFW_KEY_D, GLFW_KEY_A);
    const float up = held(v, GLFW_KEY_E, GLFW_KEY_Q);
    if (!v->scene || control || gui_wants_keyboard() || (ahead == 0 && right == 0 && up == 0))
        return false;
    /* Five suggested radii a second; a scene is twenty of them long. */
    const float faster = glfwGetKey(v->window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ? 4 : 1;
    const float step = 5 * camera_suggest_radius(v->scene) * faster * (float)seconds;
    navigate_walk(&v->viewpoint.base, v->viewpoint.axis, step * ahead, step * right, step * up);
    viewer_camera_moved(v);
    return true;
}
