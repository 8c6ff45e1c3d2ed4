/* SPDX-License-Identifier: MIT
 *
 * glssao-bench: what accuracy costs in time. It traces the truth, measures the error and the time of every
 * configuration, splits the error by cause, and writes tables and pictures of the error.
 */
#define _POSIX_C_SOURCE 200809L
#include "bent.h"
#include "check.h"
#include "clock.h"
#include "context.h"
#include "effects.h"
#include "errors.h"
#include "flicker.h"
#include "options.h"
#include "peers.h"
#include "report.h"
#include "results.h"
#include "split.h"
#include "strips.h"
#include "times.h"
#include "tool.h"
#include "words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ERROR_LENGTH = 4096 };

typedef struct run {
    options options;
    results results;
    context *context;
    map_reader reader;
    peer_bench peers;
    effects effects; /* at the size errors are measured at */
    char error[ERROR_LENGTH];
} run;

static bool open_context(run *r)
{
    r->context = tool_open(&r->options, FAULT(r->error));
    if (!r->context)
        return false;
    r->results.context = r->context;
    r->results.software = context_is_software(r->context);
    r->effects = (effects){.context = r->context,
                           .width = r->options.size[0],
                           .height = r->options.size[1],
                           .seed = r->options.seed,
                           .path = (glssao_path)r->options.path};
    return map_reader_create(&r->reader, r->options.size[0], r->options.size[1], FAULT(r->error));
}

static bool make_views(run *r)
{
    results *out = &r->results;
    const int count = bench_scenes_list(&r->options, r->results.scenes);
    out->views = calloc((size_t)count + 1, sizeof *out->views);
    if (!out->views || count == 0) {
        snprintf(r->error, sizeof r->error, count == 0 ? "no scene has that name" : "out of memory");
        return false;
    }
    for (int i = 0; i < count; i++) {
        bench_view *v = &out->views[out->view_count++];
        if (!bench_view_create(v, &r->results.scenes[i], &r->options, FAULT(r->error)))
            return false;
        if (v->truth.rays > 0)
            fprintf(stderr, "%s: traced %.0f rays in %.1f s\n", v->name, (double)v->truth.rays, v->truth.seconds);
    }
    return true;
}

static bool make_configs(run *r)
{
    static bench_config configs[BENCH_CONFIGS_MAX];
    timing no_time = {.median_ms = NAN, .p95_ms = NAN, .cpu_ms = NAN};
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++)
        no_time.pass_ms[i] = NAN;
    results *out = &r->results;
    /* It is asked for settings that it may refuse, so it has no log. */
    const glssao_config config = {
        .load = context_load, .load_user = r->context, .width = 16, .height = 16, .no_timers = true};
    glssao_effect *probe;
    const glssao_result result = glssao_create(&config, &probe);
    if (result != GLSSAO_OK) {
        snprintf(r->error, sizeof r->error, "no effect can be made: %s", glssao_result_string(result));
        return false;
    }
    const int count = bench_configs_list(&r->options, probe, configs);
    glssao_destroy(probe);
    out->configs = calloc((size_t)count + 1, sizeof *out->configs);
    for (int i = 0; out->configs && i < count; i++) {
        config_result *c = &out->configs[out->config_count++];
        *c = (config_result){.config = configs[i]};
        c->views = calloc((size_t)out->view_count, sizeof *c->views);
        for (int v = 0; c->views && v < out->view_count; v++)
            c->views[v] = (view_result){.frame_change = NAN, .roll_change = NAN, .time = no_time};
        if (!c->views) {
            snprintf(r->error, sizeof r->error, "out of memory");
            return false;
        }
    }
    if (count == 0)
        snprintf(r->error, sizeof r->error, "no configuration has that name");
    return count > 0 && out->configs;
}

