/* SPDX-License-Identifier: MIT
 *
 * glssao-economy: what a frame saves by skipping passes and tiles that the scene does not need. It times frames with
 * and without, in turns, and writes tables. No rays are traced.
 */
#define _POSIX_C_SOURCE 200809L
#include "economy.h"

#include "clock.h"
#include "configs.h"
#include "gbuffer.h"
#include "gl_counter.h"
#include "measure.h"
#include "scenes.h"
#include "statistics.h"
#include "tool.h"
#include "truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WARM_UP_FRAMES = 2 };

static const struct {
    const char *name;
    glssao_technique technique;
    glssao_quality quality;
} configs[ECONOMY_CONFIGS] = {{"horizon-medium", GLSSAO_HORIZON, GLSSAO_MEDIUM},
                              {"horizon-high", GLSSAO_HORIZON, GLSSAO_HIGH},
                              {"horizon-ultra", GLSSAO_HORIZON, GLSSAO_ULTRA},
                              {"classic-high", GLSSAO_CLASSIC, GLSSAO_HIGH},
                              {"hemisphere-high", GLSSAO_HEMISPHERE, GLSSAO_HIGH}};

glssao_settings economy_settings(int config)
{
    return glssao_default_settings(configs[config].technique, configs[config].quality);
}

const char *economy_config_name(int config)
{
    return configs[config].name;
}

double economy_skipped_share(const glssao_effect *effect)
{
    int width, height;
    const uint32_t map = glssao_map(effect, GLSSAO_MAP_TILES, &width, &height);
    float *rings = map ? malloc((size_t)width * (size_t)height * sizeof *rings) : NULL;
    if (!rings)
        return 0;
    gl.BindTexture(GL_TEXTURE_2D, map);
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, rings);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    int skipped = 0;
    for (int i = 0; i < width * height; i++)
        skipped += rings[i] > 0;
    free(rings);
    return (double)skipped / (width * height);
}

/* CPU time of all threads on a software rasteriser, GPU time otherwise. */
static bool run_once(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings, bool software,
                     double *out_ms, failure *fault)
{
    gl.Finish();
    const double start = clock_cpu_ms();
    const glssao_result result = glssao_compute(effect, frame, settings);
    gl.Finish();
    *out_ms = clock_cpu_ms() - start;
    if (result != GLSSAO_OK)
        fault_set(fault, "glssao_compute: %s", glssao_result_string(result));
    else if (!software && glssao_get_stats(effect).gpu_ms >= 0)
        *out_ms = glssao_get_stats(effect).gpu_ms;
    return result == GLSSAO_OK;
}

/* The greatest difference of the two results, in steps of R16. */
static double worst_difference(glssao_effect *const effects[2])
{
    float *pictures[2] = {NULL, NULL};
    double worst = -1;
    int w = 0, h = 0;
    for (int i = 0; i < 2; i++) {
        const uint32_t map = glssao_map(effects[i], GLSSAO_MAP_AMBIENT, &w, &h);
        pictures[i] = malloc((size_t)w * (size_t)h * sizeof(float));
        gl.BindTexture(GL_TEXTURE_2D, map);
        if (pictures[i])
            gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, pictures[i]);
        gl.BindTexture(GL_TEXTURE_2D, 0);
    }
    for (int i = 0; pictures[0] && pictures[1] && i < w * h; i++) {
        const double off = fabs((double)pictures[0][i] - (double)pictures[1][i]) * 65535;
        worst = !(off <= worst) ? off : worst; /* also for NaN */
    }
    free(pictures[0]);
    free(pictures[1]);
    return worst;
}

bool economy_compare(const economy *e, const glssao_frame *frame, int width, int height,
                     const glssao_settings *settings, economy_row *out, failure *fault)
{
    static const glssao_tiles tiles[2] = {GLSSAO_TILES_OFF, GLSSAO_TILES_ON};
    const int frames = e->options->frames > 0 ? e->options->frames : 1;
    glssao_effect *effects[2] = {NULL, NULL};
    double *ms = calloc((size_t)frames * 2, sizeof *ms);
    bool done = ms != NULL;
    for (int i = 0; done && i < 2; i++) {
        gl_counter_start(context_load, e->context);
        const glssao_config config = {.load = gl_counter_load,
                                      .log = glssao_log_to_stderr,
                                      .width = width,
                                      .height = height,
                                      .no_timers = e->software,
                                      .path = GLSSAO_PATH_FRAGMENT}; /* only draws can skip tiles */
        glssao_settings s = *settings;
        s.tiles = tiles[i];
        done = glssao_create(&config, &effects[i]) == GLSSAO_OK && glssao_compute(effects[i], frame, &s) == GLSSAO_OK;
        const gl_counts counts = gl_counter_take();
        out->programs[i] = counts.programs;
        out->bytes[i] = counts.bytes;
    }
    if (!done)
        fault_set(fault, "no first frame of %dx%d", width, height);
    for (int f = -WARM_UP_FRAMES; done && f < frames; f++)
        for (int i = 0; done && i < 2; i++) {
            glssao_settings s = *settings;
            s.tiles = tiles[i];
            double one;
            done = run_once(effects[i], frame, &s, e->software, &one, fault);
            if (f >= 0)
                ms[i * frames + f] = one;
        }
    for (int i = 0; done && i < 2; i++)
        out->ms[i] = statistics_percentile(ms + i * frames, frames, 50);
    out->skipped = done ? economy_skipped_share(effects[1]) : 0;
    out->worst = done ? worst_difference(effects) : -1;
    glssao_destroy(effects[0]);
    glssao_destroy(effects[1]);
    free(ms);
    return done;
}

