/* SPDX-License-Identifier: MIT
 *
 * Where the time goes: phases of a run, times of benchmark frames, and the file of --stats.
 */
#ifndef GLSSAO_EXAMPLES_REPORT_H
#define GLSSAO_EXAMPLES_REPORT_H

#include "fault.h"
#include "options.h"
#include "progressive.h"
#include "scene.h"
#include "trace.h"

typedef enum phase {
    PHASE_LOAD = 0, /* runs beside PHASE_CONTEXT, on a thread of its own */
    PHASE_CONTEXT,
    PHASE_SETUP, /* upload, targets, shaders */
    PHASE_PREPASS,
    PHASE_AO,
    PHASE_MAIN,
    PHASE_READBACK,
    PHASE_ENCODE, /* summed over the writer's threads, which run beside the rest */
    PHASE_COUNT
} phase;

typedef struct stopwatch {
    bool finish; /* waits for the GL before a phase ends: only where the times are asked for */
    double last_ms;
    double ms[PHASE_COUNT]; /* summed over the frames */
} stopwatch;

/* Starts timing the next phase, without counting what went before. */
void stopwatch_start(stopwatch *w);
/* Ends phase `p`; the next one begins. */
void stopwatch_lap(stopwatch *w, phase p);

typedef struct bench {
    int frames, recorded;
    double *frame_ms, *cpu_ms, *gpu_ms[GLSSAO_PASS_COUNT]; /* one value a frame; gpu_ms below 0: not measured */
} bench;

bool bench_create(bench *b, int frames);
void bench_destroy(bench *b);
void bench_record(bench *b, double frame_ms, double cpu_ms, const glssao_stats *stats);
/* To stdout. `cpu`: the processor's time too, which is what a software rasteriser uses. */
void bench_print(const bench *b, const glssao_stats *stats, bool cpu);

typedef struct report {
    const options *options;
    const scene *scene;
    const char *context;
    const glssao_settings *settings;   /* NULL without occlusion */
    glssao_stats passes;               /* of the last frame */
    const progressive_report *reached; /* NULL but with --error or --budget */
    const stopwatch *times;
    const trace_stats *traced; /* NULL but with -t raytrace */
    const bench *bench;        /* NULL without --bench */
    int frames, samples_per_pixel;
    double wall_ms, cpu_ms; /* of the whole run, up to writing this */
} report;

/* Writes JSON. False, with one line in `why`, where the file can't be written. */
bool report_write(const report *r, const char *path, fault *why);

#endif
