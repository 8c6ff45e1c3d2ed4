/* SPDX-License-Identifier: MIT
 *
 * Default settings, and the checks of everything that can be judged without asking OpenGL.
 */
#include "effect.h"

#include <math.h>
#include <stddef.h>

/* As in Learn OpenGL: 64 samples at full size, a box over the noise's tile, no contrast. */
static glssao_settings hemisphere_settings(glssao_settings s, glssao_quality quality)
{
    s.technique = GLSSAO_HEMISPHERE;
    s.surface_epsilon = 0.025f;
    s.power = 1.0f;
    s.sample_count = quality == GLSSAO_LOW ? 8 : quality == GLSSAO_MEDIUM ? 16 : quality == GLSSAO_ULTRA ? 64 : 32;
    s.half_resolution = false;
    s.blur = GLSSAO_BLUR_BOX;
    s.blur_rounds = 1;
    return s;
}

/* Half size is brought to full along surfaces, but for LOW, which it would cost as much again; ULTRA estimates at full
 * size. */
static glssao_settings horizon_settings(glssao_settings s, glssao_quality quality)
{
    s.technique = GLSSAO_HORIZON;
    s.power = 1.0f;
    s.sample_count = quality == GLSSAO_LOW ? 12 : quality == GLSSAO_MEDIUM ? 16 : 48;
    s.half_resolution = quality != GLSSAO_ULTRA;
    s.upsample = quality != GLSSAO_LOW;
    s.blur = GLSSAO_BLUR_PLANAR;
    /* The noise of a single slice is spread over twice the tile that one round smooths. */
    s.blur_rounds = quality <= GLSSAO_MEDIUM ? 2 : 1;
    return s;
}

glssao_settings glssao_default_settings(glssao_technique technique, glssao_quality quality)
{
    /* Luna's first edition of the effect; HIGH is what the book ships. */
    glssao_settings s = {
        .technique = GLSSAO_CLASSIC,
        .radius = 0.5f,
        .fade_start = 0.2f,
        .fade_end = 1.0f,
        .surface_epsilon = 0.05f,
        .power = 6.0f,
        .sample_count = 14,
        .half_resolution = true,
        .blur = GLSSAO_BLUR_BILATERAL,
        .blur_rounds = 3,
        .blur_sigma = 2.5f,
        .blur_normal_threshold = 0.8f,
        .blur_depth_threshold = 0.2f,
    };
    if (technique == GLSSAO_HEMISPHERE)
        return hemisphere_settings(s, quality);
    if (technique == GLSSAO_HORIZON)
        return horizon_settings(s, quality);
    switch (quality) {
    case GLSSAO_LOW:
        s.sample_count = 8;
        s.blur_rounds = 1;
        break;
    case GLSSAO_MEDIUM:
        s.blur_rounds = 2;
        break;
    case GLSSAO_HIGH:
        break;
    case GLSSAO_ULTRA:
        s.half_resolution = false;
        s.blur_rounds = 4;
        break;
    }
    return s;
}

/* One row a number: its field, and the range it must lie in. */
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
    {"sample_count", offsetof(glssao_settings, sample_count), true, 1.0, HEMISPHERE_CAPACITY},
    {"blur_rounds", offsetof(glssao_settings, blur_rounds), true, 0.0, 16.0},
    {"blur_sigma", offsetof(glssao_settings, blur_sigma), false, 0.1, 2.5},
    {"blur_normal_threshold", offsetof(glssao_settings, blur_normal_threshold), false, -1.0, 1.0},
    {"blur_depth_threshold", offsetof(glssao_settings, blur_depth_threshold), false, 0.0, 1e12},
};

static bool refuse(const glssao__log_sink *log, const char *field, long long value, const char *wanted)
{
    glssao__log_write(log, GLSSAO_LOG_ERROR, "%s = %lld: %s", field, value, wanted);
    return false;
}

bool glssao__settings_check(const glssao_settings *settings, const glssao__log_sink *log)
{
    if ((unsigned)settings->technique > GLSSAO_HORIZON)
        return refuse(log, "settings.technique", settings->technique, "unknown");
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
    if ((unsigned)settings->tiles > GLSSAO_TILES_ON)
        return refuse(log, "settings.tiles", settings->tiles, "unknown");
    if (settings->fade_end < settings->fade_start) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "settings.fade_end = %g: less than fade_start = %g",
                          (double)settings->fade_end, (double)settings->fade_start);
        return false;
    }
    switch (settings->blur) {
    case GLSSAO_BLUR_NONE:
    case GLSSAO_BLUR_GAUSSIAN:
    case GLSSAO_BLUR_BILATERAL:
    case GLSSAO_BLUR_BOX:
    case GLSSAO_BLUR_PLANAR:
        return true;
    }
    return refuse(log, "settings.blur", settings->blur, "unknown");
}

