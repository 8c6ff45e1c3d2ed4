/* SPDX-License-Identifier: MIT
 *
 * glssao-bench: what accuracy costs in time. Traces the truth, measures every configuration against it, takes times,
 * splits the error, and writes it all down.
 */
#define _POSIX_C_SOURCE 200809L
#include "check.h"
#include "clock.h"
#include "context.h"
#include "effects.h"
#include "errors.h"
#include "gl.h"
#include "options.h"
#include "reports.h"
#include "results.h"
#include "split.h"
#include "times.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2, ERROR_LENGTH = 4096 };

typedef struct run {
    options options;
    results results;
    bench_scene scenes[BENCH_SCENES_MAX]; /* of the views, by index */
    context *context;
    map_reader reader;
    effects effects; /* at the size errors are measured at */
    char error[ERROR_LENGTH];
} run;

static void read_machine(results *r)
{
    r->cores = (int)sysconf(_SC_NPROCESSORS_ONLN);
    snprintf(r->cpu, sizeof r->cpu, "unknown");
    FILE *f = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (f && fgets(line, sizeof line, f)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon) {
            snprintf(r->cpu, sizeof r->cpu, "%s", colon + 1 + strspn(colon + 1, " \t"));
            r->cpu[strcspn(r->cpu, "\n")] = '\0';
            break;
        }
    }
    if (f)
        fclose(f);
}

static bool open_context(run *r)
{
    r->context =
        context_create(&(context_options){.kind = (context_kind)r->options.context}, r->error, sizeof r->error);
    if (!r->context || !gl_load(context_load, r->context, r->error, sizeof r->error))
        return false;
    r->results.context = context_description(r->context);
    r->results.software = context_is_software(r->context);
    fprintf(stderr, "context: %s\n", r->results.context);
    r->effects = (effects){.context = r->context,
                           .width = r->options.size[0],
                           .height = r->options.size[1],
                           .seed = r->options.seed,
                           .path = (glssao_path)r->options.path};
    return map_reader_create(&r->reader, r->options.size[0], r->options.size[1], r->error, sizeof r->error);
}

static bool make_views(run *r)
{
    results *out = &r->results;
    const int count = bench_scenes_list(&r->options, r->scenes);
    out->views = calloc((size_t)count + 1, sizeof *out->views);
    if (!out->views || count == 0) {
        snprintf(r->error, sizeof r->error, count == 0 ? "no scene is called like that" : "out of memory");
        return false;
    }
    for (int i = 0; i < count; i++) {
        bench_view *v = &out->views[out->view_count++];
        if (!bench_view_create(v, &r->scenes[i], &r->options, r->error, sizeof r->error))
            return false;
        if (v->truth.rays > 0)
            fprintf(stderr, "%s: traced %.0f rays in %.1f s\n", v->name, (double)v->truth.rays, v->truth.seconds);
    }
    return true;
}

static bool make_configs(run *r)
{
    static bench_config configs[BENCH_CONFIGS_MAX];
    timing no_time = {.median_ms = -1, .p95_ms = -1, .cpu_ms = -1};
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++)
        no_time.pass_ms[i] = -1;
    results *out = &r->results;
    /* Silent, as it is asked for what it may refuse. */
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
        *c = (config_result){.config = configs[i], .time = no_time};
        c->views = calloc((size_t)out->view_count, sizeof *c->views);
        for (int v = 0; c->views && v < out->view_count; v++)
            c->views[v].time = no_time;
        if (!c->views) {
            snprintf(r->error, sizeof r->error, "out of memory");
            return false;
        }
    }
    if (count == 0)
        snprintf(r->error, sizeof r->error, "no configuration is called like that");
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
    int chosen = 0; /* the first, where the one asked for is not among them */
    for (int i = 0; i < out->view_count; i++)
        chosen = strcmp(r->scenes[i].name, r->options.time_scene) == 0 ? i : chosen;
    bool timed = times_measure(out, &e, &r->scenes[chosen], -1, r->error, sizeof r->error);
    out->time_scene = timed ? r->scenes[chosen].name : NULL;
    for (int i = 0; timed && r->options.time_all && i < out->view_count; i++)
        timed = times_measure(out, &e, &r->scenes[i], i, r->error, sizeof r->error);
    effects_destroy(&e);
    return timed;
}

