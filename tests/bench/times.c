/* SPDX-License-Identifier: MIT
 *
 * Turns, clocks and medians.
 */
#include "times.h"

#include "clock.h"
#include "peers.h"
#include "progress.h"
#include "statistics.h"
#include "traced.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WARM_UP_FRAMES = 1, FRAMES_AHEAD = 3, ROWS = 2 + GLSSAO_PASS_COUNT }; /* frame, CPU, passes */

/* GPU time of a frame without timers around its passes, because those delay it; negative: not known. */
static double untimed_frame_ms(effects *plain, const gbuffer *g, const glssao_frame *frame,
                               const glssao_settings *settings, const glssao_settings *scaled, failure *fault)
{
    glssao_effect *effect = effects_get(plain, g, settings, fault);
    GLuint queries[2];
    GLuint64 at[2] = {0, 0};
    if (!effect)
        return -1;
    gl.GenQueries(2, queries);
    gl.Finish();
    /* The frames ahead keep the GPU from waiting for the processor. */
    glssao_result result = GLSSAO_OK;
    for (int i = 0; i < FRAMES_AHEAD && result == GLSSAO_OK; i++)
        result = glssao_compute(effect, frame, scaled);
    gl.QueryCounter(queries[0], GL_TIMESTAMP);
    result = result == GLSSAO_OK ? glssao_compute(effect, frame, scaled) : result;
    gl.QueryCounter(queries[1], GL_TIMESTAMP);
    gl.Finish();
    for (int i = 0; i < 2; i++)
        gl.GetQueryObjectui64v(queries[i], GL_QUERY_RESULT, &at[i]);
    gl.DeleteQueries(2, queries);
    return result == GLSSAO_OK && at[1] > at[0] ? (double)(at[1] - at[0]) * 1e-6 : -1;
}

/* values[row]: this frame's. */
static bool time_frame(bool software, effects *e, effects *plain, const gbuffer *g, float radius, const bench_config *c,
                       double values[ROWS], failure *fault)
{
    const glssao_settings *settings = &c->settings;
    glssao_effect *effect = effects_get(e, g, settings, fault);
    if (!effect)
        return false;
    const glssao_settings scaled = bench_scale_settings(settings, radius);
    const glssao_frame frame = gbuffer_frame(g, c->inputs == INPUTS_DEPTH);
    /* The first compute is not timed: configurations that take turns find another's maps. */
    glssao_result result = glssao_compute(effect, &frame, &scaled);
    gl.Finish();
    const double wall = clock_wall_ms(), cpu = clock_cpu_ms();
    result = result == GLSSAO_OK ? glssao_compute(effect, &frame, &scaled) : result;
    gl.Finish();
    values[0] = clock_wall_ms() - wall;
    values[1] = clock_cpu_ms() - cpu;
    if (result != GLSSAO_OK)
        return fault_set(fault, "glssao_compute: %s", glssao_result_string(result));
    const glssao_stats stats = glssao_get_stats(effect);
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++)
        /* A software rasteriser defers drawing past the queries, so their differences mean nothing. */
        values[2 + i] = software || stats.passes[i].gpu_ms < 0 ? NAN : stats.passes[i].gpu_ms;
    if (!software && stats.gpu_ms >= 0)
        values[0] = untimed_frame_ms(plain, g, &frame, settings, &scaled, fault);
    return values[0] >= 0;
}

static timing summarise(double *values, int frames)
{
    timing t;
    t.median_ms = statistics_percentile(values, frames, 50);
    t.p95_ms = statistics_percentile(values, frames, 95);
    t.cpu_ms = statistics_percentile(values + frames, frames, 50);
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++)
        t.pass_ms[i] = statistics_percentile(values + (ptrdiff_t)(2 + i) * frames, frames, 50);
    return t;
}

