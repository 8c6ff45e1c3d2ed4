/* SPDX-License-Identifier: MIT
 *
 * glssao-render: renders a scene to pictures without a display. The file is loaded on a second thread while the
 * context is made, and pictures are encoded while the next one is drawn.
 */
#define _POSIX_C_SOURCE 200809L
#include "clock.h"
#include "context.h"
#include "gl.h"
#include "options.h"
#include "outputs.h"
#include "pipeline.h"
#include "report.h"
#include "viewpoint.h"
#include "writer.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { EXIT_DONE = 0, EXIT_NOT_RENDERED = 1, EXIT_USAGE = 2, ERROR_LENGTH = 8192, WARM_UP_FRAMES = 3 };

typedef struct loader {
    pthread_t thread;
    bool running;
    const options *options;
    scene *scene;
    double ms;
    char error[ERROR_LENGTH];
} loader;

typedef struct run {
    options options;
    loader loader;
    context *context;
    pipeline pipeline;
    viewpoint viewpoint;
    writer *writer;
    stopwatch times;
    bench bench;
    int frames_drawn;
    char error[ERROR_LENGTH];
} run;

static void *load_scene(void *argument)
{
    loader *l = argument;
    const double start = clock_wall_ms();
    const options *o = l->options;
    l->scene = o->scene_path ? scene_load(o->scene_path, l->error, sizeof l->error)
                             : scene_make(o->scene_name, l->error, sizeof l->error);
    l->ms = clock_wall_ms() - start;
    return NULL;
}

/* Scene and context side by side. */
static bool open_scene_and_context(run *r)
{
    loader *l = &r->loader;
    l->options = &r->options;
    l->running = pthread_create(&l->thread, NULL, load_scene, l) == 0;
    if (!l->running) { /* no more threads: then here */
        load_scene(l);
    }
    stopwatch_start(&r->times);
    r->context =
        context_create(&(context_options){.kind = (context_kind)r->options.context}, r->error, sizeof r->error);
    const bool loaded = r->context && gl_load(context_load, r->context, r->error, sizeof r->error);
    r->times.ms[PHASE_CONTEXT] = clock_wall_ms() - r->times.last_ms;
    if (l->running) {
        pthread_join(l->thread, NULL);
    }
    r->times.ms[PHASE_LOAD] = l->ms;
    if (!loaded) {
        return false;
    }
    fprintf(stderr, "context: %s\n", context_description(r->context));
    if (!l->scene) {
        memcpy(r->error, l->error, sizeof r->error);
        return false;
    }
    return true;
}

static pipeline_wants choose_wants(const options *o)
{
    const bool maps_alone = !o->output && (o->ao || o->normals || o->depth);
    pipeline_wants wants = {.picture = o->bench || !maps_alone};
    wants.ao = !o->no_ao && (wants.picture || o->ao);
    wants.ao_map = o->ao || o->debug_map == OPTIONS_MAP_AO || o->debug_map == OPTIONS_MAP_TILES;
    wants.traced = wants.ao && o->technique == OPTIONS_RAYTRACE;
    wants.normals = (wants.ao && !wants.traced) || o->normals || o->debug_map == OPTIONS_MAP_NORMALS ||
                    o->debug_map == OPTIONS_MAP_RANDOM;
    wants.timers = o->stats || o->bench;
    wants.prepass = wants.picture || wants.normals || o->depth;
    return wants;
}

/* With the margin on it. */
static bool find_view(run *r, float angle_rad, scene_view *out_view)
{
    const options *o = &r->options;
    if (!viewpoint_view(&r->viewpoint, r->loader.scene, angle_rad, o->width, o->height, out_view, r->error,
                        sizeof r->error)) {
        return false;
    }
    *out_view = camera_widened_view(out_view, o->margin);
    return true;
}

static bool draw(run *r, float angle_rad, scene_view *out_view)
{
    return find_view(r, angle_rad, out_view) &&
           pipeline_draw(&r->pipeline, out_view, &r->times, r->error, sizeof r->error);
}

/* Whole frames, each waited for, and without read-back. */
static bool run_bench(run *r)
{
    if (!bench_create(&r->bench, r->options.bench)) {
        snprintf(r->error, sizeof r->error, "--bench %d: out of memory", r->options.bench);
        return false;
    }
    stopwatch *times = &r->times;
    const stopwatch before = *times;
    glssao_stats stats = {0};
    times->finish = false; /* a frame flows as it would in a program: no wait between its passes */
    for (int i = -WARM_UP_FRAMES; i < r->options.bench; i++) {
        scene_view view;
        const double wall = clock_wall_ms(), cpu = clock_cpu_ms();
        if (!draw(r, 0, &view)) {
            return false;
        }
        gl.Finish();
        const double wall_ms = clock_wall_ms() - wall, cpu_ms = clock_cpu_ms() - cpu;
        stats = glssao_get_stats(r->pipeline.effect);
        if (i >= 0) {
            bench_record(&r->bench, wall_ms, cpu_ms, &stats);
        }
    }
    *times = before;
    bench_print(&r->bench, &stats, context_is_software(r->context));
    return true;
}

