/* SPDX-License-Identifier: MIT
 *
 * Draws the panel: what is shown, how it is drawn, the plan with reasons, times and help.
 */
#include "gui.h"
#include "viewer.h"

#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static void draw_scene(viewer *v)
{
    char text[512];
    if (!gui_section("Scene", true))
        return;
    const float *low = v->scene->bounds_min, *high = v->scene->bounds_max;
    snprintf(text, sizeof text, "%s\n%u triangles stored, %u instances, %.4g x %.4g x %.4g units", v->scene->name,
             v->scene->index_count / 3, v->scene->instance_count, (double)(high[0] - low[0]),
             (double)(high[1] - low[1]), (double)(high[2] - low[2]));
    gui_text_wrapped(text);
    if (gui_button("Open ..."))
        v->opening = v->about_to_open = true;
    static const char *const names[] = {"columns", "cornell", "steps", "plane"};
    for (int i = 0; i < 4; i++) {
        gui_same_line();
        if (gui_button(names[i]))
            viewer_open(v, NULL, names[i]);
    }
    if (gui_button("Fit the view (F)")) {
        v->moved = true;
        viewer_frame_scene(v);
    }
}

static void draw_show(viewer *v)
{
    char text[128];
    if (!gui_section("Show", true))
        return;
    int mode = (int)v->mode, shown = (int)v->shown;
    const bool was_raw = v->shown == SHOWN_RAW;
    if (gui_choice("picture", &mode, VIEWER_MODES))
        v->mode = (viewer_mode)mode;
    if (gui_choice("or a map", &shown, VIEWER_SHOWN)) {
        v->shown = (viewer_shown)shown;
        v->frame_due = v->frame_due || was_raw != (v->shown == SHOWN_RAW);
        if (!viewer_shows_truth(v))
            viewer_drop_truth(v);
    }
    if (v->mode == MODE_SPLIT)
        gui_slider("line", "of the width", &v->split, 0, 1, false, 0.5f);
    if (viewer_shows_truth(v)) {
        snprintf(text, sizeof text, "%d of %d rays a pixel", v->truth_shown_rounds * TRUTH_ROUND_RAYS,
                 RAY_ROUNDS * TRUTH_ROUND_RAYS);
        gui_progress((float)v->truth_shown_rounds / RAY_ROUNDS, text);
        if (v->truth_rmse >= 0) {
            snprintf(text, sizeof text, "RMSE %.4f; full colour at an error of %g", v->truth_rmse, VIEWER_ERROR_RANGE);
            gui_text(text);
        }
        gui_text("blue: too dark, red-orange: too bright");
    }
}

static void draw_drawing(viewer *v)
{
    if (!gui_section("Drawing", false))
        return;
    options *o = &v->options;
    bool shadows = !o->no_shadows;
    int size = o->shadow_size ? o->shadow_size : 2048;
    float intensity = o->intensity.given ? o->intensity.value : 1;
    bool changed = gui_check("shadows (J)", &shadows);
    changed = gui_slider_whole("shadow map", "texels", &size, 64, 4096, 2048) || changed;
    changed = gui_check("apply normal maps before occlusion (K)", &o->mapped_normals) || changed;
    changed = gui_check("specular occlusion (L)", &o->specular_occlusion) || changed;
    changed = gui_check("multi-bounce tint (B)", &o->multi_bounce) || changed;
    if (v->settings.technique == GLSSAO_HORIZON && gui_check("light by bent normals", &o->bent_normals)) {
        v->settings.bent_normals = o->bent_normals;
        changed = true;
    }
    changed = gui_slider("strength of occlusion", "", &intensity, 0, 1, false, 1) || changed;
    changed = gui_choice("map in the corner (I)", &o->debug_map, OPTIONS_MAP_WORDS) || changed;
    o->no_shadows = !shadows;
    o->shadow_size = size == 2048 ? 0 : size;
    o->intensity = (option_number){intensity != 1, intensity};
    if (changed)
        viewer_configure(v);
}

