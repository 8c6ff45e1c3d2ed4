/* SPDX-License-Identifier: MIT
 *
 * Handles keys, and holds the list that F1 shows.
 */
#include "gui.h"
#include "navigate.h"
#include "setting_table.h"
#include "viewer.h"

#include <GLFW/glfw3.h>

#include <math.h>
#include <string.h>

const char *const keys_help[][2] = {
    {"left drag", "turn the camera round the target"},
    {"right drag", "turn the camera where it stands"},
    {"middle drag, Shift + left drag", "move the camera sideways"},
    {"wheel, + -", "move nearer, farther"},
    {"W A S D, Q E", "walk; down, up (with Shift: faster)"},
    {"arrows", "turn the camera; with Ctrl in split view: move the line"},
    {"F", "fit the view to the scene"},
    {"1 2 3 4, Space", "occlusion on, off, split by a line, blinking; toggle on and off"},
    {"M, Shift+M", "next map, previous map"},
    {"P O U N V X", "picture, accessibility, raw estimate, normals, view distance, random vectors"},
    {"H Z", "shadow map, skipped tiles"},
    {"T, Y", "error against ray-traced accessibility; the ray-traced accessibility"},
    {"Tab, Shift+Tab", "technique; quality"},
    {"[ ]", "smaller, larger radius"},
    {", .", "less, more contrast"},
    {"R", "suggested radius of the scene"},
    {"Backspace", "default settings of the technique and quality"},
    {"J K L B I", "shadows, mapped normals, specular occlusion, multi-bounce, map in the corner"},
    {"Ctrl+O, drop a file", "open a glTF file, or an equirectangular picture that lights the scene"},
    {"Page Up, Page Down", "previous, next built-in scene"},
    {"Ctrl+S", "save the picture"},
    {"Ctrl+C", "copy and print the glssao-render command line"},
    {"G", "show or hide the panel"},
    {"F2", "move through the panel with keys; Esc ends that"},
    {"F1", "this list"},
    {"Ctrl+Q", "quit"},
    {NULL, NULL},
};

static void step_technique(viewer *v)
{
    viewer_set_technique(v, (v->options.technique + 1) % (GLSSAO_HORIZON + 1), v->options.quality);
}

static void step_quality(viewer *v)
{
    viewer_set_technique(v, v->options.technique, (v->options.quality + 1) % (GLSSAO_ULTRA + 1));
}

static void set_radius(viewer *v, float radius)
{
    if (v->settings.radius_in_pixels)
        v->settings.radius = radius;
    else
        setting_scale_radius(&v->settings, radius);
    v->options.radius = (option_number){true, radius};
    viewer_change(v);
}

static void show(viewer *v, viewer_shown what)
{
    const bool was_raw = v->shown == SHOWN_RAW;
    v->shown = v->shown == what ? SHOWN_PICTURE : what;
    if (was_raw != (v->shown == SHOWN_RAW))
        v->frame_due = true;
    if (!viewer_shows_truth(v))
        viewer_drop_truth(v);
}

static void step_shown(viewer *v, int by)
{
    show(v, (viewer_shown)(((int)v->shown + by + SHOWN_COUNT) % SHOWN_COUNT));
}

static void step_scene(viewer *v, int by)
{
    static const char *const names[] = {"columns", "cornell", "steps", "plane"};
    int at = by > 0 ? -1 : 0;
    for (int i = 0; i < 4; i++)
        if (!v->scene_path[0] && !strcmp(v->scene->name, names[i]))
            at = i;
    viewer_open(v, NULL, names[(at + by + 4) % 4]);
}

static void toggle(viewer *v, bool *value)
{
    *value = !*value;
    viewer_configure(v);
}

static bool key_with_control(viewer *v, int key)
{
    switch (key) {
    case GLFW_KEY_Q:
        glfwSetWindowShouldClose(v->window, GLFW_TRUE);
        return true;
    case GLFW_KEY_O:
        v->about_to_open = v->opening = true;
        return true;
    case GLFW_KEY_S:
        viewer_save_picture(v);
        return true;
    case GLFW_KEY_C:
        viewer_copy_command_line(v);
        return true;
    case GLFW_KEY_LEFT:
    case GLFW_KEY_RIGHT:
        v->split = fminf(fmaxf(v->split + (key == GLFW_KEY_LEFT ? -0.02f : 0.02f), 0), 1);
        return true;
    default:
        return false;
    }
}

