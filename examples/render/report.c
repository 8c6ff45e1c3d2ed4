/* SPDX-License-Identifier: MIT
 *
 * The stopwatch, the benchmark and the JSON of --stats.
 */
#include "report.h"

#include "clock.h"
#include "gl.h"
#include "statistics.h"
#include "whole_file.h"
#include "words.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void stopwatch_start(stopwatch *w)
{
    w->last_ms = clock_wall_ms();
}

void stopwatch_lap(stopwatch *w, phase p)
{
    if (w->finish)
        gl.Finish();
    const double now = clock_wall_ms();
    w->ms[p] += now - w->last_ms;
    w->last_ms = now;
}

bool bench_create(bench *b, int frames)
{
    *b = (bench){.frames = frames};
    double *values = calloc((size_t)frames * (2 + GLSSAO_PASS_COUNT), sizeof *values);
    if (!values)
        return false;
    b->frame_ms = values;
    b->cpu_ms = values + frames;
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++)
        b->gpu_ms[i] = values + (ptrdiff_t)frames * (2 + i);
    return true;
}

void bench_destroy(bench *b)
{
    free(b->frame_ms);
    *b = (bench){0};
}

void bench_record(bench *b, double frame_ms, double cpu_ms, const glssao_stats *stats)
{
    b->frame_ms[b->recorded] = frame_ms;
    b->cpu_ms[b->recorded] = cpu_ms;
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++)
        b->gpu_ms[i][b->recorded] = stats->passes[i].gpu_ms;
    b->recorded++;
}

static void print_times(const char *name, double *values, int count)
{
    printf("%-20s median %8.3f ms   p95 %8.3f ms\n", name, statistics_percentile(values, count, 50),
           statistics_percentile(values, count, 95));
}

void bench_print(const bench *b, const glssao_stats *stats, bool cpu)
{
    printf("%d frames\n", b->recorded);
    print_times("frame", b->frame_ms, b->recorded);
    if (cpu)
        print_times("frame, CPU", b->cpu_ms, b->recorded);
    for (int i = 0; i < GLSSAO_PASS_COUNT; i++) {
        if (stats->passes[i].draw_calls > 0 && statistics_percentile(b->gpu_ms[i], b->recorded, 50) >= 0) {
            char name[64];
            snprintf(name, sizeof name, "%s, GPU", stats->passes[i].name);
            print_times(name, b->gpu_ms[i], b->recorded);
        }
    }
}