/* g: without and with what lies beyond. values: for each configuration, ROWS rows of `frames`. */
static bool take_turns(results *r, effects *e, effects *plain, const gbuffer g[2], float radius, double *values,
                       failure *fault)
{
    const int frames = r->options->frames;
    for (int f = -WARM_UP_FRAMES; f < frames; f++) {
        progress_show("times: frame %d/%d", f < 0 ? 0 : f + 1, frames);
        for (int i = 0; i < r->config_count; i++) {
            const bench_config *c = &r->configs[i].config;
            double row[ROWS];
            if (c->kind != BENCH_EFFECT)
                continue;
            if (!time_frame(r->software, e, plain, &g[c->inputs == INPUTS_BEYOND], radius, c, row, fault))
                return false;
            for (int k = 0; f >= 0 && k < ROWS; k++)
                values[((ptrdiff_t)i * ROWS + k) * frames + f] = row[k];
        }
    }
    return true;
}

/* Adds what uploading and denoising a picture of rays takes, in the last of some frames. */
static bool time_denoiser(const bench_config *c, effects *e, const gbuffer *g, const float *picture, float radius,
                          timing *out, failure *fault)
{
    const glssao_settings scaled = bench_scale_settings(&c->settings, radius);
    glssao_effect *effect = effects_get(e, g, &c->settings, fault);
    glssao_frame frame = gbuffer_frame(g, false);
    bool done = effect != NULL;
    for (int f = -WARM_UP_FRAMES; done && f <= 0; f++) {
        gl.Finish();
        const double wall = clock_wall_ms(), cpu = clock_cpu_ms();
        frame.rays_texture = gl_make_texture(GL_R32F, GL_RED, GL_FLOAT, g->view.width, g->view.height, picture);
        done = glssao_compute(effect, &frame, &scaled) == GLSSAO_OK;
        gl.Finish();
        if (f == 0) {
            out->cpu_ms += clock_cpu_ms() - cpu;
            out->median_ms = out->p95_ms = out->median_ms + clock_wall_ms() - wall;
        }
        gl.DeleteTextures(1, &frame.rays_texture);
    }
    return done;
}

/* Ray tracing, once each: it takes long, and its times hardly vary. */
static bool time_rays(results *r, effects *e, const gbuffer *g, const scene *s, float radius, int of_view,
                      failure *fault)
{
    for (int i = 0; i < r->config_count; i++) {
        const bench_config *c = &r->configs[i].config;
        if (c->kind != BENCH_RAYS)
            continue;
        const truth_request request = {.name = c->id, .radius = radius, .rays = c->rays, .seed = r->options->seed};
        bench_truth t;
        const double cpu = clock_cpu_ms();
        const bool traced = truth_get(&request, s, &g->view, &t, fault);
        timing *out = &r->configs[i].views[of_view].time;
        out->cpu_ms = clock_cpu_ms() - cpu;
        out->median_ms = out->p95_ms = t.seconds * 1e3;
        const bool timed = traced && (!c->denoised || time_denoiser(c, e, g, t.accessibility, radius, out, fault));
        truth_destroy(&t);
        if (!timed)
            return false;
    }
    return true;
}

/* Whole frames with a few rays: read-back, tracing and upload included, the acceleration structure not. */
static bool time_traced(results *r, effects *e, const gbuffer *g, float radius, int of_view, failure *fault)
{
    const int frames = r->options->frames;
    double *values = calloc((size_t)frames * ROWS, sizeof *values);
    host_rays t = {.scene = NULL};
    bool timed = values != NULL;
    for (int i = 0; timed && i < r->config_count; i++) {
        const bench_config *c = &r->configs[i].config;
        if (c->kind != BENCH_TRACED)
            continue;
        const glssao_settings scaled = bench_scale_settings(&c->settings, radius);
        glssao_effect *effect = effects_get(e, g, &c->settings, fault);
        timed = effect && (t.embree || traced_open(&t, &r->scenes[of_view], e->width, e->height, fault));
        for (int k = 0; timed && k < frames * ROWS; k++)
            values[k] = NAN;
        for (int f = -WARM_UP_FRAMES; timed && f < frames; f++) {
            gl.Finish();
            const double wall = clock_wall_ms(), cpu = clock_cpu_ms();
            timed = traced_run(&t, g, c, radius, r->options->seed, fault);
            glssao_frame frame = gbuffer_frame(g, false);
            frame.rays_texture = t.rays.texture;
            timed = timed && glssao_compute(effect, &frame, &scaled) == GLSSAO_OK;
            gl.Finish();
            if (f >= 0) {
                values[f] = clock_wall_ms() - wall;
                values[frames + f] = clock_cpu_ms() - cpu;
            }
        }
        if (timed)
            r->configs[i].views[of_view].time = summarise(values, frames);
    }
    if (t.embree)
        fprintf(stderr, "%s: acceleration structure built in %.1f ms of processor time\n", r->scenes[of_view].name,
                t.build_ms);
    traced_close(&t);
    free(values);
    return timed;
}

