/* SPDX-License-Identifier: MIT
 *
 * Ranges of settings and of the numbers in a frame.
 */
#include "input/check.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* One row for each number: its field, and its range. */
static const struct number {
    const char *field;
    size_t offset;
    bool is_int;
    double least, most;
} numbers[] = {
    {"radius", offsetof(glssao_settings, radius), false, 0.0, 1e12},
    {"fade_start", offsetof(glssao_settings, fade_start), false, 0.0, 1e12},
    {"fade_end", offsetof(glssao_settings, fade_end), false, 0.0, 1e12},
    {"surface_epsilon", offsetof(glssao_settings, surface_epsilon), false, 0.0, 1e12},
    {"power", offsetof(glssao_settings, power), false, 0.0, 64.0},
    {"sample_count", offsetof(glssao_settings, sample_count), true, 1.0, 64.0},
    {"blur_rounds", offsetof(glssao_settings, blur_rounds), true, 0.0, 16.0},
    {"blur_sigma", offsetof(glssao_settings, blur_sigma), false, 0.1, 2.5},
    {"blur_normal_threshold", offsetof(glssao_settings, blur_normal_threshold), false, -1.0, 1.0},
    {"blur_depth_threshold", offsetof(glssao_settings, blur_depth_threshold), false, 0.0, 1e12},
    {"thickness", offsetof(glssao_settings, thickness), false, 0.0, 1e3},
    {"fade_far_start", offsetof(glssao_settings, fade_far_start), false, 0.0, 1e12},
    {"fade_far_end", offsetof(glssao_settings, fade_far_end), false, 0.0, 1e12},
    {"history", offsetof(glssao_settings, history), true, 0.0, 63.0},
};

static bool refuse(const glssao__log *log, const char *field, long long value, const char *wanted)
{
    glssao__log_write(log, GLSSAO_LOG_ERROR, "%s = %lld: %s", field, value, wanted);
    return false;
}

static bool check_fade(const glssao__log *log, const char *field, float start, float end)
{
    if (end >= start)
        return true;
    glssao__log_write(log, GLSSAO_LOG_ERROR, "settings.%s_end = %g: less than %s_start = %g", field, (double)end, field,
                      (double)start);
    return false;
}

bool glssao__check_settings(const glssao_settings *settings, const glssao__log *log)
{
    if ((unsigned)settings->technique > GLSSAO_RAYS)
        return refuse(log, "settings.technique", (int)settings->technique, "unknown");
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
        const struct number *n = &numbers[i];
        const char *at = (const char *)settings + n->offset;
        double value = n->is_int ? (double)*(const int *)(const void *)at : (double)*(const float *)(const void *)at;
        if (!(value >= n->least && value <= n->most)) { /* also true for nan */
            glssao__log_write(log, GLSSAO_LOG_ERROR, "settings.%s = %g: want %g to %g", n->field, value, n->least,
                              n->most);
            return false;
        }
    }
    if (settings->technique == GLSSAO_CLASSIC && settings->sample_count > 14)
        return refuse(log, "settings.sample_count", settings->sample_count, "classic has 14 offset vectors");
    int n = settings->sample_count;
    if (settings->technique == GLSSAO_HORIZON && n != 12 && n != 16 && n != 24 && n != 32 && n != 48 && n != 64)
        return refuse(log, "settings.sample_count", n, "horizon takes 12, 16, 24, 32, 48 or 64");
    if (settings->bent_normals && settings->technique != GLSSAO_HORIZON)
        return refuse(log, "settings.bent_normals", 1, "only the horizon technique knows directions");
    if ((unsigned)settings->tiles > GLSSAO_TILES_ON)
        return refuse(log, "settings.tiles", (int)settings->tiles, "unknown");
    if (settings->thickness > 0.0f && settings->thickness < 1e-3f) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "settings.thickness = %g: want 0.001 to 1000, or 0 for 1",
                          (double)settings->thickness);
        return false;
    }
    if (!check_fade(log, "fade", settings->fade_start, settings->fade_end) ||
        !check_fade(log, "fade_far", settings->fade_far_start, settings->fade_far_end))
        return false;
    if (settings->technique == GLSSAO_RAYS && settings->blur != GLSSAO_BLUR_PLANAR &&
        settings->blur != GLSSAO_BLUR_NONE)
        return refuse(log, "settings.blur", settings->blur, "the rays technique takes the planar blur, or none");
    switch (settings->blur) {
    case GLSSAO_BLUR_NONE:
    case GLSSAO_BLUR_GAUSSIAN:
    case GLSSAO_BLUR_BILATERAL:
    case GLSSAO_BLUR_BOX:
    case GLSSAO_BLUR_PLANAR:
        return true;
    }
    return refuse(log, "settings.blur", (int)settings->blur, "unknown");
}