static bool take_times(run *r)
{
    results *out = &r->results;
    if (r->options.frames == 0)
        return true;
    effects e = {.context = r->context,
                 .width = r->options.time_size[0],
                 .height = r->options.time_size[1],
                 .seed = r->options.seed,
                 .path = (glssao_path)r->options.path};
    int chosen = 0; /* the first, where the one asked for is not there */
    for (int i = 0; i < out->view_count; i++)
        chosen = strcmp(out->scenes[i].name, r->options.time_scene) == 0 ? i : chosen;
    r->options.time_scene = out->scenes[chosen].name;
    bool timed = true;
    for (int i = 0; timed && i < out->view_count; i++)
        if (i == chosen || r->options.time_all)
            timed = times_measure(out, &e, i, FAULT(r->error));
    effects_destroy(&e);
    return timed;
}

static bool write_results(run *r)
{
    const results *out = &r->results;
    return report_accuracy(out, FAULT(r->error)) && report_scenes(out, FAULT(r->error)) &&
           report_split(out, FAULT(r->error)) && strips_write(out, &r->effects, &r->reader, FAULT(r->error)) &&
           strips_write_worst(out, &r->effects, &r->reader, FAULT(r->error));
}

static void end_phase(const char *name, double *start_ms)
{
    const double now = clock_wall_ms();
    fprintf(stderr, "%s: %.1f s\n", name, (now - *start_ms) / 1e3);
    *start_ms = now;
}

static bool measure(run *r)
{
    results *out = &r->results;
    const double start_ms = clock_wall_ms();
    out->options = &r->options;
    out->cores = (int)sysconf(_SC_NPROCESSORS_ONLN);
    double phase_ms = start_ms;
    if (!open_context(r))
        return false;
    if (r->options.peers) {
        out->peers = &r->peers;
        if (!peers_open(&r->peers, &r->options, r->context, FAULT(r->error)))
            return false;
    }
    if (!make_views(r))
        return false;
    end_phase("scenes and their truth", &phase_ms);
    if (r->options.bent)
        return bent_measure(out, &r->effects, FAULT(r->error)) && report_scenes(out, FAULT(r->error));
    if (!make_configs(r))
        return false;
    if (!errors_measure(out, &r->effects, &r->reader, FAULT(r->error)))
        return false;
    end_phase("errors", &phase_ms);
    if (r->options.sequence_frames > 1 && !flicker_measure(out, r->context, FAULT(r->error)))
        return false;
    end_phase("frame change", &phase_ms);
    if (!take_times(r))
        return false;
    end_phase("times", &phase_ms);
    if (r->options.record)
        return true;
    if (r->options.split_seeds > 0 && !split_measure(out, r->context, &r->reader, FAULT(r->error)))
        return false;
    end_phase("split", &phase_ms);
    if (!write_results(r) || (r->options.check && !check_results(out, FAULT(r->error))))
        return false;
    fprintf(stderr, "%d scenes, %d configurations, %.0f s: %s\n", out->view_count, out->config_count,
            (clock_wall_ms() - start_ms) / 1e3, r->options.out);
    return true;
}

static void release(run *r)
{
    results *out = &r->results;
    split_destroy(out);
    for (int i = 0; i < out->config_count; i++)
        free(out->configs[i].views);
    free(out->configs);
    for (int i = 0; i < out->view_count; i++)
        bench_view_destroy(&out->views[i]);
    free(out->views);
    if (out->peers)
        peers_close(out->peers);
    effects_destroy(&r->effects);
    map_reader_destroy(&r->reader);
    context_destroy(r->context);
}

const config_result *results_level(const results *r, glssao_technique technique, glssao_quality level)
{
    char id[48];
    snprintf(id, sizeof id, "%s-%s", bench_technique_name(technique), words_at(QUALITY_WORDS, (int)level).text);
    for (int i = 0; i < r->config_count; i++)
        if (strcmp(r->configs[i].config.id, id) == 0)
            return &r->configs[i];
    return NULL;
}

int main(int argc, char **argv)
{
    static run r;
    const int code = tool_begin("glssao-bench", argc, argv, &r.options);
    if (code >= 0)
        return code;
    r.options.flat = !r.options.bent;
    const bool done = measure(&r);
    release(&r);
    return tool_end("glssao-bench", done, r.error);
}