/* Of each configuration, where the GPU's time went; nothing on a software rasteriser. */
static void print_passes(const results *out)
{
    for (int i = 0; i < out->config_count && out->time_scene; i++) {
        const timing *t = &out->configs[i].time;
        char line[512];
        int length = 0, known = 0;
        for (int k = 0; k < GLSSAO_PASS_COUNT && length < (int)sizeof line; k++)
            if (t->pass_ms[k] > 0) {
                length += snprintf(line + length, sizeof line - (size_t)length, "  %s %.4f",
                                   glssao_get_stats(NULL).passes[k].name, t->pass_ms[k]);
                known++;
            }
        if (known > 0)
            printf("%-32s %.4f ms:%s\n", out->configs[i].config.id, t->median_ms, line);
    }
}

static bool write_reports(run *r)
{
    const results *out = &r->results;
    char path[4][1024];
    static const char *const names[4] = {"bench.json", "bench.tsv", "bench.gp", "bench.png"};
    for (int i = 0; i < 4; i++)
        snprintf(path[i], sizeof path[i], "%s/%s", r->options.out, names[i]);
    bool drawn = false;
    return report_json(out, path[0], r->error, sizeof r->error) &&
           report_tsv(out, path[1], r->error, sizeof r->error) &&
           report_chart(out, path[2], path[3], &drawn, r->error, sizeof r->error) &&
           report_strips(out, &r->effects, &r->reader, r->options.out, r->error, sizeof r->error) &&
           report_worst_places(out, &r->effects, &r->reader, r->options.out, r->error, sizeof r->error) &&
           (!r->options.doc || report_document(out, r->options.doc, drawn, r->error, sizeof r->error));
}

/* So that whoever waits sees where the time goes. */
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
    read_machine(out);
    if (!make_folder(r->options.out)) {
        snprintf(r->error, sizeof r->error, "%s: no such folder can be made", r->options.out);
        return false;
    }
    double phase_ms = start_ms;
    if (!open_context(r) || !make_views(r) || !make_configs(r))
        return false;
    end_phase("scenes and their truth", &phase_ms);
    if (!errors_measure(out, &r->effects, &r->reader, r->error, sizeof r->error))
        return false;
    end_phase("errors", &phase_ms);
    if (!take_times(r))
        return false;
    end_phase("times", &phase_ms);
    print_passes(out);
    if (r->options.split_seeds > 0 && !split_measure(out, r->context, &r->reader, r->error, sizeof r->error))
        return false;
    end_phase("split", &phase_ms);
    out->seconds = (clock_wall_ms() - start_ms) / 1e3;
    return write_reports(r) && (!r->options.check || check_results(out, &r->scenes[0], r->error, sizeof r->error));
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
    effects_destroy(&r->effects);
    map_reader_destroy(&r->reader);
    context_destroy(r->context);
}

int main(int argc, char **argv)
{
    static run r;
    const options_result parsed = options_parse(argc, argv, &r.options, r.error, sizeof r.error);
    if (parsed != OPTIONS_RUN) {
        if (parsed == OPTIONS_WRONG)
            fprintf(stderr, "glssao-bench: %s\n", r.error);
        return parsed == OPTIONS_WRONG ? EXIT_USAGE : EXIT_DONE;
    }
    const bool done = measure(&r);
    if (done)
        fprintf(stderr, "%d scenes, %d configurations, %.0f s: %s\n", r.results.view_count, r.results.config_count,
                r.results.seconds, r.options.out);
    else
        fprintf(stderr, "glssao-bench: %s\n", r.error);
    release(&r);
    return done ? EXIT_DONE : EXIT_FAILED;
}
