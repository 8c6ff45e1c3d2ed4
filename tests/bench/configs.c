/* SPDX-License-Identifier: MIT
 *
 * To measure one more setting, add a row to `changes`.
 */
#include "configs.h"

#include "peers.h"
#include "words.h"

#include <stdio.h>
#include <string.h>

static const char *const technique_names[] = {"classic", "hemisphere", "horizon", "rays"};
static const char *const blur_names[] = {[GLSSAO_BLUR_NONE] = "none",
                                         [GLSSAO_BLUR_GAUSSIAN] = "gaussian",
                                         [GLSSAO_BLUR_BILATERAL] = "bilateral",
                                         [GLSSAO_BLUR_BOX] = "box",
                                         [GLSSAO_BLUR_PLANAR] = "planar"};

enum { SAME = -1, ANY = -1 };

/* What differs from the level: SAME where nothing. */
static const struct change {
    const char *suffix;
    int technique;    /* ANY: each */
    bool every_level; /* or the default one alone */
    int half, upsample, blur, rounds, samples;
    bool no_angle_weight;
    bench_inputs inputs;
} changes[] = {
    {"", ANY, true, SAME, SAME, SAME, SAME, SAME, false, INPUTS_NORMALS},
    {"-depth", ANY, true, SAME, SAME, SAME, SAME, SAME, false, INPUTS_DEPTH},
    {"-full", ANY, true, false, SAME, SAME, SAME, SAME, false, INPUTS_NORMALS},
    {"-half", ANY, true, true, SAME, SAME, SAME, SAME, false, INPUTS_NORMALS},
    {"-noblur", ANY, false, SAME, SAME, GLSSAO_BLUR_NONE, 0, SAME, false, INPUTS_NORMALS},
    {"-gaussian-1", ANY, false, SAME, SAME, GLSSAO_BLUR_GAUSSIAN, 1, SAME, false, INPUTS_NORMALS},
    {"-gaussian-2", ANY, false, SAME, SAME, GLSSAO_BLUR_GAUSSIAN, 2, SAME, false, INPUTS_NORMALS},
    {"-gaussian-3", ANY, false, SAME, SAME, GLSSAO_BLUR_GAUSSIAN, 3, SAME, false, INPUTS_NORMALS},
    {"-gaussian-4", ANY, false, SAME, SAME, GLSSAO_BLUR_GAUSSIAN, 4, SAME, false, INPUTS_NORMALS},
    {"-bilateral-1", ANY, false, SAME, SAME, GLSSAO_BLUR_BILATERAL, 1, SAME, false, INPUTS_NORMALS},
    {"-bilateral-2", ANY, false, SAME, SAME, GLSSAO_BLUR_BILATERAL, 2, SAME, false, INPUTS_NORMALS},
    {"-bilateral-3", ANY, false, SAME, SAME, GLSSAO_BLUR_BILATERAL, 3, SAME, false, INPUTS_NORMALS},
    {"-bilateral-4", ANY, false, SAME, SAME, GLSSAO_BLUR_BILATERAL, 4, SAME, false, INPUTS_NORMALS},
    {"-box-1", ANY, false, SAME, SAME, GLSSAO_BLUR_BOX, 1, SAME, false, INPUTS_NORMALS},
    {"-box-2", ANY, false, SAME, SAME, GLSSAO_BLUR_BOX, 2, SAME, false, INPUTS_NORMALS},
    {"-box-3", ANY, false, SAME, SAME, GLSSAO_BLUR_BOX, 3, SAME, false, INPUTS_NORMALS},
    {"-box-4", ANY, false, SAME, SAME, GLSSAO_BLUR_BOX, 4, SAME, false, INPUTS_NORMALS},
    {"-4samples", GLSSAO_CLASSIC, false, SAME, SAME, SAME, SAME, 4, false, INPUTS_NORMALS},
    {"-8samples", GLSSAO_CLASSIC, false, SAME, SAME, SAME, SAME, 8, false, INPUTS_NORMALS},
    {"-noangle", GLSSAO_CLASSIC, false, SAME, SAME, SAME, SAME, SAME, true, INPUTS_NORMALS},
    {"-planar-1", ANY, false, SAME, SAME, GLSSAO_BLUR_PLANAR, 1, SAME, false, INPUTS_NORMALS},
    {"-planar-2", ANY, false, SAME, SAME, GLSSAO_BLUR_PLANAR, 2, SAME, false, INPUTS_NORMALS},
    {"-upsample", ANY, false, true, true, SAME, SAME, SAME, false, INPUTS_NORMALS},
    {"-noupsample", ANY, false, true, false, SAME, SAME, SAME, false, INPUTS_NORMALS},
    {"-beyond", GLSSAO_HORIZON, true, SAME, SAME, SAME, SAME, SAME, false, INPUTS_BEYOND},
    {"-12samples", GLSSAO_HORIZON, false, SAME, SAME, SAME, SAME, 12, false, INPUTS_NORMALS},
    {"-16samples", GLSSAO_HORIZON, false, SAME, SAME, SAME, SAME, 16, false, INPUTS_NORMALS},
    {"-24samples", GLSSAO_HORIZON, false, SAME, SAME, SAME, SAME, 24, false, INPUTS_NORMALS},
    {"-48samples", GLSSAO_HORIZON, false, SAME, SAME, SAME, SAME, 48, false, INPUTS_NORMALS},
    {"-64samples", GLSSAO_HORIZON, false, SAME, SAME, SAME, SAME, 64, false, INPUTS_NORMALS},
};