static bool check_viewport(const glssao_effect *effect, const glssao_frame *frame, const glssao__log_sink *log)
{
    const int *v = frame->viewport;
    if (v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0)
        return true;
    for (int i = 0; i < 2; ++i)
        if (v[i] < 0)
            return refuse(log, i ? "frame.viewport[1]" : "frame.viewport[0]", v[i], "less than 0");
    if (v[2] == effect->width && v[3] == effect->height)
        return true;
    glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.viewport = %d x %d: want the effect's full size, %d x %d", v[2],
                      v[3], effect->width, effect->height);
    return false;
}

static bool check_logarithm(const glssao_frame *frame, const glssao__log_sink *log)
{
    const struct {
        const char *field;
        double value;
    } numbers_of[] = {
        {"log_depth_far", (double)frame->log_depth_far},
        {"log_depth_constant", glssao__projection_log_constant(frame)},
    };
    for (int i = 0; i < 2 && frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC; ++i)
        if (!(numbers_of[i].value >= 1e-12 && numbers_of[i].value <= 1e12)) { /* also true for nan */
            glssao__log_write(log, GLSSAO_LOG_ERROR, "frame.%s = %g: want 1e-12 to 1e+12", numbers_of[i].field,
                              numbers_of[i].value);
            return false;
        }
    return true;
}

static bool check_frame(const glssao_effect *effect, const glssao_frame *frame, const glssao__log_sink *log,
                        glssao__projection *out_projection)
{
    if ((unsigned)frame->depth_kind > GLSSAO_DEPTH_LOGARITHMIC)
        return refuse(log, "frame.depth_kind", frame->depth_kind, "unknown");
    if ((unsigned)frame->normal_kind > GLSSAO_NORMAL_OCTAHEDRAL)
        return refuse(log, "frame.normal_kind", frame->normal_kind, "unknown");
    bool in_alpha = frame->depth_kind == GLSSAO_DEPTH_NORMAL_ALPHA;
    if (in_alpha && frame->normal_texture == 0)
        return refuse(log, "frame.normal_texture", 0, "no texture, and GLSSAO_DEPTH_NORMAL_ALPHA reads depth from it");
    if (!in_alpha && frame->depth_texture == 0)
        return refuse(log, "frame.depth_texture", 0, "no texture");
    if (frame->margin < 0 || frame->margin % 2 != 0 || frame->margin > (effect->width - 1) / 2 ||
        frame->margin > (effect->height - 1) / 2)
        return refuse(log, "frame.margin", frame->margin, "want an even number that leaves a pixel between");
    if (!check_viewport(effect, frame, log) || !check_logarithm(frame, log))
        return false;
    if ((frame->back_texture == 0) != (frame->second_texture == 0))
        return refuse(log, frame->back_texture ? "frame.second_texture" : "frame.back_texture", 0,
                      "no texture, but the other is there");
    /* A texture that a pass both reads and draws into gives undefined pixels. */
    const gl_uint written[] = {
        effect->ambient.texture[0],
        effect->ambient.texture[1],
        effect->paired.texture[0],
        effect->paired.texture[1],
        effect->distance_map.texture,
        effect->result_map.texture,
        effect->block_map.texture,
        effect->inputs[0].texture,
        effect->inputs[1].texture,
        effect->inputs[2].texture,
        effect->inputs[3].texture,
        effect->accumulation.sum.texture,
        effect->accumulation.probe.texture,
        effect->tiles.rings.texture,
        frame->normal_texture ? 0 : effect->normal_map.texture, /* normals are rebuilt there */
    };
    for (size_t i = 0; i < sizeof written / sizeof *written; ++i)
        if (written[i] && (frame->depth_texture == written[i] || frame->normal_texture == written[i] ||
                           frame->back_texture == written[i] || frame->second_texture == written[i]))
            return refuse(log, "frame texture", written[i], "the effect's own map can't be its input");
    return glssao__projection_analyse(frame->projection, frame->clip_zero_to_one, log, out_projection);
}

bool glssao__settings_check_frame(const glssao_effect *effect, const glssao_frame *frame,
                                  const glssao_settings *settings, const glssao__log_sink *log,
                                  glssao__projection *out_projection)
{
    if (!frame || !settings) {
        glssao__log_write(log, GLSSAO_LOG_ERROR, "%s is NULL", frame ? "settings" : "frame");
        return false;
    }
    return glssao__settings_check(settings, log) && check_frame(effect, frame, log, out_projection);
}