static bool check_viewport(const glssao_frame *frame, const int size[2], const glssao__log *log)
{
    const int *v = frame->viewport;
    if (v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0)
        return true;
    for (int i = 0; i < 2; ++i)
        if (v[i] < 0)
            return refuse(log, i ? "frame.viewport[1]" : "frame.viewport[0]", v[i], "less than 0");
    if (v[2] == size[0] && v[3] == size[1])
        return true;
    glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.viewport = %d x %d: want the effect's full size, %d x %d", v[2],
                      v[3], size[0], size[1]);
    return false;
}

static bool check_logarithm(const glssao_frame *frame, const glssao__log *log)
{
    const struct {
        const char *field;
        double value;
    } constants[] = {
        {"log_depth_far", (double)frame->log_depth_far},
        {"log_depth_constant", glssao__projection_log_constant(frame)},
    };
    for (int i = 0; i < 2 && frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC; ++i)
        if (!(constants[i].value >= 1e-12 && constants[i].value <= 1e12)) { /* also true for nan */
            glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.%s = %g: want 1e-12 to 1e+12", constants[i].field,
                              constants[i].value);
            return false;
        }
    return true;
}

static bool check_margin(const glssao_frame *frame, const int size[2], const glssao__log *log)
{
    const int margin = frame->margin;
    if (margin >= 0 && margin % 2 == 0 && margin <= (size[0] - 1) / 2 && margin <= (size[1] - 1) / 2)
        return true;
    return refuse(log, "frame.margin", margin, "want an even number that leaves at least one pixel");
}

/* The matrix that turns normals from world space, if any are, and by which the history finds points again. */
static bool check_view(const glssao_frame *frame, bool has_history, const glssao__log *log)
{
    const bool turns_normals = frame->world_normals && frame->normal_texture != 0;
    if (!turns_normals && !has_history)
        return true;
    for (int i = 0; i < 16; ++i)
        if (!(fabs((double)frame->view[i]) <= FLT_MAX)) { /* also true for nan */
            glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.view[%d] = %g: not finite", i, (double)frame->view[i]);
            return false;
        }
    double rows[9];
    if (glssao__matrix_normals(frame->view, rows))
        return true;
    glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.view is singular, and %s needs it",
                      turns_normals ? "frame.world_normals" : "settings.history");
    return false;
}

bool glssao__check_frame(const glssao_frame *frame, const glssao_settings *settings, const int size[2],
                         const glssao__log *log, glssao__projection *out_projection)
{
    if (!frame || !settings) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "%s is NULL", frame ? "settings" : "frame");
        return false;
    }
    if (!glssao__check_settings(settings, log))
        return false;
    if ((unsigned)frame->depth_kind > GLSSAO_DEPTH_LOGARITHMIC)
        return refuse(log, "frame.depth_kind", (int)frame->depth_kind, "unknown");
    if ((unsigned)frame->normal_kind > GLSSAO_NORMAL_OCTAHEDRAL)
        return refuse(log, "frame.normal_kind", (int)frame->normal_kind, "unknown");
    const bool in_alpha = frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA;
    if (in_alpha && frame->normal_texture == 0)
        return refuse(log, "frame.normal_texture", 0, "no texture, but GLSSAO_DEPTH_NORMAL_ALPHA reads depth from it");
    if (!in_alpha && frame->depth_texture == 0)
        return refuse(log, "frame.depth_texture", 0, "no texture");
    if ((frame->back_texture == 0) != (frame->second_texture == 0))
        return refuse(log, frame->back_texture ? "frame.second_texture" : "frame.back_texture", 0,
                      "no texture, but the other layer has one");
    if (settings->technique == GLSSAO_RAYS && frame->rays_texture == 0)
        return refuse(log, "frame.rays_texture", 0, "no texture, and the rays technique has no estimate of its own");
    for (int i = 0; i < 2; ++i)
        if (frame->rays_offset[i] < 0 || frame->rays_offset[i] > (settings->history > 0 ? 1 : 0))
            return refuse(log, i ? "frame.rays_offset[1]" : "frame.rays_offset[0]", frame->rays_offset[i],
                          "want 0, or 1 with a history");
    if (settings->history > 0 && settings->bent_normals)
        return refuse(log, "settings.history", settings->history, "want 0: bent normals are not reused over time");
    return check_margin(frame, size, log) && check_viewport(frame, size, log) && check_logarithm(frame, log) &&
           check_view(frame, settings->history > 0, log) && glssao__projection_analyse(frame, log, out_projection);
}