static void draw_plan(viewer *v)
{
    if (!gui_section("Frame plan", false) || !gui_begin_table("plan"))
        return;
    char text[64];
    const glssao_frame frame = pipeline_frame(&v->pipeline, &v->view);
    const glssao_plan plan = glssao_plan_frame(v->pipeline.effect, &frame, &v->pipeline.settings);
    const scene_draw_counts counts = scene_renderer_counts(v->pipeline.renderer);
    snprintf(text, sizeof text, "%u draws", counts.normals);
    gui_table_row("pre-pass", true, text, "depth and view-space normals");
    for (int i = 0; i < GLSSAO_PASS_APPLY; i++) {
        snprintf(text, sizeof text, "%d draw%s", plan.passes[i].draw_calls, plan.passes[i].draw_calls == 1 ? "" : "s");
        gui_table_row(plan.passes[i].name, plan.passes[i].run, plan.passes[i].run ? text : "skip",
                      plan.passes[i].reason);
    }
    const progressive_report *reached = &v->pipeline.reached;
    snprintf(text, sizeof text, "%d estimate%s", reached->estimates, reached->estimates == 1 ? "" : "s");
    gui_table_row("at rest", rest_reuses(v) || reached->estimates > 0, reached->estimates ? text : "waits",
                  rest_error(v) > 0 ? "estimates are accumulated while nothing changes"
                  : rest_reuses(v)  ? "the history fills up while nothing changes"
                                    : "each frame stands alone");
    snprintf(text, sizeof text, "%u draws", counts.main + counts.blended + counts.sky);
    gui_table_row("main", true, text,
                  counts.culled ? "draws outside the view are skipped" : "everything is in the view");
    scene_effect effects[SCENE_EFFECT_COUNT];
    scene_renderer_effects(v->pipeline.renderer, &v->pipeline.lighting, effects);
    for (int i = 0; i < SCENE_EFFECT_COUNT; i++)
        gui_table_row(effects[i].name, effects[i].used, effects[i].used ? "use" : "skip", effects[i].reason);
    gui_end_table();
}

static void draw_times(viewer *v)
{
    if (!gui_section("Milliseconds a pass", true))
        return;
    const glssao_stats stats = glssao_get_stats(v->pipeline.effect);
    float high = 1;
    for (int i = 0; i < GRAPH_COUNT; i++)
        for (int k = 0; k < GRAPH_LENGTH; k++)
            high = fmaxf(high, v->graph[i][k]);
    for (int i = 0; i < GRAPH_COUNT; i++) {
        char label[64];
        const float last = v->graph[i][(v->graph_next + GRAPH_LENGTH - 1) % GRAPH_LENGTH];
        const char *name = i == GRAPH_PREPASS ? "pre-pass" : i == GRAPH_MAIN ? "main" : stats.passes[i].name;
        if (last <= 0 || !name)
            continue;
        snprintf(label, sizeof label, "%.2f %s", (double)last, name);
        gui_graph(label, v->graph[i], GRAPH_LENGTH, v->graph_next, high);
    }
    char text[96];
    snprintf(text, sizeof text, "%d x %d, %u frames drawn", v->width, v->height, v->frames);
    gui_text(text);
    if (rest_reuses(v)) {
        snprintf(text, sizeof text, "history of %d frames, %d at rest", v->settings.history, v->still_frames);
        gui_text(text);
    }
    if (v->pipeline.reached.estimates > 0) {
        snprintf(text, sizeof text, "%d estimates, sampling error %.4f", v->pipeline.reached.estimates,
                 v->pipeline.reached.sampling_error);
        gui_text(text);
    }
}

static void draw_save(viewer *v)
{
    static char line[2048];
    if (!gui_section("Save", false))
        return;
    if (gui_button("Picture (Ctrl+S)"))
        viewer_save_picture(v);
    gui_same_line();
    if (gui_button("Copy command line (Ctrl+C)"))
        viewer_copy_command_line(v);
    if (viewer_command_line(v, line, sizeof line))
        gui_text_wrapped(line);
}

static void draw_help(viewer *v)
{
    if (!gui_begin_dialog("Keys (F1)", &v->help_open))
        return;
    for (int i = 0; keys_help[i][0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "%-31s %s", keys_help[i][0], keys_help[i][1]);
        gui_text(text);
    }
    gui_end_dialog();
}

static void draw_open(viewer *v)
{
    if (!gui_begin_dialog("Open a .gltf or .glb file, or a picture to light it", &v->opening))
        return;
    bool chosen = gui_input("file, then Enter", v->typed_path, sizeof v->typed_path, v->about_to_open);
    v->about_to_open = false;
    chosen = gui_button("Open") || chosen;
    gui_text("Or drop one on the window.");
    gui_end_dialog();
    if (chosen && v->typed_path[0] && viewer_open_file(v, v->typed_path))
        v->opening = false;
}

/* Draws the line of the split view and labels its sides. */
static void draw_split(const viewer *v)
{
    int width = 0, height = 0;
    glfwGetWindowSize(v->window, &width, &height);
    const float x = v->split * (float)width;
    if (v->mode != MODE_SPLIT || v->shown != SHOWN_PICTURE)
        return;
    gui_line(x, 0, x, (float)height);
    gui_label(x - 40, 8, "off");
    gui_label(x + 12, 8, "on");
}

void panel_draw(viewer *v)
{
    draw_split(v);
    if (v->panel_open) {
        gui_begin_panel("glssao-view - F1: keys", v->panel_focus_due);
        v->panel_focus_due = false;
        draw_scene(v);
        draw_show(v);
        panel_draw_settings(v);
        draw_drawing(v);
        draw_plan(v);
        draw_times(v);
        draw_save(v);
        gui_end_panel();
    }
    draw_help(v);
    draw_open(v);
    if (v->notice[0] && glfwGetTime() < v->notice_until)
        gui_notice(v->notice, v->notice_is_error);
}