static void print_progress(int done, int count, double start_ms, double *last_ms)
{
    const double now = clock_wall_ms();
    const bool is_terminal = isatty(STDERR_FILENO);
    if (done < count && now - *last_ms < (is_terminal ? 100 : 5000)) {
        return;
    }
    *last_ms = now;
    const double rate = done / ((now - start_ms) / 1e3);
    fprintf(stderr, "%sframe %d of %d, %.1f a second, %.0f s left%s", is_terminal ? "\r" : "", done, count, rate,
            (count - done) / rate,
            is_terminal && done < count ? "   "
            : is_terminal               ? "   \n"
                                        : "\n");
}

static bool draw_frames(run *r)
{
    const float full_turn = 6.283185307f;
    const int count = r->options.frames ? r->options.frames : 1;
    const double start = clock_wall_ms();
    double last_progress = start;
    for (int i = 0; i < count; i++) {
        scene_view view;
        stopwatch_start(&r->times);
        if (!draw(r, full_turn * (float)i / (float)count, &view)) {
            return false;
        }
        const int number = r->options.frames ? i + 1 : 0;
        if (!outputs_take(&r->options, &r->pipeline, &view, number, r->writer, r->error, sizeof r->error)) {
            return false;
        }
        stopwatch_lap(&r->times, PHASE_READBACK);
        r->frames_drawn++;
        if (r->options.frames) {
            print_progress(i + 1, count, start, &last_progress);
        }
    }
    return true;
}

static bool write_stats(run *r, const glssao_stats *passes, const char *context_text, double start_ms)
{
    const report facts = {.options = &r->options,
                          .scene = r->loader.scene,
                          .context = context_text,
                          .settings = r->pipeline.wants.ao ? &r->pipeline.settings : NULL,
                          .passes = *passes,
                          .reached = r->pipeline.reached.estimates ? &r->pipeline.reached : NULL,
                          .times = &r->times,
                          .traced = r->pipeline.wants.traced ? &r->pipeline.truth.stats : NULL,
                          .bench = r->bench.recorded ? &r->bench : NULL,
                          .frames = r->frames_drawn,
                          .wall_ms = clock_wall_ms() - start_ms,
                          .cpu_ms = clock_cpu_ms()};
    return report_write(&facts, r->options.stats, r->error, sizeof r->error);
}

/* All but the command line. False, with r->error, where it could not render. */
static bool render(run *r, double start_ms)
{
    const options *o = &r->options;
    if (!outputs_check(o, r->error, sizeof r->error) || !open_scene_and_context(r)) {
        return false;
    }
    r->times.finish = o->stats || o->bench;
    r->writer = writer_create();
    if (!r->writer) {
        snprintf(r->error, sizeof r->error, "out of memory");
        return false;
    }
    scene_view view;
    stopwatch_start(&r->times);
    if (!viewpoint_choose(o, r->loader.scene, &r->viewpoint, r->error, sizeof r->error) || !find_view(r, 0, &view) ||
        !pipeline_create(&r->pipeline, r->loader.scene, context_load, r->context, o, choose_wants(o), r->error,
                         sizeof r->error)) {
        return false;
    }
    stopwatch_lap(&r->times, PHASE_SETUP);
    if (o->plan) {
        pipeline_print_plan(&r->pipeline, &view);
    }
    if (o->bench && !run_bench(r)) {
        return false;
    }
    const bool wants_frame = o->output || o->ao || o->normals || o->depth || (o->stats && !o->bench);
    if (wants_frame && !draw_frames(r)) {
        return false;
    }
    const glssao_stats passes = glssao_get_stats(r->pipeline.effect);
    if (!writer_finish(r->writer, &r->times.ms[PHASE_ENCODE], r->error, sizeof r->error)) {
        return false;
    }
    return !o->stats || write_stats(r, &passes, context_description(r->context), start_ms);
}

int main(int argc, char **argv)
{
    const double start_ms = clock_wall_ms();
    static run r; /* large, and zero */
    switch (options_parse(argc, argv, &r.options, r.error, sizeof r.error)) {
    case OPTIONS_DONE:
        return EXIT_DONE;
    case OPTIONS_WRONG:
        fprintf(stderr, "glssao-render: %s\n", r.error);
        return EXIT_USAGE;
    case OPTIONS_RUN:
        break;
    }
    const bool done = render(&r, start_ms);
    writer_destroy(r.writer);
    bench_destroy(&r.bench);
    if (r.context) {
        pipeline_destroy(&r.pipeline);
    }
    context_destroy(r.context);
    scene_destroy(r.loader.scene);
    if (!done) {
        fprintf(stderr, "glssao-render: %s\n", r.error);
    }
    return done ? EXIT_DONE : EXIT_NOT_RENDERED;
}