static const char *const first_names[ECONOMY_FIRSTS] = {"no cache", "the driver's cache",
                                                        "the driver's cache; program_cache is being written",
                                                        "the driver's cache and program_cache"};

const char *economy_first_name(int first)
{
    return first_names[first];
}

static bool measure_firsts(economy *e, const char *folder, failure *fault)
{
    const int w = e->options->time_size[0], h = e->options->time_size[1];
    scene_view view;
    float radius;
    bench_scene b = {.name = "columns", .radius = 1};
    gbuffer g = {.depth = 0};
    scene *s = bench_scene_open(&b, w, h, &view, &radius, fault);
    bool done = s && gbuffer_draw(&g, s, &view, 0, fault);
    const glssao_frame frame = gbuffer_frame(&g, false);
    for (int i = 0; done && i < ECONOMY_FIRSTS; i++) {
        const glssao_config config = {.load = context_load,
                                      .load_user = e->context,
                                      .log = glssao_log_to_stderr,
                                      .width = w,
                                      .height = h,
                                      .program_cache = i >= 2 ? folder : NULL};
        const glssao_settings settings = economy_settings(0);
        glssao_effect *effect = NULL;
        gl.Finish();
        const double start = e->software ? clock_cpu_ms() : clock_wall_ms();
        done = glssao_create(&config, &effect) == GLSSAO_OK && glssao_compute(effect, &frame, &settings) == GLSSAO_OK;
        gl.Finish();
        e->first_ms[i] = (e->software ? clock_cpu_ms() : clock_wall_ms()) - start;
        glssao_destroy(effect);
        fprintf(stderr, "first frame, %s: %.1f ms\n", first_names[i], e->first_ms[i]);
    }
    gbuffer_destroy(&g);
    scene_destroy(s);
    return done;
}

static bool measure_scene(economy *e, const bench_scene *b, failure *fault)
{
    scene_view view;
    float radius;
    gbuffer g = {.depth = 0};
    scene *s = bench_scene_open(b, e->options->time_size[0], e->options->time_size[1], &view, &radius, fault);
    bool done = s && gbuffer_draw(&g, s, &view, 0, fault);
    for (int t = 0; done && t < ECONOMY_CONFIGS; t++) {
        economy_row *row = &e->rows[e->row_count++];
        *row = (economy_row){.config = t};
        snprintf(row->name, sizeof row->name, "%s", b->name);
        const glssao_settings settings = economy_settings(t);
        const glssao_settings scaled = bench_scale_settings(&settings, radius);
        const glssao_frame frame = gbuffer_frame(&g, false);
        done = economy_compare(e, &frame, view.width, view.height, &scaled, row, fault);
        fprintf(stderr, "%-24s %-18s off %8.2f ms, on %8.2f ms, ratio %.3f, skipped %.3f, worst %.2f steps\n",
                row->name, economy_config_name(t), row->ms[0], row->ms[1], row->ms[1] / row->ms[0], row->skipped,
                row->worst);
        if (done && e->options->check && !(row->worst <= 1.01)) {
            fault_set(fault, "%s, %s: the pictures differ by %.1f steps", row->name, economy_config_name(t),
                      row->worst);
            done = false;
        }
    }
    gbuffer_destroy(&g);
    scene_destroy(s);
    return done;
}

static bool measure(economy *e, failure *fault)
{
    static bench_scene scenes[BENCH_SCENES_MAX];
    char *folder = e->driver_cache;
    const double start = clock_wall_ms();
    /* Set before there is a context, so that no program of an earlier run is found in the driver's cache. */
    snprintf(folder, sizeof e->driver_cache, "%s/shader-cache-%ld", e->options->out, (long)getpid());
    if (!make_folder(folder))
        return fault_set(fault, "%s: no such folder can be made", folder);
    setenv("MESA_SHADER_CACHE_DIR", folder, 1);
    setenv("__GL_SHADER_DISK_CACHE_PATH", folder, 1);
    const int count = bench_scenes_list(e->options, scenes);
    e->context = tool_open(e->options, fault);
    if (!e->context)
        return false;
    e->software = context_is_software(e->context);
    e->rows = calloc((size_t)(count + 1) * ECONOMY_CONFIGS, sizeof *e->rows);
    e->wholes = calloc((size_t)count + 1, sizeof *e->wholes);
    if (!e->rows || !e->wholes || !measure_firsts(e, folder, fault))
        return false;
    for (int i = 0; i < count; i++)
        if (!measure_scene(e, &scenes[i], fault))
            return false;
    if (!economy_measure_wholes(e, scenes, count, fault) || !economy_measure_shares(e, fault) ||
        !economy_measure_steps(e, fault))
        return false;
    fprintf(stderr, "%d scenes, %.0f s: %s\n", count, (clock_wall_ms() - start) / 1e3, e->options->out);
    return economy_write(e, fault);
}

int main(int argc, char **argv)
{
    static options o;
    static char error[4096];
    const int code = tool_begin("glssao-economy", argc, argv, &o);
    if (code >= 0)
        return code;
    static economy e;
    e.options = &o;
    e.step_scene = o.time_scene;
    const bool done = measure(&e, FAULT(error));
    free(e.rows);
    free(e.wholes);
    context_destroy(e.context);
    return tool_end("glssao-economy", done, error);
}
