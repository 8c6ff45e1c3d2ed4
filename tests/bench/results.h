/* SPDX-License-Identifier: MIT
 *
 * Everything a run finds out.
 */
#pragma once

#include "configs.h"
#include "context.h"
#include "measure.h"
#include "options.h"
#include "views.h"

/* Milliseconds; NAN: not measured. */
typedef struct timing {
    double median_ms, p95_ms;          /* of glssao_compute: GPU time, or wall clock on a software rasteriser */
    double cpu_ms;                     /* median of the process's own, all threads */
    double pass_ms[GLSSAO_PASS_COUNT]; /* medians by timer queries; not on a software rasteriser */
} timing;

/* One configuration on one view; NAN: not measured. Contrast techniques are measured with power 1 and then raised to
 * the exponent that fits best over all views; only `by_default` has the power that the settings come with. */
typedef struct view_result {
    error_measure error;
    double by_default_rmse, by_default_mean;
    double own_exponent, own_rmse; /* the exponent that fits this view alone */
    double flat_rmse, flat_mean;   /* against the truth about the surface's own normal */
    double ssim, flip, grain, specks, frame_change, roll_change;
    timing time;
} view_result;

typedef struct config_result {
    bench_config config;
    double exponent; /* 1, or for contrast techniques the one that fits best over all views */
    view_result *views;
} config_result;

enum { THICKNESS_COUNT = 8 };

/* Each on top of the ones before. */
typedef enum split_step {
    STEP_LAYER = 0,
    STEP_ESTIMATOR,
    STEP_HALF,
    STEP_NOISE,
    STEP_DENOISE,
    STEP_CONTRAST,
    STEP_COUNT
} split_step;

/* RMSE of one view. */
typedef struct split_view {
    double alone[STEP_COUNT]; /* against the step before; against the truth for the first */
    double total[STEP_COUNT]; /* against the truth; NAN: the technique has no such step */
} split_view;

typedef struct split_result {
    const config_result *of;
    split_view *views;
} split_result;

typedef struct oracle_result {
    double thickness[THICKNESS_COUNT]; /* of the radius */
    double (*rmse)[THICKNESS_COUNT];   /* a view */
    int best;                          /* of thickness, over all views */
} oracle_result;

/* The default level of each technique, and the others of horizon. */
enum { BENCH_SPLITS = BENCH_TECHNIQUES + GLSSAO_ULTRA };

typedef struct results {
    const options *options;
    const context *context;
    bool software;
    int cores;
    bench_scene scenes[BENCH_SCENES_MAX];
    bench_view *views; /* of the scenes, by index */
    int view_count;
    struct peer_bench *peers; /* NULL: none */
    config_result *configs;
    int config_count;
    oracle_result oracle;
    split_result splits[BENCH_SPLITS];
    int split_count; /* 0: not measured */
} results;

/* The quality level of a technique as it comes; NULL where it was not measured. */
const config_result *results_level(const results *r, glssao_technique technique, glssao_quality level);
