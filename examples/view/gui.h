/* SPDX-License-Identifier: MIT
 *
 * Dear ImGui as plain C: only the widgets that the viewer uses. gui.cpp is the only C++ of the viewer.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct GLFWwindow;

/* Call it after setting the window's callbacks: they are still called, before those of the panel. `scale` is the number
 * of pixels for a pixel of a screen of usual density. */
void gui_start(struct GLFWwindow *window, float scale);
void gui_stop(void);
void gui_begin_frame(void);
void gui_end_frame(void); /* draws into the bound framebuffer */

bool gui_wants_mouse(void);    /* the pointer is over the panel or drags a part of it */
bool gui_wants_keyboard(void); /* keys go to a text field or move through the panel */
void gui_leave(void);          /* the panel stops taking keys */

/* Width of the panel in pixels. */
float gui_panel_width(float scale);
/* Begins the panel, which covers the left edge of the window over its whole height. `focus`: keys go to it. Always call
 * gui_end_panel. */
void gui_begin_panel(const char *title, bool focus);
void gui_end_panel(void);
/* Begins a window in the middle that its button closes. False: it is closed; call gui_end_dialog only for true. */
bool gui_begin_dialog(const char *title, bool *open);
void gui_end_dialog(void);

bool gui_section(const char *title, bool open_at_first);
void gui_text(const char *text);
void gui_text_wrapped(const char *text);
void gui_same_line(void);
bool gui_button(const char *label);
/* A button behind the last widget, enabled if `differs`. True if it was pressed. */
bool gui_reset(const char *label, bool differs);
void gui_tip(const char *text); /* for the last widget */
bool gui_check(const char *label, bool *value);
/* `names` separated by '|'. */
bool gui_choice(const char *label, int *value, const char *names);
/* A slider with a button that sets `standard`. True if the value changed. */
bool gui_slider(const char *label, const char *unit, float *value, float low, float high, bool logarithmic,
                float standard);
bool gui_slider_whole(const char *label, const char *unit, int *value, int low, int high, int standard);
/* A text field. True if Enter was pressed in it. */
bool gui_input(const char *label, char *text, size_t size, bool focus);
void gui_graph(const char *label, const float *values, int count, int first, float high);
void gui_progress(float share, const char *text);
/* A table of three columns: name, whether it runs, why. */
bool gui_begin_table(const char *name);
void gui_table_row(const char *name, bool runs, const char *value, const char *reason);
void gui_end_table(void);

/* These draw over the picture, in window coordinates. */
void gui_line(float x0, float y0, float x1, float y1);
void gui_label(float x, float y, const char *text);
/* Shows a line at the lower edge; errors are red. */
void gui_notice(const char *text, bool is_error);

#ifdef __cplusplus
}
#endif
