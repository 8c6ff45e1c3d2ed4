/* SPDX-License-Identifier: MIT
 *
 * Opens and closes scenes, and changes what the frame shows.
 */
#include "viewer.h"

#include "gui.h"
#include "setting_table.h"
#include "words.h"

#include <GLFW/glfw3.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void *load_function(const char *name, void *user)
{
    (void)user;
    GLFWglproc function = glfwGetProcAddress(name);
    void *address = NULL;
    /* ISO C has no cast from a function pointer to an object pointer; POSIX guarantees the same representation. */
    memcpy(&address, &function, sizeof address);
    return address;
}

void viewer_say(viewer *v, bool is_error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(v->notice, sizeof v->notice, format, arguments);
    va_end(arguments);
    v->notice_is_error = is_error;
    v->notice_until = glfwGetTime() + (is_error ? 20 : 5);
    if (is_error)
        fprintf(stderr, "glssao-view: %s\n", v->notice);
}

void viewer_change(viewer *v)
{
    v->frame_due = true;
    viewer_drop_truth(v);
    rays_view_drop(v);
}

void viewer_camera_moved(viewer *v)
{
    v->moved = true;
    v->viewpoint.fitted = false;
    v->viewpoint.base.half_height = 0; /* an orthographic view becomes a perspective one */
    v->viewpoint.clip_near = v->viewpoint.clip_far = 0;
    viewer_change(v);
}

/* The share of the window that the panel covers; 0 if it leaves too little free. */
static float panel_share(const viewer *v)
{
    int width = 1;
    glfwGetWindowSize(v->window, &width, NULL);
    const float share = v->panel_open ? gui_panel_width(v->gui_scale) / (float)width : 0;
    return share < 0.7f ? share : 0;
}

void viewer_frame_scene(viewer *v)
{
    options o = v->options;
    o.width = v->width;
    o.height = v->height;
    if (v->moved) { /* fit the view, even if the file or the command line has a camera */
        o.camera = -1;
        o.eye.given = o.target.given = o.fov_deg.given = o.orthographic = false;
        o.view = NULL;
    }
    if (!viewpoint_choose(&o, v->scene, panel_share(v), &v->viewpoint, FAULT(v->error)) && !v->moved) {
        viewer_say(v, true, "%s", v->error);
        v->moved = true;
        viewer_frame_scene(v);
    }
    viewer_change(v);
}

void viewer_toggle_panel(viewer *v)
{
    v->panel_open = !v->panel_open;
    if (v->viewpoint.fitted)
        viewer_frame_scene(v);
}

static bool make_pipeline(viewer *v, pipeline *p, const scene *s)
{
    const int count = v->options.samples_per_pixel ? v->options.samples_per_pixel : 1;
    const pipeline_wants wants = {.picture = true,
                                  .samples = count,
                                  .maps = count > 1, /* the maps that are shown belong to the pixels' centres */
                                  .ao = true,
                                  .ao_map = true,
                                  .prepass = true,
                                  .normals = true,
                                  .normal_map = true,
                                  .timers = true};
    options o = v->options;
    o.width = v->width;
    o.height = v->height;
    return pipeline_create(p, s, load_function, NULL, &o, wants, FAULT(v->error));
}

bool viewer_open(viewer *v, const char *path, const char *name)
{
    const double start = glfwGetTime();
    const bool first = !v->scene;
    pipeline made = {0};
    const options before = v->options;
    v->options.scene_path = path;
    v->options.scene_name = name;
    if (!first) { /* these belong to the old scene */
        v->options.radius.given = v->options.near_plane.given = v->options.far_plane.given = false;
        v->options.time_s.given = v->options.up.given = v->options.sky_up.given = false;
    }
    inputs in;
    scene *s = stage_load_scene(&v->options, &in, FAULT(v->error));
    if (!s || !make_pipeline(v, &made, s)) {
        v->options = before;
        pipeline_destroy(&made);
        scene_destroy(s);
        inputs_free(&in);
        viewer_say(v, true, "%s", v->error);
        return false;
    }
    if (!first) {
        viewer_drop_truth(v);
        rays_view_stop(v);
        viewer_free_targets(v);
        pipeline_destroy(&v->pipeline);
        scene_destroy(v->scene);
        inputs_free(&v->inputs);
    }
    v->inputs = in;
    v->pipeline = made;
    v->scene = s;
    snprintf(v->scene_path, sizeof v->scene_path, "%s", path ? path : "");
    v->options.scene_path = path ? v->scene_path : NULL;
    if (first) {
        v->settings = made.settings;
    } else {
        v->moved = false;
        v->options.camera = 0;
        v->options.view = NULL;
        v->options.orthographic = false;
        v->options.eye.given = v->options.target.given = false;
        v->options.fov_deg.given = false;
        setting_scale_radius(&v->settings, path ? camera_suggest_radius(s) : viewer_standard(v).radius);
        viewer_say(v, false, "%s: %u triangles stored, opened in %.0f ms", s->name, s->index_count / 3,
                   1e3 * (glfwGetTime() - start));
        glfwSetWindowTitle(v->window, s->name);
    }
    viewer_frame_scene(v);
    return true;
}

static bool surround(viewer *v, const char *path)
{
    if (!pipeline_surround(&v->pipeline, &v->pipeline.own, path, FAULT(v->error))) {
        viewer_say(v, true, "%s", v->error);
        return false;
    }
    snprintf(v->environment_path, sizeof v->environment_path, "%s", path);
    v->options.environment = v->environment_path;
    viewer_configure(v);
    viewer_say(v, false, "lit by %s", path);
    return true;
}

bool viewer_open_file(viewer *v, const char *path)
{
    return words_find_ending(".hdr|.pic|.png|.jpg|.jpeg", path) >= 0 ? surround(v, path) : viewer_open(v, path, NULL);
}

void viewer_close(viewer *v)
{
    viewer_drop_truth(v);
    rays_view_stop(v);
    viewer_free_targets(v);
    if (v->scene)
        pipeline_destroy(&v->pipeline);
    scene_destroy(v->scene);
    inputs_free(&v->inputs);
    v->scene = NULL;
}

glssao_settings viewer_standard(const viewer *v)
{
    options o = v->options;
    o.radius = (option_number){v->settings.radius > 0, v->settings.radius};
    o.power.given = false;
    o.sample_count = 0;
    o.blur_rounds = -1;
    o.set = NULL;
    return pipeline_settings(&o, v->scene);
}

void viewer_set_technique(viewer *v, int technique, int quality)
{
    v->options.technique = technique;
    v->options.quality = quality;
    v->settings = viewer_standard(v);
    v->pipeline.draw_options.layers =
        technique == GLSSAO_HORIZON && v->options.layers == 2; /* only this technique reads them */
    if (!pipeline_make_targets(&v->pipeline, FAULT(v->error)))
        viewer_say(v, true, "%s", v->error);
    viewer_configure(v);
}

void viewer_configure(viewer *v)
{
    scene_draw_options *o = &v->pipeline.draw_options;
    o->shadows = !v->options.no_shadows;
    o->shadow_size = v->options.shadow_size;
    o->mapped_normals = v->options.mapped_normals;
    o->specular_occlusion = v->options.specular_occlusion;
    o->multi_bounce = v->options.multi_bounce;
    o->left_out = v->options.intensity.given ? 1 - v->options.intensity.value : 0;
    v->pipeline.debug_map = (options_map)v->options.debug_map;
    if (!scene_renderer_configure(v->pipeline.renderer, &v->pipeline.lighting, o, FAULT(v->error)))
        viewer_say(v, true, "%s", v->error);
    viewer_change(v);
}
