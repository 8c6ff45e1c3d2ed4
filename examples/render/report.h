/* SPDX-License-Identifier: MIT
 *
 * Where the time goes: the phases of a run, the times of benchmark frames, and the file of --stats.
 */
#pragma once

#include "fault.h"
#include "options.h"
#include "progressive.h"
#include "scene.h"
#include "trace.h"

typedef enum phase {
    PHASE_LOAD = 0, /* on a second thread, at the same time as PHASE_CONTEXT */
    PHASE_CONTEXT,
    PHASE_SETUP, /* upload, targets, shaders */
    PHASE_PREPASS,
    PHASE_AO,
    PHASE_MAIN,
    PHASE_READBACK,
    PHASE_ENCODE, /* sum over the writer's threads, which run at the same time as the other phases */
    PHASE_COUNT
} phase;

typedef struct stopwatch {
    bool finish; /* call glFinish at the end of each phase, so that the times are true */
    double last_ms;
    double ms[PHASE_COUNT]; /* sum over the frames */
} stopwatch;

/* Starts the next phase. The time since the last one ended is not counted. */
void stopwatch_start(stopwatch *w);
/* Ends phase `p` and starts the next one. */
void stopwatch_lap(stopwatch *w, phase p);

typedef struct bench {
    int frames, recorded;
    double *frame_ms, *cpu_ms, *gpu_ms[GLSSAO_PASS_COUNT]; /* one value for each frame; gpu_ms below 0: not measured */
} bench;

bool bench_create(bench *b, int frames);
void bench_destroy(bench *b);
void bench_record(bench *b, double frame_ms, double cpu_ms, const glssao_stats *stats);
/* Prints to stdout and sorts the values. `cpu`: print processor time too, for a software rasteriser. */
void bench_print(const bench *b, const glssao_stats *stats, bool cpu);

typedef struct report {
    const options *options;
    const scene *scene;
    const char *context;
    const glssao_settings *settings;   /* NULL: no occlusion */
    glssao_stats passes;               /* of the last frame */
    const progressive_report *reached; /* only with --error or --budget, else NULL */
    const stopwatch *times;
    const trace_stats *traced; /* only with -t raytrace, else NULL */
    const bench *bench;        /* only with --bench, else NULL */
    int frames, samples_per_pixel;
    double wall_ms, cpu_ms; /* of the whole run until now */
} report;

/* Writes JSON. False, with one line in `why`, if the file cannot be written. */
bool report_write(const report *r, const char *path, failure *why);