static glssao_settings apply(const struct change *c, glssao_technique technique, glssao_quality level)
{
    glssao_settings s = glssao_default_settings(technique, level);
    if (c->half != SAME)
        s.half_resolution = c->half;
    if (c->upsample != SAME)
        s.upsample = c->upsample;
    if (c->blur != SAME)
        s.blur = (glssao_blur)c->blur;
    if (c->rounds != SAME)
        s.blur_rounds = c->rounds;
    if (c->samples != SAME)
        s.sample_count = c->samples;
    s.no_angle_weight |= c->no_angle_weight;
    return s;
}

static bool changes_nothing(const glssao_settings *a, const glssao_settings *b)
{
    const bool same_result_size = a->upsample == b->upsample || !a->half_resolution;
    return a->half_resolution == b->half_resolution && same_result_size && a->blur == b->blur &&
           a->blur_rounds == b->blur_rounds && a->sample_count == b->sample_count &&
           a->no_angle_weight == b->no_angle_weight;
}

/* Whether the same settings have another id: upsampling and half size can be the same change. */
static bool measured(const bench_config *configs, int count, const bench_config *config)
{
    const glssao_settings *s = &config->settings;
    for (int i = 0; i < count; i++) {
        const bench_config *other = &configs[i];
        if (!config->level && !other->level && config->inputs == INPUTS_NORMALS && other->inputs == INPUTS_NORMALS &&
            other->settings.technique == s->technique && changes_nothing(&other->settings, s))
            return true;
    }
    return false;
}

static bool taken(const glssao_effect *effect, const glssao_settings *settings)
{
    glssao_frame frame = {.depth_texture = 1, .normal_texture = 1}; /* a plan does not look at the names */
    for (int i = 0; i < 16; i += 5)
        frame.projection[i] = 1;
    return glssao_plan_frame(effect, &frame, settings).passes[GLSSAO_PASS_ESTIMATE].run;
}

static int add_rays(const options *o, bench_config *out, int count)
{
    for (int i = 0; 1 << i / 2 <= o->most_rays && count < BENCH_CONFIGS_MAX; i++) {
        bench_config c = {.kind = BENCH_RAYS,
                          .level = true,
                          .denoised = i % 2,
                          .settings = glssao_default_settings(GLSSAO_RAYS, GLSSAO_HIGH),
                          .rays = 1 << i / 2};
        snprintf(c.id, sizeof c.id, "rays-%d%s", c.rays, c.denoised ? "-denoised" : "");
        if (options_match(o->only, c.id))
            out[count++] = c;
    }
    return count;
}