/* Length of the UTF-8 sequence at `text` in bytes; 0: it is invalid. */
static int utf8_length(const unsigned char *text)
{
    const int length = text[0] < 0x80                      ? 1
                       : text[0] >= 0xc2 && text[0] < 0xe0 ? 2
                       : text[0] >= 0xe0 && text[0] < 0xf0 ? 3
                       : text[0] >= 0xf0 && text[0] < 0xf5 ? 4
                                                           : 0;
    for (int i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    return length;
}

static void print_string(FILE *f, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    fputc('"', f);
    while (*at) {
        const int length = utf8_length(at);
        if (length == 0)
            fputs("\\ufffd", f);
        else if (*at == '"' || *at == '\\')
            fprintf(f, "\\%c", *at);
        else if (*at < 0x20)
            fprintf(f, "\\u%04x", *at);
        else
            fwrite(at, 1, (size_t)length, f);
        at += length ? length : 1;
    }
    fputc('"', f);
}

static void print_field(FILE *f, const char *name, const char *text)
{
    fprintf(f, "  \"%s\": ", name);
    print_string(f, text);
    fputs(",\n", f);
}

/* Prints null for a negative time, which was not measured. */
static void print_ms(FILE *f, const char *name, double ms)
{
    if (ms < 0)
        fprintf(f, "\"%s\": null", name);
    else
        fprintf(f, "\"%s\": %.3f", name, ms);
}

static void print_scene(FILE *f, const scene *s)
{
    fputs("  \"scene\": {\"name\": ", f);
    print_string(f, s->name);
    fprintf(f, ", \"triangles\": %" PRIu64 ", \"instances\": %u},\n  \"warnings\": [", scene_count_triangles(s),
            s->instance_count);
    for (size_t i = 0; i < s->warning_count; i++) {
        fputs(i ? ", " : "", f);
        print_string(f, s->warnings[i]);
    }
    fputs("],\n", f);
}

static void print_settings(FILE *f, const report *r)
{
    const glssao_settings *s = r->settings;
    if (!s) {
        fputs("  \"settings\": null,\n", f);
        return;
    }
    fprintf(f,
            "  \"settings\": {\"technique\": \"%s\", \"quality\": \"%s\", \"radius\": %.9g, "
            "\"radius_in_pixels\": %s, \"thickness\": %.9g, \"fade_far_start\": %.9g, \"fade_far_end\": %.9g, "
            "\"fade_start\": %.9g, "
            "\"fade_end\": %.9g, \"surface_epsilon\": %.9g, \"power\": %.9g, \"sample_count\": %d, "
            "\"half_resolution\": %s, \"upsample\": %s, \"tiles\": \"%s\", \"blur\": \"%s\", \"blur_rounds\": %d, "
            "\"blur_sigma\": %.9g, "
            "\"blur_normal_threshold\": %.9g, \"blur_depth_threshold\": %.9g, \"history\": %d, "
            "\"noise_index\": %u, \"bent_normals\": %s, \"seed\": %u},\n",
            words_at(ALL_TECHNIQUE_WORDS, (int)s->technique).text, words_at(QUALITY_WORDS, r->options->quality).text,
            (double)s->radius, s->radius_in_pixels ? "true" : "false", (double)s->thickness, (double)s->fade_far_start,
            (double)s->fade_far_end, (double)s->fade_start, (double)s->fade_end, (double)s->surface_epsilon,
            (double)s->power, s->sample_count, s->half_resolution ? "true" : "false", s->upsample ? "true" : "false",
            words_at(TILES_WORDS, (int)s->tiles).text, words_at(BLUR_WORDS, (int)s->blur).text, s->blur_rounds,
            (double)s->blur_sigma, (double)s->blur_normal_threshold, (double)s->blur_depth_threshold, s->history,
            s->noise_index, s->bent_normals ? "true" : "false", r->options->seed);
}

static void print_traced(FILE *f, const report *r)
{
    const glssao_settings *s = r->settings;
    fprintf(f,
            "  \"settings\": {\"technique\": \"raytrace\", \"radius\": %.9g, \"power\": %.9g, \"sample_count\": %d, "
            "\"seed\": %u},\n",
            (double)s->radius, (double)s->power, s->sample_count, r->options->seed);
    fprintf(f, "  \"rays\": %" PRIu64 ",\n  \"rays_per_second\": %.0f,\n", r->traced->rays,
            r->traced->seconds > 0 ? (double)r->traced->rays / r->traced->seconds : 0.0);
}

static void print_passes(FILE *f, const report *r)
{
    fputs("  \"passes\": [", f);
    const char *separator = "\n";
    for (int i = 0; r->settings && !r->traced && i < GLSSAO_PASS_COUNT; i++) {
        const struct glssao_pass_stats *pass = &r->passes.passes[i];
        fprintf(f, "%s    {\"name\": ", separator);
        print_string(f, pass->name ? pass->name : "");
        fprintf(f, ", \"draw_calls\": %d, ", pass->draw_calls);
        print_ms(f, "gpu_ms", pass->gpu_ms);
        fputc('}', f);
        separator = ",\n";
    }
    fputs("\n  ],\n", f);
}

static void print_bench(FILE *f, const bench *b)
{
    fprintf(f, "  \"bench\": {\"frames\": %d, ", b->recorded);
    print_ms(f, "median_ms", statistics_percentile(b->frame_ms, b->recorded, 50));
    fputs(", ", f);
    print_ms(f, "p95_ms", statistics_percentile(b->frame_ms, b->recorded, 95));
    fputs(", ", f);
    print_ms(f, "cpu_median_ms", statistics_percentile(b->cpu_ms, b->recorded, 50));
    fputs("},\n", f);
}

bool report_write(const report *r, const char *path, failure *why)
{
    static const char *const phase_names[PHASE_COUNT] = {"load", "context", "setup",    "prepass",
                                                         "ao",   "main",    "readback", "encode"};
    whole_file file;
    if (!whole_file_open(&file, path, why))
        return false;
    FILE *f = file.file;
    const uint32_t v = glssao_version();
    fprintf(f, "{\n  \"program\": \"glssao-render %d.%d.%d\",\n  \"library\": \"%u.%u.%u\",\n", GLSSAO_VERSION_MAJOR,
            GLSSAO_VERSION_MINOR, GLSSAO_VERSION_PATCH, v >> 16, v >> 8 & 255, v & 255);
    print_field(f, "context", r->context);
    print_scene(f, r->scene);
    fprintf(f, "  \"width\": %d,\n  \"height\": %d,\n  \"frames\": %d,\n  \"samples_per_pixel\": %d,\n",
            r->options->width, r->options->height, r->frames, r->samples_per_pixel);
    if (r->traced)
        print_traced(f, r);
    else
        print_settings(f, r);
    print_passes(f, r);
    if (r->reached)
        fprintf(f, "  \"estimates\": %d,\n  \"sampling_error\": %.6g,\n", r->reached->estimates,
                r->reached->sampling_error);
    if (r->bench)
        print_bench(f, r->bench);
    fputs("  \"ms\": {", f);
    for (int i = 0; i < PHASE_COUNT; i++) {
        print_ms(f, phase_names[i], r->times->ms[i]);
        fputs(", ", f);
    }
    print_ms(f, "wall", r->wall_ms);
    fputs(", ", f);
    print_ms(f, "cpu", r->cpu_ms);
    fputs("}\n}\n", f);
    const bool written = !ferror(f);
    if (!written)
        fault_set(why, "%s: it could not be written in full", path);
    return whole_file_close(&file, written, why);
}