static bool key_of_view(viewer *v, int key)
{
    const float step = 0.1f;
    switch (key) {
    case GLFW_KEY_F:
        v->moved = true; /* fit the view, even if the file or the command line has a camera */
        viewer_frame_scene(v);
        return true;
    case GLFW_KEY_LEFT:
    case GLFW_KEY_RIGHT:
        navigate_orbit(&v->viewpoint.base, v->viewpoint.axis, key == GLFW_KEY_LEFT ? -step : step, 0);
        break;
    case GLFW_KEY_UP:
    case GLFW_KEY_DOWN:
        navigate_orbit(&v->viewpoint.base, v->viewpoint.axis, 0, key == GLFW_KEY_DOWN ? -step : step);
        break;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
        navigate_zoom(&v->viewpoint.base, key == GLFW_KEY_EQUAL || key == GLFW_KEY_KP_ADD ? 0.9f : 1 / 0.9f);
        break;
    default:
        return false;
    }
    viewer_camera_moved(v);
    return true;
}

static bool key_of_show(viewer *v, int key, bool shift)
{
    static const struct {
        int key;
        viewer_shown shown;
    } maps[] = {{GLFW_KEY_O, SHOWN_AO},         {GLFW_KEY_U, SHOWN_RAW},    {GLFW_KEY_N, SHOWN_NORMALS},
                {GLFW_KEY_V, SHOWN_DISTANCE},   {GLFW_KEY_X, SHOWN_RANDOM}, {GLFW_KEY_H, SHOWN_SHADOW},
                {GLFW_KEY_T, SHOWN_DIFFERENCE}, {GLFW_KEY_Y, SHOWN_TRUTH},  {GLFW_KEY_Z, SHOWN_TILES},
                {GLFW_KEY_P, SHOWN_PICTURE}};
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++)
        if (maps[i].key == key) {
            show(v, maps[i].shown);
            return true;
        }
    if (key >= GLFW_KEY_1 && key <= GLFW_KEY_4) {
        v->mode = (viewer_mode)(key - GLFW_KEY_1);
        show(v, SHOWN_PICTURE);
        v->shown = SHOWN_PICTURE;
    } else if (key == GLFW_KEY_SPACE) {
        v->mode = v->mode == MODE_ON ? MODE_OFF : MODE_ON;
    } else if (key == GLFW_KEY_M) {
        step_shown(v, shift ? -1 : 1);
    } else {
        return false;
    }
    return true;
}

static bool key_of_settings(viewer *v, int key, bool shift)
{
    switch (key) {
    case GLFW_KEY_TAB:
        (shift ? step_quality : step_technique)(v);
        return true;
    case GLFW_KEY_LEFT_BRACKET:
        set_radius(v, v->settings.radius / 1.25f);
        return true;
    case GLFW_KEY_RIGHT_BRACKET:
        set_radius(v, v->settings.radius * 1.25f);
        return true;
    case GLFW_KEY_R:
        set_radius(v, v->settings.radius_in_pixels ? (float)SETTING_PIXELS : camera_suggest_radius(v->scene));
        return true;
    case GLFW_KEY_COMMA:
    case GLFW_KEY_PERIOD:
        v->settings.power = fminf(fmaxf(v->settings.power + (key == GLFW_KEY_COMMA ? -0.25f : 0.25f), 0), 64);
        viewer_change(v);
        return true;
    case GLFW_KEY_BACKSPACE:
        v->settings = viewer_standard(v);
        viewer_change(v);
        return true;
    case GLFW_KEY_J:
        toggle(v, &v->options.no_shadows);
        return true;
    case GLFW_KEY_K:
        toggle(v, &v->options.mapped_normals);
        return true;
    case GLFW_KEY_L:
        toggle(v, &v->options.specular_occlusion);
        return true;
    case GLFW_KEY_B:
        toggle(v, &v->options.multi_bounce);
        return true;
    case GLFW_KEY_I:
        v->options.debug_map = v->options.debug_map ? OPTIONS_MAP_NONE : OPTIONS_MAP_AO;
        viewer_configure(v);
        return true;
    default:
        return false;
    }
}

void keys_press(viewer *v, int key, int modifiers)
{
    const bool shift = modifiers & GLFW_MOD_SHIFT;
    if (key == GLFW_KEY_F1) {
        v->help_open = !v->help_open;
    } else if (key == GLFW_KEY_F2) {
        if (!v->panel_open)
            viewer_toggle_panel(v);
        v->panel_focus_due = true;
    } else if (key == GLFW_KEY_ESCAPE) {
        v->help_open = v->opening = false;
        gui_leave();
    } else if (modifiers & GLFW_MOD_CONTROL) {
        if (!gui_wants_keyboard() || key != GLFW_KEY_C) /* in the panel, Ctrl+C copies text */
            key_with_control(v, key);
    } else if (gui_wants_keyboard()) {
        return;
    } else if (key == GLFW_KEY_G) {
        viewer_toggle_panel(v);
    } else if (key == GLFW_KEY_PAGE_UP || key == GLFW_KEY_PAGE_DOWN) {
        step_scene(v, key == GLFW_KEY_PAGE_UP ? -1 : 1);
    } else if (!key_of_view(v, key) && !key_of_show(v, key, shift)) {
        key_of_settings(v, key, shift);
    }
}