/* What a host with depth and normals pays for a peer: its passes, drawn from a recording. */
static bool time_peers(results *r, const gbuffer *g, float radius, int of_view, failure *fault)
{
    const int frames = r->options->frames;
    const peer_view view = {g, radius, r->views[of_view].median_distance};
    double *values = calloc((size_t)frames * ROWS, sizeof *values);
    replay_inputs in;
    bool timed = replay_inputs_create(&in, g) && values && peers_record_configs(r, &view, 1, fault);
    for (int i = 0; timed && !r->options->record && i < r->config_count; i++) {
        if (r->configs[i].config.kind != BENCH_PEER)
            continue;
        replay *p = peers_load(r->peers, r->configs[i].config.peer, &view, fault);
        timed = p != NULL;
        for (int k = 0; timed && k < frames * ROWS; k++)
            values[k] = NAN;
        for (int f = -WARM_UP_FRAMES; timed && f < frames; f++) {
            gl.Finish();
            const double wall = clock_wall_ms(), cpu = clock_cpu_ms();
            replay_draw(r->peers->replayer, p, &in);
            gl.Finish();
            if (f < 0)
                continue;
            values[f] = clock_wall_ms() - wall;
            values[frames + f] = clock_cpu_ms() - cpu;
            if (!r->software)
                values[f] = replay_gpu_ms(r->peers->replayer, p, &in);
        }
        if (timed)
            r->configs[i].views[of_view].time = summarise(values, frames);
        replay_destroy(p);
    }
    replay_inputs_destroy(&in);
    free(values);
    return timed;
}

bool times_measure(results *r, effects *e, int of_view, failure *fault)
{
    const ptrdiff_t per_config = (ptrdiff_t)ROWS * r->options->frames;
    double *values = calloc((size_t)r->config_count * (size_t)per_config, sizeof *values);
    if (!values)
        return fault_set_memory(fault);
    effects plain = *e;
    memset(plain.of, 0, sizeof plain.of);
    plain.no_timers = true;
    scene_view view;
    float radius;
    gbuffer g[2] = {{.depth = 0}};
    scene *s = bench_scene_open(&r->scenes[of_view], e->width, e->height, &view, &radius, fault);
    const bool timed =
        s && gbuffer_draw(&g[0], s, &view, 0, fault) &&
        gbuffer_draw(&g[1], s, &view, gbuffer_margin(e->width), fault) &&
        take_turns(r, e, &plain, g, radius, values, fault) && time_rays(r, e, &g[0], s, radius, of_view, fault) &&
        time_traced(r, e, &g[0], radius, of_view, fault) && (!r->peers || time_peers(r, &g[0], radius, of_view, fault));
    effects_destroy(&plain);
    for (int i = 0; timed && i < r->config_count; i++)
        if (r->configs[i].config.kind == BENCH_EFFECT)
            r->configs[i].views[of_view].time = summarise(values + i * per_config, r->options->frames);
    progress_clear();
    gbuffer_destroy(&g[0]);
    gbuffer_destroy(&g[1]);
    scene_destroy(s);
    free(values);
    return timed;
}