/* A few rays that the host traces: alone, and as corrections. */
static int add_traced(const options *o, bench_config *out, int count)
{
    static const struct {
        glssao_technique technique;
        glssao_quality level;
        int rays; /* 0: as many as suit the level */
        bool adaptive;
    } rows[] = {{GLSSAO_RAYS, GLSSAO_LOW, 0, false},      {GLSSAO_RAYS, GLSSAO_MEDIUM, 0, false},
                {GLSSAO_RAYS, GLSSAO_HIGH, 0, false},     {GLSSAO_RAYS, GLSSAO_ULTRA, 0, false},
                {GLSSAO_RAYS, GLSSAO_MEDIUM, 0, true},    {GLSSAO_RAYS, GLSSAO_HIGH, 0, true},
                {GLSSAO_HORIZON, GLSSAO_LOW, 2, false},   {GLSSAO_HORIZON, GLSSAO_MEDIUM, 2, false},
                {GLSSAO_HORIZON, GLSSAO_HIGH, 1, false},  {GLSSAO_HORIZON, GLSSAO_HIGH, 2, false},
                {GLSSAO_HORIZON, GLSSAO_HIGH, 2, true},   {GLSSAO_HORIZON, GLSSAO_HIGH, 4, false},
                {GLSSAO_HORIZON, GLSSAO_ULTRA, 1, false}, {GLSSAO_HORIZON, GLSSAO_ULTRA, 2, false}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0] && count < BENCH_CONFIGS_MAX; i++) {
        const char *name = technique_names[rows[i].technique],
                   *level = words_at(QUALITY_WORDS, (int)rows[i].level).text;
        bench_config c = {.kind = BENCH_TRACED,
                          .level = rows[i].rays == 0 && !rows[i].adaptive,
                          .adaptive = rows[i].adaptive,
                          .settings = glssao_default_settings(rows[i].technique, rows[i].level)};
        char with[20] = "";
        c.rays = rows[i].rays ? rows[i].rays : c.settings.sample_count;
        if (rows[i].rays)
            snprintf(with, sizeof with, "-with-%d-rays", c.rays % 100);
        snprintf(c.id, sizeof c.id, "%s-%.8s%s%s", name, level, with, c.adaptive ? "-adaptive" : "");
        if (options_match(o->only, c.id))
            out[count++] = c;
    }
    return count;
}

static int add_peers(const options *o, bench_config *out, int count)
{
    for (int i = 0; o->peers && i < peers_count(o->peer_grid) && count < BENCH_CONFIGS_MAX; i++) {
        bench_config c = {.kind = BENCH_PEER, .level = true, .peer = i};
        bool listed = false;
        peers_name(i, c.id);
        for (int k = 0; k < count; k++)
            listed |= strcmp(out[k].id, c.id) == 0;
        if (!listed && options_match(o->only, c.id))
            out[count++] = c;
    }
    return count;
}

int bench_configs_list(const options *o, const glssao_effect *effect, bench_config out[BENCH_CONFIGS_MAX])
{
    int count = 0;
    if (o->record)
        return add_peers(o, out, 0);
    for (int t = 0; t < BENCH_TECHNIQUES; t++)
        for (int level = GLSSAO_LOW; level <= GLSSAO_ULTRA; level++) {
            const glssao_settings base = glssao_default_settings((glssao_technique)t, (glssao_quality)level);
            for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
                const struct change *c = &changes[i];
                if ((c->technique != ANY && c->technique != t) || (!c->every_level && level != GLSSAO_HIGH))
                    continue;
                bench_config config = {.settings = apply(c, (glssao_technique)t, (glssao_quality)level),
                                       .level = c->suffix[0] == '\0',
                                       .inputs = c->inputs};
                snprintf(config.id, sizeof config.id, "%s-%s%s", technique_names[t],
                         words_at(QUALITY_WORDS, level).text, c->suffix);
                if ((config.level || config.inputs != INPUTS_NORMALS || !changes_nothing(&config.settings, &base)) &&
                    !measured(out, count, &config) && options_match(o->only, config.id) && count < BENCH_CONFIGS_MAX &&
                    taken(effect, &config.settings))
                    out[count++] = config;
            }
        }
    return add_peers(o, out, add_traced(o, out, add_rays(o, out, count)));
}

const char *bench_technique_name(glssao_technique technique)
{
    return technique_names[technique];
}

const char *bench_blur_name(glssao_blur blur)
{
    return blur_names[blur];
}

bool bench_has_contrast(const bench_config *c)
{
    return c->kind == BENCH_PEER || (c->kind == BENCH_EFFECT && c->settings.technique != GLSSAO_HORIZON);
}

glssao_settings bench_scale_settings(const glssao_settings *settings, float radius)
{
    glssao_settings s = *settings;
    const float scale = radius / s.radius;
    s.radius = radius;
    s.fade_start *= scale;
    s.fade_end *= scale;
    s.surface_epsilon *= scale;
    s.blur_depth_threshold *= scale;
    return s;
}
